// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "cases/base/float_bits.hpp"
#include "cases/toml/binary32.hpp"

namespace cases {

namespace {

constexpr size_t kLineLength = 100;  // of arrays, as far as items allow
// Outside of these exponents a power of two is easier to read as a power than in digits.
constexpr int kSmallPower = -16;
constexpr int kLargePower = 30;

std::string non_finite(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    for (const char* word : {"nan", "-nan", "inf", "-inf"}) {
        if (read_special_number(word)->non_finite == bits) {
            return string_toml(word);
        }
    }
    return fmt::format("\"bits(0x{:08x})\"", bits);
}

}  // namespace

std::string string_toml(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (c == '\n') {
            out += "\\n";
        } else if (code < 0x20 || code == 0x7f) {
            out += fmt::format("\\u{:04x}", code);
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string number_toml(float value, Reading reading) {
    if (!std::isfinite(value)) {
        return non_finite(value);
    }
    if (std::fpclassify(value) == FP_ZERO) {
        return std::signbit(value) ? "-0.0" : "0";
    }
    // What a TOML float means is the nearest binary64, which is rounded again.
    const std::string plain = shortest(value);
    double read = 0;
    std::from_chars(plain.data(), plain.data() + plain.size(), read);
    const bool is_plain = reading == Reading::exact ? !(read < static_cast<double>(value)) &&
                                                          !(read > static_cast<double>(value))
                                                    : same_bits(static_cast<float>(read), value);
    std::vector<std::string> ways;
    if (is_plain) {
        ways.push_back(plain);
    }
    int exponent = 0;
    const float half = std::frexp(value, &exponent);  // of magnitude 1/2 for a power of two
    const bool is_far = exponent - 1 < kSmallPower || exponent - 1 > kLargePower;
    if (is_far && same_bits(std::fabs(half), 0.5F)) {
        ways.push_back(fmt::format("\"{}2^{}\"", value < 0 ? "-" : "", exponent - 1));
    }
    if (!is_plain) {
        ways.push_back(fmt::format("\"{}f\"", plain));
        ways.push_back(fmt::format("\"{:a}\"", value));
    }
    return *std::min_element(
        ways.begin(), ways.end(),
        [](const std::string& a, const std::string& b) { return a.size() < b.size(); });
}

std::string list_toml(const std::vector<std::string>& items, std::string_view separator) {
    return fmt::format("[{}]", fmt::join(items, separator));
}

std::string array_toml(const std::vector<std::string>& items, size_t group) {
    std::vector<std::string> pieces;
    for (size_t i = 0; i < items.size(); ++i) {
        if (group == 0 || i % group == 0) {
            pieces.push_back(items[i]);
        } else {
            pieces.back() += ", " + items[i];
        }
    }
    const std::string_view separator = group == 0 ? ", " : ",  ";
    std::string line = list_toml(pieces, separator);
    if (line.size() <= kLineLength) {
        return line;
    }
    std::string out = "[";
    line.clear();
    for (const std::string& piece : pieces) {
        if (!line.empty() && line.size() + separator.size() + piece.size() > kLineLength) {
            out += "\n  " + line + ",";
            line.clear();
        }
        line += line.empty() ? piece : std::string(separator) + piece;
    }
    return out + "\n  " + line + ",\n]";
}

std::string mask_toml(uint32_t mask) {
    return mask < 10 ? std::to_string(mask) : fmt::format("{:#x}", mask);
}

void TableText::add(std::string_view key, std::string value) {
    const Key* row = keys_.find(key);
    if (row == nullptr) {
        return;  // no file has it
    }
    const auto at =
        std::ranges::lower_bound(lines_, row, {}, &std::pair<const Key*, std::string>::first);
    if (at != lines_.end() && at->first == row) {
        at->second = std::move(value);
    } else {
        lines_.emplace(at, row, std::move(value));
    }
}

std::string TableText::lines() const {
    size_t width = 0;
    for (const auto& [key, value] : lines_) {
        width = std::max(width, key->name.size());
    }
    std::string out;
    for (const auto& [key, value] : lines_) {
        out += fmt::format("{:<{}} = {}\n", key->name, width, value);
    }
    return out;
}

std::string TableText::in_line() const {
    std::string out;
    for (const auto& [key, value] : lines_) {
        out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", key->name, value);
    }
    return "{ " + out + " }";
}

}  // namespace cases
