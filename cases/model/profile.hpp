// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace cases {

// What a device is held to (docs/design.md, "Three profiles"), loosest first: what breaks a profile
// breaks every later one.
enum class Profile : uint8_t {
    vulkan,    // only what the Vulkan text forbids
    practice,  // plus: floor/ceil snapping to the subpixel grid, binary32-like arithmetic
    direct3d,  // plus: round-to-nearest snapping, the top-left rule, exact evaluation positions
};
inline constexpr Profile kProfiles[] = {Profile::vulkan, Profile::practice, Profile::direct3d};

std::string_view to_string(Profile profile);
std::optional<Profile> parse_profile(std::string_view name);

}  // namespace cases
