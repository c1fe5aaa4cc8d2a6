// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/format/color_format.hpp"

#include <cstring>

namespace cases {

// No component reaches over the border of a 32-bit word.

TexelCodes decode_texel(ColorFormat format, const std::byte* texel) {
    const ColorFormatRow& row = row_of(format);
    std::array<uint32_t, 4> words{};
    std::memcpy(words.data(), texel, bytes_of(format));
    TexelCodes codes{};
    for (size_t k = 0; k < codes.size(); ++k) {
        const uint64_t mask = (uint64_t{1} << row.bits[k]) - 1;
        codes[k] =
            static_cast<uint32_t>(words[row.first_bit[k] / 32U] >> row.first_bit[k] % 32U & mask);
    }
    return codes;
}

void encode_texel(ColorFormat format, const TexelCodes& codes, std::byte* texel) {
    const ColorFormatRow& row = row_of(format);
    std::array<uint32_t, 4> words{};
    for (size_t k = 0; k < codes.size(); ++k) {
        if (row.bits[k] != 0) {
            words[row.first_bit[k] / 32U] |= codes[k] << row.first_bit[k] % 32U;
        }
    }
    std::memcpy(texel, words.data(), bytes_of(format));
}

}  // namespace cases
