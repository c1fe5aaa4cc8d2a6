// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/profile.hpp"

namespace cases {

std::string_view to_string(Profile profile) {
    switch (profile) {
        case Profile::vulkan:
            return "vulkan";
        case Profile::practice:
            return "practice";
        case Profile::direct3d:
            return "direct3d";
    }
    return "";
}

std::optional<Profile> parse_profile(std::string_view name) {
    for (const Profile profile : kProfiles) {
        if (to_string(profile) == name) {
            return profile;
        }
    }
    return std::nullopt;
}

}  // namespace cases
