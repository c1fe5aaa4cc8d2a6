// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory beside an attachment that a rendering has changed (rule write.outside).
#pragma once

#include <span>

#include "diff/verdict.hpp"

namespace diff {

// Adds one finding each to a verdict. Such a word belongs to no sample: the finding stands at the
// target's first sample if the memory lies before the attachment's, else at the last.
void add_stray_writes(const cases::Case& c, std::span<const capture::StrayWrite> writes,
                      Verdict& verdict);

}  // namespace diff
