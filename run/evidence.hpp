// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is kept of a judged case so that a reader can check it by hand: pictures, the triangles over
// them, and the values at wrong samples.
#pragma once

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/position/limits.hpp"
#include "report/record/run.hpp"

namespace run {

// Fills reference and geometry of the record of a case that passes.
void keep_reference(report::CaseRecord& record, const cases::Case& c, const diff::Verdict& verdict,
                    const ref::Expectation& expectation, const ref::Limits& limits);

// Fills pictures, geometry and evidence of the record of a case with draws or a blit; of planes
// that the capture lacks nothing is kept. `expectation` is empty for a blit.
void keep_evidence(report::CaseRecord& record, const cases::Case& c, const diff::Verdict& verdict,
                   const ref::Expectation& expectation, const capture::CaptureView& capture,
                   const ref::Limits& limits);

}  // namespace run
