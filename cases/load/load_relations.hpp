// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Loads the key `relations` of a case file.
#pragma once

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// Reads the relations of a case whose target and draws have been read.
std::vector<Relation> load_relations(LeafContext& context, const TomlValue& value, const Case& c);

}  // namespace cases
