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
    const auto result = [&]() -> uint32_t {
        switch (op) {
            case LogicOp::clear:
                return 0;
            case LogicOp::and_both:
                return source & before;
            case LogicOp::and_reverse:
                return source & ~before;
            case LogicOp::copy:
                return source;
            case LogicOp::and_inverted:
                return ~source & before;
            case LogicOp::no_op:
                return before;
            case LogicOp::exclusive_or:
                return source ^ before;
            case LogicOp::or_both:
                return source | before;
            case LogicOp::nor:
                return ~(source | before);
            case LogicOp::equivalent:
                return ~(source ^ before);
            case LogicOp::invert:
                return ~before;
            case LogicOp::or_reverse:
                return source | ~before;
            case LogicOp::copy_inverted:
                return ~source;
            case LogicOp::or_inverted:
                return ~source | before;
            case LogicOp::nand:
                return ~(source & before);
            case LogicOp::set:
                break;
        }
        return UINT32_MAX;
    };
    return result() & all;
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
