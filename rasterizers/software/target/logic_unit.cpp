// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Logical operations. The number of an operation (VkLogicOp) is its truth table: of the bits s and
// d of source and destination, bit 3 - (2s + d) of the number is the result. AND is 0001, COPY
// 0011.
#include "rasterizers/software/target/blend_unit.hpp"

namespace software {

namespace {

uint32_t by_truth_table(uint32_t table, uint32_t source, uint32_t before) {
    uint32_t out = 0;
    for (uint32_t bit = 0; bit < 32; ++bit) {
        const uint32_t s = source >> bit & 1U, d = before >> bit & 1U;
        out |= (table >> (3 - (2 * s + d)) & 1U) << bit;
    }
    return out;
}

// The truth table with source and destination exchanged.
uint32_t exchanged(uint32_t table) {
    return (table & 0b1001U) | (table & 0b0010U) << 1 | (table & 0b0100U) >> 1;
}

}  // namespace

bool BlendUnit::has_logic(size_t k) const {
    const Channel& channel = layout_.channels[k];
    if (channel.bits == 0 || (device_.fault == "logic-alpha-copied"_fault && k == 3)) {
        return false;
    }
    switch (layout_.channels[0].number) {  // alpha of an sRGB format is UNORM itself
        case Number::unorm:
        case Number::uint:
            return true;
        case Number::srgb:
            return device_.fault == "logic-on-srgb"_fault;
        default:
            return device_.fault == "logic-on-floats"_fault;
    }
}

uint32_t BlendUnit::operated(cases::LogicOp op, uint32_t source, uint32_t before, size_t k) const {
    auto table =
        static_cast<uint32_t>(device_.fault == "logic-copies"_fault ? cases::LogicOp::copy : op);
    if (device_.fault == "logic-operands-exchanged"_fault) {
        table = exchanged(table);
    }
    const uint32_t bits = device_.fault == "logic-low-bits"_fault ? 4 : layout_.channels[k].bits;
    const uint32_t all = bits == 32 ? UINT32_MAX : (1U << bits) - 1;
    const uint32_t rest = bits == layout_.channels[k].bits ? 0 : source & ~all;
    return (by_truth_table(table, source, before) & all) | rest;
}

}  // namespace software
