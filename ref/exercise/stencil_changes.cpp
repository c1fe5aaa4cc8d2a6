// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Changes of the stencil state; each is of both faces of every draw.
#include <algorithm>
#include <utility>

#include "cases/model/sample.hpp"
#include "ref/exercise/changes.hpp"

namespace ref {

namespace {

using cases::Case;
using cases::CompareOp;
using cases::StencilFace;
using cases::StencilOp;

// Whether a change of faces left another state.
template <class Change>
bool change_faces(Case& c, const Change& change) {
    bool is_changed = false;
    for (cases::Draw& draw : c.draws) {
        const cases::StencilState before = draw.stencil;
        change(draw.stencil.front);
        change(draw.stencil.back);
        is_changed = is_changed || !(draw.stencil == before);
    }
    return c.target.has_stencil && is_changed;
}

CompareOp turned(CompareOp op) {
    switch (op) {
        case CompareOp::less:
            return CompareOp::greater;
        case CompareOp::greater:
            return CompareOp::less;
        case CompareOp::less_or_equal:
            return CompareOp::greater_or_equal;
        case CompareOp::greater_or_equal:
            return CompareOp::less_or_equal;
        default:
            return op;
    }
}

StencilOp exchanged(StencilOp op) {
    switch (op) {
        case StencilOp::increment_and_clamp:
            return StencilOp::increment_and_wrap;
        case StencilOp::increment_and_wrap:
            return StencilOp::increment_and_clamp;
        case StencilOp::decrement_and_clamp:
            return StencilOp::decrement_and_wrap;
        case StencilOp::decrement_and_wrap:
            return StencilOp::decrement_and_clamp;
        default:
            return op;
    }
}

}  // namespace

bool pass_every_stencil(Case& c) {
    return change_faces(c, [](StencilFace& face) { face.compare = CompareOp::always; });
}

bool show_all_to_queries(Case& c) {
    bool has_any = false;
    for (cases::Draw& draw : c.draws) {
        if (!cases::is_occlusion(draw.query)) {
            continue;
        }
        has_any = true;
        draw.cull = cases::CullMode::none;
        draw.discard = cases::Discard::none;
        draw.rasterizer_discard = false;
        draw.multisample.sample_mask = UINT32_MAX;
        draw.multisample.shader_mask.reset();
        draw.depth.compare = CompareOp::always;
        draw.depth.bounds.reset();
        draw.stencil.front.compare = draw.stencil.back.compare = CompareOp::always;
    }
    return has_any;
}

bool turn_stencil_compare(Case& c) {
    return change_faces(c, [](StencilFace& face) { face.compare = turned(face.compare); });
}

bool keep_stencils(Case& c) {
    return change_faces(
        c, [](StencilFace& face) { face.fail = face.depth_fail = face.pass = StencilOp::keep; });
}

bool exchange_stencil_clamps(Case& c) {
    return change_faces(c, [](StencilFace& face) {
        for (StencilOp* op : {&face.fail, &face.depth_fail, &face.pass}) {
            *op = exchanged(*op);
        }
    });
}

bool ignore_stencil_masks(Case& c) {
    return change_faces(c, [](StencilFace& face) {
        face.compare_mask |= cases::kStencilBits;
        face.write_mask |= cases::kStencilBits;
    });
}

bool exchange_stencil_faces(Case& c) {
    bool is_changed = false;
    for (cases::Draw& draw : c.draws) {
        is_changed = is_changed || !(draw.stencil.front == draw.stencil.back);
        std::swap(draw.stencil.front, draw.stencil.back);
    }
    return c.target.has_stencil && is_changed;
}

bool take_depth_fail_as_pass(Case& c) {
    return change_faces(c, [](StencilFace& face) { face.depth_fail = face.pass; });
}

bool take_depth_fail_as_fail(Case& c) {
    return change_faces(c, [](StencilFace& face) { face.depth_fail = face.fail; });
}

}  // namespace ref
