// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fills in what was not delivered: what the reference allows, as near to the delivered planes as
// can be.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "capture/capture.hpp"
#include "capture/delivered.hpp"
#include "cases/model/case.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

// The values that were delivered.
ref::ValueSelection selection_of(const capture::Delivered& planes);

// A stencil that a sample may hold, with these hits (front, back) if they are known.
uint32_t likely_stencil(const ref::Expectation& expectation, size_t index,
                        std::optional<std::pair<uint32_t, uint32_t>> hits);

// The whole capture of a case with instruments, colours left out.
capture::Capture completed(const cases::Case& c, const ref::Expectation& expectation,
                           const capture::Delivered& planes);

// Whether these planes, if they are those of an empty picture, would be right.
bool are_right_if_empty(const cases::Case& c, const ref::Expectation& expectation,
                        const capture::Delivered& planes);

}  // namespace diff
