// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>
#include <vector>

#include "cases/fault/bodies.hpp"
#include "cases/model/derive.hpp"

namespace cases::fault {

namespace {

// Changes each clear of a case; what it becomes has as much to say as before.
template <class Change>
bool each_clear(Case& c, const Change& change) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        Clear clear = d.clear.value_or(Clear{});
        uint32_t layer = d.layer;
        if (d.clear && change(clear, layer)) {
            d = clear_draw(c.target, std::move(clear), layer);
            is_changed = true;
        }
    }
    return is_changed;
}

template <class Change>
bool each_rect(Case& c, const Change& change) {
    return each_clear(c, [&](Clear& clear, uint32_t&) { return any_of(clear.rects, change); });
}

// The draw before each clear decides something of it; a clear before all draws is as it was.
template <class Change>
bool each_behind_draw(Case& c, const Change& change) {
    bool is_changed = false;
    const Draw* before = nullptr;
    for (Draw& d : c.draws) {
        is_changed = (d.clear && before != nullptr && change(d, *before)) || is_changed;
        before = d.clear ? before : &d;
    }
    return is_changed;
}

bool cut_by_scissor(Draw& d, const Draw& before) {
    const Rect& s = before.scissor;
    return any_of(d.clear->rects, [&](Rect& r) {
        const int64_t x0 = std::max(r.x, s.x), y0 = std::max(r.y, s.y);
        const int64_t x1 = std::min(int64_t{r.x} + r.width, int64_t{s.x} + s.width);
        const int64_t y1 = std::min(int64_t{r.y} + r.height, int64_t{s.y} + s.height);
        const Rect cut{static_cast<int32_t>(x0), static_cast<int32_t>(y0),
                       static_cast<uint32_t>(std::max<int64_t>(x1 - x0, 0)),
                       static_cast<uint32_t>(std::max<int64_t>(y1 - y0, 0))};
        return set(r, cut);
    });
}

bool clear_first(Case& c) {
    const auto is_clear = [](const Draw& d) { return d.clear.has_value(); };
    const bool is_changed = !std::ranges::is_partitioned(c.draws, is_clear);
    std::ranges::stable_partition(c.draws, is_clear);
    return is_changed;
}

bool clear_late(Case& c) {
    bool is_changed = false;
    for (size_t k = 0; k + 1 < c.draws.size(); ++k) {
        if (c.draws[k].clear && !c.draws[k + 1].clear) {
            std::swap(c.draws[k], c.draws[k + 1]);
            is_changed = true;
            ++k;
        }
    }
    return is_changed;
}

// A value that no clear or earlier pass has left there. Of two aspects in one image the first one
// has the load operation of the second, where that is another.
bool load_other_depth(Target& t) {
    return t.has_depth && set(t.depth_clear, t.depth_clear > 0.5F ? 0.0F : 1.0F);
}
bool load_other_stencil(Target& t) {
    return t.has_stencil && set(t.stencil_clear, t.stencil_clear ^ kStencilBits);
}
bool load_other_color(Target& t) {
    constexpr float kOther = 0.75F;
    return t.color &&
           set(t.color->clear, is_integer(t.color->format) ? glm::vec4(1) : glm::vec4(kOther));
}
bool exchanges(const Target& t) {
    return t.has_depth && t.has_stencil && t.depth_load != t.stencil_load &&
           t.depth_load != LoadOp::dont_care && t.stencil_load != LoadOp::dont_care;
}

const Body kClearBodies[] = {
    {"load-as-clear"_fault,
     [](Case& c) {
         Target& t = c.target;
         const bool depth = is_loaded(t.depth_load) && load_other_depth(t);
         return (is_loaded(t.stencil_load) && load_other_stencil(t)) || depth;
     }},
    {"load-color-as-clear"_fault,
     [](Case& c) {
         return c.target.color && is_loaded(c.target.color->load) && load_other_color(c.target);
     }},
    {"load-stencil-as-depth"_fault,
     [](Case& c) { return exchanges(c.target) && load_other_stencil(c.target); }},
    {"load-depth-as-stencil"_fault,
     [](Case& c) { return exchanges(c.target) && load_other_depth(c.target); }},
    {"clear-ignored"_fault,
     [](Case& c) {
         bool is_changed = false;
         for (Draw& d : c.draws) {
             is_changed = (d.clear && set(d.rasterizer_discard, true)) || is_changed;
         }
         return is_changed;
     }},
    {"clear-whole-target"_fault,
     [](Case& c) {
         return each_rect(c, [whole = Rect{0, 0, c.target.width, c.target.height}](Rect& r) {
             return set(r, whole);
         });
     }},
    {"clear-scissored"_fault, [](Case& c) { return each_behind_draw(c, cut_by_scissor); }},
    {"clear-rect-closed"_fault,
     [](Case& c) {
         return each_rect(c, [&c](Rect& r) {
             const uint32_t right =
                 std::min(r.width + 1, c.target.width - static_cast<uint32_t>(r.x));
             const uint32_t low =
                 std::min(r.height + 1, c.target.height - static_cast<uint32_t>(r.y));
             const bool is_wider = set(r.width, right);
             return set(r.height, low) || is_wider;
         });
     }},
    {"clear-rect-column-lost"_fault,
     [](Case& c) { return each_rect(c, [](Rect& r) { return ++r.x, --r.width, true; }); }},
    {"clear-first-rect-only"_fault,
     [](Case& c) {
         return each_clear(c, [](Clear& clear, uint32_t&) {
             return clear.rects.size() > 1 && (clear.rects.resize(1), true);
         });
     }},
    {"clear-first-layer-only"_fault,
     [](Case& c) {
         return each_clear(c, [](Clear& clear, uint32_t&) { return set(clear.layers, 1U); });
     }},
    {"clear-layer-zero"_fault,
     [](Case& c) { return each_clear(c, [](Clear&, uint32_t& layer) { return set(layer, 0U); }); }},
    {"clear-all-aspects"_fault,
     [](Case& c) {
         const bool has_both = c.target.has_depth && c.target.has_stencil;
         return has_both && each_clear(c, [](Clear& clear, uint32_t&) {
                    const bool is_half = clear.depth.has_value() != clear.stencil.has_value();
                    clear.depth = is_half ? clear.depth.value_or(0) : clear.depth;
                    clear.stencil = is_half ? clear.stencil.value_or(0) : clear.stencil;
                    return is_half;
                });
     }},
    {"clear-depth-beside-stencil-lost"_fault,
     [](Case& c) {
         return each_clear(c, [](Clear& clear, uint32_t&) {
             return clear.depth && clear.stencil && (clear.depth.reset(), true);
         });
     }},
    {"clear-before-draws"_fault, clear_first},
    {"clear-after-next-draw"_fault, clear_late},
    {"clear-masked"_fault,
     [](Case& c) {
         return each_behind_draw(c, [](Draw& d, const Draw& before) {
             return d.clear->color && set(d.color.write_mask, before.color.write_mask);
         });
     }},
};

}  // namespace

std::span<const Body> clear_bodies() {
    return kClearBodies;
}

}  // namespace cases::fault
