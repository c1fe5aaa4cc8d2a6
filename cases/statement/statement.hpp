// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What Vulkan and Direct3D 11 say about drawing triangles, statement by statement, with the freedom
// they leave, and which rules (rule.hpp) hold a device to it. docs/rules.md shows the table.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "cases/model/profile.hpp"

namespace cases {

// How strictly a specification speaks.
enum class Strictness : uint8_t {
    exact,       // one answer a sample
    tolerance,   // a bound that the text states
    free,        // implementation-dependent: several answers are legal
    undefined,   // any value, but no harm to anything else
    contrary,    // the text contradicts itself or is silent: never a finding at its profile
    not_spoken,  // this specification does not speak of it
};

struct Statement {
    std::string_view topic;  // what it is about
    Strictness vulkan;
    Strictness direct3d;
    std::string_view judged;  // how a device is judged by it, and what it is never judged by
    // Ids of the rules that judge it; unused ones are empty.
    std::array<std::string_view, 6> rules;
    // If no rule judges it: why not.
    std::string_view reason;
    // The loosest profile at which breaking it is a finding, where that is not the loosest of its
    // rules': they judge other statements, too.
    std::optional<Profile> from = {};
};

// All statements by number.
std::span<const Statement> all_statements();
std::string_view to_string(Strictness strictness);

}  // namespace cases
