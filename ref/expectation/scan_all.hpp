// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/triangle_setups.hpp"

namespace ref {

// The samples that the triangles of a case must or may cover, in drawing order; y counts the rows
// of the stacked layers. Sets up those that may touch a sample, and keeps those that do.
std::vector<fast::Span> scan_all(const cases::Case& c,
                                 const std::vector<cases::Triangle>& triangles,
                                 TriangleSetups& setups);

}  // namespace ref
