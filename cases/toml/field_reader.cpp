// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/toml/field_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "cases/base/counted.hpp"
#include "cases/select/selector.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

Number from_double(double value) {
    return {exact(value), std::fpclassify(value) == FP_ZERO && std::signbit(value)};
}

}  // namespace

std::string alternatives(Words words) {
    std::string text;
    for (size_t i = 0; i < words.size(); ++i) {
        text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
        text += fmt::format("\"{}\"", words[i]);
    }
    return text;
}

LeafContext::LeafContext(std::vector<Parameter> parameters) : parameters_(std::move(parameters)) {}

const TomlValue* LeafContext::parameter(std::string_view key) {
    for (const auto& [name, value] : parameters_) {
        if (name == key) {
            used_.insert(name);
            return value;
        }
    }
    return nullptr;
}

Names LeafContext::names(const std::vector<std::pair<std::string, Number>>& more) {
    Names names;
    for (const auto& [name, value] : more) {
        names.known.push_back(name);
    }
    for (const auto& [name, value] : parameters_) {
        names.known.push_back(name);
    }
    names.find = [this, more](std::string_view word) -> std::optional<Number> {
        for (const auto& [name, value] : more) {
            if (name == word) {
                return value;
            }
        }
        const TomlValue* value = parameter(word);
        if (value == nullptr) {
            return std::nullopt;
        }
        if (value->is(Kind::integer)) {
            return Number{mpq_class(mpz_class(static_cast<long>(value->integer))), false};
        }
        if (value->is(Kind::floating) && std::isfinite(value->floating)) {
            return from_double(value->floating);
        }
        if (value->is(Kind::string)) {
            if (tl::expected<Number, std::string> n = evaluate(value->string, Names{})) {
                return *n;
            }
        }
        return std::nullopt;
    };
    names.why = [this](std::string_view word) -> std::string {
        const TomlValue* value = parameter(word);
        if (value == nullptr) {
            return "";
        }
        return fmt::format(
            "the value of the matrix key {} in line {} is no number; there, expressions have no "
            "names",
            word, value->where.line);
    };
    return names;
}

void LeafContext::error(const SourceLocation& where, std::string message) {
    errors_.push_back({where, std::move(message)});
}

std::optional<Number> LeafContext::number(const TomlValue& value, const std::string& what) {
    // Only expressions have names.
    return number(value, what, value.is(Kind::string) ? names() : Names{});
}

std::optional<Number> LeafContext::number(const TomlValue& value, const std::string& what,
                                          const Names& names) {
    if (value.is(Kind::integer)) {
        return Number{mpq_class(mpz_class(static_cast<long>(value.integer))), false};
    }
    if (value.is(Kind::floating)) {
        if (!std::isfinite(value.floating)) {
            error(value.where,
                  fmt::format(
                      "{} is not a finite number; inf and nan may stand in positions of space "
                      "\"clip\" and in attributes only",
                      what));
            return std::nullopt;
        }
        return from_double(value.floating);
    }
    if (value.is(Kind::string) && value.string.starts_with("bits(")) {
        error(value.where,
              fmt::format("{}: \"{}\" may stand in positions of space \"clip\" and in attributes "
                          "only",
                          what, value.string));
        return std::nullopt;
    }
    if (value.is(Kind::string)) {
        tl::expected<Number, std::string> n = evaluate(value.string, names);
        if (!n) {
            error(value.where, fmt::format("{}: {}", what, n.error()));
            return std::nullopt;
        }
        return *n;
    }
    error(value.where, fmt::format("{} is {}; write a number or an expression in quotes", what,
                                   describe(value)));
    return std::nullopt;
}

std::optional<Number> LeafContext::any_binary32(const TomlValue& value, const std::string& what) {
    if (value.is(Kind::floating) && !std::isfinite(value.floating)) {
        return number_of_bits(std::bit_cast<uint32_t>(static_cast<float>(value.floating)));
    }
    if (!value.is(Kind::string)) {
        return number(value, what);
    }
    const std::string text = named_text(value.string);
    if (std::optional<Number> special = read_special_number(text)) {
        return special;
    }
    if (text.rfind("bits(", 0) == 0) {
        error(
            value.where,
            fmt::format("{}: \"{}\" is not the bits of a binary32; write eight hexadecimal digits "
                        "as in \"bits(0x7fc00001)\"",
                        what, text));
        return std::nullopt;
    }
    return number(value, what);
}

std::optional<float> LeafContext::share(const TomlValue& value, const Key& key) {
    const std::optional<Number> n = number(value, std::string(key.name));
    if (n && (n->value < 0 || n->value > 1)) {
        error(value.where, fmt::format("{} is outside 0..1{}", key.name, key.advice));
        return std::nullopt;
    }
    return n ? std::optional(round_to_binary32(*n).value) : std::nullopt;
}

std::optional<int64_t> LeafContext::integer(const TomlValue& value, const std::string& what,
                                            int64_t low, int64_t high) {
    const std::optional<Number> n = number(value, what);
    if (!n) {
        return std::nullopt;
    }
    if (n->value.get_den() != 1 || n->value < mpz_class(static_cast<long>(low)) ||
        n->value > mpz_class(static_cast<long>(high))) {
        error(value.where, fmt::format("{} is not an integer from {} to {}", what, low, high));
        return std::nullopt;
    }
    return n->value.get_num().get_si();
}

std::optional<bool> LeafContext::boolean(const TomlValue& value, const std::string& what) {
    const TomlValue* source = &value;
    if (value.is(Kind::string)) {
        if (const TomlValue* named = parameter(value.string)) {
            source = named;
        }
    }
    if (!source->is(Kind::boolean)) {
        error(value.where, fmt::format("{} is {}; write true or false", what, describe(*source)));
        return std::nullopt;
    }
    return source->boolean;
}

std::optional<std::string> LeafContext::text(const TomlValue& value, const std::string& what) {
    if (!value.is(Kind::string)) {
        error(value.where, fmt::format("{} is {}; write a string", what, describe(value)));
        return std::nullopt;
    }
    return value.string;
}

std::optional<size_t> LeafContext::word(const TomlValue& value, const std::string& what,
                                        Words words) {
    const std::optional<std::string> given = text(value, what);
    if (!given) {
        return std::nullopt;
    }
    const auto find = [&](std::string_view w) { return std::ranges::find(words, w); };
    auto it = find(*given);
    std::string shown = *given;
    if (it == words.end()) {
        shown = named_text(*given);
        it = find(shown);
    }
    if (it != words.end()) {
        return static_cast<size_t>(it - words.begin());
    }
    const std::string nearest =
        nearest_name(shown, std::vector<std::string>(words.begin(), words.end()));
    // Who writes "perspective" does not mean "noperspective".
    const bool is_opposite = nearest == "no" + shown;
    error(value.where,
          nearest.empty() || is_opposite
              ? fmt::format("{} is \"{}\"; write {}", what, shown, alternatives(words))
              : fmt::format("{} is \"{}\"; did you mean \"{}\"?", what, shown, nearest));
    return std::nullopt;
}

std::optional<std::vector<Number>> LeafContext::numbers(const TomlValue& value,
                                                        const std::string& what, size_t count) {
    if (!value.is(Kind::array) || value.array.size() != count) {
        error(value.where, value.is(Kind::array)
                               ? fmt::format("{} has {} instead of {}", what,
                                             counted(value.array.size(), "number"), count)
                               : fmt::format("{} is {}; write an array of {} numbers", what,
                                             describe(value), count));
        return std::nullopt;
    }
    std::vector<Number> result;
    for (const TomlValue& element : value.array) {
        std::optional<Number> n = number(element, what);
        if (!n) {
            return std::nullopt;
        }
        result.push_back(std::move(*n));
    }
    return result;
}

std::optional<std::array<float, 2>> LeafContext::depths(const TomlValue& value,
                                                        const std::string& what, const char* each) {
    const std::optional<std::vector<Number>> ends = numbers(value, what, 2);
    std::array<float, 2> out{};
    for (size_t k = 0; ends && k < 2; ++k) {
        if ((*ends)[k].value < 0 || (*ends)[k].value > 1) {
            error(value.array[k].where,
                  fmt::format("{} is outside 0..1, which Vulkan does not allow", each));
            return std::nullopt;
        }
        out.at(k) = round_to_binary32((*ends)[k]).value;
    }
    return ends ? std::optional(out) : std::nullopt;
}

std::optional<float> LeafContext::binary32(const TomlValue& value, const std::string& what) {
    const std::optional<Number> n = number(value, what);
    return n ? binary32(*n, value.where, what) : std::nullopt;
}

std::optional<float> LeafContext::binary32(const Number& n, const SourceLocation& where,
                                           const std::string& what) {
    const float rounded = round_to_binary32(n).value;
    if (std::isinf(rounded)) {
        error(where, fmt::format("{} is larger than the largest binary32", what));
        return std::nullopt;
    }
    return rounded;
}

bool LeafContext::table(const TomlValue& value, const std::string& what) {
    if (!value.is(Kind::table)) {
        error(value.where, fmt::format("{} is {}; write a table", what, describe(value)));
        return false;
    }
    return true;
}

bool LeafContext::array(const TomlValue& value, const std::string& what) {
    if (!value.is(Kind::array)) {
        error(value.where, fmt::format("{} is {}; write an array", what, describe(value)));
        return false;
    }
    return true;
}

bool LeafContext::array_of(const TomlValue& value, const std::string& what, size_t count,
                           const char* form) {
    if (!array(value, what)) {
        return false;
    }
    if (value.array.size() != count) {
        error(value.where, fmt::format("{} has {}; write {}", what,
                                       counted(value.array.size(), "number"), form));
        return false;
    }
    return true;
}

std::optional<std::array<uint32_t, 2>> LeafContext::read_size(const TomlValue& table,
                                                              const char* name,
                                                              const std::string& owner,
                                                              int64_t largest) {
    const TomlValue* size = table.find("size");
    if (size == nullptr) {
        error(table.where, fmt::format("{} has no size; write size = [width, height]", name));
        return std::nullopt;
    }
    if (!array_of(*size, "size", 2, "[width, height]")) {
        return std::nullopt;
    }
    const auto width = integer(size->array[0], owner + "'s width", 1, largest);
    const auto height = integer(size->array[1], owner + "'s height", 1, largest);
    if (!width || !height) {
        return std::nullopt;
    }
    return {{static_cast<uint32_t>(*width), static_cast<uint32_t>(*height)}};
}

std::string LeafContext::named_text(const std::string& text) {
    const TomlValue* named = parameter(text);
    return named != nullptr && named->is(Kind::string) ? named->string : text;
}

void LeafContext::known_keys(const TomlValue& table, const KeyTable& keys,
                             const std::string& what) {
    std::vector<std::string_view> names;
    for (const Key& key : keys.keys) {
        names.push_back(key.name);
    }
    known_keys(table, what.empty() ? std::string(keys.name) : what, names);
}

void LeafContext::known_keys(const TomlValue& table, const std::string& what, Words keys) {
    for (const TomlEntry& entry : table.table) {
        if (std::ranges::find(keys, entry.key) != keys.end()) {
            continue;
        }
        const std::string nearest =
            nearest_name(entry.key, std::vector<std::string>(keys.begin(), keys.end()));
        error(entry.where, nearest.empty()
                               ? fmt::format("{} has no key \"{}\"; its keys are {}", what,
                                             entry.key, fmt::join(keys, ", "))
                               : fmt::format("{} has no key \"{}\"; did you mean \"{}\"?", what,
                                             entry.key, nearest));
    }
}

}  // namespace cases
