// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/logic.hpp"

#include <algorithm>
#include <utility>

namespace ref::color {

using cases::LogicOp;

bool takes_logic(cases::ColorFormat format) {
    const cases::ComponentKind kind = row_of(format).kind;
    return kind != cases::ComponentKind::srgb && !is_floating(kind);
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
    const bool is_signed = cases::is_signed(component.kind());
    const auto whole_of = [&](uint32_t code) {
        return static_cast<int64_t>(component.whole_of(code));
    };
    const auto whole_at = [&](const mpq_class& value) {
        return whole_of(component.code_of(value));
    };
    const int64_t first = whole_at(source.low), last = whole_at(source.high);
    const int64_t from = whole_at(before.low), to = whole_at(before.high);
    int64_t low = is_signed ? -(int64_t{1} << (bits - 1)) : 0;
    int64_t high = low + (int64_t{1} << bits) - 1;
    if (static_cast<uint64_t>(last - first + 1) * static_cast<uint64_t>(to - from + 1) <=
        kMostPairs) {
        std::swap(low, high);
        for (int64_t s = first; s <= last; ++s) {
            for (int64_t d = from; d <= to; ++d) {
                const int64_t whole = whole_of(
                    operated(op, static_cast<uint32_t>(s), static_cast<uint32_t>(d), bits));
                low = std::min(low, whole);
                high = std::max(high, whole);
            }
        }
    }
    Interval out;
    component.value_of(static_cast<uint32_t>(low), out.low);
    component.value_of(static_cast<uint32_t>(high), out.high);
    return out;
}

}  // namespace ref::color
