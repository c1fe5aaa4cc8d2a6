// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The one table of reasons: which rule a reason is, and how it is told.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "ref/coverage/reason.hpp"
#include "ref/expectation/explain.hpp"

namespace ref {

// The rule that a device breaks which decides otherwise. At profile direct3d: of a device that
// looser profiles allow to do so.
std::string_view rule_of(ReasonKind kind, cases::Profile level);

// A reason of a triangle at a sample, in one sentence.
std::string sentence_of(Reason reason, const TriangleExplanation& t, const cases::Case& c,
                        cases::SampleId sample);

// Why a set of triangles covers a sample as often as it does.
std::string sentence_of(const FixedSet& set, const std::vector<cases::Triangle>& triangles);

// That no draw at all may touch the sample: of other_layer, scissor and viewport.
std::string_view sentence_of_all(ReasonKind kind);

}  // namespace ref
