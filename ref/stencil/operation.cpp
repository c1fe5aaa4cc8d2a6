// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/stencil/operation.hpp"

#include <algorithm>

#include "cases/model/sample.hpp"

namespace ref::stencil {

using cases::CompareOp;
using cases::kStencilBits;
using cases::StencilOp;

bool is_needed(const cases::Case& c) {
    return c.target.has_stencil &&
           (!c.target.has_instruments || c.target.stencil_clear != 0 ||
            c.target.stencil_load == cases::LoadOp::dont_care ||
            std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& draw) {
                return draw.stencil != cases::StencilState{} || stores_discarded(draw);
            }));
}

// "A is the reference value, B the stored one, both after they are combined with compareMask"; LESS
// passes if A < B (Vulkan specification, VkCompareOp and "Stencil Test").
bool passes(const cases::StencilFace& face, uint32_t stored) {
    const uint32_t mask = face.compare_mask & kStencilBits;
    const uint32_t a = face.reference & mask;
    const uint32_t b = stored & mask;
    switch (face.compare) {
        case CompareOp::never:
            return false;
        case CompareOp::less:
            return a < b;
        case CompareOp::equal:
            return a == b;
        case CompareOp::less_or_equal:
            return a <= b;
        case CompareOp::greater:
            return a > b;
        case CompareOp::not_equal:
            return a != b;
        case CompareOp::greater_or_equal:
            return a >= b;
        case CompareOp::always:
            return true;
    }
    return true;
}

// The operation takes the stored value, not the masked one, and REPLACE the whole reference
// (Vulkan specification, VkStencilOp); then "the stencil write mask ... controls which bits of the
// stored value are updated".
uint32_t updated(StencilOp op, const cases::StencilFace& face, uint32_t stored) {
    uint32_t made = stored;
    switch (op) {
        case StencilOp::keep:
            break;
        case StencilOp::zero:
            made = 0;
            break;
        case StencilOp::replace:
            made = face.reference;
            break;
        case StencilOp::increment_and_clamp:
            made = std::min(stored + 1, kStencilBits);
            break;
        case StencilOp::decrement_and_clamp:
            made = stored == 0 ? 0 : stored - 1;
            break;
        case StencilOp::invert:
            made = ~stored;
            break;
        case StencilOp::increment_and_wrap:
            made = stored + 1;
            break;
        case StencilOp::decrement_and_wrap:
            made = stored - 1;
            break;
    }
    const uint32_t mask = face.write_mask & kStencilBits;
    return ((stored & ~mask) | (made & mask)) & kStencilBits;
}

}  // namespace ref::stencil
