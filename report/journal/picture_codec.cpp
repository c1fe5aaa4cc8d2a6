// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/picture_codec.hpp"

#include <algorithm>
#include <array>

namespace report {

namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr size_t kMaxPicture = size_t{64} << 20;  // bytes
constexpr size_t kMaxRun = 256;

constexpr std::array<int8_t, 256> make_inverse() {
    std::array<int8_t, 256> inverse{};
    for (int8_t& entry : inverse) {
        entry = -1;
    }
    for (size_t k = 0; k < kAlphabet.size(); ++k) {
        inverse[static_cast<unsigned char>(kAlphabet[k])] = static_cast<int8_t>(k);
    }
    return inverse;
}
constexpr std::array<int8_t, 256> kInverse = make_inverse();

}  // namespace

std::string base64_encode(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t at = 0; at < bytes.size(); at += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - at);
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) {
            word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += k <= count ? kAlphabet[word >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

std::optional<std::string> base64_decode(std::string_view text) {
    if (text.size() % 4 != 0) {
        return std::nullopt;
    }
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (size_t at = 0; at < text.size(); at += 4) {
        const bool last = at + 4 == text.size();
        const size_t padding = !last || text[at + 3] != '=' ? 0U : text[at + 2] == '=' ? 2U : 1U;
        uint32_t word = 0;
        for (size_t k = 0; k < 4; ++k) {
            const int8_t digit =
                k < 4 - padding ? kInverse[static_cast<unsigned char>(text[at + k])] : int8_t{0};
            if (digit < 0) {
                return std::nullopt;
            }
            word = word << 6 | static_cast<uint32_t>(digit);
        }
        for (size_t k = 0; k < 3 - padding; ++k) {
            bytes += static_cast<char>(word >> (16 - 8 * k) & 0xffU);
        }
    }
    return bytes;
}

std::string encode_picture(const std::vector<uint8_t>& bytes) {
    std::string runs;
    for (size_t at = 0; at < bytes.size();) {
        size_t end = at + 1;
        while (end < bytes.size() && end - at < kMaxRun && bytes[end] == bytes[at]) {
            ++end;
        }
        runs += static_cast<char>(end - at - 1);
        runs += static_cast<char>(bytes[at]);
        at = end;
    }
    return base64_encode(runs);
}

std::optional<std::vector<uint8_t>> decode_picture(std::string_view text) {
    const auto runs = base64_decode(text);
    if (!runs || runs->size() % 2 != 0) {
        return std::nullopt;
    }
    std::vector<uint8_t> bytes;
    for (size_t at = 0; at < runs->size(); at += 2) {
        const size_t length = size_t{static_cast<unsigned char>((*runs)[at])} + 1;
        if (bytes.size() + length > kMaxPicture) {
            return std::nullopt;
        }
        bytes.insert(bytes.end(), length, static_cast<uint8_t>((*runs)[at + 1]));
    }
    return bytes;
}

}  // namespace report
