// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/logic_unit.hpp"

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

bool has_logic(const FormatLayout& layout, size_t k, Fault fault) {
    if (layout.channels[k].bits == 0 || (fault == "logic-alpha-copied"_fault && k == 3)) {
        return false;
    }
    switch (layout.channels[0].number) {  // alpha of an sRGB format is UNORM itself
        case Number::unorm:
        case Number::uint:
        case Number::snorm:
        case Number::sint:
            return true;
        case Number::srgb:
            return fault == "logic-on-srgb"_fault;
        default:
            return fault == "logic-on-floats"_fault;
    }
}

uint32_t operated(cases::LogicOp op, uint32_t source, uint32_t before, uint32_t bits_of_code,
                  Fault fault) {
    auto table = static_cast<uint32_t>(fault == "logic-copies"_fault ? cases::LogicOp::copy : op);
    if (fault == "logic-operands-exchanged"_fault) {
        table = exchanged(table);
    }
    const uint32_t bits = fault == "logic-low-bits"_fault ? 4 : bits_of_code;
    const uint32_t all = bits == 32 ? UINT32_MAX : (1U << bits) - 1;
    const uint32_t rest = bits == bits_of_code ? 0 : source & ~all;
    return (by_truth_table(table, source, before) & all) | rest;
}

}  // namespace software
