// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers that a table gives the vertices of a draw: written out, constant, or a plane.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cases/generate/vertices.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// The vertices after mirror, rotate and offset, from which values are computed.
struct AttributeSource {
    const std::vector<ExactVertex>& vertices;
    Space space;
    const Viewport& viewport;
    Topology topology;
    bool indexed;
    const Target& target;
    const Draw& draw;  // its instances
};

// The numbers that are allowed.
struct ValueRule {
    std::string what;     // "an attribute", in errors
    bool is_one = false;  // one finite number a vertex; else one to four, nan and inf among them
    std::string instead;  // the end of the error about a vertex that has no x and y
    // Nothing, or the error about a number and the binary32 that it becomes.
    std::function<std::string(const Number&, float)> refusal;
};

// Each reading returns false after a mistake, which goes to the context.
class VertexValues {
  public:
    VertexValues(LeafContext& context, const AttributeSource& source, ValueRule rule)
        : all(source.vertices.size(), glm::vec4(0.0F)),
          context_(context),
          source_(source),
          rule_(std::move(rule)) {}

    // An entry a vertex, or one for all.
    bool read_values(const TomlValue& value, bool is_constant);
    // Each component is an expression in x and y of the vertex in pixels, z and w of its clip-space
    // position.
    bool read_plane(const TomlValue& value);
    bool store(size_t vertex, size_t component, const Number& n, const SourceLocation& where);

    std::vector<glm::vec4> all;
    std::string_view entries = "vertices";  // what there is one for each of, in errors
    uint32_t components = 1;

  private:
    bool count_components(const TomlValue& value, uint32_t& count);
    const TomlValue& component(const TomlValue& value, size_t i) const;

    LeafContext& context_;
    const AttributeSource& source_;
    ValueRule rule_;
};

}  // namespace cases
