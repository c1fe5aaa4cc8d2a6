// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/stencil_unit.hpp"

#include <utility>

namespace software {

using cases::CompareOp;
using cases::StencilFace;
using cases::StencilOp;

StencilAttachment::StencilAttachment(const cases::Case& c, const Device& device)
    : case_(c), device_(device), samples_(c.target.samples) {
    if (c.target.has_stencil) {
        const bool is_lost = device.fault == "stencil-clear-ignored"_fault;
        values_.assign(size_t{c.target.width} * c.target.rows() * c.target.samples,
                       is_lost ? 0
                       : c.target.stencil_load == cases::LoadOp::dont_care
                           ? c.target.stencil_clear ^ 0xffU
                           : c.target.stencil_clear);
    }
}

// The state that the device uses for a face.
StencilFace StencilAttachment::face_of(uint32_t number, bool front) const {
    const cases::Draw& draw = case_.draws[number];
    const Fault fault = device_.fault;
    bool as_front = front;
    if (fault == "stencil-faces-exchanged"_fault) {
        as_front = !front;
    } else if (fault == "stencil-front-only"_fault) {
        as_front = true;
    } else if (fault == "stencil-own-facing"_fault) {  // front is clockwise, always
        as_front = front == (draw.front_face == cases::FrontFace::clockwise);
    }
    StencilFace face = as_front ? draw.stencil.front : draw.stencil.back;
    if (fault == "stencil-reference-of-front"_fault) {
        face.reference = draw.stencil.front.reference;
    } else if (fault == "stencil-masks-of-front"_fault) {
        face.compare_mask = draw.stencil.front.compare_mask;
        face.write_mask = draw.stencil.front.write_mask;
    } else if (fault == "stencil-reference-stale"_fault) {
        const cases::StencilState& first = case_.draws[0].stencil;
        face.reference = (front ? first.front : first.back).reference;
    } else if (fault == "stencil-operations-stale"_fault) {
        const cases::StencilState& first = case_.draws[0].stencil;
        const StencilFace& older = front ? first.front : first.back;
        face.fail = older.fail;
        face.depth_fail = older.depth_fail;
        face.pass = older.pass;
    }
    return face;
}

bool StencilAttachment::compare(const StencilFace& face, uint32_t stored) const {
    const Fault fault = device_.fault;
    const uint32_t mask = fault == "stencil-compare-unmasked"_fault ? 0xffU : face.compare_mask;
    uint32_t a = face.reference & 0xffU;
    uint32_t b = stored;
    a = fault == "stencil-reference-unmasked"_fault ? a : a & mask;
    b = fault == "stencil-stored-unmasked"_fault ? b : b & mask;
    if (fault == "stencil-compare-turned"_fault) {
        std::swap(a, b);
    } else if (fault == "stencil-compare-signed"_fault) {
        a ^= 0x80U;
        b ^= 0x80U;
    }
    switch (face.compare) {
        case CompareOp::never:
            return false;
        case CompareOp::less:
            return fault == "stencil-less-or-equal"_fault ? a <= b : a < b;
        case CompareOp::equal:
            return a == b;
        case CompareOp::less_or_equal:
            return a <= b;
        case CompareOp::greater:
            return fault == "stencil-less-or-equal"_fault ? a >= b : a > b;
        case CompareOp::not_equal:
            return a != b;
        case CompareOp::greater_or_equal:
            return a >= b;
        default:
            return true;
    }
}

uint32_t StencilAttachment::apply(StencilOp op, const StencilFace& face, uint32_t stored) const {
    const Fault fault = device_.fault;
    const bool stops_up = fault == "stencil-saturates"_fault;
    const bool stops_down = stops_up || fault == "stencil-wrap-stops-at-zero"_fault;
    switch (op) {
        case StencilOp::zero:
            return 0;
        case StencilOp::replace:
            return fault == "stencil-replace-masked"_fault ? face.reference & face.compare_mask
                                                           : face.reference;
        case StencilOp::increment_and_clamp:
            return stored == 255 && fault != "stencil-increment-wraps"_fault ? 255 : stored + 1;
        case StencilOp::decrement_and_clamp:
            return stored == 0 && fault != "stencil-decrement-wraps"_fault ? 0 : stored - 1;
        case StencilOp::invert:
            return fault == "stencil-invert-negates"_fault ? 0U - stored : ~stored;
        case StencilOp::increment_and_wrap:
            return stored == 255 && stops_up ? 255 : stored + 1;
        case StencilOp::decrement_and_wrap:
            return stored == 0 && stops_down ? 0 : stored - 1;
        default:
            return stored;
    }
}

uint32_t StencilAttachment::masked(StencilOp op, const StencilFace& face, uint32_t stored) const {
    uint32_t mask = face.write_mask & 0xffU;
    switch (device_.fault) {
        case "stencil-seven-bits"_fault:
            mask &= 0x7fU;
            break;
        case "stencil-write-unmasked"_fault:
            mask = 0xff;
            break;
        case "stencil-zero-unmasked"_fault:
            mask = op == StencilOp::zero ? 0xffU : mask;
            break;
        default:
            break;
    }
    const bool is_cut = device_.fault == "stencil-operation-masked"_fault;
    const uint32_t from = is_cut ? stored & face.write_mask : stored;
    return (stored & ~mask) | (apply(op, face, from) & mask);
}

bool StencilAttachment::test(size_t index, uint32_t draw, bool front, bool passes) {
    if (values_.empty()) {
        return true;
    }
    const Fault fault = device_.fault;
    if (fault == "stencil-test-stale"_fault && draw != draw_) {
        before_ = values_;
        draw_ = draw;
    }
    const StencilFace face = face_of(draw, front);
    const size_t first = index - index % samples_;
    const size_t tested = fault == "stencil-sample-zero"_fault ? first : index;
    const uint32_t stored = fault == "stencil-test-stale"_fault ? before_[tested] : values_[tested];
    const bool is_late = fault == "stencil-after-depth"_fault && !passes;
    const bool is_passed = is_late || compare(face, stored);
    StencilOp op = !is_passed ? face.fail : passes ? face.pass : face.depth_fail;
    if (is_passed && !passes) {
        op = fault == "stencil-before-depth"_fault       ? face.pass
             : fault == "stencil-depth-fail-lost"_fault  ? StencilOp::keep
             : fault == "stencil-depth-fail-fails"_fault ? face.fail
                                                         : op;
    } else if (!is_passed && fault == "stencil-fail-lost"_fault) {
        op = StencilOp::keep;
    }
    switch (fault) {
        case "stencil-per-pixel"_fault:  // whichever sample is drawn, all of the pixel count
            for (size_t s = 0; s < samples_; ++s) {
                values_[first + s] = masked(op, face, values_[first + s]);
            }
            break;
        case "stencil-never-written"_fault:
            break;
        default:
            values_[tested] = masked(op, face, values_[tested]);
            break;
    }
    return is_passed || fault == "stencil-fail-draws"_fault;
}

}  // namespace software
