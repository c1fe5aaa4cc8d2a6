// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cases/model/case.hpp"

namespace cases {

// The table [[draw]] of a case with the tables inside it.
std::string draw_text(const Draw& draw, const Target& target);

// The four numbers of a colour.
std::string color_text(const glm::vec4& color);

}  // namespace cases
