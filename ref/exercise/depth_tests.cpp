// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/depth_tests.hpp"

#include "cases/model/sample.hpp"

namespace ref {

using cases::Profile;

bool is_overwritten(const View& view, std::string_view) {
    return view.sample.bounds.total_max >= 2 &&
           view.sample.writers.size() < view.sample.hits.size() && view.shows_order();
}

bool is_compared(const View& view, std::string_view rule) {
    const JudgeReasons& reasons = view.sample.reasons;
    for (size_t m = 0; DepthTest::is_needed(view.of()) && m < reasons.fates.size(); ++m) {
        const cases::CompareOp op = view.facts.draw_of(view.sample.hits[m].triangle).depth.compare;
        if (reasons.fates[m].depth() != DepthOutcome::open && op != cases::CompareOp::always &&
            op != cases::CompareOp::never &&
            rule_of(reasons.depth_reasons[m], Profile::vulkan) == rule &&
            view.shows(view.sample.hits[m].triangle)) {
            return true;
        }
    }
    return false;
}

bool is_depth_kept(const View& view, std::string_view) {
    const JudgeReasons& reasons = view.sample.reasons;
    for (size_t m = 0; DepthTest::is_needed(view.of()) && m < reasons.fates.size(); ++m) {
        const uint32_t t = view.sample.hits[m].triangle;
        if ((reasons.fates[m].depth() == DepthOutcome::fails ||
             !view.facts.draw_of(t).depth.write) &&
            view.shows(t)) {
            return true;
        }
    }
    return false;
}

bool is_depth_rounded(const View& view, std::string_view) {
    return view.of().target.has_instruments && is_surely_hit(view) &&
           view.of().target.depth_format != cases::DepthFormat::d32_float;
}

bool is_clamped(const View& view, std::string_view) {
    return view.of().target.has_instruments && is_written_by(view, [&](uint32_t t) {
               return view.facts.draw_of(t).depth.clamp &&
                      view.facts.is_beyond_range(t, view.sample);
           });
}

bool has_coord_depth(const View& view, std::string_view) {
    return view.of().target.has_instruments && is_written_by(view, [&](uint32_t t) {
               const cases::Draw& draw = view.facts.draw_of(t);
               return draw.depth.write && replaces_depth_by_coord(draw);
           });
}

bool is_counted_by_stencil(const View& view, std::string_view) {
    return view.of().target.has_stencil && !stencil::is_needed(view.of()) &&
           !view.sample.hits.empty();
}

bool is_counted_by_query(const View& view, std::string_view) {
    const JudgeReasons& reasons = view.sample.reasons;
    const auto passes = [&](size_t m) {
        if (reasons.fates.empty()) {  // no test asks
            return view.sample.hits[m].coverage == Coverage::must;
        }
        const path::Fate& fate = reasons.fates[m];
        return (fate.passes || fate.is_discarded) && !fate.is_absent && !fate.fails &&
               !fate.fails_depth && !fate.fails_bounds;
    };
    for (size_t m = 0; m < view.sample.hits.size(); ++m) {
        const cases::Draw& draw = view.facts.draw_of(view.sample.hits[m].triangle);
        if (cases::is_occlusion(draw.query) && passes(m)) {
            return true;
        }
    }
    return false;
}

bool is_of_statistics(const View& view, std::string_view) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        return cases::is_statistic(view.facts.draw_of(hit.triangle).query);
    });
}

}  // namespace ref
