// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/document/document.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace fuzz {

Document number(double value) {
    constexpr double kLargestWhole = 0x1p53;
    if (std::isnan(value) && std::signbit(value)) {
        return text("-nan");
    }
    Document out;
    const bool is_negative_zero = std::fpclassify(value) == FP_ZERO && std::signbit(value);
    if (std::fabs(value) < kLargestWhole && std::floor(value) >= value && !is_negative_zero) {
        out.kind = Kind::integer;
        out.integer = static_cast<int64_t>(value);
    } else {
        out.kind = Kind::floating;
        out.floating = value;
    }
    return out;
}

Document text(std::string value) {
    Document out;
    out.kind = Kind::string;
    out.string = std::move(value);
    return out;
}

Document boolean(bool value) {
    Document out;
    out.kind = Kind::boolean;
    out.boolean = value;
    return out;
}

Document list(std::vector<Document> elements) {
    Document out;
    out.kind = Kind::array;
    out.array = std::move(elements);
    return out;
}

Document numbers(const std::vector<double>& values) {
    std::vector<Document> elements;
    elements.reserve(values.size());
    for (const double value : values) {
        elements.push_back(number(value));
    }
    return list(std::move(elements));
}

Document table() {
    return {};
}

Document* find(Document& table, std::string_view key) {
    const auto entry = std::find_if(table.table.begin(), table.table.end(),
                                    [&](const cases::TomlEntry& e) { return e.key == key; });
    return entry == table.table.end() ? nullptr : &entry->value;
}

Document& set(Document& table, std::string_view key, Document value) {
    if (Document* entry = find(table, key)) {
        return *entry = std::move(value);
    }
    table.table.push_back({std::string(key), {}, std::move(value)});
    return table.table.back().value;
}

bool erase(Document& table, std::string_view key) {
    return std::erase_if(table.table, [&](const cases::TomlEntry& e) { return e.key == key; }) > 0;
}

bool erase_at(Document* table, std::string_view key, size_t element) {
    Document* list = table == nullptr ? nullptr : find(*table, key);
    if (list == nullptr || element >= list->array.size()) {
        return false;
    }
    list->array.erase(list->array.begin() + static_cast<std::ptrdiff_t>(element));
    return !list->array.empty() || erase(*table, key);
}

bool erase_color(Document& document) {
    Document* target = find(document, "target");
    if (target == nullptr || !erase(*target, "color")) {
        return false;
    }
    for (const char* key : {"judged", "attachments", "resolve"}) {
        erase(*target, key);
    }
    for_each_draw(document, [](Document& draw) { erase(draw, "color"); });
    return true;
}

static uint64_t bits_of(double value) {
    return std::bit_cast<uint64_t>(std::isnan(value) ? std::numeric_limits<double>::quiet_NaN()
                                                     : value);
}

bool is_same(const Document& a, const Document& b) {
    return a.kind == b.kind && a.boolean == b.boolean && a.integer == b.integer &&
           bits_of(a.floating) == bits_of(b.floating) && a.string == b.string &&
           std::ranges::equal(a.array, b.array, is_same) && a.table.size() == b.table.size() &&
           std::ranges::all_of(a.table, [&](const cases::TomlEntry& entry) {
               const Document* other = b.find(entry.key);
               return other != nullptr && is_same(entry.value, *other);
           });
}

}  // namespace fuzz
