// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How the reasons of a sample are told: the sentences of the table (ref/reason/reason.cpp) with the
// names and numbers of a triangle in them.
#pragma once

#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/path/path.hpp"
#include "ref/reason/reason.hpp"

namespace ref {

// A reason of a triangle at a sample, in one sentence.
std::string sentence_of(Reason reason, const TriangleExplanation& t, const cases::Case& c,
                        cases::SampleId sample);

// Why a set of triangles covers a sample as often as it does.
std::string sentence_of(const FixedSet& set, const std::vector<cases::Triangle>& triangles);

// How a fragment, whose depth is told by `depths`, fares in the depth test.
std::string sentence_of(ReasonKind depth_reason, DepthOutcome outcome, cases::CompareOp compare,
                        const std::string& depths);

// How a fragment fares in the depth bounds test.
std::string sentence_of(const path::Fate& fate, const cases::DepthBounds& bounds);

// How a fragment fares in the stencil test of the faces that it may show.
std::string sentence_of(const path::Fate& fate, const cases::StencilState& state, bool can_be_front,
                        bool can_be_back);

}  // namespace ref
