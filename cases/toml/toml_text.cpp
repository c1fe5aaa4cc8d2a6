// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/toml/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "cases/key/key.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

constexpr size_t kColumns = 100;  // of a line, where values allow it

// Keys stand as their rows do, those of triangles behind the others, and last those without a row.
std::vector<const TomlEntry*> ordered(const TomlValue& table, const KeyTable* keys) {
    std::vector<std::pair<std::pair<int, const Key*>, const TomlEntry*>> entries;
    for (const TomlEntry& entry : table.table) {
        const Key* row = find_key(keys, entry.key);
        const int group = row == nullptr ? 2 : row->has(Key::kShape) ? 1 : 0;
        entries.push_back({{group, row}, &entry});
    }
    std::ranges::stable_sort(entries, {}, [](const auto& e) { return e.first; });
    std::vector<const TomlEntry*> out;
    std::ranges::transform(entries, std::back_inserter(out),
                           [](const auto& e) { return e.second; });
    return out;
}

std::string float_text(double value) {
    if (std::isnan(value)) {
        return "nan";
    }
    if (std::isinf(value)) {
        return value < 0 ? "-inf" : "inf";
    }
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    std::string digits(buffer.data(), end);
    if (digits.find_first_of(".e") == std::string::npos) {
        digits += ".0";
    }
    return digits;
}

// Keys are written in one line.
std::string quoted(const std::string& text, bool is_key = false) {
    // Pictures and other texts of several lines stay so; three quotes would end them.
    const bool is_block =
        !is_key && text.find('\n') != std::string::npos && text.find('"') == std::string::npos;
    std::string out = is_block ? "\"\"\"\n" : "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (c == '\n' && is_block) {
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            out += c;
        }
    }
    return out + (is_block ? "\"\"\"" : "\"");
}

std::string key_text(const std::string& key) {
    constexpr std::string_view kBare =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !key.empty() && key.find_first_not_of(kBare) == std::string::npos ? key
                                                                             : quoted(key, true);
}

std::string inline_text(const TomlValue& value, const KeyTable* keys);

std::string array_text(const TomlValue& value, const KeyTable* keys) {
    std::string out = "[";
    for (const TomlValue& element : value.array) {
        out += (out.size() > 1 ? ", " : "") + inline_text(element, keys);
    }
    return out + "]";
}

std::string inline_text(const TomlValue& value, const KeyTable* keys) {
    switch (value.kind) {
        case Kind::boolean:
            return value.boolean ? "true" : "false";
        case Kind::integer:
            return fmt::format("{}", value.integer);
        case Kind::floating:
            return float_text(value.floating);
        case Kind::string:
            return quoted(value.string);
        case Kind::array:
            return array_text(value, keys);
        case Kind::table: {
            std::string out;
            for (const TomlEntry* entry : ordered(value, keys)) {
                out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", key_text(entry->key),
                                   inline_text(entry->value, keys_in(keys, entry->key)));
            }
            return out.empty() ? "{}" : "{ " + out + " }";
        }
        case Kind::date_time:
            break;
    }
    return "0001-01-01";  // no case has one, and the tree does not say which it was
}

// An array over several lines: one element a line if they are arrays, as many as fit otherwise.
std::string wrapped(const TomlValue& value, const KeyTable* keys) {
    std::string out = "[";
    std::string line;
    for (const TomlValue& element : value.array) {
        const std::string next = inline_text(element, keys) + ",";
        if (!line.empty() &&
            (element.is(Kind::array) || line.size() + 1 + next.size() > kColumns)) {
            out += "\n" + line;
            line.clear();
        }
        line += (line.empty() ? "    " : " ") + next;
    }
    if (!line.empty()) {
        line.pop_back();
    }
    return out + "\n" + line + "\n]";
}

bool is_all_tables(const TomlValue& value) {
    return value.is(Kind::array) && !value.array.empty() &&
           std::ranges::all_of(value.array, [](const TomlValue& d) { return d.is(Kind::table); });
}

// Whether [name.key] tells it, not key = value inside of [name].
bool has_header(const std::string& parent, const TomlEntry& entry) {
    if (entry.value.is(Kind::table)) {
        return parent.empty() || parent == "target" || parent == "expect";
    }
    return is_all_tables(entry.value) && (parent.empty() || parent == "draw") &&
           entry.key != "relations";
}

void write_entries(const std::string& parent, const TomlValue& table, const KeyTable* keys,
                   std::string& out) {
    const std::vector<const TomlEntry*> entries = ordered(table, keys);
    for (const TomlEntry* entry : entries) {
        if (has_header(parent, *entry)) {
            continue;
        }
        const std::string line = key_text(entry->key) + " = ";
        const KeyTable* inner = keys_in(keys, entry->key);
        const std::string plain = inline_text(entry->value, inner);
        const bool is_long = entry->value.is(Kind::array) && !entry->value.array.empty() &&
                             (entry->key == "vertices" || line.size() + plain.size() > kColumns);
        out += line + (is_long ? wrapped(entry->value, inner) : plain) + "\n";
    }
    for (const TomlEntry* entry : entries) {
        if (!has_header(parent, *entry)) {
            continue;
        }
        const std::string name = (parent.empty() ? "" : parent + ".") + key_text(entry->key);
        const bool is_list = entry->value.is(Kind::array);
        const std::span<const TomlValue> tables =
            is_list ? std::span(entry->value.array) : std::span(&entry->value, 1);
        for (const TomlValue& one : tables) {
            out += is_list ? fmt::format("\n[[{}]]\n", name) : fmt::format("\n[{}]\n", name);
            write_entries(name, one, keys_in(keys, entry->key), out);
        }
    }
}

}  // namespace

std::string to_text(const TomlValue& document) {
    std::string out;
    write_entries("", document, &kFileKeys, out);
    return out;
}

}  // namespace cases
