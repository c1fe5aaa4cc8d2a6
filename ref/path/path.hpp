// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A path is one history of a sample's fragments, in drawing order: each is there or not, shows a
// face, meets the depth bounds, stencil and depth tests, which come in this order, and is discarded
// or shows. Sources: Vulkan specification, "Fragment Operations", "Depth Bounds Test", "Stencil
// Test", "Depth Test"; docs/rules.md.
//
// Where it is open whether a triangle covers the sample, which face it shows, how a comparison of
// depths comes out or whether its shader discards it, each answer is another path, and the
// fragments after it see another stencil and depth. A picture is right if one path satisfies all
// planes that were delivered: what they show is asked of paths together, never one by one.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/stencil/operation.hpp"

namespace ref::path {

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
    uint32_t triangle = 0;
    // Whether its shader discards it by a value is open; but for that it covers the sample.
    bool is_value_open = false, is_sure_but_for_value = false;
    // Of a clear, which passes every test and is discarded then: its colour shows all the same.
    bool is_clear = false;
    // Whether clipping may leave several pieces of the triangle, each with fragments of its own.
    bool is_in_pieces = false;
    friend bool operator==(const Fragment&, const Fragment&) = default;
};

inline constexpr cases::StencilState kKeepStencil{{}, {}};  // where there is none

// Fragments of which some number are there.
struct FragmentSet {
    uint32_t least = 0, most = 0;
    friend bool operator==(const FragmentSet&, const FragmentSet&) = default;
};

inline constexpr int kClearDepth = -1;  // instead of the number of the fragment that stored it

struct Question {
    uint32_t clear = 0;       // of the stencil
    bool is_unknown = false;  // the stencil may be any instead
    std::vector<Fragment> fragments;
    std::vector<FragmentSet> sets;
    // Whether the depth that another one stored, or the clear value, lies in the depth bounds of a
    // fragment's draw, which is tested first; empty: it does.
    std::function<DepthOutcome(int stored, uint32_t fragment)> bounds = {};
    // The depth test of a fragment against the depth that another one stored, or against the clear
    // value; empty: every fragment passes.
    std::function<DepthOutcome(int stored, uint32_t fragment)> depth = {};

    DepthOutcome bounds_of(int stored, size_t fragment) const {
        return bounds ? bounds(stored, static_cast<uint32_t>(fragment)) : DepthOutcome::passes;
    }
    DepthOutcome depth_of(int stored, size_t fragment) const {
        return depth ? depth(stored, static_cast<uint32_t>(fragment)) : DepthOutcome::passes;
    }
};

// What may become of a fragment on some path, if it is there.
struct Fate {
    bool fails = false;        // the stencil test
    bool fails_depth = false;  // having passed it
    bool passes = false;       // both, and shows
    bool is_absent = false;    // it does not cover the sample
    // Having passed both, it is discarded by its shader.
    bool is_discarded = false;
    bool fails_bounds = false;  // the depth bounds test, before all others
    stencil::Values met = {};   // the stencils that its test compares with on some path
    // Whether it gets to the stencil test, and to the depth test.
    bool is_tested() const { return fails || gets_to_depth(); }
    bool gets_to_depth() const { return passes || fails_depth || is_discarded; }
    // What its depth test comes to, if it gets there.
    DepthOutcome depth() const {
        const bool may_pass = passes || is_discarded;
        return may_pass == fails_depth ? DepthOutcome::open
               : may_pass              ? DepthOutcome::passes
                                       : DepthOutcome::fails;
    }
    bool always_passes() const { return passes && is_certain(); }
    // Whether it is one and the same on all paths.
    bool is_certain() const {
        return fails + fails_depth + passes + is_absent + is_discarded + fails_bounds == 1;
    }
    friend bool operator==(const Fate&, const Fate&) = default;
};

// The stencils that go with a number of hits.
struct Outcome {
    uint32_t front = 0, back = 0;
    stencil::Values values;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

// All paths of a question, seen plane by plane.
struct Resolution {
    // There are more states than are followed: nothing is claimed of the sample.
    bool is_free = false;
    std::vector<Outcome> outcomes;  // by front, then back; each pair once
    std::vector<Fate> fates;        // of each fragment
    std::vector<bool> is_last;      // of each fragment: it may be the last that shows
    std::vector<bool> is_stored;    // its depth may be the one that stays
    bool may_be_clear = false;      // or no fragment's
};

// States that are followed at most after each fragment.
inline constexpr size_t kMostStates = 4096;
// The same where lists of fragments tell states apart: each list is a colour that somebody
// computes.
inline constexpr size_t kMostLists = 1024;

// Follows all paths side by side; those that cannot be told apart by what comes after are one.
Resolution resolve(const Question& question);
// Answers a question: resolve or exact::resolve (exact.hpp).
using Resolve = Resolution (*)(const Question&);

// The stencils of a sample with these outcomes: those that go with the hits, front and back; with
// hits that no path has, and with none given, any that it may hold. Without an outcome it is what
// it was cleared to; `is_free`: nothing is claimed of it.
stencil::Values values_of(std::span<const Outcome> outcomes, bool is_free, uint32_t clear,
                          const std::optional<std::pair<uint32_t, uint32_t>>& hits);

// How much is known of the fragments that show at a sample.
struct SeenHits {
    enum class Detail : uint8_t { none, any, total, faces };
    Detail detail = Detail::none;
    uint32_t front = 0, back = 0;  // any: front is 0 or 1; total: front alone
    uint32_t total() const { return front + back; }
    friend bool operator==(const SeenHits&, const SeenHits&) = default;
};

// What the planes of a picture show of a sample, as far as they were delivered. Each observes the
// path: it allows some paths and denies the others.
struct Observed {
    SeenHits hits;
    std::optional<uint32_t> stencil;
    // Of each fragment: whether it may be the last that shows, and the last that stored its depth;
    // empty where nothing is known of that. Instead of a fragment: none shows, none stored it.
    std::vector<bool> last, stored;
    bool may_be_unhit = true, may_be_clear = true;
    // Fragments of which those are counted that pass all tests: those that show, and,
    // `with_discarded`, those that are discarded then. `number`: how many there are, if it is
    // known.
    struct Counting {
        std::vector<bool> of;
        bool with_discarded = false;
        std::optional<uint32_t> number;
    };
    std::optional<Counting> counting;
};

// What a colour tells of fragments, clears among them: those of one kind look alike, and nothing is
// left of what one that replaces has met.
struct Kinds {
    std::vector<uint32_t> kind;  // of each fragment: the first of its kind
    std::vector<bool> replaces;
};

// The fragments that show on a path, in drawing order, and what the path leaves.
struct History {
    std::vector<uint32_t> shown;
    std::vector<bool> is_front;       // of each of them
    std::vector<uint32_t> discarded;  // those that are discarded once they have passed all tests
    int stored = kClearDepth;
    uint32_t stencil = 0;
};

enum class Answer : uint8_t { no, yes, free };

// Whether a path satisfies all that was observed; `free`: there are too many states to tell.
Answer has_path(const Question& question, const Observed& observed);
// Such a path: of fragments that may be absent or present the first ones are absent.
std::optional<History> find_path(const Question& question, const Observed& observed);

// How many fragments are counted on the paths that satisfy what was observed, a counting among it.
// Nothing if there are too many states, or no such path.
struct Counted {
    uint32_t least = 0, most = 0;
};
std::optional<Counted> counted_by(const Question& question, const Observed& observed);

// The fragments that show, and clears, on the paths that satisfy what was observed, each list once.
// With `kinds` a list begins with the last fragment that replaces, and has the first fragments of
// their kinds.
struct Shown {
    bool is_free = false;
    std::vector<std::vector<uint32_t>> lists;
};
Shown shown_by(const Question& question, const Observed& observed, const Kinds* kinds = nullptr);

}  // namespace ref::path
