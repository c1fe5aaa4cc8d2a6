// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/judge_run.hpp"

#include <algorithm>
#include <array>

#include "cases/base/float_bits.hpp"
#include "ref/value/fragment/shading_rate.hpp"

namespace ref::value {

using cases::same_bits;

namespace {

// Where the run's numbers of a quantity lie; null where nobody has them.
RunValue numbers_of(const FragmentRun& run, const Quantity& q) {
    if (q.id.is_depth()) {
        return {&q, run.depth.empty() ? nullptr : run.depth.data(), 1};
    }
    const std::span<const glm::vec4> plane =
        q.id.is_attribute() ? run.attributes.at(q.id.attribute) : run.frag_coord;
    return {&q, plane.empty() ? nullptr : &plane.front().x + q.id.component, 4};
}

// How many leading fragments have the one number that is right for a quantity of these kinds.
size_t count_exact(const Quantity& q, const RunValue& got, const FragmentRun& run, float flat) {
    const bool is_x = q.id.component == 0;
    size_t k = 0;
    for (; k < run.frag_coord.size(); ++k) {
        const float centre = static_cast<float>(is_x ? run.first.x + k : run.first.y) + 0.5F;
        if (!same_bits(got.at[k * got.step], q.kind == Kind::flat ? flat : centre)) {
            break;
        }
    }
    return k;
}

}  // namespace

size_t RunJudge::judge(SetUps& set_ups, std::span<const Quantity> selected, uint32_t t,
                       const FragmentRun& run, std::span<double> ratios) {
    const Primitive& primitive = set_ups.primitive(t);
    const cases::Target& target = set_ups.target();
    if (!primitive.is_finite || !is_plain_depth(primitive) || target.samples != 1 ||
        discards_by_value(*primitive.draw) || has_large_fragments(*primitive.draw) ||
        shading_rate(*primitive.draw, 1) != ShadingRate::fragment) {
        return 0;
    }
    const Filters& filters = set_ups.filters(t);
    size_t count = run.frag_coord.size();
    values_.clear();
    for (const Quantity& q : selected) {
        const RunValue got = numbers_of(run, q);
        if (got.at == nullptr) {
            return 0;
        }
        if (is_numeric(q)) {
            values_.push_back(got);
        } else if (q.kind == Kind::flat || q.kind == Kind::pixel_centre) {
            const float flat = q.kind == Kind::flat ? provoking_value(primitive, q.id) : 0.0F;
            count = std::min(count, count_exact(q, got, run, flat));
        } else {
            return 0;
        }
    }
    std::array<double, kRunLength> others;
    for (size_t done = 0; done < count;) {
        const size_t n = std::min(kRunLength, count - done);
        const cases::SampleId id{run.first.x + static_cast<uint32_t>(done), run.first.y,
                                 run.first.sample, run.first.layer};
        const FixedPoint at = sample_position(id.x, id.y, id.sample, target);
        const RunPoints points{{id.x + 0.5, id.y + 0.5}, {pixels(at.x), pixels(at.y)}};
        const std::span<double> unsnapped = ratios.subspan(done, n);
        filter_run(filters.unsnapped, values_, points, kBudgetFactor, unsnapped);
        // As filter(): where the unsnapped basis does not explain the fragment within one budget,
        // the snapped one may.
        const bool is_explained = std::all_of(unsnapped.begin(), unsnapped.end(),
                                              [](double ratio) { return ratio <= 1; });
        if (!is_explained && filters.snapped) {
            const std::span<double> snapped(others.data(), n);
            filter_run(*filters.snapped, values_, points, kBudgetFactor, snapped);
            for (size_t k = 0; k < n; ++k) {
                unsnapped[k] =
                    unsnapped[k] <= 1 ? unsnapped[k] : std::min(unsnapped[k], snapped[k]);
            }
        }
        for (size_t k = 0; k < n; ++k, ++done) {
            if (!(unsnapped[k] <= 1)) {
                return done;
            }
        }
        for (RunValue& value : values_) {
            value.at += n * value.step;
        }
    }
    return count;
}

}  // namespace ref::value
