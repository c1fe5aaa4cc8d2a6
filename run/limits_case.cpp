// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/limits_case.hpp"

#include <fmt/format.h>

#include "cases/model/device.hpp"
#include "cases/model/rule_ids.hpp"

namespace run {

report::CaseRecord judge_limits(const capture::DeviceInfo& device) {
    diff::Verdict verdict;
    for (const capture::WrongLimit& limit : device.wrong_limits) {
        diff::Finding finding = diff::finding_of_case(diff::FindingKind::value);
        finding.rule = cases::rule::device_limits;
        finding.level = cases::Profile::vulkan;
        finding.quantity = limit.name;
        finding.expected = limit.required;
        finding.got = limit.claimed;
        finding.why = "Vulkan requires it " + limit.of;
        if (limit.name == "subPixelPrecisionBits") {
            finding.why += fmt::format("; every case is judged as if the device had {} bits",
                                       cases::kLeastSubpixelBits);
        }
        verdict.add(std::move(finding), cases::Target());
    }
    report::CaseRecord record;
    record.outcome = diff::Outcome(verdict);
    record.outcome.wrong_samples = 0;  // nothing was drawn
    record.id = cases::kLimitsCase;
    record.description = "The device's limits are what Vulkan requires.";
    record.rules = {cases::rule::device_limits};
    record.status = verdict.ok() ? report::Status::pass : report::Status::fail;
    if (device.api_version.empty()) {
        record.status = report::Status::unsupported;
        record.reason = "what draws here has no Vulkan, and so no limits of it";
    }
    return record;
}

}  // namespace run
