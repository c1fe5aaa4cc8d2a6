// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a rendering as a whole and belongs to no sample: memory beside its attachments
// (rule write.outside), numbers of its queries (query.occlusion, query.statistics).
#pragma once

#include <functional>
#include <span>

#include "diff/attribution.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/counted.hpp"

namespace diff {

// Memory that has changed: adds one finding each to a verdict. Such a word belongs to no sample:
// the finding stands at the target's first sample if the memory lies before the attachment's, else
// at the last.
void add_stray_writes(const cases::Case& c, std::span<const capture::StrayWrite> writes,
                      Verdict& verdict);

// Adds one finding for each draw whose query is wrong. Such a number belongs to no sample: the
// finding stands at the first sample of the target. Where hits are wrong, as many may be counted
// as there are or ought to be, or fewer. `shown_at`: what the planes show, at a profile.
using ShownOf = std::function<ref::ShownAt(cases::Profile profile)>;
void judge_queries(const cases::Case& c, const capture::CaptureView& capture,
                   Attribution& attribution, const ShownOf& shown_at, Verdict& verdict);

}  // namespace diff
