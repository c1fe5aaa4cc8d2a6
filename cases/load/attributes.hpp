// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables [[draw.attribute]].
#pragma once

#include <vector>

#include "cases/load/vertex_values.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

std::vector<Attribute> read_attributes(LeafContext& context, const TomlValue& value,
                                       const AttributeSource& source);

}  // namespace cases
