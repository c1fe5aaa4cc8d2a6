// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Queries around the draws of a case, of occlusion and of pipeline statistics. The latter are asked
// where a case is drawn as it is: through a door a draw may be other vertices.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"

namespace vk_harness {

// The queries of one case, one a draw. Those of draws that ask for none are not used.
class Queries {
  public:
    // Keeps references.
    Queries(const Device& device, const cases::Case& c);

    // Outside of a rendering, before its first query.
    void reset(VkCommandBuffer commands) const;
    // Around the draw's commands, where it asks for a query; clears and loads lie outside, since
    // they "may count towards the results of queries" (Vulkan specification, "Query Operation").
    void begin(VkCommandBuffer commands, uint32_t draw) const;
    void end(VkCommandBuffer commands, uint32_t draw) const;

    // What was counted (capture::Planes::counted), when the commands have been submitted.
    std::vector<uint64_t> read() const;

  private:
    bool is_asked(cases::Query query) const;
    VkQueryPool pool_of(cases::Query query) const;
    const Device* device_;
    const cases::Case* case_;
    std::map<VkQueryPipelineStatisticFlags, Handle<VkQueryPool>> pools_;  // 0: occlusion
};

}  // namespace vk_harness
