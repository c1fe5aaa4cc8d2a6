// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Logical operations. The number of an operation (VkLogicOp) is its truth table: of the bits s and
// d of source and destination, bit 3 - (2s + d) of the number is the result. AND is 0001, COPY
// 0011.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cases/model/color_state.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/software/target/store.hpp"

namespace software {

// Whether component k of a format takes logical operations.
bool has_logic(const FormatLayout& layout, size_t k, Fault fault);

// A code after an operation.
uint32_t operated(cases::LogicOp op, uint32_t source, uint32_t before, uint32_t bits_of_code,
                  Fault fault);

}  // namespace software
