// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How the samples of an outline are tested: which of its edges by the top-left rule, which as
// strict, which as parallel to the hull of their boxes; in snapped positions or in boxes.
#pragma once

#include "cases/model/profile.hpp"
#include "ref/coverage/facing.hpp"
#include "ref/coverage/setup.hpp"

namespace ref {

// Decides the mode of an outline whose vertices are known, and the tests of its edges. `step`: the
// device's subpixel grid in fixed-point units.
void choose_mode(Outline& o, int64_t step, cases::Profile profile);

// The signs that the outline's area may have; those of what has none only if it `may_be_zero`, or
// has never any.
AreaSigns signs_of(const Outline& o, int64_t step, bool may_be_zero);

}  // namespace ref
