// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/vertex_values.hpp"

#include <fmt/format.h>

namespace cases {

bool VertexValues::store(size_t vertex, size_t component, const Number& n,
                         const SourceLocation& where) {
    const float value = round_to_binary32(n).value;
    if (std::string refusal = rule_.refusal(n, value); !refusal.empty()) {
        context_.error(where, std::move(refusal));
        return false;
    }
    all[vertex][static_cast<glm::vec4::length_type>(component)] = value;
    return true;
}

// Of one vertex: a number or an array of 1 to 4.
bool VertexValues::count_components(const TomlValue& value, uint32_t& count) {
    const bool is_array = value.is(TomlValue::Kind::array) && !rule_.is_one;
    if (is_array && (value.array.empty() || value.array.size() > 4)) {
        context_.error(value.where,
                       fmt::format("{} components are given; write 1 to 4", value.array.size()));
        return false;
    }
    count = is_array ? static_cast<uint32_t>(value.array.size()) : 1;
    return true;
}

const TomlValue& VertexValues::component(const TomlValue& value, size_t i) const {
    return value.is(TomlValue::Kind::array) && !rule_.is_one ? value.array[i] : value;
}

bool VertexValues::read_values(const TomlValue& value, bool is_constant) {
    if (!is_constant && !context_.array(value, "values")) {
        return false;
    }
    if (!is_constant && value.array.size() != all.size()) {
        context_.error(value.where, fmt::format("values has {} entries for {} {}",
                                                value.array.size(), all.size(), entries));
        return false;
    }
    for (size_t v = 0; v < all.size(); ++v) {
        const TomlValue& one = is_constant ? value : value.array[v];
        uint32_t count = 0;
        if (!count_components(one, count)) {
            return false;
        }
        components = v == 0 ? count : components;
        if (count != components) {
            context_.error(one.where,
                           fmt::format("entry {} of values has {} components, the first has {}; "
                                       "write the same number everywhere",
                                       v, count, components));
            return false;
        }
        for (size_t i = 0; i < components; ++i) {
            const TomlValue& element = component(one, i);
            const std::optional<Number> n = rule_.is_one
                                                ? context_.number(element, rule_.what)
                                                : context_.any_binary32(element, rule_.what);
            if (!n || !store(v, i, *n, element.where)) {
                return false;
            }
        }
    }
    return true;
}

bool VertexValues::read_plane(const TomlValue& value) {
    if (!count_components(value, components)) {
        return false;
    }
    for (const auto& [key, parameter] : context_.parameters()) {
        if (key == "x" || key == "y" || key == "z" || key == "w") {
            context_.error(value.where,
                           fmt::format("plane cannot tell the matrix key {} from the vertex's "
                                       "own {}; rename the key",
                                       key, key));
            return false;
        }
    }
    for (size_t v = 0; v < all.size(); ++v) {
        const ExactVertex& vertex = source_.vertices[v];
        const std::optional<PixelPosition> at =
            pixel_position(vertex, source_.space, source_.viewport);
        if (!at) {
            context_.error(value.where,
                           fmt::format("plane has no x and y at vertex {}, whose {}{}", v,
                                       is_finite(vertex) ? "w is 0" : "position is not finite",
                                       rule_.instead));
            return false;
        }
        const Names names = context_.names({{"x", {at->x, false}},
                                            {"y", {at->y, false}},
                                            {"z", vertex.xyzw[2]},
                                            {"w", vertex.xyzw[3]}});
        for (size_t i = 0; i < components; ++i) {
            const TomlValue& element = component(value, i);
            const std::optional<Number> n = context_.number(element, "plane", names);
            if (!n || !store(v, i, *n, element.where)) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace cases
