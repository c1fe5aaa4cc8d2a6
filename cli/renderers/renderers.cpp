// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/renderers/renderers.hpp"

#include "rasterizers/algorithms/device.hpp"
#include "rasterizers/renderer/renderers.hpp"
#include "vk_harness/public/harness.hpp"

namespace cli {

capture::RendererKinds all_renderers() {
    static const std::vector<capture::RendererKind> kKinds = [] {
        std::vector<capture::RendererKind> kinds = {
            {.name = "vulkan",
             .help = "a driver",
             .make = vk_harness::make_renderer,
             .list = vk_harness::list_devices,
             .find_drivers = vk_harness::find_drivers,
             .needs = vk_harness::needs_of},
            {.name = "reference",
             .help = "what the reference expects",
             .make = rasterizers::reference_renderer},
            {.name = "software",
             .help = "software:KEY=VALUE,..., the software rasterizer with such choices",
             .make = rasterizers::software_renderer,
             .wrong_choices = rasterizers::wrong_choices},
        };
        for (const rasterizers::Device& device : rasterizers::all_devices()) {
            kinds.push_back({.name = device.name,
                             .help = device.description,
                             .make = rasterizers::algorithm_renderer});
        }
        return kinds;
    }();
    return kKinds;
}

const capture::RendererKind& renderer_of(const capture::RendererOptions& options) {
    return *capture::find_renderer(all_renderers(), options.renderer);
}

capture::Installed find_drivers(const capture::RendererOptions& options) {
    const capture::RendererKind& kind = renderer_of(options);
    return kind.find_drivers != nullptr ? kind.find_drivers(options) : capture::Installed();
}

}  // namespace cli
