// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The case that no file has and nothing is drawn of: what the device says of its limits.
#pragma once

#include "capture/renderer.hpp"
#include "report/record/run.hpp"

namespace run {

// The record of cases::kLimitsCase: a finding at profile vulkan for each limit that is not as
// Vulkan requires it, or unsupported if what draws has no Vulkan.
report::CaseRecord judge_limits(const capture::DeviceInfo& device);

}  // namespace run
