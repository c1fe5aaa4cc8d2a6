// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The rules a device is held to. docs/rules.md is generated from this table.
#pragma once

#include <span>
#include <string_view>

#include "cases/model/profile.hpp"

namespace cases {

struct Rule {
    std::string_view id;      // "cover.inside"
    Profile profile;          // the loosest profile at which breaking it is a finding
    std::string_view title;   // one line, as a report shows it
    std::string_view text;    // what is demanded and what is left free, in a few sentences
    std::string_view anchor;  // the Vulkan specification's HTML anchor; may be empty
    std::string_view
        direct3d;           // section of the Direct3D 11.3 functional specification; may be empty
    std::string_view code;  // the reference code that decides it
};

// All rules, in the order of docs/rules.md.
std::span<const Rule> all_rules();
// Whether the rule is of the device by itself (kLimitsCase), so that no case can claim it, and no
// sample exercises it.
bool is_of_device(std::string_view id);
// The rule of that id, or nothing.
const Rule* find_rule(std::string_view id);

}  // namespace cases
