// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/format/vertex_format.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "cases/base/float_bits.hpp"

namespace cases {

namespace {

constexpr glm::vec4 kMissing = {0, 0, 0, 1};  // what components are read as that a format lacks

// A whole number from `least` to `most`, but not -0, in its low bits.
std::optional<uint32_t> whole_code(float number, float least, float most, uint32_t bits) {
    if (!(number >= least && number <= most) || std::floor(number) < number ||
        same_bits(number, -0.0F)) {
        return std::nullopt;
    }
    return static_cast<uint32_t>(static_cast<int32_t>(number)) & ((1U << bits) - 1);
}

}  // namespace

std::optional<uint32_t> vertex_code(VertexKind kind, uint32_t bits, float number) {
    if (kind == VertexKind::binary32) {
        return std::bit_cast<uint32_t>(number);
    }
    if (kind == VertexKind::half) {
        return half_bits(number);
    }
    const bool is_signed = kind == VertexKind::snorm || kind == VertexKind::sscaled;
    const auto most = static_cast<float>((1U << (is_signed ? bits - 1 : bits)) - 1);
    if (kind == VertexKind::uscaled || kind == VertexKind::sscaled) {
        return whole_code(number, is_signed ? -most : 0, most, bits);
    }
    const auto end = whole_code(number, is_signed ? -1.0F : 0.0F, 1, bits);
    return end ? whole_code(number * most, -most, most, bits) : std::nullopt;
}

bool holds(VertexFormat format, std::span<const glm::vec4> values) {
    const VertexFormatRow& row = row_of(format);
    return std::ranges::all_of(values, [&row](const glm::vec4& value) {
        for (int k = 0; k < 4; ++k) {
            const uint32_t bits = row.bits.at(static_cast<size_t>(k));
            if (bits == 0 ? !same_bits(value[k], kMissing[k])
                          : !vertex_code(row.kind, bits, value[k])) {
                return false;
            }
        }
        return true;
    });
}

VertexFormat other_vertex_format(std::span<const glm::vec4> values, uint32_t offered, size_t salt) {
    std::vector<VertexFormat> held;
    for (const VertexFormatRow& row : kVertexFormats) {
        if (row.format != VertexFormat::rgba32_float && (offered & bit_of(row.format)) != 0 &&
            !values.empty() && holds(row.format, values)) {
            held.push_back(row.format);
        }
    }
    return held.empty() ? VertexFormat::rgba32_float : held[salt % held.size()];
}

void encode_vertex(VertexFormat format, const glm::vec4& value, std::byte* to) {
    const VertexFormatRow& row = row_of(format);
    std::array<uint32_t, 4> words{};
    for (size_t k = 0; k < 4; ++k) {
        const uint32_t bits = row.bits.at(k), first = row.first_bit.at(k);
        if (bits != 0) {
            const uint32_t code =
                vertex_code(row.kind, bits, value[static_cast<int>(k)]).value_or(0);
            words.at(first / 32) |= code << (first % 32);
        }
    }
    std::memcpy(to, words.data(), bytes_of(format));  // little-endian, as all hosts here
}

}  // namespace cases
