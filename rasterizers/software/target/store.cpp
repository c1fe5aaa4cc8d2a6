// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/store.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace software {

namespace {

float steps_of(uint32_t bits) {
    return static_cast<float>((1U << bits) - 1);
}

float to_unit(float v) {
    return v > 0 ? v < 1 ? v : 1.0F : 0.0F;  // NaN: 0
}

// Khronos Data Format Specification, sRGB transfer functions.
float encode_srgb(float linear) {
    return linear <= 0.0031308F ? linear * 12.92F : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

float decode_srgb(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

uint32_t to_code(float v, uint32_t bits, const Device& device) {
    const float steps = steps_of(bits);
    if (device.fault == "store-wraps"_fault) {
        const double whole = std::floor(static_cast<double>(v) * static_cast<double>(steps) + 0.5);
        return static_cast<uint32_t>(static_cast<int64_t>(whole)) & ((1U << bits) - 1);
    }
    v = to_unit(v);
    if ((device.fault == "store-through-8-bits"_fault || device.narrow_through_eight) && bits < 8) {
        const auto eight = static_cast<uint32_t>(v * 255.0F + 0.5F);
        return eight >> (8 - bits);
    }
    if (device.fault == "store-scale"_fault) {
        return static_cast<uint32_t>(std::fmin(v * (steps + 1), steps));
    }
    const float scaled = v * steps;
    if (device.fault == "store-truncates"_fault) {
        return static_cast<uint32_t>(scaled);
    }
    switch (device.unorm) {
        case UnormRounding::nearest:
            break;
        case UnormRounding::nearest_even:
            return static_cast<uint32_t>(std::nearbyint(scaled));
        case UnormRounding::nearest_down:
            return static_cast<uint32_t>(std::ceil(scaled - 0.5F));
        case UnormRounding::down:
            return static_cast<uint32_t>(scaled);
    }
    return static_cast<uint32_t>(std::floor(scaled + 0.5F));
}

}  // namespace

FormatLayout layout_of(cases::ColorFormat format) {
    const cases::ColorFormatRow& row = cases::row_of(format);
    const auto has_bytes = [](uint8_t bits) { return bits % 8 == 0; };
    const bool is_packed = !std::ranges::all_of(row.bits, has_bytes);
    FormatLayout out{};
    for (size_t k = 0; k < 4; ++k) {
        const bool is_linear = k == 3;  // the alpha of sRGB
        out.channels[k] = {is_linear && row.kind == Number::srgb ? Number::unorm : row.kind,
                           row.bits[k]};
        out.position[k] = static_cast<uint8_t>(k);
        for (size_t n = 0; !is_packed && row.bits[k] != 0 && n < 4; ++n) {
            const bool is_before = row.bits[n] != 0 && row.first_bit[n] < row.first_bit[k];
            out.position[k] = static_cast<uint8_t>(out.position[k] + (is_before ? 1 : 0) -
                                                   (n < k && row.bits[n] != 0 ? 1 : 0));
        }
    }
    return out;
}

namespace {

// The sign and the code of the magnitude make a code of two's complement.
uint32_t to_snorm(float v, uint32_t bits, const Device& device) {
    const bool is_negative = v < 0 && device.fault != "snorm-unsigned"_fault;
    const uint32_t code = to_code(is_negative ? -v : v, bits - 1, device);
    return (is_negative ? ~code + 1 : code) & ((1U << bits) - 1);
}

uint32_t to_whole(float v, Channel channel, const Device& device) {
    const bool is_signed =
        cases::is_signed(channel.number) && device.fault != "integer-unsigned"_fault;
    const int64_t code = static_cast<int64_t>(is_signed || v > 0 ? v : 0.0F);
    const uint32_t bits = device.fault == "integer-8-bits"_fault ? 8U : channel.bits;
    return static_cast<uint32_t>(code) & (UINT32_MAX >> (32 - bits));
}

// A half of 11 or 10 bits: a binary16 number without its sign and last places.
uint32_t to_short_half(float v, uint32_t bits, const Device& device) {
    const bool is_lost = v < 0 && device.fault != "short-float-magnitude"_fault;
    const uint32_t dropped = 15 - bits;
    const uint32_t half = is_lost ? 0U : to_half(v, device) & 0x7fffU;
    const bool is_up =
        (half >> (dropped - 1) & 1U) != 0 && !device.half_toward_zero && half < 0x7c00U;
    return std::isnan(v) ? UINT32_MAX >> (32 - bits) : (half >> dropped) + (is_up ? 1 : 0);
}

}  // namespace

uint32_t store_channel(float v, Channel channel, const Device& device) {
    if (channel.number == Number::half || channel.number == Number::binary32) {
        if (device.fault == "float-store-clamped"_fault) {
            v = to_unit(v);
        }
    }
    switch (channel.number) {
        case Number::unorm:
            return to_code(v, channel.bits, device);
        case Number::srgb:  // to nearest: an encoded 1 may be a little less in binary32
            if (device.unorm == UnormRounding::down) {
                Device nearest = device;
                nearest.unorm = UnormRounding::nearest;
                return store_channel(v, channel, nearest);
            }
            if (device.fault == "srgb-not-encoded"_fault) {
                return to_code(v, channel.bits, device);
            }
            if (device.fault == "srgb-gamma"_fault) {
                return to_code(std::pow(to_unit(v), 1.0F / 2.2F), channel.bits, device);
            }
            return to_code(encode_srgb(to_unit(v)), channel.bits, device);
        case Number::half:
            return channel.bits < 16 ? to_short_half(v, channel.bits, device) : to_half(v, device);
        case Number::binary32:
            return std::bit_cast<uint32_t>(
                device.fault == "float-store-half"_fault ? from_half(to_half(v, device)) : v);
        case Number::snorm:
            return to_snorm(v, channel.bits, device);
        case Number::uint:
        case Number::sint:
            break;
    }
    return to_whole(v, channel, device);
}

float load_channel(uint32_t code, Channel channel, const Device& device) {
    switch (channel.number) {
        case Number::unorm:
            return static_cast<float>(code) / steps_of(channel.bits);
        case Number::srgb: {
            const float encoded = static_cast<float>(code) / steps_of(channel.bits);
            return device.fault == "srgb-not-decoded"_fault ? encoded : decode_srgb(encoded);
        }
        case Number::half:
            return from_half(
                static_cast<uint16_t>(channel.bits < 16 ? code << (15 - channel.bits) : code));
        case Number::binary32:
            return std::bit_cast<float>(code);
        case Number::snorm:
            return std::fmax(static_cast<float>(cases::signed_code(code, channel.bits)) /
                                 steps_of(channel.bits - 1),
                             -1.0F);
        case Number::sint:
            return static_cast<float>(cases::signed_code(code, channel.bits));
        case Number::uint:
            break;
    }
    return static_cast<float>(code);
}

uint16_t to_half(float v, const Device& device) {
    const uint32_t bits = std::bit_cast<uint32_t>(v);
    const auto sign = static_cast<uint16_t>(bits >> 16 & 0x8000U);
    const int exponent = static_cast<int>(bits >> 23 & 0xffU) - 127;
    uint32_t fraction = bits & 0x7fffffU;
    if (exponent == 128) {  // infinity or NaN
        return static_cast<uint16_t>(sign | (fraction != 0 ? 0x7e00U : 0x7c00U));
    }
    if (device.fault == "half-exponent-wraps"_fault) {
        const uint32_t biased = static_cast<uint32_t>(exponent + 15) & 0x1fU;
        return static_cast<uint16_t>(sign | (exponent < -14 ? 0U : biased << 10 | fraction >> 13));
    }
    if (exponent > 15) {
        return static_cast<uint16_t>(sign | (device.half_toward_zero ? 0x7bffU : 0x7c00U));
    }
    if (exponent < -25) {
        return sign;
    }
    // 10 bits of the fraction are kept, fewer of numbers below 2^-14.
    uint32_t lost = 13;
    uint32_t base = 0;
    if (exponent >= -14) {
        base = static_cast<uint32_t>(exponent + 15) << 10;
    } else {
        fraction |= 0x800000U;
        lost += static_cast<uint32_t>(-14 - exponent);
    }
    uint32_t code = base + (fraction >> lost);
    const uint32_t rest = fraction & ((1U << lost) - 1);
    const uint32_t middle = 1U << (lost - 1);
    const bool is_up = rest > middle || (rest == middle && (code & 1U) != 0);
    // A carry runs on into the exponent, and from the largest number to infinity.
    code += is_up && !device.half_toward_zero ? 1U : 0U;
    return static_cast<uint16_t>(sign | code);
}

float from_half(uint16_t bits) {
    const int exponent = bits >> 10 & 0x1f;
    const int fraction = bits & 0x3ff;
    const float sign = (bits & 0x8000) != 0 ? -1.0F : 1.0F;
    if (exponent == 31) {
        return fraction != 0 ? std::nanf("") : sign * HUGE_VALF;
    }
    return exponent == 0 ? sign * std::ldexp(static_cast<float>(fraction), -24)
                         : sign * std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
}

}  // namespace software
