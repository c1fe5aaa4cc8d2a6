// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A triangle of four samples a pixel whose inputs are planes of the position, so that expectations
// can be written down, and fragments of devices that evaluate them where a test says.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cases/model/sample.hpp"
#include "ref/value/places.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/coverage_fixture.hpp"

namespace ref::test {

using cases::Auxiliary;
using cases::Profile;

// The triangle (1,1) (7,1) (1,7) of 8x8 pixels with four samples.
inline cases::Case triangle(Auxiliary auxiliary) {
    cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}}, 4);
    cases::Attribute position;  // x, y
    position.interpolation = cases::Interpolation::noperspective;
    position.components = 2;
    position.auxiliary = auxiliary;
    position.values = {{1, 1, 0, 0}, {7, 1, 0, 0}, {1, 7, 0, 0}};
    cases::Attribute sum;  // x + 2 y
    sum.auxiliary = auxiliary;
    sum.values = {{3, 0, 0, 0}, {9, 0, 0, 0}, {15, 0, 0, 0}};
    c.draws[0].attributes = {position, sum};
    return c;
}

// A device that evaluates the first attribute at p, the second at q.
inline FragmentValues fragment(cases::SampleId id, Point p, Point q) {
    FragmentValues v;
    v.frag_coord = {static_cast<float>(id.x) + 0.5F, static_cast<float>(id.y) + 0.5F, 0.5F, 1};
    v.depth = 0.5F;
    v.attributes[0] = {static_cast<float>(p[0]), static_cast<float>(p[1]), 0, 0};
    v.attributes[1] = {static_cast<float>(q[0] + 2 * q[1]), 0, 0, 0};
    return v;
}

// The profiles that accept a fragment, as letters; the oracle has to agree.
inline std::string accepted(const cases::Case& c, cases::SampleId id, const FragmentValues& v) {
    std::string out;
    for (const Profile profile : cases::kProfiles) {
        ValueReference values(c, {8}, profile);
        const FragmentVerdict fast = values.judge(0, id, v);
        const FragmentVerdict exact = values.judge_exact(0, id, v);
        EXPECT_EQ(fast.ok, exact.ok) << cases::to_string(profile);
        out += fast.ok ? cases::to_string(profile).substr(0, 1) : "-";
        if (!fast.ok) {
            // The level of a finding is the loosest profile that forbids it.
            const auto first = out.find('-');
            for (const ValueMismatch& m : fast.mismatches) {
                EXPECT_LE(m.level, profile);
                EXPECT_GE(m.level, cases::kProfiles[first]);
            }
        }
    }
    return out;
}

inline constexpr cases::SampleId kWhole{2, 2, 1};  // all four samples are covered
// Pixel (4,3) is cut by x + y = 8: samples 0 (4.375,3.125) and 2 (4.125,3.625) are covered, the
// centre lies on the edge.
inline constexpr cases::SampleId kPart{4, 3, 2};

}  // namespace ref::test
