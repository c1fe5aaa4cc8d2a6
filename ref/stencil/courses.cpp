// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cases/model/sample.hpp"
#include "ref/stencil/outcome.hpp"

namespace ref::stencil {

namespace {

using cases::CompareOp;
using cases::kStencilBits;
using cases::StencilOp;

// How a course stands after some fragments: all that its future depends on, and what is asked of
// its past.
struct Course {
    uint32_t value = 0;
    int stored = kClearDepth;
    uint32_t front = 0, back = 0;
    int last = -1;
    std::vector<uint32_t> in_set;   // how many of each set were there; 0 after its last member
    std::vector<uint8_t> is_there;  // of each fragment that a later one is the twin of
    friend auto operator<=>(const Course&, const Course&) = default;
};

class Courses {
  public:
    explicit Courses(const Question& question) : question_(question) {
        const size_t count = question.fragments.size();
        out_.fates.resize(count);
        out_.is_last.assign(count, false);
        out_.is_stored.assign(count, false);
        left_.assign(question.sets.size(), 0);
        is_asked_.assign(count, false);
        for (const Fragment& fragment : question.fragments) {
            if (fragment.set >= 0) {
                ++left_[static_cast<size_t>(fragment.set)];
            }
            if (fragment.twin >= 0) {
                is_asked_[static_cast<size_t>(fragment.twin)] = true;
            }
        }
        const bool has_twins =
            std::find(is_asked_.begin(), is_asked_.end(), true) != is_asked_.end();
        now_.insert({question.clear & kStencilBits, kClearDepth, 0, 0, -1,
                     std::vector<uint32_t>(question.sets.size()),
                     std::vector<uint8_t>(has_twins ? count : 0)});
    }

    Resolution run() {
        for (size_t m = 0; m < question_.fragments.size(); ++m) {
            const int set = question_.fragments[m].set;
            if (set >= 0) {
                --left_[static_cast<size_t>(set)];
            }
            std::set<Course> before;
            std::swap(before, now_);
            for (const Course& course : before) {
                step(course, m);
            }
            if (now_.empty() || now_.size() > kMostCourses) {
                out_.is_free = true;
                return std::move(out_);
            }
        }
        finish();
        return std::move(out_);
    }

  private:
    // Both ways for fragment m, as far as they are open.
    void step(const Course& course, size_t m) {
        const Fragment& fragment = question_.fragments[m];
        const std::optional<bool> forced =
            fragment.twin < 0
                ? std::nullopt
                : std::optional(course.is_there[static_cast<size_t>(fragment.twin)] != 0);
        if (!fragment.is_sure && !forced.value_or(false)) {
            Course absent = course;
            if (count(absent, fragment, m, false)) {
                out_.fates[m].is_absent = true;
                now_.insert(std::move(absent));
            }
        }
        if (forced.value_or(true)) {
            Course present = course;
            if (count(present, fragment, m, true) && tests_within_bounds(present, m)) {
                if (fragment.can_be_front) {
                    test(present, m, true);
                }
                if (fragment.can_be_back) {
                    test(present, m, false);
                }
            }
        }
    }

    // Notes whether fragment m is there; false if its set cannot come out.
    bool count(Course& course, const Fragment& fragment, size_t m, bool is_there) {
        if (is_asked_[m]) {
            course.is_there[m] = is_there ? 1 : 0;
        }
        if (fragment.set < 0) {
            return true;
        }
        const auto k = static_cast<size_t>(fragment.set);
        const FragmentSet& set = question_.sets[k];
        uint32_t& number = course.in_set[k];
        number += is_there ? 1 : 0;
        const bool fits = number <= set.most && number + left_[k] >= set.least;
        number = left_[k] > 0 ? number : 0;
        return fits;
    }

    // The depth bounds test, which leaves everything as it is where it fails: whether it may pass.
    bool tests_within_bounds(const Course& course, size_t m) {
        const DepthOutcome bounds = question_.bounds
                                        ? question_.bounds(course.stored, static_cast<uint32_t>(m))
                                        : DepthOutcome::passes;
        if (bounds != DepthOutcome::passes) {
            out_.fates[m].fails_bounds = true;
            now_.insert(course);
        }
        return bounds != DepthOutcome::fails;
    }

    void test(const Course& course, size_t m, bool front) {
        const Fragment& fragment = question_.fragments[m];
        const cases::StencilFace& face = front ? fragment.state->front : fragment.state->back;
        Fate& fate = out_.fates[m];
        fate.met.set(course.value);
        Course next = course;
        if (!passes(face, course.value)) {
            fate.fails = true;
            next.value = updated(face.fail, face, course.value);
            now_.insert(std::move(next));
            return;
        }
        const DepthOutcome depth = question_.depth
                                       ? question_.depth(course.stored, static_cast<uint32_t>(m))
                                       : DepthOutcome::passes;
        if (depth != DepthOutcome::passes) {
            fate.fails_depth = true;
            next.value = updated(face.depth_fail, face, course.value);
            now_.insert(next);
        }
        if (depth != DepthOutcome::fails) {
            const bool is_discarded =
                front ? fragment.is_discarded_front : fragment.is_discarded_back;
            next.value = updated(face.pass, face, course.value);
            next.stored = fragment.writes_depth ? static_cast<int>(m) : course.stored;
            if (is_discarded || fragment.is_discard_open) {
                fate.is_discarded = true;
                now_.insert(next);
            }
            if (!is_discarded || fragment.is_discard_open) {
                fate.passes = true;
                next.last = static_cast<int>(m);
                next.front += front ? 1 : 0;
                next.back += front ? 0 : 1;
                now_.insert(std::move(next));
            }
        }
    }

    void finish() {
        std::map<std::pair<uint32_t, uint32_t>, Values> outcomes;
        for (const Course& course : now_) {
            outcomes[{course.front, course.back}].set(course.value);
            if (course.last >= 0) {
                out_.is_last[static_cast<size_t>(course.last)] = true;
            }
            if (course.stored == kClearDepth) {
                out_.may_be_clear = true;
            } else {
                out_.is_stored[static_cast<size_t>(course.stored)] = true;
            }
        }
        for (const auto& [hits, values] : outcomes) {
            out_.outcomes.push_back({hits.first, hits.second, values});
        }
    }

    const Question& question_;
    Resolution out_;
    std::set<Course> now_;
    std::vector<uint32_t> left_;  // members of each set that are still to come
    std::vector<bool> is_asked_;  // a later fragment is its twin
};

}  // namespace

bool is_needed(const cases::Case& c) {
    return c.target.has_stencil &&
           (!c.target.has_instruments || c.target.stencil_clear != 0 ||
            std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& draw) {
                return draw.stencil != cases::StencilState{} || stores_discarded(draw);
            }));
}

// "A is the reference value, B the stored one, both after they are combined with compareMask"; LESS
// passes if A < B (Vulkan specification, VkCompareOp and "Stencil Test").
bool passes(const cases::StencilFace& face, uint32_t stored) {
    const uint32_t mask = face.compare_mask & kStencilBits;
    const uint32_t a = face.reference & mask;
    const uint32_t b = stored & mask;
    switch (face.compare) {
        case CompareOp::never:
            return false;
        case CompareOp::less:
            return a < b;
        case CompareOp::equal:
            return a == b;
        case CompareOp::less_or_equal:
            return a <= b;
        case CompareOp::greater:
            return a > b;
        case CompareOp::not_equal:
            return a != b;
        case CompareOp::greater_or_equal:
            return a >= b;
        case CompareOp::always:
            return true;
    }
    return true;
}

// The operation takes the stored value, not the masked one, and REPLACE the whole reference
// (Vulkan specification, VkStencilOp); then "the stencil write mask ... controls which bits of the
// stored value are updated".
uint32_t updated(StencilOp op, const cases::StencilFace& face, uint32_t stored) {
    uint32_t made = stored;
    switch (op) {
        case StencilOp::keep:
            break;
        case StencilOp::zero:
            made = 0;
            break;
        case StencilOp::replace:
            made = face.reference;
            break;
        case StencilOp::increment_and_clamp:
            made = std::min(stored + 1, kStencilBits);
            break;
        case StencilOp::decrement_and_clamp:
            made = stored == 0 ? 0 : stored - 1;
            break;
        case StencilOp::invert:
            made = ~stored;
            break;
        case StencilOp::increment_and_wrap:
            made = stored + 1;
            break;
        case StencilOp::decrement_and_wrap:
            made = stored - 1;
            break;
    }
    const uint32_t mask = face.write_mask & kStencilBits;
    return ((stored & ~mask) | (made & mask)) & kStencilBits;
}

Resolution resolve(const Question& question) {
    return Courses(question).run();
}

}  // namespace ref::stencil
