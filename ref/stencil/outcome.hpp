// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the stencil of a sample may hold in the end, and which of its fragments are left of the
// depth bounds, stencil and depth tests, which come in this order. Sources: Vulkan specification,
// "Fragment Operations", "Depth Bounds Test", "Stencil Test", VkStencilOp, VkCompareOp;
// docs/rules.md. The stencil is an unsigned integer of eight bits, and all arithmetic on it exact.
//
// Where it is open whether a triangle covers the sample, which face it shows or whether it passes
// the depth test, each answer leads to another course of events, and the fragments after it see
// another stencil and depth. The answers are taken together: a course has one stencil, one stored
// depth and one number of hits, and what a sample may show is what the courses end in.
#pragma once

#include <bitset>
#include <compare>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/reason/reason.hpp"

namespace ref::stencil {

using Values = std::bitset<256>;  // a set of stencil values

// A triangle that may cover the sample; in drawing order.
struct Fragment {
    const cases::StencilState* state = nullptr;
    bool is_sure = false;  // it covers the sample
    bool can_be_front = false, can_be_back = false;
    bool writes_depth = false;
    // What is discarded after it has been tested and stored: it is no hit.
    bool is_discarded_front = false, is_discarded_back = false;
    bool is_discard_open = false;  // whichever face it shows: it is discarded so, or it is a hit
    int set = -1;                  // the set that it belongs to, or -1
    int twin = -1;  // an earlier fragment without which it is not there, nor that one without it
};

// Fragments of which some number are there.
struct FragmentSet {
    uint32_t least = 0, most = 0;
};

inline constexpr int kClearDepth = -1;  // instead of the number of the fragment that stored it

struct Question {
    uint32_t clear = 0;  // of the stencil
    std::vector<Fragment> fragments;
    std::vector<FragmentSet> sets;
    // Whether the depth that another one stored, or the clear value, lies in the depth bounds of a
    // fragment's draw, which is tested first; empty: it does.
    std::function<DepthOutcome(int stored, uint32_t fragment)> bounds = {};
    // The depth test of a fragment against the depth that another one stored, or against the clear
    // value; empty: every fragment passes.
    std::function<DepthOutcome(int stored, uint32_t fragment)> depth;
};

// What may become of a fragment in some course, if it is there.
struct Fate {
    bool fails = false;        // the stencil test
    bool fails_depth = false;  // having passed it
    bool passes = false;       // both
    bool is_absent = false;    // it does not cover the sample
    // Having passed both, it is discarded by its shader.
    bool is_discarded = false;
    bool fails_bounds = false;  // the depth bounds test, before all others
    Values met = {};            // the stencils that its test compares with in some course
    // Whether it gets to the stencil test, and to the depth test.
    bool is_tested() const { return fails || gets_to_depth(); }
    bool gets_to_depth() const { return passes || fails_depth || is_discarded; }
    bool always_passes() const {
        return passes && !fails && !fails_depth && !is_absent && !is_discarded && !fails_bounds;
    }
    friend bool operator==(const Fate&, const Fate&) = default;
};

// The stencils that go with a number of hits.
struct Outcome {
    uint32_t front = 0, back = 0;
    Values values;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

struct Resolution {
    // There are more courses than are followed: nothing is claimed of the sample.
    bool is_free = false;
    std::vector<Outcome> outcomes;  // by front, then back; each pair once
    std::vector<Fate> fates;        // of each fragment
    std::vector<bool> is_last;      // of each fragment: it may be the last that passes
    std::vector<bool> is_stored;    // its depth may be the one that stays
    bool may_be_clear = false;      // or no fragment's
};

// Whether the stencil of a case is more than a count of its hits, by which diff/resolve.hpp judges
// it: some draw tests it or has operations of its own, or stores it of fragments that it discards,
// it is not cleared to 0, or no hits are counted.
bool is_needed(const cases::Case& c);

// Courses that are followed at most, at a time: as many as differ in what comes after them, or in
// their hits.
inline constexpr size_t kMostCourses = 4096;

// Whether a fragment passes the stencil test.
bool passes(const cases::StencilFace& face, uint32_t stored);
// What an operation leaves, its write mask included.
uint32_t updated(cases::StencilOp op, const cases::StencilFace& face, uint32_t stored);

// Follows all courses side by side; those that cannot be told apart by what comes after are one.
Resolution resolve(const Question& question);

// Answers a question: resolve or exact::resolve (exact.hpp).
using Resolve = Resolution (*)(const Question&);

}  // namespace ref::stencil
