// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The features that the harness uses where a device has them: one table says of each where
// Capabilities has it, in which structure it is asked about and enabled, and by which extension.
#pragma once

#include <memory>
#include <vector>

#include "vk_harness/device/capabilities.hpp"

namespace vk_harness {

// Asks the device for all of them, and for those that every device has to have. Its version, its
// limits and extensions without features (CoreSupport) are known.
void query_features(Capabilities& c);

// Those of them that a device has, as vkCreateDevice wants them.
class EnabledFeatures {
  public:
    explicit EnabledFeatures(const Capabilities& c);
    EnabledFeatures(const EnabledFeatures&) = delete;
    EnabledFeatures& operator=(const EnabledFeatures&) = delete;
    ~EnabledFeatures();

    const VkPhysicalDeviceFeatures2& chain() const;
    std::vector<const char*> extensions;

  private:
    struct Structures;
    struct Table;
    std::unique_ptr<Structures> structures_;
    friend void query_features(Capabilities& c);
};

}  // namespace vk_harness
