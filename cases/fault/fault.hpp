// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The catalogue of faults: what a device may do wrong, a row each. Bodies name their row, and a row
// may have one of each kind: a change of the case (change.hpp), code of the software device, which
// varies its arithmetic and never the picture, calls (tests/breaking_layer). docs/mutants.md is
// made of the rows.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string_view>

#include "cases/fault/geometry_rows.hpp"
#include "cases/fault/row.hpp"
#include "cases/fault/state_rows.hpp"
#include "cases/fault/stencil_rows.hpp"
#include "cases/fault/target_rows.hpp"
#include "cases/fault/value_rows.hpp"

namespace cases {

// All rows: those that the software device has code for, and behind them those that it draws by a
// change of the case or the picture. Whoever asks for faults asks for all of them.
inline constexpr size_t kCodeFaultCount = std::size(kGeometryFaults) + std::size(kValueFaults) +
                                          std::size(kTargetFaults) + std::size(kStencilFaults);
inline constexpr auto kFaults = [] {
    std::array<FaultRow, kCodeFaultCount + std::size(kStateFaults)> rows;
    size_t count = 0;
    for (const std::span<const FaultRow> part :
         {std::span<const FaultRow>(kGeometryFaults), std::span<const FaultRow>(kValueFaults),
          std::span<const FaultRow>(kTargetFaults), std::span<const FaultRow>(kStencilFaults),
          std::span<const FaultRow>(kStateFaults)}) {
        for (const FaultRow& row : part) {
            rows[count] = row;
            rows[count].fault = static_cast<Fault>(count + 1);
            ++count;
        }
    }
    return rows;
}();

// Whether the software device has code for a fault; not none.
constexpr bool has_code(Fault fault) {
    return static_cast<size_t>(fault) <= kCodeFaultCount;
}

// The fault of that name; none if no row has it.
constexpr Fault find_fault(std::string_view name) {
    const auto* row = std::ranges::find(kFaults, name, &FaultRow::name);
    return row == kFaults.end() ? kNoFault : row->fault;
}

// "bias-ignored"_fault; a name without a row does not compile.
consteval Fault operator""_fault(const char* name, size_t length) {
    const Fault fault = find_fault({name, length});
    return fault == kNoFault ? throw "no row of the catalogue has this name" : fault;
}

constexpr const FaultRow& row_of(Fault fault) {  // not none
    return kFaults[static_cast<size_t>(fault) - 1];
}
constexpr std::string_view to_string(Fault fault) {
    return fault == kNoFault ? "none" : row_of(fault).name;
}

}  // namespace cases
