// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A datasheet as JSON, schema docs/schema/probe-1.json.
#pragma once

#include <string>
#include <string_view>

#include "cases/base/error.hpp"
#include "probe/base/datasheet.hpp"

namespace probe {

std::string to_json(const Datasheet& sheet);

// Error: one sentence that says what is wrong with the text.
cases::Expected<Datasheet> from_json(std::string_view text);

}  // namespace probe
