// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/document/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace fuzz {

using cases::TomlEntry;
using Kind = Document::Kind;

namespace {

constexpr size_t kLineLength = 100;

// Keys that stand before all others of the file, in this order.
constexpr std::array<std::string_view, 7> kFirst = {"format", "description", "catches", "rules",
                                                    "links",  "relations",   "leaves"};

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (c == '\n') {
            out += "\\n";
        } else if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\u{:04x}", byte);
        } else {
            out += c;
        }
    }
    return out + '"';
}

// A key with signs that a bare one may not have stands in quotes.
std::string key_text(const std::string& key) {
    const bool is_bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
    return is_bare ? key : quoted(key);
}

std::string text_of(double value) {
    if (std::isnan(value)) {
        return std::signbit(value) ? "-nan" : "nan";
    }
    if (std::isinf(value)) {
        return value < 0 ? "-inf" : "inf";
    }
    if (std::fpclassify(value) == FP_ZERO) {
        return std::signbit(value) ? "-0.0" : "0";
    }
    return fmt::format("{}", value);
}

bool is_table_array(const Document& value) {
    return value.is(Kind::array) && !value.array.empty() &&
           std::all_of(value.array.begin(), value.array.end(),
                       [](const Document& element) { return element.is(Kind::table); });
}

std::string inline_text(const Document& value) {
    std::vector<std::string> parts;
    switch (value.kind) {
        case Kind::boolean:
            return value.boolean ? "true" : "false";
        case Kind::integer:
            return std::to_string(value.integer);
        case Kind::floating:
            return text_of(value.floating);
        case Kind::string:
            return quoted(value.string);
        case Kind::array:
            for (const Document& element : value.array) {
                parts.push_back(inline_text(element));
            }
            return fmt::format("[{}]", fmt::join(parts, ", "));
        case Kind::table:
            for (const TomlEntry& entry : value.table) {
                parts.push_back(key_text(entry.key) + " = " + inline_text(entry.value));
            }
            return parts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(parts, ", "));
        case Kind::date_time:
            break;
    }
    return quoted(value.string);
}

// "key = value", an array that is too long for a line with as many elements a line as fit.
std::string line(const std::string& key, const Document& value) {
    std::string text = key_text(key) + " = " + inline_text(value) + '\n';
    if (text.size() <= kLineLength || !value.is(Kind::array)) {
        return text;
    }
    text = key_text(key) + " = [\n";
    std::string row;
    for (const Document& element : value.array) {
        const std::string part = inline_text(element) + ",";
        if (!row.empty() && row.size() + part.size() + 5 > kLineLength) {
            text += "   " + row + '\n';
            row.clear();
        }
        row += ' ' + part;
    }
    return text + "   " + row + "\n]\n";
}

bool stands_apart(const std::string& path, const TomlEntry& entry) {
    const bool is_color = path == "target" && entry.key == "color";
    return is_table_array(entry.value) ? path.empty() ? entry.key == "draw" : path == "draw"
                                       : entry.value.is(Kind::table) && (path.empty() || is_color);
}

// Keys of a table, then its tables under headers of their own.
std::string table_text(const Document& table, const std::string& path) {
    std::string text;
    for (const TomlEntry& entry : table.table) {
        if (!stands_apart(path, entry)) {
            text += line(entry.key, entry.value);
        }
    }
    for (const TomlEntry& entry : table.table) {
        if (!stands_apart(path, entry)) {
            continue;
        }
        const std::string below = (path.empty() ? "" : path + ".") + key_text(entry.key);
        if (entry.value.is(Kind::table)) {
            text += fmt::format("\n[{}]\n{}", below, table_text(entry.value, below));
            continue;
        }
        for (const Document& element : entry.value.array) {
            text += fmt::format("\n[[{}]]\n{}", below, table_text(element, below));
        }
    }
    return text;
}

}  // namespace

std::string to_text(const Document& document) {
    Document sorted = document;
    std::stable_sort(sorted.table.begin(), sorted.table.end(),
                     [](const TomlEntry& a, const TomlEntry& b) {
                         const auto rank = [](const TomlEntry& entry) {
                             return std::find(kFirst.begin(), kFirst.end(), entry.key);
                         };
                         return rank(a) < rank(b);
                     });
    return table_text(sorted, "");
}

Document* find(Document& table, std::string_view key) {
    const auto at = std::find_if(table.table.begin(), table.table.end(),
                                 [&](const TomlEntry& entry) { return entry.key == key; });
    return at == table.table.end() ? nullptr : &at->value;
}

bool erase(Document& table, std::string_view key) {
    return std::erase_if(table.table, [&](const TomlEntry& entry) { return entry.key == key; }) > 0;
}

void set(Document& table, std::string_view key, Document value) {
    if (Document* known = find(table, key); known != nullptr) {
        *known = std::move(value);
    } else {
        table.table.push_back({std::string(key), {}, std::move(value)});
    }
}

Document number(double value) {
    Document out;
    out.kind = Kind::floating;
    out.floating = value;
    return out;
}

Document array(std::vector<Document> elements) {
    Document out;
    out.kind = Kind::array;
    out.array = std::move(elements);
    return out;
}

double number_of(const Document& value) {
    return value.is(Kind::integer)    ? static_cast<double>(value.integer)
           : value.is(Kind::floating) ? value.floating
                                      : 0;
}

}  // namespace fuzz
