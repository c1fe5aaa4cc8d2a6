// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Two datasheets side by side.
#pragma once

#include <string>
#include <vector>

#include "probe/base/datasheet.hpp"

namespace probe {

struct Difference {
    std::string id, question;
    std::string a, b;  // the answers; "not asked" where a datasheet lacks the property
    friend bool operator==(const Difference&, const Difference&) = default;
};
// The properties that have other answers, in the order of the datasheets. Measured figures are not
// compared: they differ with every driver.
std::vector<Difference> differences(const Datasheet& a, const Datasheet& b);

// For a terminal. Each is told with where it comes from, a file or a device as it was asked for.
std::string comparison_text(const Datasheet& a, const Datasheet& b, const std::string& from_a,
                            const std::string& from_b);

}  // namespace probe
