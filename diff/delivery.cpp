// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/delivery.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"

namespace diff {

bool Delivery::has_values() const {
    return values.frag_coord ||
           std::ranges::find(values.attributes, true) != values.attributes.end();
}

Delivery delivery_of(const cases::Case& c) {
    Delivery out;
    constexpr auto kLost = cases::StoreOp::dont_care;
    out.has_color = c.target.color && c.target.color->store != kLost;
    out.has_stencil = c.target.has_stencil && c.target.stencil_store != kLost;
    out.values.depth = c.target.has_depth && c.target.depth_store != kLost;
    if (!c.target.has_instruments) {
        out = {false,         capture::HitDetail::none, false, {false, out.values.depth, {}},
               out.has_color, out.has_stencil};
    }
    return out;
}

Delivery delivery_of(const cases::Case& c, const capture::Delivered& planes) {
    Delivery out{false,
                 planes.detail,
                 // gl_PrimitiveID alone does not tell instances apart.
                 !planes.draws.empty() &&
                     std::ranges::all_of(c.draws, [](const auto& d) { return d.instances == 1; }),
                 {!planes.frag_coord.empty(), !planes.depth.empty(), {}},
                 c.target.color && !planes.color.empty(),
                 c.target.has_stencil && !planes.stencil.empty(),
                 true};
    for (size_t a = 0; a < planes.attributes.size(); ++a) {
        out.values.attributes.at(a) = !planes.attributes.at(a).empty();
    }
    return out;
}

capture::Capture capture_of(const cases::Case& c, const ref::Expectation& expectation,
                            const capture::Delivered& planes) {
    capture::Capture out;
    out.target = c.target;
    out.has_primitive = true;
    out.attribute_count = cases::attributes_of(c);
    const size_t count = out.sample_count();
    out.hits.assign(count, {0, 0, capture::kHitGuard, capture::kHitGuard});
    for (size_t k = 0; k < std::min(count, planes.front.size()); ++k) {
        out.hits[k].x = static_cast<float>(planes.front[k]);
        out.hits[k].y = planes.back.empty() ? 0.0F : static_cast<float>(planes.back[k]);
        out.hits[k].w += out.hits[k].x + out.hits[k].y;
    }
    out.writers.assign(count, {});
    for (size_t k = 0; k < std::min(count, planes.draws.size()); ++k) {
        capture::Writer& writer = out.writers[k];
        writer.draw = planes.draws[k];
        writer.primitive = planes.primitives[k];
        // Nobody delivers it; it follows from the primitive.
        const auto wrote = std::ranges::find_if(expectation.triangles, [&](const auto& t) {
            return t.draw == writer.draw && t.primitive == writer.primitive;
        });
        writer.provoking_vertex = wrote != expectation.triangles.end() ? wrote->provoking
                                  : writer.draw == capture::kClearId   ? capture::kClearId
                                                                       : 0;
    }
    out.frag_coord = planes.frag_coord;
    out.frag_coord.resize(count, glm::vec4(capture::kClearValue));
    out.depth = planes.depth;
    out.depth.resize(count, c.target.depth_clear);
    for (uint32_t a = 0; a < out.attribute_count; ++a) {
        out.attributes.at(a) = planes.attributes.at(a);
        out.attributes.at(a).resize(count, glm::vec4(capture::kClearValue));
    }
    out.color = planes.color;
    out.stencil = planes.stencil;
    return out;
}

}  // namespace diff
