// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A row of the catalogue of faults.
#pragma once

#include <cstdint>
#include <string_view>

namespace cases {

// A fault of the catalogue: the number of its row, from 1.
enum class Fault : uint16_t {};
inline constexpr Fault kNoFault{};

struct FaultRow {
    std::string_view name;
    std::string_view sentence;  // what the device does wrong
    std::string_view rules;     // the rules that this breaks, ids separated by spaces
    Fault fault = kNoFault;     // filled in by the catalogue
};

}  // namespace cases
