// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device may show at each sample of a case: how many hits by front and back faces, and which
// triangles may have written last. Exactly-one rules (shared edges, mesh interiors) narrow the
// bounds.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/coverage.hpp"
#include "ref/path/path.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// Says which hits are allowed at one sample. All of these hold: front in [front_min, front_max],
// back in [back_min, back_max], front - back in [signed_min, signed_max], front + back in
// [total_min, total_max].
struct HitBounds {
    uint32_t front_min = 0, front_max = 0;
    uint32_t back_min = 0, back_max = 0;
    int32_t signed_min = 0, signed_max = 0;
    uint32_t total_min = 0, total_max = 0;
    bool allows(uint32_t front, uint32_t back) const;
    // Whether some pair that is allowed looks so.
    bool allows(const path::SeenHits& seen) const;
    // True if exactly one pair (front, back) is allowed.
    bool is_decided() const;
    friend bool operator==(const HitBounds&, const HitBounds&) = default;
};

struct SampleExpectation {
    HitBounds hits;
    uint32_t writers_begin = 0;  // into Expectation::writers
    uint32_t writers_count =
        0;  // triangles that may have written last, ascending; 0 if none may hit
    // Into Expectation::depth_writers: whose depth may be stored. Only where a draw tests depth or
    // does not write it (DepthTest::is_needed); otherwise it is the last writer's.
    uint32_t depth_begin = 0, depth_count = 0;
    bool depth_may_be_clear = false;  // or no fragment's
    // Into Lists::fragments. Where something is open: all that take part in the paths, with their
    // sets and tests. Else, if the target has a colour or no instruments, or a draw a query: those
    // that pass all tests.
    uint32_t fragments_begin = 0, fragments_count = 0;
    uint32_t sets_begin = 0, sets_count = 0;
    uint32_t tests_begin = 0, tests_count = 0;
    bool is_open = false;  // there is more than one path (ref/path/path.hpp)
    bool is_free = false;  // there are too many: nothing is claimed
    // Into Lists::stencils, if the case needs a stencil test (stencil::is_needed); none: the
    // clear value, wherever nothing hits.
    uint32_t stencils_begin = 0, stencils_count = 0;
};

// How a depth that was stored meets the tests of a fragment.
struct TestedDepth {
    uint32_t fragment = 0;           // of the sample
    int stored = path::kClearDepth;  // fragment of the sample, or the clear value
    DepthOutcome bounds = DepthOutcome::passes, depth = DepthOutcome::passes;
    friend bool operator==(const TestedDepth&, const TestedDepth&) = default;
};

// What the expectations of samples point to.
struct Lists {
    std::vector<uint32_t> writers;
    std::vector<uint32_t> depth_writers;
    std::vector<path::Fragment> fragments;  // without the state of their draws
    std::vector<path::FragmentSet> sets;
    std::vector<TestedDepth> tests;  // of a sample by fragment, then by what is stored
    std::vector<path::Outcome> stencils;
};

// What is expected of every sample, by index_of (sample.hpp). Of most samples the same is expected
// as of their neighbours, so each expectation is kept once, with a number, and a sample has four
// bytes.
class SampleExpectations {
  public:
    static constexpr uint32_t kNothing = 0;  // the number of what no triangle may hit

    SampleExpectations() = default;  // of no sample
    explicit SampleExpectations(size_t samples) : numbers_(samples, kNothing) {}

    size_t size() const { return numbers_.size(); }
    const SampleExpectation& operator[](size_t index) const { return table_[numbers_[index]]; }
    // Samples with one number have one expectation; those with two numbers may have equal ones.
    uint32_t number(size_t index) const { return numbers_[index]; }
    const SampleExpectation& of_number(uint32_t number) const { return table_[number]; }

    uint32_t add(const SampleExpectation& expected) {
        table_.push_back(expected);
        return static_cast<uint32_t>(table_.size() - 1);
    }
    // Gives a number to `count` samples from `first` on, each `step` after the one before.
    void set(size_t first, size_t count, size_t step, uint32_t number) {
        for (size_t k = 0; k < count; ++k) {
            numbers_[first + k * step] = number;
        }
    }

  private:
    std::vector<uint32_t> numbers_;
    std::vector<SampleExpectation> table_{SampleExpectation{}};  // by number
};

struct Expectation : Lists {
    Limits limits;
    cases::Profile profile = cases::Profile::direct3d;
    cases::Target target;
    std::vector<cases::Triangle> triangles;  // drawing order
    SampleExpectations samples;
    uint64_t must_samples = 0;    // samples that must be hit at least once: the control of the case
    uint64_t either_samples = 0;  // samples where more than one answer is allowed

    std::span<const uint32_t> writers_of(const SampleExpectation& s) const {
        return std::span(writers).subspan(s.writers_begin, s.writers_count);
    }
    std::span<const uint32_t> depth_writers_of(const SampleExpectation& s) const {
        return std::span(depth_writers).subspan(s.depth_begin, s.depth_count);
    }
    std::span<const path::Fragment> fragments_of(const SampleExpectation& s) const {
        return std::span(fragments).subspan(s.fragments_begin, s.fragments_count);
    }
    std::span<const TestedDepth> tests_of(const SampleExpectation& s) const {
        return std::span(tests).subspan(s.tests_begin, s.tests_count);
    }
    std::span<const path::Outcome> stencils_of(const SampleExpectation& s) const {
        return std::span(stencils).subspan(s.stencils_begin, s.stencils_count);
    }
};

// The stencils that a sample of a case with a stencil test may hold: those that go with these hits,
// front and back; of hits that no path has, and of none given, any that it may hold.
stencil::Values stencils_at(const Expectation& e, const SampleExpectation& s,
                            std::optional<std::pair<uint32_t, uint32_t>> hits);

// The triangles whose fragments show at a sample of which nothing is open, in drawing order, if its
// fragments are kept.
std::vector<uint32_t> shown_at(const Expectation& e, const SampleExpectation& s);

// The paths of a sample of which something is open, with the tests of the case's draws. Keeps
// references.
path::Question question_of(const Expectation& e, const cases::Case& c, const SampleExpectation& s);

// Whether a sample has the same hits, writers, depths and stencils in two expectations of one case.
bool is_same(const Expectation& a, const Expectation& b, size_t index);

class Onlooker;  // onlooker.hpp

// Computes the expectation of a case. A case that the loader accepted always has one. An onlooker
// sees each sample as it is judged.
// Source: docs/design.md "The reference"; Vulkan specification, "Basic Polygon Rasterization".
Expectation expect(const cases::Case& c, const Limits& limits, cases::Profile profile,
                   Onlooker* onlooker = nullptr);  // fast

namespace exact {
// The oracle computes the same from rationals alone, slowly and in the obvious way.
Expectation expect(const cases::Case& c, const Limits& limits, cases::Profile profile);
}  // namespace exact

}  // namespace ref
