// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables [[draw.attribute]].
#pragma once

#include <vector>

#include "cases/generate/vertices.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// What attributes are computed from: the vertices after mirror, rotate and offset.
struct AttributeSource {
    const std::vector<ExactVertex>& vertices;
    Space space;
    const Viewport& viewport;
    Topology topology;
    bool indexed;
    const Target& target;
};

std::vector<Attribute> read_attributes(LeafContext& context, const TomlValue& value,
                                       const AttributeSource& source);

// "plane" expressions: x and y of the vertex in pixels, z and w of its clip-space position.
Names plane_names(LeafContext& context, const ExactVertex& vertex, const PixelPosition& at);
// False after a mistake: a matrix key has the name of one of these.
bool check_plane_keys(LeafContext& context, const SourceLocation& where);

}  // namespace cases
