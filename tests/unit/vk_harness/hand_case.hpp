// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases written by hand in pixels, and the device that the tests draw them on.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "vk_harness/public/harness.hpp"

namespace vk_harness::testing {

// A position in a target of width x height pixels, depth z, as clip coordinates. Exact if the size
// is a power of two and x, y, w are short.
inline glm::vec4 at(const cases::Target& target, float x, float y, float z = 0.5F, float w = 1.0F) {
    const float half_width = static_cast<float>(target.width) / 2.0F;
    const float half_height = static_cast<float>(target.height) / 2.0F;
    return {(x - half_width) / half_width * w, (y - half_height) / half_height * w, z * w, w};
}

// One draw that covers the whole target with viewport and scissor.
inline cases::Draw make_draw(const cases::Target& target, std::span<const glm::vec2> pixels) {
    cases::Draw draw;
    for (const glm::vec2& p : pixels) {
        draw.positions.push_back(at(target, p.x, p.y));
    }
    draw.viewport = {0, 0, static_cast<float>(target.width), static_cast<float>(target.height),
                     0, 1};
    draw.scissor = {0, 0, target.width, target.height};
    return draw;
}

inline cases::Case make_case(const cases::Target& target, std::vector<glm::vec2> pixels) {
    cases::Case c;
    c.id = "hand";
    c.target = target;
    c.draws.push_back(make_draw(target, pixels));
    return c;
}

// 136 pixels by the top-left rule; x right, y down, so the vertices go clockwise.
inline std::vector<glm::vec2> half_square() {
    return {{4.5F, 4.5F}, {20.5F, 4.5F}, {4.5F, 20.5F}};
}

// The device of the environment (VK_DRIVER_FILES); its absence fails the test.
capture::Renderer& renderer();
// Draws without reading anything back.
std::vector<Rendered> render_bare(capture::Renderer& renderer, std::span<const cases::Case> batch);
capture::Capture draw(const cases::Case& c);
std::vector<capture::Capture> draw_all(const std::vector<cases::Case>& batch);

// Counts over all samples.
struct Count {
    uint64_t front = 0, back = 0, clear = 0, inconsistent = 0, not_copied = 0;
};
Count count(const capture::Capture& capture);

// Index of pixel (x,y) in a target with one sample.
inline size_t index(const capture::Capture& capture, uint32_t x, uint32_t y) {
    return size_t{y} * capture.target.width + x;
}

}  // namespace vk_harness::testing
