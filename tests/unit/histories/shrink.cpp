// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "shrink.hpp"

#include <vector>

namespace histories {

namespace {

// Takes a draw away, and its number from what the sample shows; false if the sample shows the draw.
bool take_draw(Finding& finding, size_t number) {
    finding.scene.draws.erase(finding.scene.draws.begin() + static_cast<std::ptrdiff_t>(number));
    for (Seen& seen : finding.sample) {
        if (seen.draw == static_cast<int>(number)) {
            return false;
        }
        seen.draw -= seen.draw > static_cast<int>(number) ? 1 : 0;
    }
    return true;
}

bool take_triangle(Finding& finding, size_t number, size_t triangle) {
    auto& triangles = finding.scene.draws[number].triangles;
    triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
    for (Seen& seen : finding.sample) {
        if (seen.draw == static_cast<int>(number)) {
            if (seen.triangle == static_cast<int>(triangle)) {
                return false;
            }
            seen.triangle -= seen.triangle > static_cast<int>(triangle) ? 1 : 0;
        }
    }
    return !triangles.empty();
}

// States of a draw as they are by default, one by one.
std::vector<std::function<void(Draw&)>> plainer() {
    return {[](Draw& d) { d.stencil.reset(); },
            [](Draw& d) { d.bounds.reset(); },
            [](Draw& d) { d.compare = kAlways; },
            [](Draw& d) { d.writes_depth = true; },
            [](Draw& d) { d.discard = Discard::none; },
            [](Draw& d) { d.early = false; },
            [](Draw& d) { d.has_sample_shading = false; },
            [](Draw& d) { d.frag_depth.reset(); },
            [](Draw& d) { d.sample_mask = ~0U; },
            [](Draw& d) { d.shader_mask.reset(); },
            [](Draw& d) { d.culls_front = d.culls_back = false; },
            [](Draw& d) { d.clockwise = false; },
            [](Draw& d) { d.scissor.reset(); },
            [](Draw& d) { d.logic.reset(); },
            [](Draw& d) { d.alpha_to_one = false; },
            [](Draw& d) { d.alpha_to_coverage = false; },
            [](Draw& d) { d.query = Query::none; },
            [](Draw& d) { d.has_wide_viewport = true; },
            [](Draw& d) {
                for (ColorState& color : d.colors) {
                    color.blend.reset();
                }
            },
            [](Draw& d) {
                for (ColorState& color : d.colors) {
                    color.write_mask = 15;
                }
            },
            [](Draw& d) {
                for (Triangle& triangle : d.triangles) {
                    triangle.slope = 0;
                }
            }};
}

}  // namespace

Finding shrunk(Finding finding, const std::function<bool(const Finding&)>& is_still) {
    const auto accept = [&](const Finding& smaller) {
        const bool is_accepted = is_still(smaller);
        finding = is_accepted ? smaller : finding;
        return is_accepted;
    };
    for (size_t p = 0; p < kPlaneCount && !finding.planes.is_whole; ++p) {
        Finding smaller = finding;
        smaller.planes.set &= ~(1U << p);
        if (p == kHits) {
            smaller.planes.detail = capture::HitDetail::none;
        }
        if (smaller.planes.set != 0) {
            accept(smaller);
        }
    }
    for (size_t d = finding.scene.draws.size(); d-- > 0;) {
        Finding smaller = finding;
        if (smaller.scene.draws.size() > 1 && take_draw(smaller, d) && accept(smaller)) {
            continue;
        }
        for (size_t t = finding.scene.draws[d].triangles.size(); t-- > 0;) {
            smaller = finding;
            if (take_triangle(smaller, d, t)) {
                accept(smaller);
            }
        }
        for (const auto& change : plainer()) {
            smaller = finding;
            change(smaller.scene.draws[d]);
            accept(smaller);
        }
    }
    Finding smaller = finding;
    smaller.scene.has_stencil = finding.planes.has(kStencil);
    for (Draw& draw : smaller.scene.draws) {
        draw.stencil.reset();
    }
    accept(smaller);
    return finding;
}

}  // namespace histories
