// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/delivered/completion.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "capture/blank_capture.hpp"
#include "cases/model/derive.hpp"
#include "diff/last_fragment.hpp"
#include "ref/stencil/outcome.hpp"
#include "ref/stencil/values.hpp"

namespace diff {

ref::ValueSelection selection_of(const capture::Delivered& planes) {
    ref::ValueSelection selection;
    selection.frag_coord = !planes.frag_coord.empty();
    selection.depth = !planes.depth.empty();
    for (size_t a = 0; a < planes.attributes.size(); ++a) {
        selection.attributes.at(a) = !planes.attributes.at(a).empty();
    }
    return selection;
}

// A stencil that a sample may hold, with these hits if they are known.
uint32_t likely_stencil(const ref::Expectation& expectation, size_t index,
                        std::optional<std::pair<uint32_t, uint32_t>> hits) {
    return ref::stencil::least_of(stencils_at(expectation, expectation.samples[index], hits));
}

namespace {

// A primitive and a vertex that no case has, of a writer that was not delivered.
constexpr uint32_t kNobody = capture::kClearId - 1;

bool is_clear(float v) {
    return std::bit_cast<uint32_t>(v) == std::bit_cast<uint32_t>(capture::kClearValue);
}

class Completion {
  public:
    Completion(const cases::Case& c, const ref::Expectation& expectation,
               const capture::Delivered& planes)
        : case_(c),
          expectation_(expectation),
          planes_(planes),
          values_(c, expectation.limits, expectation.profile),
          selection_(selection_of(planes)),
          stores_discarded_(cases::stores_discarded(c)) {
        values_.judge_only(selection_);
    }

    capture::Capture run() {
        out_ = capture::blank_capture(case_);
        const size_t count = out_.sample_count();
        for (size_t index = 0; index < count; ++index) {
            complete(index);
            if (case_.target.has_stencil) {
                const glm::vec4& hits = out_.hits[index];
                out_.stencil.push_back(likely_stencil(
                    expectation_, index,
                    std::pair(static_cast<uint32_t>(hits.x), static_cast<uint32_t>(hits.y))));
            }
        }
        return std::move(out_);
    }

    // Whether these planes, if they are those of an empty picture, would be right.
    bool may_be_empty() {
        out_.attribute_count = cases::attributes_of(case_);
        for (size_t index = 0; index < expectation_.samples.size(); ++index) {
            if ((expectation_.samples[index].hits.total_min > 0 && !is_covered(index)) ||
                !may_have_depth(index)) {
                return false;
            }
        }
        return true;
    }

  private:
    void complete(size_t index) {
        const ref::HitBounds& bounds = expectation_.samples[index].hits;
        const bool covered = is_covered(index);
        const auto [front, back] = covered ? hits_of(index, bounds) : std::pair(0U, 0U);
        out_.hits[index] = {static_cast<float>(front), static_cast<float>(back), capture::kHitGuard,
                            capture::kHitGuard + static_cast<float>(front + back)};
        if (!covered) {
            keep_contradictions(index);
            return;
        }
        const bool is_unwritten =
            !planes_.draws.empty() && planes_.draws[index] == capture::kClearId;
        const ref::FragmentValues values = values_of(index);
        out_.frag_coord[index] = values.frag_coord;
        out_.depth[index] = values.depth;
        for (uint32_t a = 0; a < out_.attribute_count; ++a) {
            out_.attributes.at(a)[index] = values.attributes.at(a);
        }
        out_.writers[index] = is_unwritten ? capture::Writer{} : writer_of(index, values);
    }

    // Whether the delivered depth is one that may be stored, where draws test or keep depths.
    bool may_have_depth(size_t index) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        if (planes_.depth.empty() || expected.depth_count == 0) {
            return true;
        }
        const std::span<const uint32_t> writers = expectation_.depth_writers_of(expected);
        const ref::FragmentValues values = values_of(index);
        return (expected.depth_may_be_clear &&
                capture::is_clear_depth(case_.target, planes_.depth[index])) ||
               std::ranges::any_of(writers, [&](uint32_t t) {
                   return values_.judge(t, id_of(index), values, ref::FragmentPart::depth).ok;
               });
    }

    // What planes hold of a sample that others call clear: the comparison tells of it. A depth is
    // what is stored; the other values are a fragment's, and there is none.
    void keep_contradictions(size_t index) {
        if (!planes_.draws.empty() && planes_.draws[index] != capture::kClearId) {
            out_.writers[index] = {planes_.draws[index], planes_.primitives[index], 0,
                                   capture::kClearId};
        }
        if (!planes_.depth.empty()) {
            out_.depth[index] = planes_.depth[index];
        }
    }

    // What the planes say of a sample's coverage, the most telling one first.
    bool is_covered(size_t index) {
        if (planes_.detail != capture::HitDetail::none) {
            const uint32_t back =
                planes_.detail == capture::HitDetail::faces ? planes_.back[index] : uint32_t{0};
            return planes_.front[index] + back > 0;
        }
        if (!planes_.draws.empty()) {
            return planes_.draws[index] != capture::kClearId;
        }
        const bool is_depth_clear =
            planes_.depth.empty() || capture::is_clear_depth(case_.target, planes_.depth[index]);
        bool all_clear = planes_.frag_coord.empty() || is_clear(planes_.frag_coord[index].x);
        bool has_values = !planes_.frag_coord.empty();
        for (const auto& attribute : planes_.attributes) {
            all_clear = all_clear && (attribute.empty() || is_clear(attribute[index].x));
            has_values = has_values || !attribute.empty();
        }
        if (all_clear && !is_depth_clear && stores_discarded_) {
            // The depth may be that of a discarded fragment, which is no hit.
            return !has_values && expectation_.samples[index].hits.total_min > 0;
        }
        all_clear = all_clear && is_depth_clear;
        if (!all_clear || expectation_.samples[index].hits.total_min == 0) {
            return !all_clear;
        }
        // Some triangles leave the clear values: of a depth equal to it, or without the attribute.
        const ref::FragmentValues values = values_of(index);
        const auto fits = [&](uint32_t t) { return fits_triangle(t, index, values); };
        return best_writer(index, values, fits).has_value();
    }

    bool fits_triangle(uint32_t t, size_t index, const ref::FragmentValues& values) {
        return values_.judge(t, id_of(index), values, part_of(case_, expectation_, t)).ok;
    }

    std::pair<uint32_t, uint32_t> hits_of(size_t index, const ref::HitBounds& bounds) const {
        if (planes_.detail == capture::HitDetail::faces) {
            return {planes_.front[index], planes_.back[index]};
        }
        const bool is_counted = planes_.detail == capture::HitDetail::total;
        const uint32_t least = is_counted ? planes_.front[index] : std::max(1U, bounds.total_min);
        const uint32_t most = is_counted ? least : std::max(least, bounds.total_max);
        for (uint32_t total = least; total <= std::min(most, bounds.total_max); ++total) {
            for (uint32_t front = 0; front <= total; ++front) {
                if (bounds.allows(front, total - front)) {
                    return {front, total - front};
                }
            }
        }
        // Wrong whatever the faces: by the face that the triangles here have.
        const uint32_t total = is_counted ? least : 1;
        return bounds.front_max == 0 && bounds.back_max > 0 ? std::pair(0U, total)
                                                            : std::pair(total, 0U);
    }

    ref::FragmentValues values_of(size_t index) const {
        ref::FragmentValues values;
        values.frag_coord = planes_.frag_coord.empty() ? glm::vec4(0) : planes_.frag_coord[index];
        values.depth = planes_.depth.empty() ? 0.0F : planes_.depth[index];
        for (uint32_t a = 0; a < out_.attribute_count; ++a) {
            const auto& plane = planes_.attributes.at(a);
            values.attributes.at(a) = plane.empty() ? glm::vec4(0) : plane[index];
        }
        return values;
    }

    cases::SampleId id_of(size_t index) const { return cases::sample_at(case_.target, index); }

    // Of the triangles that may have written last, are the delivered writer's and fit `accept`:
    // the one that explains the values best, the last of equals.
    template <class Accept>
    std::optional<uint32_t> best_writer(size_t index, const ref::FragmentValues& values,
                                        const Accept& accept) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        std::optional<uint32_t> best;
        std::optional<ref::FragmentVerdict> best_verdict;
        for (uint32_t k = 0; k < expected.writers_count; ++k) {
            const uint32_t t = expectation_.writers[expected.writers_begin + k];
            const cases::Triangle& triangle = expectation_.triangles[t];
            const bool is_delivered =
                planes_.draws.empty() || (planes_.draws[index] == triangle.draw &&
                                          planes_.primitives[index] == triangle.primitive);
            if (!is_delivered || !accept(t)) {
                continue;
            }
            if (expected.writers_count == 1) {
                return t;
            }
            ref::FragmentVerdict verdict =
                values_.judge(t, id_of(index), values, part_of(case_, expectation_, t));
            if (!best || (verdict.ok && !best_verdict->ok) ||
                (verdict.ok == best_verdict->ok &&
                 verdict.worst_ratio <= best_verdict->worst_ratio)) {
                best = t;
                best_verdict = std::move(verdict);
            }
        }
        return best;
    }

    capture::Writer writer_of(size_t index, const ref::FragmentValues& values) {
        if (const auto t = best_writer(index, values, [](uint32_t) { return true; })) {
            const cases::Triangle& triangle = expectation_.triangles[*t];
            return {triangle.draw, triangle.primitive, triangle.provoking, capture::kClearId};
        }
        if (planes_.draws.empty()) {
            // No triangle may be here: the hits are told of. Nobody says whose they are.
            return {0, kNobody, kNobody, capture::kClearId};
        }
        capture::Writer writer{planes_.draws[index], planes_.primitives[index], 0,
                               capture::kClearId};
        for (const cases::Triangle& t : expectation_.triangles) {
            if (t.draw == writer.draw && t.primitive == writer.primitive) {
                writer.provoking_vertex = t.provoking;
            }
        }
        return writer;
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::Delivered& planes_;
    ref::ValueReference values_;
    ref::ValueSelection selection_;
    bool stores_discarded_ = false;
    capture::Capture out_;
};

}  // namespace

capture::Capture completed(const cases::Case& c, const ref::Expectation& expectation,
                           const capture::Delivered& planes) {
    return Completion(c, expectation, planes).run();
}

bool are_right_if_empty(const cases::Case& c, const ref::Expectation& expectation,
                        const capture::Delivered& planes) {
    return Completion(c, expectation, planes).may_be_empty();
}

}  // namespace diff
