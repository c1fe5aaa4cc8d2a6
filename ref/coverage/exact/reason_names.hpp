// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Names the reasons of a sample that exact::decide has decided: edges, planes and distances.
#pragma once

#include "ref/coverage/setup.hpp"

namespace ref {

// Adds to `out`, which the outlines gave its coverage, the reasons of one of them, whose own answer
// at p was `own`.
void name_reasons(const TriangleSetup& setup, const Outline& outline, const FixedPoint& p,
                  Coverage own, Decision& out);

// Adds the reasons of the set-up and its window, and puts all in the order in which they are told.
void name_setup_reasons(const TriangleSetup& setup, const FixedPoint& p, Decision& out);

}  // namespace ref
