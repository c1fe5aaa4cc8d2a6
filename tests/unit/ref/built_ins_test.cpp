// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What fragments read of the pipeline: sample mask, sample number, sample position.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ref/number/fixed_point.hpp"
#include "ref/value/places.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/multisample_fixture.hpp"

namespace ref::test {
namespace {

using cases::Source;

cases::Case with_source(Source source, uint32_t components) {
    cases::Case c = triangle(Auxiliary::none);
    cases::Attribute a;
    a.source = source;
    a.components = components;
    c.draws[0].attributes = {a};
    return c;
}

FragmentValues built_in(cases::SampleId id, glm::vec4 value, bool is_shaded) {
    FragmentValues v = fragment(id, {0, 0}, {0, 0});
    v.attributes[0] = value;
    if (is_shaded) {
        const auto& at = cases::standard_sample_locations(4)[id.sample];
        v.frag_coord.x = static_cast<float>(id.x) + static_cast<float>(at[0]) / 16;
        v.frag_coord.y = static_cast<float>(id.y) + static_cast<float>(at[1]) / 16;
    }
    return v;
}

TEST(BuiltIns, SampleMaskInIsTheCoverage) {
    cases::Case c = with_source(Source::sample_mask_in, 1);
    const auto mask = [&](float m, bool is_shaded = false) {
        return accepted(c, kPart, built_in(kPart, {m, 0, 0, 0}, is_shaded));
    };
    EXPECT_EQ(mask(5), "vpd");
    EXPECT_EQ(mask(4), "---");   // sample 0 is covered, too
    EXPECT_EQ(mask(7), "---");   // sample 1 is not
    EXPECT_EQ(mask(1), "---");   // the sample itself is missing
    EXPECT_EQ(mask(21), "---");  // there is no sample 4
    EXPECT_EQ(mask(5.5F), "---");
    c.draws[0].multisample.sample_mask = 0b0100;
    EXPECT_EQ(mask(4), "vpd");
    EXPECT_EQ(mask(5), "---");
    c.draws[0].multisample = {};
    c.draws[0].multisample.min_sample_shading = 1.0F;
    EXPECT_EQ(mask(4, true), "vpd");
    EXPECT_EQ(mask(5, true), "v--");
    c.draws[0].multisample.min_sample_shading = 0.5F;
    EXPECT_EQ(mask(4, true), "vpd");
    EXPECT_EQ(mask(5, true), "vpd");
}

TEST(BuiltIns, SampleIdAndPosition) {
    const cases::Case id = with_source(Source::sample_id, 1);
    EXPECT_EQ(accepted(id, kPart, built_in(kPart, {2, 0, 0, 0}, true)), "vpd");
    EXPECT_EQ(accepted(id, kPart, built_in(kPart, {0, 0, 0, 0}, true)), "v--");
    EXPECT_EQ(accepted(id, kPart, built_in(kPart, {4, 0, 0, 0}, true)), "---");
    const cases::Case at = with_source(Source::sample_position, 2);
    EXPECT_EQ(accepted(at, kPart, built_in(kPart, {0.125F, 0.625F, 0, 0}, true)), "vpd");
    EXPECT_EQ(accepted(at, kPart, built_in(kPart, {0.375F, 0.125F, 0, 0}, true)), "v--");
    EXPECT_EQ(accepted(at, kPart, built_in(kPart, {0.375F, 0.625F, 0, 0}, true)), "---");
}

// Numbers of a quantity that a profile accepts, tried one by one; `put` writes one into a fragment.
template <class Put>
std::set<float> accepted_numbers(ValueReference& values, cases::SampleId id,
                                 const std::string& quantity, const std::vector<float>& numbers,
                                 Put put) {
    std::set<float> out;
    for (const float n : numbers) {
        for (const float other : numbers) {
            FragmentValues v = fragment(id, {0, 0}, {0, 0});
            put(v, n, other);
            const FragmentVerdict verdict = values.judge(0, id, v);
            const auto blamed = std::count_if(
                verdict.mismatches.begin(), verdict.mismatches.end(), [&](const auto& m) {
                    const std::string text = to_text(m.quantity);
                    return text.substr(0, text.find('.')) == quantity.substr(0, quantity.find('.'));
                });
            if (blamed == 0) {
                out.insert(n);
            }
        }
    }
    return out;
}

// What explain and the report say besides the likeliest number is what judging accepts.
TEST(BuiltIns, OtherNumbersThatAreRightAreTold) {
    std::vector<float> places;  // in the pixel
    for (const uint32_t k : {2U, 6U, 8U, 10U, 14U}) {
        places.push_back(static_cast<float>(k) / 16);
    }
    const std::vector<float> whole = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    size_t several = 0;
    size_t single = 0;
    const auto check = [&](const cases::Case& c, const std::string& name,
                           const std::vector<float>& numbers, bool is_in_framebuffer, auto put) {
        for (const Profile profile : cases::kProfiles) {
            for (const cases::SampleId id : {kWhole, kPart, cases::SampleId{4, 3, 0}}) {
                if (id.sample >= c.target.samples ||
                    (c.draws[0].multisample.sample_mask >> id.sample & 1U) == 0) {
                    continue;  // nothing is written there
                }
                ValueReference values(c, {8}, profile);
                const std::set<float> right = accepted_numbers(
                    values, id, name, numbers,
                    [&](FragmentValues& v, float a, float b) { put(v, id, a, b); });
                for (const ExpectedValue& e : values.expected(0, id)) {
                    if (to_text(e) != name) {
                        continue;
                    }
                    EXPECT_TRUE(e.is_flat);
                    EXPECT_EQ(e.also.empty(), right.size() == 1) << e.also;
                    (e.also.empty() ? single : several) += 1;
                    const float base = is_in_framebuffer ? static_cast<float>(id.x) : 0;
                    EXPECT_EQ(right.count(static_cast<float>(e.nearest) - base), 1U);
                    if (e.also.find_first_not_of("or ,.0123456789") == std::string::npos) {
                        std::set<float> told = {static_cast<float>(e.nearest) - base};
                        std::istringstream list(e.also.empty() ? "" : e.also.substr(3));
                        for (std::string number; std::getline(list, number, ',');) {
                            told.insert(std::stof(number) - base);
                        }
                        EXPECT_EQ(told, right) << e.also;
                    }
                }
            }
        }
    };
    const auto at_x = [](FragmentValues& v, cases::SampleId id, float x, float y) {
        v.frag_coord.x = static_cast<float>(id.x) + x;
        v.frag_coord.y = static_cast<float>(id.y) + y;
    };
    for (const Auxiliary auxiliary : {Auxiliary::none, Auxiliary::sample}) {
        for (const float least : {0.0F, 0.25F, 0.5F, 1.0F}) {
            cases::Case c = triangle(auxiliary);
            if (least > 0) {
                c.draws[0].multisample.min_sample_shading = least;
            }
            check(c, "frag_coord.x", places, true, at_x);
        }
    }
    const auto in_attribute = [](FragmentValues& v, cases::SampleId, float x, float y) {
        v.attributes[0] = {x, y, 0, 0};
    };
    check(with_source(Source::sample_position, 2), "attribute 0.x", places, false, in_attribute);
    check(with_source(Source::sample_id, 1), "attribute 0.x", {0, 1, 2, 3, 4}, false, in_attribute);
    for (const float least : {0.0F, 0.5F, 1.0F}) {
        cases::Case c = with_source(Source::sample_mask_in, 1);
        if (least > 0) {
            c.draws[0].multisample.min_sample_shading = least;
        }
        check(c, "attribute 0.x", whole, false, in_attribute);
        for (const uint32_t mask : {0b0101U, 0b0100U, 0b0001U}) {
            c.draws[0].multisample.sample_mask = mask;
            check(c, "attribute 0.x", whole, false, in_attribute);
        }
    }
    cases::Case one = with_source(Source::sample_id, 1);
    one.target.samples = 1;
    check(one, "attribute 0.x", {0, 1, 2}, false, in_attribute);
    EXPECT_GT(several, 20U);
    EXPECT_GT(single, 20U);
}

TEST(BuiltIns, InvocationsAreCountedUp) {
    cases::Draw draw;
    EXPECT_EQ(value::least_invocations(draw, 8), 1U);
    draw.multisample.min_sample_shading = 0.0F;
    EXPECT_EQ(value::least_invocations(draw, 8), 1U);
    draw.multisample.min_sample_shading = 0.26F;
    EXPECT_EQ(value::least_invocations(draw, 8), 3U);
    EXPECT_EQ(value::shading_rate(draw, 8), value::ShadingRate::some);
    EXPECT_EQ(value::shading_rate(draw, 1), value::ShadingRate::fragment);
    draw.attributes.emplace_back().source = Source::sample_id;
    EXPECT_EQ(value::least_invocations(draw, 8), 8U);
}

}  // namespace
}  // namespace ref::test
