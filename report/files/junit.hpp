// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// junit.xml, a pure function of a Run.
#pragma once

#include <string>

#include "report/record/run.hpp"

namespace report {

// junit.xml: valid XML 1.0 and UTF-8 whatever bytes a driver printed.
std::string to_junit(const Run& run);

}  // namespace report
