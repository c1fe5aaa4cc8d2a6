// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of a colour: what a fragment writes and what is left of it.
#pragma once

#include <string>

#include "ref/color/color_memory.hpp"

namespace ref::color {

// How a fragment with this output and source turns one colour of the target into another.
std::string step_text(const Unit& unit, const cases::ColorOutput& output, const Source& source,
                      const Color& before, const Color& left);

}  // namespace ref::color
