// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The choices of the software device as words: "ties=top-right,fused=yes".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rasterizers/software/choice/device.hpp"

namespace software {

// One field of Device with the values that it may have, in the order of its enumeration.
struct Choice {
    std::string_view key;  // "half-toward-zero"
    std::vector<std::string_view> values;
    void (*set)(Device& device, size_t value);
};
// Every field of Device but the fault and the displaced places, which no specification leaves free.
const std::vector<Choice>& all_choices();

// Sets the choices that a text names, "key=value" separated by commas. Returns what is wrong with
// the text, one sentence that says what there is, or "".
std::string set_choices(Device& device, std::string_view text);

}  // namespace software
