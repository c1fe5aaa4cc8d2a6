// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A device, one fragment after the other: the operations of Vulkan's chapter "Fragment Operations"
// in their order at one sample. What the text leaves open is asked for, so that the same code is a
// device (which answers at random) and the enumerator (which tries all answers, one by one).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cases/model/profile.hpp"
#include "scene.hpp"
#include "stored_color.hpp"

namespace histories {

// What is seen of a sample when all is drawn.
struct Seen {
    uint32_t front = 0, back = 0;
    int draw = -1, triangle = -1;   // that wrote last
    double z = 0, a = 0;            // its FragCoord.z, and attribute "a"
    double z_free = 0, a_free = 0;  // by how much the device's choice of a place may change them
    bool is_at_sample = false;      // its FragCoord
    double depth = 0;
    uint32_t stencil = 0;
    Codes color{};
    bool is_color_large = false;  // it was once, so that formats with less range have another one
    std::array<uint32_t, kMaxDraws> counted{};  // fragments of each draw that pass all tests
};

// Answers with a number below `count`.
using Pick = std::function<uint32_t(uint32_t count)>;

// What a device may do.
struct Freedom {
    cases::Profile profile = cases::Profile::direct3d;
    // A device has depths, which all comparisons see; what is enumerated has any outcome where two
    // depths are so near that somebody may compute them to lie in another order.
    bool is_device = false;
    uint64_t seed = 0;  // of the device's depths
};

// A fault: what one draw of the scene gets wrong, always.
enum class Wrong : uint8_t {
    nothing,
    is_lost,
    depth_ignored,
    depth_reversed,
    depth_kept,
    bounds_ignored,
    stencil_ignored,
    stencil_kept,
    discard_ignored,
    discards_all,
    early_as_late,
    face_exchanged,
    cull_ignored,
    mask_ignored,
    blend_ignored,
    written_twice
};
inline constexpr int kWrongs = 16;
struct Fault {
    Wrong what = Wrong::nothing;
    size_t draw = 0;
};

// Which fragments of a pixel whose attribute's sign is open are kept, by draw and triangle.
using Kept = std::vector<std::vector<bool>>;

Seen draw_sample(const Scene& scene, const Place& place, const Freedom& freedom, const Kept& kept,
                 const Pick& pick, const Fault& fault = {});

// Whether one invocation decides for all samples of a pixel, of some draw or of this one.
bool is_shared(const Scene& scene, const Freedom& freedom);
bool is_shared(const Scene& scene, const Draw& draw, const Freedom& freedom);
// Whether the sign of attribute "a" is open at the sample.
bool is_sign_open(const Scene& scene, const Draw& draw, const Place& place, const Freedom& freedom);

}  // namespace histories
