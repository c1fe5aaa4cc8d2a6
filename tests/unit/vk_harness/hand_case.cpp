// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "hand_case.hpp"

#include <cstdlib>
#include <iostream>
#include <memory>

namespace vk_harness::testing {

capture::Renderer& renderer() {
    static const std::unique_ptr<capture::Renderer> shared = [] {
        auto made = make_renderer({});
        if (!made) {
            std::cerr << "these tests need a Vulkan 1.3 device: " << made.error().message << '\n';
            for (const std::string& reason : made.error().reasons) {
                std::cerr << "  " << reason << '\n';
            }
            std::exit(EXIT_FAILURE);
        }
        return std::move(*made);
    }();
    return *shared;
}

std::vector<Rendered> render_bare(capture::Renderer& renderer, std::span<const cases::Case> batch) {
    return renderer.render(batch, capture::PlaneSet(), [](std::string_view) {}, {});
}

std::vector<capture::Capture> draw_all(const std::vector<cases::Case>& batch) {
    std::vector<capture::Capture> captures;
    for (Rendered& rendered : renderer().render(batch)) {
        EXPECT_EQ(rendered.status, Rendered::Status::drawn) << rendered.reason;
        captures.push_back(std::move(rendered.capture));
    }
    return captures;
}

capture::Capture draw(const cases::Case& c) {
    return draw_all({c}).front();
}

Count count(const capture::Capture& capture) {
    Count result;
    for (size_t k = 0; k < capture.hits.size(); ++k) {
        switch (capture::sample_state(capture, k)) {
            case capture::SampleState::clear:
                ++result.clear;
                break;
            case capture::SampleState::drawn:
                result.front += static_cast<uint64_t>(capture.hits[k].x);
                result.back += static_cast<uint64_t>(capture.hits[k].y);
                break;
            case capture::SampleState::not_copied:
                ++result.not_copied;
                break;
            case capture::SampleState::depth_only:
            case capture::SampleState::inconsistent:
                ++result.inconsistent;
                break;
        }
    }
    return result;
}

}  // namespace vk_harness::testing
