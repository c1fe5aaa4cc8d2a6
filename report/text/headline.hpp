// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run found, in one sentence, and how grave it is.
#pragma once

#include <string>

#include "report/record/run.hpp"

namespace report {

// "87 of 3574 cases fail, 2 crash", "All 3185 judged cases pass", "No case was judged".
std::string headline(const Run& run);

// "3 of 92 known failures are drawn with bits that nobody has seen before: ID, ID, ID"; empty if
// there are none, or if nothing is known of pictures.
std::string new_pictures_text(const Run& run);

}  // namespace report
