// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/renderer.hpp"

#include "vk_harness/own_samples.hpp"

namespace vk_harness {

VulkanRenderer::VulkanRenderer(const Options& options) : body_(options) {
    ask_sample_locations(body_);
}

std::string VulkanRenderer::lacking(const cases::Case& c) const {
    const auto rejection = check_renderings(body_.device().capabilities(), c);
    return rejection ? rejection->reason : std::string();
}

std::vector<Rendered> VulkanRenderer::render(std::span<const cases::Case> batch,
                                             capture::PlaneSet planes, const Step& step,
                                             const PlaneStore& store) {
    return body_.render(batch, planes.any(), step, store);
}

Result<std::unique_ptr<capture::Renderer>> make_renderer(const Options& options) {
    return attempt([&]() -> std::unique_ptr<capture::Renderer> {
        return std::make_unique<VulkanRenderer>(options);
    });
}

}  // namespace vk_harness
