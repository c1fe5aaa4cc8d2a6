// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/own_samples.hpp"

#include <cmath>
#include <optional>

namespace vk_harness {

namespace {

constexpr uint32_t kSide = 8;  // pixels: locations may differ from pixel to pixel

// A triangle over all samples, whose one attribute is gl_SamplePosition.
cases::Case asking_case(uint32_t samples) {
    cases::Case c;
    c.id = "sample locations";
    c.target.width = c.target.height = kSide;
    c.target.samples = samples;
    c.target.has_depth = false;
    cases::Draw& draw = c.draws.emplace_back();
    draw.positions = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    draw.viewport = {0, 0, kSide, kSide};
    draw.scissor = {0, 0, kSide, kSide};
    cases::Attribute& position = draw.attributes.emplace_back();
    position.name = "position";
    position.source = cases::Source::sample_position;
    position.components = 2;
    return c;
}

std::optional<uint8_t> sixteenths(float at) {
    const float number = at * 16;
    if (!(number >= 0 && number <= 15) || std::fmod(number, 1.0F) > 0) {
        return std::nullopt;
    }
    return static_cast<uint8_t>(number);
}

}  // namespace

cases::SampleLocations told_locations(std::span<const glm::vec4> positions, uint32_t samples) {
    cases::SampleLocations told;
    for (size_t k = 0; k < positions.size(); ++k) {
        const std::optional<uint8_t> x = sixteenths(positions[k].x);
        const std::optional<uint8_t> y = sixteenths(positions[k].y);
        if (!x || !y) {
            return {};
        }
        const std::array<uint8_t, 2> at{*x, *y};
        if (k < samples) {
            told.push_back(at);
        } else if (told[k % samples] != at) {
            return {};
        }
    }
    return told;
}

void ask_sample_locations(BatchRenderer& renderer) {
    Device& device = renderer.device();
    const Capabilities& c = device.capabilities();
    if (c.has_standard_locations || !c.has_sample_shading) {
        return;
    }
    std::vector<cases::SampleLocations> told;
    std::string error;
    for (uint32_t samples = 2; samples <= 16; samples *= 2) {
        // So that the case is drawn: until the answer is there, the locations count as told.
        device.set_sample_locations({cases::SampleLocations(samples)});
        const cases::Case asking = asking_case(samples);
        const Rendered answer =
            renderer.render({&asking, 1}, true, [](std::string_view) {}, {}).front();
        if (answer.status == Rendered::Status::drawn) {
            cases::SampleLocations own = told_locations(answer.capture.attributes[0], samples);
            if (!own.empty()) {
                told.push_back(std::move(own));
            }
        } else if (answer.status != Rendered::Status::unsupported) {
            error = "the device cannot be asked where its samples are: " + answer.reason;
        }
    }
    device.set_sample_locations(std::move(told), std::move(error));
}

}  // namespace vk_harness
