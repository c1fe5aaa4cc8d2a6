// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case whose attachments are large: read back piece by piece, so that it takes the memory of its
// images or of its capture, not of both and a copy.
#pragma once

#include <functional>
#include <string_view>

#include "vk_harness/commands/submission.hpp"

namespace vk_harness {

// Whether a case is so large that it is read back so, if it is drawn alone.
bool is_large(const CasePlan& plan);

// Reads attachments back that were drawn, by rows and one after another (`step` tells of each), and
// frees each behind that unless `keeps_images`. `alignment`: of places in the read-back buffer.
void read_by_rows(const Device& device, Submission& submission, TargetCache& targets,
                  const CasePlan& plan, VkDeviceSize alignment, bool keeps_images,
                  const std::function<void(std::string_view)>& step,
                  const capture::PlaneSpans& planes);

}  // namespace vk_harness
