// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The blend unit of the software device (integers and binary32) and the reference's (exact
// rationals) share no code. Over every format, factor and operation the reference allows what any
// legal unit stores, and refuses units with a fault.
#include "rasterizers/software/target/blend_unit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "cases/model/profile.hpp"
#include "mutants/software.hpp"
#include "ref/color/blend.hpp"

namespace mutants {
namespace {

using cases::ColorFormat;
using cases::Profile;

constexpr std::array kBlendable = {
    ColorFormat::rgba8_unorm,   ColorFormat::bgra8_unorm,  ColorFormat::rgba8_srgb,
    ColorFormat::rgb10a2_unorm, ColorFormat::r5g6b5_unorm, ColorFormat::rgba16_unorm,
    ColorFormat::rgba16_float,  ColorFormat::rgba32_float, ColorFormat::r32_float};

bool is_float(ColorFormat format) {
    const Number number = layout_of(format).channels[0].number;
    return number == Number::half || number == Number::binary32;
}

class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    uint32_t below(uint32_t n) { return static_cast<uint32_t>(engine_() % n); }

    // What shaders write: also beyond 0 and 1, often a number that some format holds exactly.
    float number(bool wide) {
        switch (below(6)) {
            case 0:
                return static_cast<float>(below(3)) * 0.5F;
            case 1:
                return static_cast<float>(below(256)) / 255.0F;
            case 2:
                return static_cast<float>(below(32)) / 16.0F - 0.5F;
            default:
                break;
        }
        const float unit = static_cast<float>(below(1U << 24)) * 0x1p-24F;
        return wide ? unit * 16.0F - 8.0F : unit * 1.5F - 0.25F;
    }
    glm::vec4 color(bool wide) { return {number(wide), number(wide), number(wide), number(wide)}; }

  private:
    std::mt19937 engine_;
};

struct Fragment {
    cases::ColorOutput output;
    glm::vec4 source{};
};

Fragment any_fragment(Random& random, bool wide, size_t number) {
    Fragment out;
    out.source = random.color(wide);
    if (random.below(4) == 0) {
        out.output.write_mask = static_cast<uint8_t>(random.below(16));
    }
    out.output.alpha_to_one = random.below(4) == 0;
    cases::Blend blend;
    // Every pair of factors with every operation is the colours' in 19 * 19 * 5 numbers.
    blend.color = {static_cast<cases::BlendFactor>(number % 19),
                   static_cast<cases::BlendFactor>(number / 19 % 19),
                   static_cast<cases::BlendOp>(number / 361 % 5)};
    blend.alpha = {static_cast<cases::BlendFactor>(random.below(19)),
                   static_cast<cases::BlendFactor>(random.below(19)),
                   static_cast<cases::BlendOp>(random.below(5))};
    blend.constants = random.color(wide);
    blend.second = random.color(wide);
    if (random.below(8) != 0) {
        out.output.blend = blend;
    }
    return out;
}

ref::color::Color exact(const glm::vec4& v) {
    ref::color::Color out;
    for (size_t k = 0; k < 4; ++k) {
        out[k] = ref::color::point(static_cast<double>(v[static_cast<int>(k)]));
    }
    return out;
}

struct Count {
    size_t allowed = 0, refused = 0;
    std::string first;  // refused
};

// Clears a texel and draws one fragment onto it, or `length` of them, as the device and as the
// reference do it.
Count hold_against_reference(const Device& device, Profile profile, ColorFormat format,
                             uint32_t seed, size_t length, size_t step = 1) {
    Count count;
    Random random(seed);
    const BlendUnit unit(format, device);
    const ref::color::Unit reference{format, profile};
    for (size_t number = 0; number < 19 * 19 * 5; number += step) {
        const glm::vec4 clear = random.color(is_float(format));
        Texel texel = unit.cleared(clear);
        // The reference goes on from the bits that the clear has left.
        ref::color::Color allowed = reference.cleared({format, clear});
        const capture::ColorCodes cleared = unit.read_back(texel);
        for (uint32_t k = 0; k < 4; ++k) {
            const ref::color::Component component(cases::component_of(format, k));
            mpq_class value;
            if (component.exists() && component.value_of(cleared[k], value)) {
                allowed[k] = ref::color::point(value);
            }
        }
        std::string story;
        for (size_t n = 0; n < length; ++n) {
            const Fragment f = any_fragment(random, is_float(format), number + n * 97);
            texel = unit.write(f.output, f.source, texel);
            allowed = reference.write(f.output, exact(f.source), allowed);
        }
        if (reference.allows(allowed, unit.read_back(texel))) {
            ++count.allowed;
            continue;
        }
        if (count.refused++ == 0) {
            count.first = std::string(cases::name_of(format)) + " number " +
                          std::to_string(number) + ": allowed " + reference.text_of(allowed) +
                          ", got " + reference.text_of(unit.read_back(texel));
        }
    }
    return count;
}

struct Unit {
    const char* name;
    Profile profile;
    Device device;
};

std::vector<Unit> legal_units() {
    std::vector<Unit> out;
    const auto add = [&](const char* name, Profile profile, const auto& change) {
        out.push_back({name, profile, {}});
        change(out.back().device);
    };
    add("shifts", Profile::direct3d, [](Device&) {});
    add("divide", Profile::direct3d, [](Device& d) { d.multiply = FixedMultiply::divide; });
    add("nearest even", Profile::direct3d,
        [](Device& d) { d.unorm = UnormRounding::nearest_even; });
    add("binary32", Profile::direct3d, [](Device& d) { d.blend = BlendMath::binary32; });
    add("fused", Profile::direct3d, [](Device& d) {
        d.blend = BlendMath::binary32;
        d.fused = true;
    });
    add("one product", Profile::direct3d, [](Device& d) { d.blend = BlendMath::one_product; });
    add("halves towards zero", Profile::direct3d, [](Device& d) { d.half_toward_zero = true; });
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        add("down", profile, [](Device& d) { d.unorm = UnormRounding::down; });
    }
    return out;
}

TEST(BlendUnit, EveryLegalUnitIsAllowed) {
    for (const Unit& unit : legal_units()) {
        for (const ColorFormat format : kBlendable) {
            const Count one = hold_against_reference(unit.device, unit.profile, format, 1, 1);
            EXPECT_EQ(one.refused, 0U) << unit.name << ": " << one.first;
            const Count many = hold_against_reference(unit.device, unit.profile, format, 2, 3, 3);
            EXPECT_EQ(many.refused, 0U) << unit.name << ", three fragments: " << many.first;
        }
    }
}

// Each fault is refused in every format that it concerns, and nothing is refused where it does not
// differ from the faultless unit.
TEST(BlendUnit, WrongOnesAreRefused) {
    const std::vector<ColorFormat> blendable(kBlendable.begin(), kBlendable.end());
    const std::vector<ColorFormat> unorm = {ColorFormat::rgba8_unorm, ColorFormat::bgra8_unorm,
                                            ColorFormat::rgb10a2_unorm, ColorFormat::r5g6b5_unorm,
                                            ColorFormat::rgba16_unorm};
    const std::vector<ColorFormat> eight = {ColorFormat::rgba8_unorm, ColorFormat::bgra8_unorm};
    const std::vector<ColorFormat> srgb = {ColorFormat::rgba8_srgb};
    const std::vector<ColorFormat> floats = {ColorFormat::rgba16_float, ColorFormat::rgba32_float,
                                             ColorFormat::r32_float};
    const std::vector<ColorFormat> with_alpha = {
        ColorFormat::rgba8_unorm,   ColorFormat::bgra8_unorm,  ColorFormat::rgba8_srgb,
        ColorFormat::rgb10a2_unorm, ColorFormat::rgba16_unorm, ColorFormat::rgba16_float,
        ColorFormat::rgba32_float};
    const std::vector<ColorFormat> wide = {ColorFormat::rgba32_float, ColorFormat::r32_float};
    struct Row {
        Fault fault;
        Profile profile;
        std::vector<ColorFormat> formats;
    };
    const Row rows[] = {
        {"blend-ignored"_fault, Profile::vulkan, blendable},
        {"blend-factors-exchanged"_fault, Profile::vulkan, blendable},
        {"blend-alpha-for-color"_fault, Profile::vulkan, blendable},
        {"blend-color-for-alpha"_fault, Profile::vulkan, with_alpha},
        {"blend-complement-forgotten"_fault, Profile::vulkan, blendable},
        {"blend-saturate-ignored"_fault, Profile::vulkan, with_alpha},
        {"blend-saturate-alpha"_fault, Profile::vulkan, with_alpha},
        {"blend-dst-alpha-one"_fault, Profile::vulkan, with_alpha},
        {"blend-missing-alpha-zero"_fault,
         Profile::vulkan,
         {ColorFormat::r5g6b5_unorm, ColorFormat::r32_float}},
        {"blend-constants-alpha"_fault, Profile::vulkan, blendable},
        {"blend-op-ignored"_fault, Profile::vulkan, blendable},
        {"blend-subtract-exchanged"_fault, Profile::vulkan, blendable},
        {"blend-min-max-scaled"_fault, Profile::vulkan, blendable},
        {"blend-premultiplies"_fault, Profile::vulkan, blendable},
        {"blend-shift-only"_fault, Profile::vulkan, eight},
        {"blend-floats-clamped"_fault, Profile::vulkan, floats},
        {"alpha-to-one-ignored"_fault, Profile::vulkan, blendable},
        {"alpha-to-one-stored"_fault, Profile::vulkan, blendable},
        {"alpha-to-one-unblended"_fault, Profile::vulkan, blendable},
        {"alpha-to-one-of-second"_fault, Profile::vulkan, blendable},
        {"alpha-to-one-everywhere"_fault, Profile::vulkan, blendable},
        {"second-as-first"_fault, Profile::vulkan, blendable},
        {"second-lost"_fault, Profile::vulkan, blendable},
        {"second-alpha-as-first"_fault, Profile::vulkan, blendable},
        {"second-alpha-as-color"_fault, Profile::vulkan, blendable},
        {"second-complement-forgotten"_fault, Profile::vulkan, blendable},
        {"second-unclamped"_fault,
         Profile::vulkan,
         {ColorFormat::rgb10a2_unorm, ColorFormat::r5g6b5_unorm, ColorFormat::rgba16_unorm,
          ColorFormat::rgba8_srgb}},
        {"sources-exchanged"_fault, Profile::vulkan, blendable},
        {"write-mask-ignored"_fault, Profile::vulkan, blendable},
        {"write-mask-ignored-blending"_fault, Profile::vulkan, blendable},
        {"write-mask-shifted"_fault, Profile::vulkan, blendable},
        {"write-mask-unswizzled"_fault, Profile::vulkan, {ColorFormat::bgra8_unorm}},
        {"bgra-swapped"_fault, Profile::vulkan, {ColorFormat::bgra8_unorm}},
        {"store-truncates"_fault, Profile::direct3d, unorm},
        {"store-wraps"_fault, Profile::vulkan, unorm},
        {"store-scale"_fault, Profile::direct3d, unorm},
        {"store-through-8-bits"_fault, Profile::direct3d, {ColorFormat::r5g6b5_unorm}},
        {"float-store-clamped"_fault, Profile::vulkan, floats},
        {"float-store-half"_fault, Profile::vulkan, wide},
        {"srgb-not-encoded"_fault, Profile::vulkan, srgb},
        {"srgb-not-decoded"_fault, Profile::vulkan, srgb},
        {"srgb-alpha-encoded"_fault, Profile::vulkan, srgb},
        {"srgb-gamma"_fault, Profile::vulkan, srgb},
    };
    for (const Row& row : rows) {
        Device device;
        device.fault = row.fault;
        for (const ColorFormat format : row.formats) {
            const Count count = hold_against_reference(device, row.profile, format, 3, 1);
            EXPECT_GT(count.refused, 0U) << to_string(row.fault) << ", " << cases::name_of(format);
            EXPECT_GT(count.allowed, 0U) << to_string(row.fault) << ", " << cases::name_of(format);
        }
    }
}

// Truncation is what Vulkan leaves open and Direct3D does not.
TEST(BlendUnit, TruncationBreaksDirect3dAlone) {
    Device device;
    device.unorm = UnormRounding::down;
    for (const ColorFormat format : {ColorFormat::rgba8_unorm, ColorFormat::r5g6b5_unorm}) {
        EXPECT_EQ(hold_against_reference(device, Profile::practice, format, 4, 1).refused, 0U);
        EXPECT_GT(hold_against_reference(device, Profile::direct3d, format, 4, 1).refused, 0U);
    }
}

TEST(Store, HalvesByHand) {
    const Device even;
    Device zero;
    zero.half_toward_zero = true;
    EXPECT_EQ(to_half(1.0F, even), 0x3c00);
    EXPECT_EQ(to_half(-2.0F, even), 0xc000);
    EXPECT_EQ(to_half(65504.0F, even), 0x7bff);
    EXPECT_EQ(to_half(65519.0F, even), 0x7bff);
    EXPECT_EQ(to_half(65520.0F, even), 0x7c00);  // half a step beyond: infinity
    EXPECT_EQ(to_half(65520.0F, zero), 0x7bff);
    EXPECT_EQ(to_half(1.0F + 0x1p-11F, even), 0x3c00);  // a tie goes to the even one
    EXPECT_EQ(to_half(1.0F + 0x3p-11F, even), 0x3c02);
    EXPECT_EQ(to_half(1.0F + 0x3p-11F, zero), 0x3c01);
    EXPECT_EQ(to_half(0x1p-24F, even), 0x0001);
    EXPECT_EQ(to_half(0x1p-25F, even), 0x0000);
    EXPECT_EQ(to_half(0x1.8p-25F, even), 0x0001);
    for (uint32_t bits = 0; bits < 0x10000; ++bits) {
        const float value = from_half(static_cast<uint16_t>(bits));
        if (!std::isnan(value)) {
            ASSERT_EQ(to_half(value, even), bits);
            ASSERT_EQ(to_half(value, zero), bits);
        }
    }
}

// Codes of 8 bits and fewer come back as they are, whatever the path.
TEST(Store, CodesComeBack) {
    for (const UnormRounding rounding : {UnormRounding::nearest, UnormRounding::nearest_even}) {
        Device device;
        device.unorm = rounding;
        for (const uint32_t bits : {2U, 5U, 6U, 8U, 10U, 16U}) {
            for (uint32_t code = 0; code < 1U << bits; ++code) {
                const Channel channel{Number::unorm, bits};
                ASSERT_EQ(store_channel(load_channel(code, channel, device), channel, device),
                          code);
            }
        }
        for (uint32_t code = 0; code < 256; ++code) {
            const Channel channel{Number::srgb, 8};
            ASSERT_EQ(store_channel(load_channel(code, channel, device), channel, device), code);
        }
    }
}

// The two ways to divide a product of bytes by 255 agree: both round to nearest.
TEST(BlendUnit, MultipliesBytesToNearest) {
    Device divides, shifts;
    divides.multiply = FixedMultiply::divide;
    shifts.multiply = FixedMultiply::shifts;
    const BlendUnit a(ColorFormat::rgba8_unorm, divides);
    const BlendUnit b(ColorFormat::rgba8_unorm, shifts);
    cases::ColorOutput output;
    output.blend =
        cases::Blend{{cases::BlendFactor::dst_color, cases::BlendFactor::zero, cases::BlendOp::add},
                     {cases::BlendFactor::zero, cases::BlendFactor::zero, cases::BlendOp::add},
                     glm::vec4(0)};
    for (uint32_t x = 0; x < 256; ++x) {
        for (uint32_t y = 0; y < 256; ++y) {
            const glm::vec4 source(static_cast<float>(x) / 255.0F);
            const Texel before{y, y, y, y};
            const uint32_t nearest = (2 * x * y + 255) / 510;
            ASSERT_EQ(a.write(output, source, before)[0], nearest) << x << " " << y;
            ASSERT_EQ(b.write(output, source, before)[0], nearest) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace mutants
