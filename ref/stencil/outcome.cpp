// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/stencil/outcome.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/model/sample.hpp"

namespace ref::stencil {

namespace {

using cases::CompareOp;
using cases::kStencilBits;
using cases::StencilOp;

// Short ones need no memory of their own.
using Numbers = std::u32string;

// How courses stand after some fragments: all that their future depends on.
struct Course {
    uint32_t value = 0;
    int stored = kClearDepth;
    Numbers in_set;  // how many of each set were there; 0 after its last member
    // Of each fragment that a later one is the twin of: 1 if it was, until the last of these.
    std::string is_there;
    friend auto operator<=>(const Course&, const Course&) = default;
};

// What is asked of the past of the courses that stand so.
struct Past {
    std::vector<uint64_t> hits;  // those that they have, in units of kFront and kBack, ascending
    Numbers lasts;               // which fragments passed last, ascending
};

constexpr uint64_t kFront = uint64_t{1} << 32U, kBack = 1;
std::pair<uint32_t, uint32_t> faces_of(uint64_t hits) {
    return {static_cast<uint32_t>(hits / kFront), static_cast<uint32_t>(hits % kFront)};
}

// What is in either of two ascending lists.
template <class List>
List together(const List& a, const List& b) {
    List out;
    out.reserve(a.size() + b.size());
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    return out;
}

// Of courses that stand alike only their pasts are told apart, and of these only what they end in:
// so there are few, however many fragments are open.
class Courses {
  public:
    explicit Courses(const Question& question) : question_(question) {
        const size_t count = question.fragments.size();
        out_.fates.resize(count);
        out_.is_last.assign(count, false);
        out_.is_stored.assign(count, false);
        left_.assign(question.sets.size(), 0);
        last_twin_.assign(count, -1);
        for (size_t m = 0; m < count; ++m) {
            const Fragment& fragment = question.fragments[m];
            if (fragment.set >= 0) {
                ++left_[static_cast<size_t>(fragment.set)];
            }
            if (fragment.twin >= 0) {
                last_twin_[static_cast<size_t>(fragment.twin)] = static_cast<int>(m);
            }
        }
        const bool has_twins = std::ranges::any_of(last_twin_, [](int twin) { return twin >= 0; });
        now_.push_back(
            {Course{question.clear & kStencilBits, kClearDepth, Numbers(question.sets.size(), 0),
                    std::string(has_twins ? count : 0, '\0')},
             Past{{0}, {}}});
    }

    Resolution run() {
        for (size_t m = 0; m < question_.fragments.size(); ++m) {
            const int set = question_.fragments[m].set;
            if (set >= 0) {
                --left_[static_cast<size_t>(set)];
            }
            for (const auto& [course, past] : now_) {
                step(course, past, m);
            }
            if (!join()) {
                out_.is_free = true;
                return std::move(out_);
            }
        }
        finish();
        return std::move(out_);
    }

  private:
    // Makes one of the next courses that stand alike, and takes these; false if there is none, or
    // if they and their numbers of hits are too many.
    bool join() {
        std::ranges::sort(next_, {}, &std::pair<Course, Past>::first);
        now_.clear();
        size_t count = 0;
        for (auto& [course, past] : next_) {
            if (now_.empty() || now_.back().first != course) {
                count += past.hits.size();
                now_.emplace_back(std::move(course), std::move(past));
            } else {
                Past& known = now_.back().second;
                count -= known.hits.size();
                known.hits = together(known.hits, past.hits);
                known.lasts = together(known.lasts, past.lasts);
                count += known.hits.size();
            }
            if (count > kMostCourses) {
                return false;
            }
        }
        next_.clear();
        return !now_.empty();
    }

    // Both ways for fragment m, as far as they are open.
    void step(const Course& course, const Past& past, size_t m) {
        const Fragment& fragment = question_.fragments[m];
        const std::optional<bool> forced =
            fragment.twin < 0
                ? std::nullopt
                : std::optional(course.is_there[static_cast<size_t>(fragment.twin)] != '\0');
        if (!fragment.is_sure && !forced.value_or(false)) {
            Course absent = course;
            if (count(absent, fragment, m, false)) {
                out_.fates[m].is_absent = true;
                next_.emplace_back(std::move(absent), past);
            }
        }
        if (forced.value_or(true)) {
            Course present = course;
            if (count(present, fragment, m, true) && tests_within_bounds(present, past, m)) {
                if (fragment.can_be_front) {
                    test(present, past, m, true);
                }
                if (fragment.can_be_back) {
                    test(present, past, m, false);
                }
            }
        }
    }

    // Notes whether fragment m is there; false if its set cannot come out.
    bool count(Course& course, const Fragment& fragment, size_t m, bool is_there) {
        if (last_twin_[m] >= 0) {
            course.is_there[m] = is_there ? '\1' : '\0';
        }
        if (fragment.twin >= 0 &&
            last_twin_[static_cast<size_t>(fragment.twin)] == static_cast<int>(m)) {
            course.is_there[static_cast<size_t>(fragment.twin)] = '\0';
        }
        if (fragment.set < 0) {
            return true;
        }
        const auto k = static_cast<size_t>(fragment.set);
        const FragmentSet& set = question_.sets[k];
        char32_t& number = course.in_set[k];
        number += is_there ? 1 : 0;
        const bool fits = number <= set.most && number + left_[k] >= set.least;
        number = left_[k] > 0 ? number : 0;
        return fits;
    }

    // The depth bounds test, which leaves everything as it is where it fails: whether it may pass.
    bool tests_within_bounds(const Course& course, const Past& past, size_t m) {
        const DepthOutcome bounds = question_.bounds
                                        ? question_.bounds(course.stored, static_cast<uint32_t>(m))
                                        : DepthOutcome::passes;
        if (bounds != DepthOutcome::passes) {
            out_.fates[m].fails_bounds = true;
            next_.emplace_back(course, past);
        }
        return bounds != DepthOutcome::fails;
    }

    void test(const Course& course, const Past& past, size_t m, bool front) {
        const Fragment& fragment = question_.fragments[m];
        const cases::StencilFace& face = front ? fragment.state->front : fragment.state->back;
        Fate& fate = out_.fates[m];
        fate.met.set(course.value);
        Course next = course;
        if (!passes(face, course.value)) {
            fate.fails = true;
            next.value = updated(face.fail, face, course.value);
            next_.emplace_back(std::move(next), past);
            return;
        }
        const DepthOutcome depth = question_.depth
                                       ? question_.depth(course.stored, static_cast<uint32_t>(m))
                                       : DepthOutcome::passes;
        if (depth != DepthOutcome::passes) {
            fate.fails_depth = true;
            next.value = updated(face.depth_fail, face, course.value);
            next_.emplace_back(next, past);
        }
        if (depth != DepthOutcome::fails) {
            const bool is_discarded =
                front ? fragment.is_discarded_front : fragment.is_discarded_back;
            next.value = updated(face.pass, face, course.value);
            next.stored = fragment.writes_depth ? static_cast<int>(m) : course.stored;
            if (is_discarded || fragment.is_discard_open) {
                fate.is_discarded = true;
                next_.emplace_back(next, past);
            }
            if (!is_discarded || fragment.is_discard_open) {
                fate.passes = true;
                Past hit;
                hit.hits = past.hits;
                for (uint64_t& hits : hit.hits) {
                    hits += front ? kFront : kBack;
                }
                hit.lasts.assign(1, static_cast<char32_t>(m));
                next_.emplace_back(std::move(next), std::move(hit));
            }
        }
    }

    void finish() {
        std::map<std::pair<uint32_t, uint32_t>, Values> outcomes;
        for (const auto& [course, past] : now_) {
            for (const uint64_t hits : past.hits) {
                outcomes[faces_of(hits)].set(course.value);
            }
            for (const char32_t last : past.lasts) {
                out_.is_last[last] = true;
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
    std::vector<std::pair<Course, Past>> now_, next_;  // by course; after the fragment at hand
    std::vector<uint32_t> left_;                       // members of each set that are still to come
    std::vector<int> last_twin_;  // the last fragment whose twin this one is, or -1
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
