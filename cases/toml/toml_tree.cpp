// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/toml/toml_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cases::tree {

TomlValue number(double value) {
    constexpr double kLargestWhole = 0x1p53;
    if (std::isnan(value) && std::signbit(value)) {
        return text("-nan");
    }
    TomlValue out;
    const bool is_negative_zero = std::fpclassify(value) == FP_ZERO && std::signbit(value);
    if (std::fabs(value) < kLargestWhole && std::floor(value) >= value && !is_negative_zero) {
        out.kind = TomlValue::Kind::integer;
        out.integer = static_cast<int64_t>(value);
    } else {
        out.kind = TomlValue::Kind::floating;
        out.floating = value;
    }
    return out;
}

TomlValue text(std::string_view value) {
    TomlValue out;
    out.kind = TomlValue::Kind::string;
    out.string = value;
    return out;
}

TomlValue boolean(bool value) {
    TomlValue out;
    out.kind = TomlValue::Kind::boolean;
    out.boolean = value;
    return out;
}

TomlValue list(std::vector<TomlValue> elements) {
    TomlValue out;
    out.kind = TomlValue::Kind::array;
    out.array = std::move(elements);
    return out;
}

TomlValue numbers(const std::vector<double>& values) {
    std::vector<TomlValue> elements;
    elements.reserve(values.size());
    for (const double value : values) {
        elements.push_back(number(value));
    }
    return list(std::move(elements));
}

TomlValue* find(TomlValue& table, std::string_view key) {
    const auto entry = std::ranges::find(table.table, key, &TomlEntry::key);
    return entry == table.table.end() ? nullptr : &entry->value;
}

TomlValue& set(TomlValue& table, std::string_view key, TomlValue value) {
    if (TomlValue* entry = find(table, key)) {
        return *entry = std::move(value);
    }
    table.table.push_back({std::string(key), {}, std::move(value)});
    return table.table.back().value;
}

}  // namespace cases::tree
