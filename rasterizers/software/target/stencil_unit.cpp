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
        const bool is_lost = device.fault == Fault::stencil_clear_ignored;
        values_.assign(size_t{c.target.width} * c.target.rows() * c.target.samples,
                       is_lost ? 0 : c.target.stencil_clear);
    }
}

// The state that the device uses for a face.
StencilFace StencilAttachment::face_of(uint32_t number, bool front) const {
    const cases::Draw& draw = case_.draws[number];
    const Fault fault = device_.fault;
    bool as_front = front;
    if (fault == Fault::stencil_faces_exchanged) {
        as_front = !front;
    } else if (fault == Fault::stencil_front_only) {
        as_front = true;
    } else if (fault == Fault::stencil_own_facing) {  // front is clockwise, always
        as_front = front == (draw.front_face == cases::FrontFace::clockwise);
    }
    StencilFace face = as_front ? draw.stencil.front : draw.stencil.back;
    if (fault == Fault::stencil_reference_of_front) {
        face.reference = draw.stencil.front.reference;
    } else if (fault == Fault::stencil_masks_of_front) {
        face.compare_mask = draw.stencil.front.compare_mask;
        face.write_mask = draw.stencil.front.write_mask;
    } else if (fault == Fault::stencil_reference_stale) {
        const cases::StencilState& first = case_.draws[0].stencil;
        face.reference = (front ? first.front : first.back).reference;
    } else if (fault == Fault::stencil_operations_stale) {
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
    const uint32_t mask = fault == Fault::stencil_compare_unmasked ? 0xffU : face.compare_mask;
    uint32_t a = face.reference & 0xffU;
    uint32_t b = stored;
    a = fault == Fault::stencil_reference_unmasked ? a : a & mask;
    b = fault == Fault::stencil_stored_unmasked ? b : b & mask;
    if (fault == Fault::stencil_compare_turned) {
        std::swap(a, b);
    } else if (fault == Fault::stencil_compare_signed) {
        a ^= 0x80U;
        b ^= 0x80U;
    }
    switch (face.compare) {
        case CompareOp::never:
            return false;
        case CompareOp::less:
            return fault == Fault::stencil_less_or_equal ? a <= b : a < b;
        case CompareOp::equal:
            return a == b;
        case CompareOp::less_or_equal:
            return a <= b;
        case CompareOp::greater:
            return fault == Fault::stencil_less_or_equal ? a >= b : a > b;
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
    const bool stops_up = fault == Fault::stencil_saturates;
    const bool stops_down = stops_up || fault == Fault::stencil_wrap_stops_at_zero;
    switch (op) {
        case StencilOp::zero:
            return 0;
        case StencilOp::replace:
            return fault == Fault::stencil_replace_masked ? face.reference & face.compare_mask
                                                          : face.reference;
        case StencilOp::increment_and_clamp:
            return stored == 255 && fault != Fault::stencil_increment_wraps ? 255 : stored + 1;
        case StencilOp::decrement_and_clamp:
            return stored == 0 && fault != Fault::stencil_decrement_wraps ? 0 : stored - 1;
        case StencilOp::invert:
            return fault == Fault::stencil_invert_negates ? 0U - stored : ~stored;
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
        case Fault::stencil_seven_bits:
            mask &= 0x7fU;
            break;
        case Fault::stencil_write_unmasked:
            mask = 0xff;
            break;
        case Fault::stencil_zero_unmasked:
            mask = op == StencilOp::zero ? 0xffU : mask;
            break;
        default:
            break;
    }
    const bool is_cut = device_.fault == Fault::stencil_operation_masked;
    const uint32_t from = is_cut ? stored & face.write_mask : stored;
    return (stored & ~mask) | (apply(op, face, from) & mask);
}

bool StencilAttachment::test(size_t index, uint32_t draw, bool front, bool passes) {
    if (values_.empty()) {
        return true;
    }
    const Fault fault = device_.fault;
    if (fault == Fault::stencil_test_stale && draw != draw_) {
        before_ = values_;
        draw_ = draw;
    }
    const StencilFace face = face_of(draw, front);
    const size_t first = index - index % samples_;
    const size_t tested = fault == Fault::stencil_sample_zero ? first : index;
    const uint32_t stored = fault == Fault::stencil_test_stale ? before_[tested] : values_[tested];
    const bool is_late = fault == Fault::stencil_after_depth && !passes;
    const bool is_passed = is_late || compare(face, stored);
    StencilOp op = !is_passed ? face.fail : passes ? face.pass : face.depth_fail;
    if (is_passed && !passes) {
        op = fault == Fault::stencil_before_depth       ? face.pass
             : fault == Fault::stencil_depth_fail_lost  ? StencilOp::keep
             : fault == Fault::stencil_depth_fail_fails ? face.fail
                                                        : op;
    } else if (!is_passed && fault == Fault::stencil_fail_lost) {
        op = StencilOp::keep;
    }
    switch (fault) {
        case Fault::stencil_per_pixel:  // whichever sample is drawn, all of the pixel count
            for (size_t s = 0; s < samples_; ++s) {
                values_[first + s] = masked(op, face, values_[first + s]);
            }
            break;
        case Fault::stencil_never_written:
            break;
        default:
            values_[tested] = masked(op, face, values_[tested]);
            break;
    }
    return is_passed || fault == Fault::stencil_fail_draws;
}

}  // namespace software
