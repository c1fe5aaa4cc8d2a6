// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/delivered.hpp"

#include <glm/vec4.hpp>

#include "planes.hpp"

namespace histories {

namespace {

using capture::Delivered;
using capture::HitDetail;

// The judge may not take stencils yet.
template <class D>
constexpr bool has_stencil_plane() {
    return requires(D d) { d.stencil; };
}
template <class D>
void put_stencil(D& to, uint32_t stencil) {
    if constexpr (has_stencil_plane<D>()) {
        to.stencil.push_back(stencil);
    }
}

glm::vec4 frag_coord_of(const Place& place, const Seen& w) {
    return is_hit(w) ? glm::vec4(w.is_at_sample ? place.at_x : place.x + 0.5,
                                 w.is_at_sample ? place.at_y : place.y + 0.5, w.z, 1)
                     : glm::vec4(capture::kClearValue);
}
glm::vec4 attribute(const Seen& seen, double value) {
    return is_hit(seen) ? glm::vec4(value, 0, 0, 0) : glm::vec4(capture::kClearValue);
}

}  // namespace

bool takes_stencil() {
    return has_stencil_plane<Delivered>();
}

Delivered delivered(const Scene& scene, const Planes& planes, const std::vector<Shown>& picture) {
    Delivered out;
    out.detail = planes.detail;
    for (size_t index = 0; index < picture.size(); ++index) {
        const Place place = place_of(scene, index);
        const Shown& s = picture[index];
        const uint32_t front = s[kHits].front, back = s[kHits].back;
        if (planes.detail == HitDetail::faces) {
            out.front.push_back(front);
            out.back.push_back(back);
        } else if (planes.detail != HitDetail::none) {
            const uint32_t total = front + back;
            out.front.push_back(planes.detail == HitDetail::total ? total : total > 0 ? 1 : 0);
        }
        if (planes.has(kWriter)) {
            const Seen& w = s[kWriter];
            out.draws.push_back(is_hit(w) ? static_cast<uint32_t>(w.draw) : capture::kClearId);
            out.primitives.push_back(is_hit(w) ? static_cast<uint32_t>(w.triangle)
                                               : capture::kClearId);
        }
        if (planes.has(kFragCoord)) {
            out.frag_coord.push_back(frag_coord_of(place, s[kFragCoord]));
        }
        if (planes.has(kAttributeV)) {
            out.attributes[0].push_back(attribute(s[kAttributeV], value_v(s[kAttributeV])));
        }
        if (planes.has(kAttributeA)) {
            out.attributes[1].push_back(attribute(s[kAttributeA], s[kAttributeA].a));
        }
        if (planes.has(kDepth)) {
            out.depth.push_back(static_cast<float>(s[kDepth].depth));
        }
        if (planes.has(kColor)) {
            out.color.push_back(s[kColor].color);
        }
        if (planes.has(kStencil)) {
            put_stencil(out, s[kStencil].stencil);
        }
    }
    return out;
}

capture::Capture captured(const Scene& scene, const cases::Target& target,
                          const std::vector<Shown>& picture, const std::vector<uint64_t>& counted) {
    const Delivered all = delivered(scene, whole_of(scene), picture);
    capture::Capture out;
    out.target = target;
    out.has_primitive = true;
    out.attribute_count = 2;
    out.counted = counted;
    for (size_t i = 0; i < all.draws.size(); ++i) {
        const auto front = static_cast<float>(all.front[i]), back = static_cast<float>(all.back[i]);
        out.hits.emplace_back(front, back, capture::kHitGuard, capture::kHitGuard + front + back);
        const bool is_clear = all.draws[i] == capture::kClearId;
        out.writers.push_back({all.draws[i], all.primitives[i],
                               is_clear ? capture::kClearId : 3 * all.primitives[i],
                               capture::kClearId});
    }
    out.frag_coord = all.frag_coord;
    out.attributes = all.attributes;
    out.depth = all.depth;
    out.color = all.color;
    for (size_t i = 0; i < picture.size() && scene.has_stencil; ++i) {
        out.stencil.push_back(picture[i][kStencil].stencil);
    }
    return out;
}

}  // namespace histories
