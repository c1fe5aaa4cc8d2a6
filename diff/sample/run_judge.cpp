// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/sample/run_judge.hpp"

#include <algorithm>

#include "capture/runs.hpp"
#include "cases/model/sample.hpp"
#include "diff/sample/fragment_part.hpp"

namespace diff {

// The one triangle that must cover a sample, if no other may and it writes all planes.
std::optional<uint32_t> RunJudge::only_writer(const ref::SampleExpectation& expected) const {
    const ref::HitBounds& b = expected.hits;
    if (b.total_min != 1 || b.total_max != 1 || b.front_max + b.back_max != 1 ||
        !b.allows(b.front_max, b.back_max) || expected.writers_count != 1) {
        return std::nullopt;
    }
    const uint32_t t = expectation_.writers_of(expected).front();
    return part_of(case_, expectation_, t) == ref::FragmentPart::all ? std::optional(t)
                                                                     : std::nullopt;
}

RunJudge::Right RunJudge::judge(size_t index, size_t count) {
    const ref::SampleExpectation& expected = expectation_.samples[index];
    if (expected.hits == ref::HitBounds{}) {
        return {capture::count_clear(capture_, index, count), std::nullopt, {}};
    }
    const std::optional<uint32_t> t =
        case_.target.samples == 1 ? only_writer(expected) : std::nullopt;
    if (!t) {
        return {};
    }
    const cases::Triangle& triangle = expectation_.triangles[*t];
    const capture::Writer writer{
        triangle.draw, capture_.has_primitive ? triangle.primitive : capture::kNoPrimitive,
        triangle.provoking, capture::kClearId};
    count = capture::count_hit_once(capture_, index, count, expected.hits.front_max == 1, writer);
    if (count == 0) {
        return {};
    }
    ref::FragmentRun run;
    run.first = cases::sample_at(case_.target, index);
    run.frag_coord = capture_.frag_coord.subspan(index, count);
    run.depth = capture_.depth.empty() ? capture_.depth : capture_.depth.subspan(index, count);
    for (uint32_t a = 0; a < capture_.attribute_count; ++a) {
        run.attributes.at(a) = capture_.attributes.at(a).subspan(index, count);
    }
    ratios_.resize(std::max(ratios_.size(), count));
    count = values_.judge_run(*t, run, std::span(ratios_).first(count));
    return {count, t, std::span(ratios_).first(count)};
}

}  // namespace diff
