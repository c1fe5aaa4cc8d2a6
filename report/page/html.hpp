// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// report.html, a pure function of a Run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "report/record/run.hpp"

namespace report {

// report.html: one file that opens by double click and loads nothing.
std::string to_html(const Run& run);
// Calls visit(1, that) and, for further pages with the cases whose pictures would make it larger
// than 8 MB, visit(k, page): part k (from 2 on) belongs beside the first in a file with "-k" before
// ".html".
void for_each_page(const Run& run, const std::function<void(size_t, const std::string&)>& visit);

}  // namespace report
