// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case as JSON that a program can draw without knowing our case files: docs/schema/case-1.json.
#pragma once

#include <string>
#include <vector>

#include "cases/model/case.hpp"

namespace capture {

// What a renderer has to be able to do beyond triangles from lists, one sample a pixel, w = 1, the
// whole target as viewport and scissor, both faces, no depth test: words of
// docs/schema/case-1.json, in its order.
std::vector<std::string> needs_of(const cases::Case& c);

// The text of the file, with a line feed at its end.
std::string export_case(const cases::Case& c);

}  // namespace capture
