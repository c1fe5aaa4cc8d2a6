// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of depths and stencils: what a device has stored, and what the reference has there.
#pragma once

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "report/record/run.hpp"
#include "run/picture.hpp"

namespace run {

// Adds both, in one scale from the least depth to the greatest. The reference's, which take time,
// only if a finding is about a depth: they are the middle of what is accepted of the fragments
// whose depth may be stored; none where a sample is free, or where nothing is promised.
void add_depths(report::Pictures& pictures, const PictureWindow& window, const cases::Case& c,
                const diff::Verdict& verdict, const ref::Expectation& expectation,
                const capture::CaptureView& capture);

// The same of the stencil, if a finding is about it; the reference's is none where several are
// right.
void add_stencils(report::Pictures& pictures, const PictureWindow& window, const cases::Case& c,
                  const diff::Verdict& verdict, const ref::Expectation& expectation,
                  const capture::CaptureView& capture);

}  // namespace run
