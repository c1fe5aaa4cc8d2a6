// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// report.html, a pure function of a Run.
#pragma once

#include <string>
#include <vector>

#include "report/record/run.hpp"

namespace report {

// report.html: one file that opens by double click and loads nothing.
std::string to_html(const Run& run);
// The same, and further pages with the cases whose pictures would make it larger than 8 MB: part k
// (from 2 on) belongs beside the first in a file with "-k" before ".html".
std::vector<std::string> to_html_parts(const Run& run);

}  // namespace report
