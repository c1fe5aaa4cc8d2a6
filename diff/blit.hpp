// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares a blitted image with the reference, texel by texel.
#pragma once

#include "diff/verdict.hpp"

namespace diff {

// Judges the colour plane of a capture of a case with a blit. A texel inside the destination region
// counts as hit if it does not hold the clear value any more.
Verdict compare_blit(const cases::Case& c, cases::Profile profile,
                     const capture::CaptureView& capture);

}  // namespace diff
