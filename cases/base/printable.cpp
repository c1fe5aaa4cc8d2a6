// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/base/utf8.hpp"

namespace cases {

namespace {

// What a terminal may obey, what reorders the text around it, and what XML 1.0 forbids.
bool is_unsafe(uint32_t c) {
    const bool control = (c < 0x20 && c != '\n' && c != '\t') || (c >= 0x7f && c < 0xa0);
    const bool reorders = c == 0x200e || c == 0x200f || c == 0x061c ||
                          (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
    const bool noncharacter = (c & 0xfffeU) == 0xfffeU || (c >= 0xfdd0 && c <= 0xfdef);
    return control || reorders || noncharacter || c == 0xfeff;
}

// Letters, digits and signs of ASCII, and spaces.
bool is_plain(std::string_view bytes) {
    return std::ranges::all_of(bytes, [](char c) { return c >= 0x20 && c < 0x7f; });
}

}  // namespace

CodePoint code_point_at(std::string_view bytes, size_t at) {
    const auto byte = [&](size_t k) {
        return static_cast<uint32_t>(static_cast<unsigned char>(bytes[k]));
    };
    const uint32_t lead = byte(at);
    if (lead < 0x80) {
        return {lead, 1, true};
    }
    const size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    constexpr uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
    if (lead < 0xc2 || lead > 0xf4 || at + length > bytes.size()) {
        return {lead, 1, false};
    }
    uint32_t value = lead & (0x7fU >> length);
    for (size_t k = 1; k < length; ++k) {
        const uint32_t next = byte(at + k);
        if ((next & 0xc0U) != 0x80U) {
            return {lead, 1, false};
        }
        value = value << 6 | (next & 0x3fU);
    }
    const bool surrogate = value >= 0xd800 && value <= 0xdfff;
    if (value < kSmallest[length] || value > 0x10ffff || surrogate) {
        return {lead, 1, false};
    }
    return {value, length, true};
}

bool is_utf8(std::string_view bytes) {
    if (is_plain(bytes)) {
        return true;
    }
    for (size_t at = 0; at < bytes.size();) {
        const CodePoint c = code_point_at(bytes, at);
        if (!c.valid) {
            return false;
        }
        at += c.length;
    }
    return true;
}

std::string printable(std::string_view bytes) {
    if (is_plain(bytes)) {
        return std::string(bytes);
    }
    std::string text;
    text.reserve(bytes.size());
    for (size_t at = 0; at < bytes.size();) {
        const CodePoint c = code_point_at(bytes, at);
        const std::string_view unit = bytes.substr(at, c.length);
        if (c.valid && !is_unsafe(c.value)) {
            text += unit;
        } else {
            for (const char byte : unit) {
                text += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
            }
        }
        at += c.length;
    }
    return text;
}

std::string markup(std::string_view bytes) {
    std::string text;
    for (const char c : printable(bytes)) {
        switch (c) {
            case '&':
                text += "&amp;";
                break;
            case '<':
                text += "&lt;";
                break;
            case '>':
                text += "&gt;";
                break;
            case '"':
                text += "&quot;";
                break;
            default:
                text += c;
        }
    }
    return text;
}

}  // namespace cases
