// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/toml/toml_reader.hpp"

// Some malformed files break assertions of the parser ("[=", "[3,}"). They are thrown here, in
// every build, so that such a file is a mistake like any other.
struct BrokenAssertion {};
[[noreturn]] static void break_off() {
    throw BrokenAssertion();
}
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : break_off())
// The header-only parser without exceptions, whatever the package's default is: the program then
// needs no shared library for it, and every other mistake arrives as a value.
#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#undef TOML_EXCEPTIONS
#define TOML_HEADER_ONLY 1
#define TOML_SHARED_LIB 0
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

namespace cases {

namespace {

constexpr int kMaxDepth = 32;             // of arrays and tables
constexpr size_t kMaxLineLength = 65536;  // bytes; bounds the depth of a dotted key

class Converter {
  public:
    explicit Converter(std::string file_name) : file_name_(std::move(file_name)) {}

    Expected<TomlValue> convert(const toml::node& node, int depth) {
        TomlValue value;
        value.where = location(node.source());
        if (depth > kMaxDepth) {
            return tl::unexpected(
                Error{value.where, "the file nests arrays and tables too deeply; at most " +
                                       std::to_string(kMaxDepth) + " levels are read"});
        }
        switch (node.type()) {
            case toml::node_type::boolean:
                value.kind = TomlValue::Kind::boolean;
                value.boolean = node.as_boolean()->get();
                return value;
            case toml::node_type::integer:
                value.kind = TomlValue::Kind::integer;
                value.integer = node.as_integer()->get();
                return value;
            case toml::node_type::floating_point:
                value.kind = TomlValue::Kind::floating;
                value.floating = node.as_floating_point()->get();
                return value;
            case toml::node_type::string:
                value.kind = TomlValue::Kind::string;
                value.string = node.as_string()->get();
                return value;
            case toml::node_type::array:
                return convert_array(*node.as_array(), std::move(value), depth);
            case toml::node_type::table:
                return convert_table(*node.as_table(), std::move(value), depth);
            default:
                value.kind = TomlValue::Kind::date_time;
                return value;
        }
    }

    SourceLocation location(const toml::source_region& source) const {
        return {file_name_, source.begin.line, source.begin.column};
    }

  private:
    Expected<TomlValue> convert_array(const toml::array& array, TomlValue value, int depth) {
        value.kind = TomlValue::Kind::array;
        value.array.reserve(array.size());
        for (const toml::node& element : array) {
            Expected<TomlValue> converted = convert(element, depth + 1);
            if (!converted) {
                return converted;
            }
            value.array.push_back(std::move(*converted));
        }
        return value;
    }

    Expected<TomlValue> convert_table(const toml::table& table, TomlValue value, int depth) {
        value.kind = TomlValue::Kind::table;
        for (const auto& [key, child] : table) {
            Expected<TomlValue> converted = convert(child, depth + 1);
            if (!converted) {
                return converted;
            }
            value.table.push_back(
                {std::string(key.str()), location(key.source()), std::move(*converted)});
        }
        // The parser sorts keys by name.
        std::stable_sort(value.table.begin(), value.table.end(),
                         [](const TomlEntry& a, const TomlEntry& b) {
                             return std::tie(a.where.line, a.where.column) <
                                    std::tie(b.where.line, b.where.column);
                         });
        return value;
    }

    std::string file_name_;
};

size_t longest_line(std::string_view text) {
    size_t longest = 0;
    size_t start = 0;
    while (start < text.size()) {
        const size_t end = std::min(text.find('\n', start), text.size());
        longest = std::max(longest, end - start);
        start = end + 1;
    }
    return longest;
}

// The line of a key with very many dots, or 0. The parser recurses once a part of a dotted key, so
// such keys must not reach it. A key ends at '=' or ']'; rows of an expected picture do not.
uint32_t line_of_long_key(std::string_view text) {
    constexpr int kMaxDots = 64;
    int dots = 0;
    uint32_t line = 1;
    for (const char c : text) {
        if (c == '.') {
            ++dots;
        } else if ((c == '=' || c == ']') && dots > kMaxDots) {
            return line;
        } else if (std::string_view("=[]{},\n").find(c) != std::string_view::npos) {
            dots = 0;
            line += c == '\n' ? 1 : 0;
        }
    }
    return 0;
}

bool breaks_the_parser(std::string_view text) {
    try {
        static_cast<void>(toml::parse(text));
        return false;
    } catch (const BrokenAssertion&) {
        return true;
    }
}

// The line at which the parser stops without a word: the shortest beginning of the text that stops
// it, too, ends there.
uint32_t line_that_breaks_the_parser(std::string_view text) {
    std::vector<size_t> ends;
    for (size_t end = text.find('\n'); end != std::string_view::npos;
         end = text.find('\n', end + 1)) {
        ends.push_back(end + 1);
    }
    const auto breaking = std::partition_point(ends.begin(), ends.end(), [&](size_t end) {
        return !breaks_the_parser(text.substr(0, end));
    });
    return static_cast<uint32_t>(breaking - ends.begin()) + 1;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
    for (const TomlEntry& entry : table) {
        if (entry.key == key) {
            return &entry.value;
        }
    }
    return nullptr;
}

std::string describe(const TomlValue& value) {
    switch (value.kind) {
        case TomlValue::Kind::boolean:
            return value.boolean ? "true" : "false";
        case TomlValue::Kind::integer:
            return "the number " + std::to_string(value.integer);
        case TomlValue::Kind::floating:
            return "a number";
        case TomlValue::Kind::string:
            return "the string \"" + value.string + "\"";
        case TomlValue::Kind::array:
            return "an array";
        case TomlValue::Kind::table:
            return "a table";
        case TomlValue::Kind::date_time:
            return "a date or time";
    }
    return "";
}

Expected<TomlValue> read_toml(std::string_view text, const std::string& file_name) {
    const SourceLocation file{file_name, 0, 0};
    if (text.size() > kMaxFileSize) {
        return tl::unexpected(
            Error{file, "the file has " + std::to_string(text.size()) +
                            " bytes, more than the 4 MiB of a case file; split it"});
    }
    if (longest_line(text) > kMaxLineLength) {
        return tl::unexpected(Error{file, "the file has a line of more than " +
                                              std::to_string(kMaxLineLength) + " bytes; break it"});
    }
    if (const uint32_t line = line_of_long_key(text); line != 0) {
        return tl::unexpected(
            Error{{file_name, line, 1},
                  "a key has more than 64 dots, which nests too deeply; write fewer"});
    }
    Converter converter(file_name);
    try {
        const toml::parse_result parsed = toml::parse(text);
        if (!parsed) {
            return tl::unexpected(
                Error{converter.location(parsed.error().source()),
                      "this is not TOML: " + std::string(parsed.error().description())});
        }
        return converter.convert(parsed.table(), 0);
    } catch (const BrokenAssertion&) {
        return tl::unexpected(Error{{file_name, line_that_breaks_the_parser(text), 1},
                                    "this is not TOML: a key or a value is missing in this line"});
    }
}

}  // namespace cases
