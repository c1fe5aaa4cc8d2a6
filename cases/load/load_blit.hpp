// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// The table [blit] of a case whose target has been read: a colour target alone.
std::optional<Blit> load_blit(LeafContext& context, const TomlValue& table, const Target& target);

}  // namespace cases
