// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "diagnosis/as_if.hpp"

namespace diagnosis::as_if {

namespace {

using cases::BlendFactor;
using cases::BlendOp;

bool each_blend(Case& c, bool (*change)(cases::Blend&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = (d.color.blend && change(*d.color.blend)) || is_changed;
    }
    return is_changed;
}

bool each_equation(Case& c, bool (*change)(cases::BlendEquation&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        if (d.color.blend) {
            is_changed = change(d.color.blend->color) || is_changed;
            is_changed = change(d.color.blend->alpha) || is_changed;
        }
    }
    return is_changed;
}

template <BlendFactor from, BlendFactor to>
bool factor_as(Case& c) {
    return each_equation(c, [](cases::BlendEquation& e) {
        const bool is_source = e.source == from && set(e.source, to);
        return (e.destination == from && set(e.destination, to)) || is_source;
    });
}

// Moves entries of a picture: entry (x, y) is taken from (x + dx, y + dy) where there is one.
void take_from(capture::Capture& capture, int64_t dx, int64_t dy) {
    const int64_t width = capture.target.width;
    const int64_t height = capture.target.rows();
    capture::for_each_plane(
        [&](const capture::Plane& plane, auto& entries) {
            if (entries.empty()) {
                return;
            }
            const auto per_pixel =
                static_cast<int64_t>(plane.entries) / std::max<int64_t>(1, width * height);
            const auto old = entries;
            for (int64_t y = 0; y < height; ++y) {
                for (int64_t x = 0; x < width; ++x) {
                    const int64_t from =
                        std::min(y + dy, height - 1) * width + std::min(x + dx, width - 1);
                    for (int64_t s = 0; s < per_pixel; ++s) {
                        entries[static_cast<size_t>((y * width + x) * per_pixel + s)] =
                            old[static_cast<size_t>(from * per_pixel + s)];
                    }
                }
            }
        },
        capture, capture);
}

// True if the face tested or changed the stencil before.
bool set_off(cases::StencilFace& face) {
    bool is_changed = set(face.compare, cases::CompareOp::always);
    for (cases::StencilOp* op : {&face.fail, &face.depth_fail, &face.pass}) {
        is_changed = set(*op, cases::StencilOp::keep) || is_changed;
    }
    return is_changed;
}

template <uint32_t value>
bool cleared_to(Case& c) {
    return c.target.has_stencil && set(c.target.stencil_clear, value);
}

const Row kTargetsRows[] = {
    // colour
    {"blend-off-unless-adding", "Only equations that add are blended",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool adds = !d.color.blend || (d.color.blend->color.op == BlendOp::add &&
                                                  d.color.blend->alpha.op == BlendOp::add);
             return !adds && (d.color.blend.reset(), true);
         });
     }},
    {"blend-alpha-replaced", "Alpha is replaced instead of blended",
     [](Case& c) {
         return each_blend(c, [](cases::Blend& b) { return set(b.alpha, cases::BlendEquation{}); });
     }},
    {"src-alpha-as-one", "SRC_ALPHA counts as ONE",
     factor_as<BlendFactor::src_alpha, BlendFactor::one>},
    {"src-alpha-as-dst-alpha", "SRC_ALPHA counts as DST_ALPHA",
     factor_as<BlendFactor::src_alpha, BlendFactor::dst_alpha>},
    {"one-minus-src-alpha-as-one", "ONE_MINUS_SRC_ALPHA counts as ONE",
     factor_as<BlendFactor::one_minus_src_alpha, BlendFactor::one>},
    {"dst-alpha-as-one", "DST_ALPHA counts as ONE",
     factor_as<BlendFactor::dst_alpha, BlendFactor::one>},
    {"dst-color-as-src-color", "DST_COLOR counts as SRC_COLOR",
     factor_as<BlendFactor::dst_color, BlendFactor::src_color>},
    {"constant-color-as-alpha", "CONSTANT_COLOR counts as CONSTANT_ALPHA",
     factor_as<BlendFactor::constant_color, BlendFactor::constant_alpha>},
    {"min-max-exchanged", "MIN and MAX of blending are exchanged",
     [](Case& c) {
         return each_equation(c,
                              [](auto& e) { return exchange(e.op, BlendOp::min, BlendOp::max); });
     }},
    {"subtract-adds", "SUBTRACT adds",
     [](Case& c) {
         return each_equation(
             c, [](auto& e) { return e.op == BlendOp::subtract && set(e.op, BlendOp::add); });
     }},
    {"blend-constants-red-blue", "Red and blue of the blend constants are exchanged",
     [](Case& c) {
         return each_blend(c, [](cases::Blend& b) {
             std::swap(b.constants.x, b.constants.z);
             return b.constants.x < b.constants.z || b.constants.x > b.constants.z;
         });
     }},
    {"write-mask-no-alpha", "Alpha is never written",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return set(d.color.write_mask, static_cast<uint8_t>(d.color.write_mask & 7U));
         });
     }},
    {"write-mask-red-blue", "Red and blue of the write mask are exchanged",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const unsigned m = d.color.write_mask;
             return set(d.color.write_mask,
                        static_cast<uint8_t>((m & 0xaU) | (m & 1U) << 2U | (m & 4U) >> 2U));
         });
     }},
    {"depth-cleared-to-one", "Depth is cleared to 1 whatever is asked",
     [](Case& c) { return c.target.has_depth && set(c.target.depth_clear, 1.0F); }},
    // stencil
    {"stencil-off", "There is no stencil test, and the stencil is not written",
     [](Case& c) {
         return c.target.has_stencil && each(c, [](Draw& d) {
                    const bool front = set_off(d.stencil.front);
                    return set_off(d.stencil.back) || front;
                });
     }},
    {"stencil-cleared-to-one", "The stencil is cleared to 1 whatever is asked", cleared_to<1>},
    {"stencil-cleared-to-all", "The stencil is cleared to 255 whatever is asked", cleared_to<255>},
    // the whole picture
    {"read-back-right", "Copies of the picture begin one column further right", always,
     [](capture::Capture& p) { take_from(p, 1, 0); }},
    {"read-back-below", "Copies of the picture begin one row lower", always,
     [](capture::Capture& p) { take_from(p, 0, 1); }},
    // blits
    {"blit-mirrored-x", "Blits are mirrored left to right",
     [](Case& c) { return c.blit && (std::swap(c.blit->source.x0, c.blit->source.x1), true); }},
    {"blit-mirrored-y", "Blits are mirrored top to bottom",
     [](Case& c) { return c.blit && (std::swap(c.blit->source.y0, c.blit->source.y1), true); }},
    {"blit-source-column-lost", "Blits leave out the last column of their source",
     [](Case& c) {
         return c.blit &&
                (--(c.blit->source.x1 > c.blit->source.x0 ? c.blit->source.x1 : c.blit->source.x0),
                 true);
     }},
    {"blit-destination-row-lost", "Blits leave out the last row of their destination",
     [](Case& c) {
         return c.blit &&
                (--(c.blit->destination.y1 > c.blit->destination.y0 ? c.blit->destination.y1
                                                                    : c.blit->destination.y0),
                 true);
     }},
};

}  // namespace

std::span<const Row> target_rows() {
    return kTargetsRows;
}

}  // namespace diagnosis::as_if
