// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The harness as a renderer.
#pragma once

#include "vk_harness/batch_renderer.hpp"

namespace vk_harness {

class VulkanRenderer : public capture::Renderer {
  public:
    // Throws Failure.
    explicit VulkanRenderer(const Options& options);
    const DeviceInfo& device() const override { return body_.device().capabilities().info; }
    std::string lacking(const cases::Case& c) const override;
    std::vector<Rendered> render(std::span<const cases::Case> batch, capture::PlaneSet planes,
                                 const Step& step, const PlaneStore& store) override;

  private:
    BatchRenderer body_;
};

}  // namespace vk_harness
