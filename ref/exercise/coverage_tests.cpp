// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/coverage_tests.hpp"

#include <algorithm>
#include <cmath>

#include "ref/coverage/exact/exact.hpp"

namespace ref {

using cases::Profile;

bool is_surely_covered(const View& view, std::string_view) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        return hit.coverage == Coverage::must && view.shows(hit.triangle);
    });
}

namespace {
bool is_hit(const View& view, uint32_t t) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) { return hit.triangle == t; });
}
}  // namespace

// A triangle that may draw in the sample's place, and does not.
bool is_outside_one(const View& view, std::string_view) {
    const JudgedSample& s = view.sample;
    const auto& triangles = view.facts.triangles();
    if (s.hits.size() == triangles.size()) {
        return false;
    }
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (view.facts.draw_of(t).layer != s.id.layer || is_hit(view, t)) {
            continue;
        }
        const TriangleSetup& setup = view.setups[t];
        if (setup.kind == TriangleSetup::Kind::outlines && setup.window.may_touch(s.p) &&
            setup.window.may_write(s.id.sample) && view.shows(t)) {
            return true;
        }
    }
    return false;
}

bool is_in_set(const View& view, std::string_view rule) {
    return std::ranges::any_of(view.sample.reasons.sets, [&](const FixedSet& set) {
        return rule_of(set.why, Profile::vulkan) == rule &&
               std::ranges::any_of(set.triangles, [&](uint32_t t) { return view.shows(t); });
    });
}

namespace {
bool has_reason_of(const Decision& decision, std::string_view rule) {
    return std::ranges::any_of(decision.reasons, [&](const Reason& r) {
        return rule_of(r.kind, Profile::direct3d) == rule;
    });
}
}  // namespace

// Profile practice leaves a triangle open at the sample, and direct3d decides it for this rule.
bool is_settled(const View& view, std::string_view rule) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        if (hit.coverage != Coverage::either || !view.shows(hit.triangle)) {
            return false;
        }
        const Decision decision = view.facts.decide(hit.triangle, view.sample);
        return decision.coverage != Coverage::either && has_reason_of(decision, rule);
    });
}

// The same by where its vertices snap, also where the sample is then on an edge.
bool is_settled_by_snapping(const View& view, std::string_view) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        const TriangleSetup& setup = view.setups[hit.triangle];
        const std::span<const Box> boxes = setup.unclipped.vertices();
        // Not what alpha to coverage leaves open.
        return hit.coverage == Coverage::either && !setup.window.is_open() &&
               view.shows(hit.triangle) &&
               std::ranges::any_of(
                   boxes, [](const Box& box) { return box.x0 != box.x1 || box.y0 != box.y1; }) &&
               view.facts.decide(hit.triangle, view.sample).coverage != Coverage::either;
    });
}

// A triangle must cover the sample for the area that it has in common with its pixel, and does not
// cover the sample itself.
bool is_overestimated(const View& view, std::string_view) {
    return std::ranges::any_of(view.sample.hits, [&](const Hit& hit) {
        const TriangleSetup& setup = view.setups[hit.triangle];
        if (!setup.area.is_over() || hit.coverage != Coverage::must || !view.shows(hit.triangle)) {
            return false;
        }
        return std::ranges::none_of(setup.outlines(), [&](const Outline* o) {
            return exact::is_in_hull(o->vertices(), view.sample.p);
        });
    });
}

// A triangle within a pixel of the sample's own is decided by what this rule says of its area.
bool has_reason_of_area(const View& view, std::string_view rule) {
    const auto& triangles = view.facts.triangles();
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const TriangleSetup& setup = view.setups[t];
        if (!setup.area.is_on() || setup.kind != TriangleSetup::Kind::outlines ||
            view.facts.draw_of(t).layer != view.sample.id.layer || !view.shows(t)) {
            continue;
        }
        PixelArea near;
        near.mode = cases::Conservative::overestimate;
        near.most = 2 * kFixedOne;
        near.keeps_degenerates = true;
        const bool is_near = std::ranges::any_of(setup.outlines(), [&](const Outline* o) {
            return exact::pixel_coverage(setup, near, *o, pixel_centre(view.sample.p)) !=
                   Coverage::must_not;
        });
        if (!is_near) {
            continue;
        }
        const Decision decision = view.facts.decide(t, view.sample);
        if (decision.coverage != Coverage::either && has_reason_of(decision, rule)) {
            return true;
        }
    }
    return false;
}

namespace {
// Whether this reason may keep a triangle from the sample at all; it is cheap to say.
bool may_keep(ReasonKind kind, const View& view, uint32_t t) {
    switch (kind) {
        case ReasonKind::viewport:
            return !view.setups[t].window.is_in_zone(view.sample.p);
        case ReasonKind::clip_plane:
            return view.setups[t].is_clipped || view.setups[t].kind == TriangleSetup::Kind::nothing;
        default:
            return false;
    }
}
}  // namespace

// A triangle that would cover the sample is kept from it by the rule.
bool is_kept_away(const View& view, std::string_view rule) {
    for (auto k = size_t{0}; k <= static_cast<size_t>(kLastReason); ++k) {
        const auto kind = static_cast<ReasonKind>(k);
        if (rule_of(kind, Profile::vulkan) != rule) {
            continue;
        }
        for (uint32_t t = 0; t < view.facts.triangles().size(); ++t) {
            if (!may_keep(kind, view, t) || is_hit(view, t)) {
                continue;
            }
            const Decision decision = view.facts.decide(t, view.sample);
            if (is_suppressed(decision) &&
                std::ranges::any_of(decision.reasons,
                                    [&](const Reason& r) { return r.kind == kind; }) &&
                view.shows(t)) {
                return true;
            }
        }
    }
    return false;
}

bool shows_face(const View& view, std::string_view) {
    return view.of().target.has_instruments && is_written_by(view, [&](uint32_t t) {
               const TriangleSetup& setup = view.setups[t];
               return setup.can_be_front != setup.can_be_back;
           });
}

bool is_of_instance(const View& view, std::string_view) {
    return is_written_by(view, [&](uint32_t t) {
        const cases::Draw& draw = view.facts.draw_of(t);
        return !draw.clear &&
               (!draw.offsets.empty() || std::ranges::any_of(draw.attributes, [](const auto& a) {
                   return a.divisor.has_value();
               }));
    });
}

bool is_beside_bad_number(const View& view, std::string_view) {
    return is_surely_hit(view) && view.facts.has_bad_number();
}

// A triangle with a vertex beyond a border of the viewport.
bool crosses_border(const View& view, std::string_view) {
    return is_written_by(view, [&](uint32_t t) {
        return std::ranges::any_of(view.facts.triangles()[t].vertex, [&](uint32_t v) {
            const glm::vec4& p = view.facts.draw_of(t).positions[v];
            return std::fabs(p.x) > p.w || std::fabs(p.y) > p.w;
        });
    });
}

// A triangle with a vertex outside the view volume, or on one of its depth planes.
bool reaches_volume(const View& view, std::string_view) {
    return is_written_by(view, [&](uint32_t t) {
        const cases::Draw& draw = view.facts.draw_of(t);
        return view.setups[t].is_clipped ||
               std::ranges::any_of(view.facts.triangles()[t].vertex, [&](uint32_t v) {
                   const glm::vec4& p = draw.positions[v];
                   const float low = draw.depth.negative_one_to_one ? -p.w : 0.0F;
                   return p.z <= low || p.z >= p.w;
               });
    });
}

}  // namespace ref
