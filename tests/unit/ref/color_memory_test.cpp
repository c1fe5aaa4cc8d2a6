// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The short ways to a colour against the long ones: what binary64 says of a stored code against
// rationals, colours that are remembered against Unit::write, four ranges against one by one.
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <optional>
#include <random>

#include "ref/color/color.hpp"
#include "ref/color/component_filter.hpp"
#include "value_case.hpp"

namespace ref::color {
namespace {

using cases::BlendFactor;
using cases::BlendOp;
using cases::ComponentKind;
using cases::Profile;

bool is_stored_exactly(const Component& component, double low, double high, uint32_t code,
                       Profile profile) {
    const Interval stored =
        component.stored({mpq_class(low), mpq_class(high)}, profile, /*is_blended=*/false);
    return component.allows(code, stored);
}

// Up to three numbers of binary64 away, or not at all.
double near(double value, std::mt19937& random) {
    const double towards = random() % 2 == 0 ? HUGE_VAL : -HUGE_VAL;
    for (uint32_t steps = random() % 4; steps > 0; --steps) {
        value = std::nextafter(value, towards);
    }
    return value;
}

TEST(MayStore, SaysWhatRationalsSay) {
    struct Tried {
        cases::ComponentFormat format;
        uint32_t top;  // no code is larger
    };
    const Tried all[] = {
        {{ComponentKind::unorm, 2}, 3},       {{ComponentKind::unorm, 5}, 31},
        {{ComponentKind::unorm, 8}, 255},     {{ComponentKind::unorm, 10}, 1023},
        {{ComponentKind::unorm, 16}, 65535},  {{ComponentKind::half, 16}, 0xffff},
        {{ComponentKind::binary32, 32}, ~0U}, {{ComponentKind::uint, 8}, 255},
        {{ComponentKind::uint, 32}, ~0U},     {{ComponentKind::srgb, 8}, 255},
        {{ComponentKind::snorm, 8}, 255},     {{ComponentKind::snorm, 16}, 65535},
        {{ComponentKind::sint, 8}, 255},      {{ComponentKind::half, 11}, 2047},
    };
    std::mt19937 random(15);
    for (const Tried& tried : all) {
        const Component component(tried.format);
        size_t known = 0;
        size_t yes = 0;
        const size_t count = 40000;
        for (size_t n = 0; n < count; ++n) {
            // A value at or between codes, at the edge of a rule or anywhere.
            const auto code_at = static_cast<uint32_t>(
                std::uniform_int_distribution<uint32_t>(0, tried.top)(random));
            mpq_class exact;
            double value = 1e5 * std::ldexp(1.0, static_cast<int>(random() % 40) - 20);
            if (component.value_of(code_at, exact)) {
                value = exact.get_d();
                mpq_class next;
                if (random() % 2 == 0 && code_at < tried.top &&
                    component.value_of(code_at + 1, next)) {
                    const double parts[] = {0, 0.25, 0.4, 0.5, 0.6, 1};
                    value += (next.get_d() - value) * parts[random() % 6];
                }
            }
            value *= random() % 16 == 0 ? -1 : 1;
            const double low = near(value, random);
            const double high = random() % 4 == 0 ? std::max(low, near(low * 1.004, random)) : low;
            const auto code =
                std::min(tried.top, static_cast<uint32_t>(code_at + random() % 5 - 2));
            const Profile profile = cases::kProfiles[random() % 3];
            const std::optional<bool> may = may_store(component, low, high, code, profile);
            if (may) {
                ++known;
                yes += *may ? 1U : 0U;
                ASSERT_EQ(*may, is_stored_exactly(component, low, high, code, profile))
                    << static_cast<int>(tried.format.kind) << " of " << tried.format.bits
                    << " bits, code " << code << ", " << low << " to " << high << ", profile "
                    << static_cast<int>(profile);
            }
        }
        const bool is_short = component.is_unsigned_float();
        if (tried.format.kind == ComponentKind::srgb || is_short) {
            EXPECT_EQ(known, 0U);
        } else {
            EXPECT_GT(known, count / 2);
            EXPECT_GT(yes, count / 40);
            EXPECT_LT(yes, known);
        }
    }
}

TEST(MayStore, InfinitiesAndNoNumbers) {
    const Component half({ComponentKind::half, 16});
    const Component binary32({ComponentKind::binary32, 32});
    const double sizes[] = {0, 1, 65503, 65504, 65505, 65536, 1e10, 0x1.fffffep127, 0x1p128, 1e300};
    for (const double low : sizes) {
        for (const double sign : {1.0, -1.0}) {
            const double v = sign * low;
            for (const uint32_t code :
                 {0x7bfeU, 0x7bffU, 0x7c00U, 0x7c01U, 0xfbffU, 0xfc00U, 0xfe00U, 0U, 0x8000U}) {
                EXPECT_EQ(may_store(half, v, v, code, Profile::vulkan),
                          is_stored_exactly(half, v, v, code, Profile::vulkan))
                    << v << " as " << code;
            }
            for (const uint32_t code : {0x7f7ffffeU, 0x7f7fffffU, 0x7f800000U, 0x7f800001U,
                                        0xff7fffffU, 0xff800000U, 0xffc00000U, 0U, 0x80000000U}) {
                EXPECT_EQ(may_store(binary32, v, v, code, Profile::vulkan),
                          is_stored_exactly(binary32, v, v, code, Profile::vulkan))
                    << v << " as " << code;
            }
        }
    }
}

cases::Blend any_blend(std::mt19937& random) {
    cases::Blend blend;
    for (cases::BlendEquation* e : {&blend.color, &blend.alpha}) {
        e->source = static_cast<BlendFactor>(random() % 19);
        e->destination = static_cast<BlendFactor>(random() % 19);
        e->op = static_cast<BlendOp>(random() % 5);
    }
    blend.constants = {0.25F, 0.5F, 0.75F, 0.125F};
    blend.second = {0.5F, 0.125F, 1.0F, 0.25F};
    return blend;
}

// Triangles in four draws that write flat or constant colours in all manners; `is_varied`: small
// ones, each of its own colour, that nothing replaces.
cases::Case flat_colors(cases::ColorFormat format, uint32_t triangles, bool is_varied,
                        std::mt19937& random) {
    constexpr uint32_t kSize = 24;
    cases::Case c = value_test::make_case(kSize, {});
    c.target.color = {format, {0.125F, 0.25F, 0.5F, 0.75F}};
    c.target.has_instruments = false;
    c.target.has_depth = false;
    const cases::Draw empty = c.draws.front();
    c.draws.clear();
    for (uint32_t d = 0; d < 4; ++d) {
        cases::Draw draw = empty;
        draw.positions.clear();
        cases::Attribute flat;
        flat.name = "c";
        flat.interpolation = cases::Interpolation::flat;
        flat.components = 4;
        for (uint32_t t = 0; t < triangles; ++t) {
            const auto coordinate = [&] { return static_cast<double>(random() % 193) / 8 + 0.03; };
            const double x = coordinate(), y = coordinate();
            const double size = is_varied ? 2.1 : 16.1;
            for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {size, 0.0}, {0.0, size}}) {
                draw.positions.push_back(value_test::clip_of(x + dx, y + dy, 0.5, 1, kSize));
                const auto part = [&] {
                    return is_varied ? static_cast<float>(random() % 1000) / 999.0F
                                     : static_cast<float>(t % 3) / 7.0F;
                };
                flat.values.emplace_back(part(), part(), part(), part());
            }
        }
        draw.color.attribute = d == 1 ? -1 : 0;
        draw.color.value = {0.3F, 0.6F, 0.1F, 0.5F};
        if (is_varied || d != 2) {
            draw.color.blend = any_blend(random);
        }
        draw.color.write_mask = d == 3 ? 0b0101 : 0xf;
        draw.attributes.push_back(flat);
        c.draws.push_back(draw);
    }
    return c;
}

// What Unit::write makes of the fragments, one after another.
Color left_by_all(const cases::Case& c, const Expectation& expectation, const Unit& unit,
                  std::span<const path::Fragment> hits) {
    Color color = unit.cleared(*c.target.color);
    for (const path::Fragment& hit : hits) {
        const cases::Triangle& triangle = expectation.triangles[hit.triangle];
        const cases::Draw& draw = c.draws[triangle.draw];
        const glm::vec4 v = draw.color.attribute < 0
                                ? draw.color.value
                                : draw.attributes[0].values[triangle.provoking];
        Color source;
        for (size_t k = 0; k < 4; ++k) {
            source[k] = point(static_cast<double>(v[static_cast<int>(k)]));
        }
        color = unit.write(draw.color, source, color);
    }
    return color;
}

void check_remembered(uint32_t triangles, bool is_varied, std::mt19937& random) {
    for (const cases::ColorFormat format :
         {cases::ColorFormat::rgba8_unorm, cases::ColorFormat::rgba16_float,
          cases::ColorFormat::rgba32_float, cases::ColorFormat::r5g6b5_unorm}) {
        const cases::Case c = flat_colors(format, triangles, is_varied, random);
        const Expectation expectation = expect(c, Limits{8}, Profile::direct3d);
        ColorReference reference(c, expectation);
        const Unit unit{format, Profile::direct3d};
        size_t layered = 0;
        for (size_t index = 0; index < expectation.samples.size(); ++index) {
            const auto hits = expectation.fragments_of(expectation.samples[index]);
            if (expectation.samples[index].is_open) {
                continue;
            }
            layered += hits.size() > 1 ? 1U : 0U;
            const cases::SampleId id = sample_at(c.target, index);
            const Color color = left_by_all(c, expectation, unit, hits);
            std::array<uint32_t, 4> codes = unit.codes_of(color);
            ASSERT_EQ(reference.codes(index, id), codes) << index;
            for (uint32_t n = 0; n < 4; ++n) {
                ASSERT_EQ(reference.explains(index, id, codes), unit.allows(color, codes)) << index;
                codes.at(random() % 3) ^= 1U << random() % 2;
            }
        }
        EXPECT_GT(layered, 100U);
    }
}

TEST(ExhaustiveColorMemory, RemembersWhatTheUnitWrites) {
    std::mt19937 random(4);
    for (int n = 0; n < 4; ++n) {
        check_remembered(6, false, random);
    }
}

TEST(ExhaustiveColorMemory, ColoursBeyondItsCapacityAreComputed) {
    std::mt19937 random(5);
    check_remembered(ColorReference::kRemembered / 4, true, random);  // in each of four draws
}

// What a device wrote down of its fragment may be anything; NaN has no rational.
TEST(ColorMemory, WhatIsNoNumberIsNotTakenForWhatWasWritten) {
    std::mt19937 random(6);
    const cases::Case c = flat_colors(cases::ColorFormat::rgba32_float, 6, false, random);
    const Expectation expectation = expect(c, Limits{8}, Profile::direct3d);
    ColorReference reference(c, expectation);
    size_t compared = 0;
    for (size_t index = 0; index < expectation.samples.size(); ++index) {
        const auto hits = expectation.fragments_of(expectation.samples[index]);
        if (hits.empty() || expectation.samples[index].is_open) {
            continue;
        }
        ++compared;
        const cases::SampleId id = sample_at(c.target, index);
        ColorWitness witness;
        witness.paths.hits = {path::SeenHits::Detail::total, static_cast<uint32_t>(hits.size()), 0};
        const std::array<uint32_t, 4> codes = reference.codes(index, id, witness);
        for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
            for (int k = 0; k < 4; ++k) {
                glm::vec4 written(0.25F);
                written[k] = bad;
                witness.written[0] = &written;
                ASSERT_EQ(reference.codes(index, id, witness), codes) << index;
                ASSERT_TRUE(reference.explains(index, id, codes, witness)) << index;
            }
        }
    }
    EXPECT_GT(compared, 100U);
}

// 1/w is 8 (x - 8.5): 0 at the centre of a pixel whose sample at 8.875 is covered. Whatever a
// device makes of the division may be stored, and may be blended.
TEST(ColorMemory, AValueThatIsDividedByZeroLeavesAnything) {
    const uint32_t nan = std::bit_cast<uint32_t>(std::nanf(""));
    const uint32_t infinity = std::bit_cast<uint32_t>(-HUGE_VALF);
    const uint32_t number = std::bit_cast<uint32_t>(0.25F);
    for (const std::optional<BlendOp> op :
         {std::optional<BlendOp>(), std::optional(BlendOp::add), std::optional(BlendOp::min)}) {
        cases::Case c =
            value_test::make_case(16, {value_test::clip_of(8.625, 4, 0.5, 1, 16),
                                       value_test::clip_of(8.625, 13, 0.5, 1, 16),
                                       value_test::clip_of(12.5, 8.5, 0.5, 1.0 / 32, 16)});
        c.target.samples = 4;
        c.target.has_instruments = false;
        c.target.color.emplace().format = cases::ColorFormat::rgba32_float;
        value_test::add_attribute(c, cases::Interpolation::smooth, 4,
                                  {glm::vec4(0.25F), glm::vec4(0.5F), glm::vec4(1.0F)});
        c.draws[0].color.attribute = 0;
        if (op) {
            const cases::BlendEquation equation{BlendFactor::one, BlendFactor::one, *op};
            c.draws[0].color.blend = cases::Blend{equation, equation};
        }
        const Expectation expectation = expect(c, Limits{8}, Profile::direct3d);
        ColorReference reference(c, expectation);
        const auto explains = [&](cases::SampleId id, uint32_t code) {
            const size_t index = cases::index_of(c.target, id);
            return reference.explains(index, id, {code, code, code, code});
        };
        for (const uint32_t code : {nan, infinity, number}) {
            EXPECT_TRUE(explains({8, 8, 1}, code)) << code;
        }
        // In a pixel that is covered as a whole nothing is divided by zero.
        for (const uint32_t code : {nan, infinity}) {
            EXPECT_FALSE(explains({10, 8, 1}, code)) << code;
        }
    }
}

TEST(ColorMemory, KeepsNoMoreThanItsCapacity) {
    ColorMemory memory({}, 2);
    const auto first = memory.name_of(0, true, {});
    ASSERT_TRUE(first);
    EXPECT_EQ(memory.name_of(0, true, {}), first);
    const auto second = memory.name_of(0, false, {});
    ASSERT_TRUE(second);
    EXPECT_NE(second, first);
    EXPECT_FALSE(memory.name_of(1, true, {}));
    int calls = 0;
    const auto leave = [&] {
        ++calls;
        return Color{};
    };
    ColorMemory::Node* const node = memory.after(memory.root(), *first, leave);
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(memory.after(memory.root(), *first, leave), node);
    EXPECT_EQ(memory.after(*node, *first, leave), nullptr);
    EXPECT_EQ(memory.after(memory.root(), *second, leave), nullptr);
    EXPECT_EQ(calls, 1);
}

TEST(Ranges, AreThoseOfEveryComponent) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-2, 14);
    for (int n = 0; n < 60; ++n) {
        std::array<glm::vec4, 3> clip{};
        for (glm::vec4& v : clip) {
            v = value_test::clip_of(place(random), place(random), 0.5,
                                    n % 3 == 0 ? 1 : 0.2 + place(random) / 10, 12);
        }
        cases::Case c = value_test::make_case(12, clip);
        const auto any = [&] { return static_cast<float>(place(random)); };
        for (uint32_t a = 0; a < 3; ++a) {
            value_test::add_attribute(
                c, static_cast<cases::Interpolation>(a), a + 2,
                {glm::vec4(any(), any(), any(), any()), glm::vec4(any(), any(), any(), any()),
                 glm::vec4(any(), any(), any(), 1)});
        }
        for (const Profile profile : cases::kProfiles) {
            ValueReference reference(c, Limits{8}, profile);
            for (uint32_t s = 0; s < 16; ++s) {
                const cases::SampleId id{s % 4 * 3, s / 4 * 3, 0};
                for (const size_t attribute : {0U, 1U, 2U}) {
                    const std::array<ValueRange, 4> all = reference.ranges(0, id, attribute);
                    for (uint32_t k = 0; k < 4; ++k) {
                        const ValueRange one =
                            reference.range(0, id, QuantityId::of_attribute(attribute, k));
                        ASSERT_EQ(all[k].is_promised, one.is_promised);
                        ASSERT_EQ(std::bit_cast<uint64_t>(all[k].low),
                                  std::bit_cast<uint64_t>(one.low));
                        ASSERT_EQ(std::bit_cast<uint64_t>(all[k].high),
                                  std::bit_cast<uint64_t>(one.high));
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace ref::color
