// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>
#include <utility>

#include "cases/fault/bodies.hpp"

namespace cases::fault {

namespace {

template <CompareOp from, CompareOp to>
bool compared_as(Draw& d) {
    return replace(d.depth.compare, from, to);
}

bool scale_bias(DepthBias& b, float by) {
    b.constant *= by;
    b.slope *= by;
    return true;
}

bool operate(StencilFace& face, bool (*change)(StencilOp&)) {
    bool is_changed = false;
    for (StencilOp* op : {&face.fail, &face.depth_fail, &face.pass}) {
        is_changed = change(*op) || is_changed;
    }
    return is_changed;
}
bool keep_all(StencilFace& face) {
    return operate(face, [](StencilOp& op) { return set(op, StencilOp::keep); });
}

const Body kDepthBodies[] = {
    // depth
    {"less-or-equal-as-less"_fault, compared_as<CompareOp::less_or_equal, CompareOp::less>},
    {"greater-as-greater-or-equal"_fault,
     compared_as<CompareOp::greater, CompareOp::greater_or_equal>},
    {"greater-or-equal-as-greater"_fault,
     compared_as<CompareOp::greater_or_equal, CompareOp::greater>},
    {"not-equal-as-always"_fault, compared_as<CompareOp::not_equal, CompareOp::always>},
    {"equal-as-less-or-equal"_fault, compared_as<CompareOp::equal, CompareOp::less_or_equal>},
    {"never-as-always"_fault, compared_as<CompareOp::never, CompareOp::always>},
    {"depth-test-ignored"_fault, [](Draw& d) { return set(d.depth.compare, CompareOp::always); }},
    {"depth-test-off"_fault,
     [](Draw& d) {
         const bool tests = set(d.depth.compare, CompareOp::always);
         return set(d.depth.write, false) || tests;
     }},
    {"depth-write-off"_fault, [](Draw& d) { return set(d.depth.write, false); }},
    {"depth-of-first-vertex"_fault,
     [](Draw& d) {
         const glm::vec4 first = d.positions.front();
         return any_of(d.positions, [&](glm::vec4& p) {
             return set(p, glm::vec4{p.x, p.y, first.z / first.w * p.w, p.w});
         });
     }},
    {"frag-depth-ignored"_fault,
     [](Draw& d) { return set(d.frag_depth, std::optional<FragDepth>()); }},
    {"bounds-ignored"_fault,
     [](Draw& d) { return set(d.depth.bounds, std::optional<DepthBounds>()); }},
    {"bounds-exclusive"_fault,
     [](Draw& d) {
         if (d.depth.bounds) {
             d.depth.bounds->min = std::nextafter(d.depth.bounds->min, 2.0F);
             d.depth.bounds->max = std::nextafter(d.depth.bounds->max, -1.0F);
         }
         return d.depth.bounds.has_value();
     }},
    {"bias-ignored"_fault, [](Draw& d) { return set(d.depth.bias, std::optional<DepthBias>()); }},
    {"bias-sign"_fault, [](DepthBias& b) { return scale_bias(b, -1); }},
    {"bias-enlarged"_fault, [](DepthBias& b) { return scale_bias(b, 256); }},
    {"bias-no-constant"_fault, [](DepthBias& b) { return set(b.constant, 0.0F); }},
    {"bias-constant-doubled"_fault, [](DepthBias& b) { return set(b.constant, 2 * b.constant); }},
    {"bias-no-slope"_fault, [](DepthBias& b) { return set(b.slope, 0.0F); }},
    {"bias-slope-negated"_fault, [](DepthBias& b) { return set(b.slope, -b.slope); }},
    {"bias-slope-halved"_fault, [](DepthBias& b) { return set(b.slope, b.slope / 2); }},
    {"bias-clamp-negated"_fault, [](DepthBias& b) { return set(b.clamp, -b.clamp); }},
    {"depth-clamp-off"_fault,
     [](Draw& d) {
         const bool clamps = set(d.depth.clamp, false);
         return clamps && set(d.depth.clip, std::optional<bool>(true));
     }},
    {"depth-clip-flipped"_fault,
     [](Draw& d) {
         d.depth.clip = !d.depth.clip.value_or(!d.depth.clamp);
         return true;
     }},
    {"depth-volume-flipped"_fault,
     [](Draw& d) {
         d.depth.negative_one_to_one = !d.depth.negative_one_to_one;
         return true;
     }},
    {"depth-cleared-to-one"_fault,
     [](Case& c) { return c.target.has_depth && set(c.target.depth_clear, 1.0F); }},
    // stencil
    {"stencil-off"_fault,
     [](StencilFace& face) {
         const bool tests = set(face.compare, CompareOp::always);
         return keep_all(face) || tests;
     }},
    {"stencil-test-passes"_fault,
     [](StencilFace& face) { return set(face.compare, CompareOp::always); }},
    {"stencil-compare-turned"_fault,
     [](StencilFace& face) {
         return exchange(face.compare, CompareOp::less, CompareOp::greater) ||
                exchange(face.compare, CompareOp::less_or_equal, CompareOp::greater_or_equal);
     }},
    {"stencil-never-written"_fault, keep_all},
    {"stencil-clamps-exchanged"_fault,
     [](StencilFace& face) {
         return operate(face, [](StencilOp& op) {
             return exchange(op, StencilOp::increment_and_clamp, StencilOp::increment_and_wrap) ||
                    exchange(op, StencilOp::decrement_and_clamp, StencilOp::decrement_and_wrap);
         });
     }},
    {"stencil-masks-ignored"_fault,
     [](StencilFace& face) {
         const bool compares = set(face.compare_mask, face.compare_mask | kStencilBits);
         return set(face.write_mask, face.write_mask | kStencilBits) || compares;
     }},
    {"stencil-faces-exchanged"_fault,
     [](Case& c) {
         return c.target.has_stencil && any_of(c.draws, [](Draw& d) {
                    std::swap(d.stencil.front, d.stencil.back);
                    return !(d.stencil.front == d.stencil.back);
                });
     }},
    {"stencil-before-depth"_fault,
     [](StencilFace& face) { return set(face.depth_fail, face.pass); }},
    {"stencil-depth-fail-fails"_fault,
     [](StencilFace& face) { return set(face.depth_fail, face.fail); }},
    {"stencil-cleared-to-one"_fault,
     [](Case& c) { return c.target.has_stencil && set(c.target.stencil_clear, 1U); }},
    {"stencil-cleared-to-all"_fault,
     [](Case& c) { return c.target.has_stencil && set(c.target.stencil_clear, 255U); }},
};

}  // namespace

std::span<const Body> depth_bodies() {
    return kDepthBodies;
}

}  // namespace cases::fault
