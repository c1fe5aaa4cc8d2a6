// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A datasheet as one page that needs nothing else: a star of ties, staircases of rounding, curves
// of errors.
#pragma once

#include <string>

#include "probe/base/datasheet.hpp"

namespace probe {

std::string to_html(const Datasheet& sheet);

// A picture alone; empty if there is none.
std::string to_svg(const Picture& picture);

}  // namespace probe
