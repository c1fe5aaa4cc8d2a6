// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/logic.hpp"

#include <algorithm>
#include <utility>

namespace ref::color {

using cases::LogicOp;

bool takes_logic(cases::ColorFormat format) {
    const cases::ComponentKind kind = row_of(format).kind;
    return kind == cases::ComponentKind::unorm || kind == cases::ComponentKind::uint;
}

uint32_t operated(LogicOp op, uint32_t source, uint32_t before, uint32_t bits) {
    const uint32_t all = bits == 32 ? UINT32_MAX : (1U << bits) - 1;
    uint32_t out = 0;
    // Vulkan numbers an operation by its truth table: bit k says what it makes of the k-th pair.
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t pair =
            ((k & 2U) != 0 ? ~source : source) & ((k & 1U) != 0 ? ~before : before);
        out |= (static_cast<uint32_t>(op) >> k & 1U) != 0 ? pair : 0;
    }
    return out & all;
}

Interval operated(LogicOp op, const Component& component, const Interval& source,
                  const Interval& before) {
    constexpr uint64_t kMostPairs = 1U << 12;
    const uint32_t bits = component.bits();
    const uint32_t first = component.code_of(source.low), last = component.code_of(source.high);
    const uint32_t from = component.code_of(before.low), to = component.code_of(before.high);
    uint32_t low = 0, high = operated(LogicOp::set, 0, 0, bits);
    if ((uint64_t{last} - first + 1) * (uint64_t{to} - from + 1) <= kMostPairs) {
        std::swap(low, high);
        for (uint64_t s = first; s <= last; ++s) {
            for (uint64_t d = from; d <= to; ++d) {
                const uint32_t code =
                    operated(op, static_cast<uint32_t>(s), static_cast<uint32_t>(d), bits);
                low = std::min(low, code);
                high = std::max(high, code);
            }
        }
    }
    Interval out;
    component.value_of(low, out.low);
    component.value_of(high, out.high);
    return out;
}

}  // namespace ref::color
