// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/scene.hpp"

namespace ref {

namespace {

// Sets up the triangles that may touch a sample, and keeps those that do.
std::vector<fast::Span> scan_all(const cases::Case& c,
                                 const std::vector<cases::Triangle>& triangles,
                                 TriangleSetups& setups) {
    std::vector<fast::Span> spans;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (!setups.may_touch_a_sample(t)) {
            continue;
        }
        const size_t first = spans.size();
        fast::scan(setups[t], t, c.target, spans);
        const uint32_t down = layer_of(c.draws[triangles[t].draw], triangles[t]) * c.target.height;
        for (size_t k = first; down > 0 && k < spans.size(); ++k) {
            spans[k].y += down;
        }
        // What has no sample is asked for again only where an open sample is near one of its edges
        // (SharedEdges::triangles_at).
        if (spans.size() == first) {
            setups.forget_last(t);
        }
    }
    return spans;
}

}  // namespace

Scene::Scene(const cases::Case& the_case, const Limits& the_limits, cases::Profile the_profile,
             bool is_told)
    : c(the_case),
      limits(the_limits),
      profile(the_profile),
      triangles(assemble(c)),
      setups(c, triangles, limits, profile, is_told),
      spans(scan_all(c, triangles, setups)),
      discards(c, limits, profile, false),
      depth(DepthTest::is_needed(c)
                ? std::make_optional<DepthTest>(c, triangles, limits, profile, false)
                : std::nullopt),
      narrowing(c, profile, triangles, setups,
                {fast::is_in_hull, fast::winding, fast::is_inside_whole, path::resolve},
                depth ? &*depth : nullptr, discards) {}

}  // namespace ref
