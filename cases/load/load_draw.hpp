// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// One [[draw]] table. `number` counts from 1 and stands in notes. Mistakes go to the context; the
// result is then meaningless.
Draw load_draw(LeafContext& context, const TomlValue& table, const Target& target, size_t number,
               std::vector<std::string>& notes);

}  // namespace cases
