// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From a case and what was drawn of it to the record that the reports show.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/consistency.hpp"
#include "diff/delivered.hpp"
#include "ref/position/limits.hpp"
#include "report/record/run.hpp"

namespace run {

// What is kept of a judged case; with `symptoms` and `brief` (diff::Wanted) no pictures, and
// neither how often a rule is broken at which level nor by how much.
enum class KeepPictures { symptoms, brief, none, failed, all };

// What is known of a case before it has run: what the file says of it.
report::PlannedCase planned_case(const cases::Case& c);

// What a worker has found besides the capture: in comparing the case's derived renderings with it,
// one result a derivation, and beside the attachments' memory.
struct WorkerFindings {
    std::span<const diff::Consistency> consistency;
    std::span<const capture::StrayWrite> stray_writes;
};

// Judges a capture, and what the worker has found besides, into `record`: pass, fail, or error if
// the case or the capture cannot be judged.
void judge(report::CaseRecord& record, const cases::Case& c, const capture::CaptureView& capture,
           const WorkerFindings& found, const ref::Limits& limits, cases::Profile profile,
           KeepPictures pictures);

// What becomes of a drawn case: a status, and what else its record is to hold. Called on any
// thread.
using Judge = std::function<void(report::CaseRecord&, const cases::Case&,
                                 const capture::CaptureView&, const WorkerFindings&)>;

// The same of what another program delivered: at least one plane, sizes as the case's target.
void judge_delivered(report::CaseRecord& record, const cases::Case& c,
                     const capture::Delivered& planes, const ref::Limits& limits,
                     cases::Profile profile, KeepPictures pictures);

// What --require-support makes of a record: a case that is not supported fails.
void require_support(report::CaseRecord& record);

// What can be said of a case before any device is asked: empty, or why the reference disagrees with
// the picture drawn by hand.
std::string check_before_running(const cases::Case& c);

}  // namespace run
