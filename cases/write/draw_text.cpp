// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/draw_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "cases/base/float_bits.hpp"
#include "cases/load/color.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"
#include "cases/write/toml_text.hpp"
#include "cases/write/vertex_text.hpp"

namespace cases {

namespace {

std::string numbers(std::initializer_list<float> values) {
    std::vector<std::string> items;
    for (const float value : values) {
        items.push_back(number_toml(value, Reading::nearest));
    }
    return list_toml(items);
}

bool same_color(const glm::vec4& a, const glm::vec4& b) {
    return same_bits(a.r, b.r) && same_bits(a.g, b.g) && same_bits(a.b, b.b) && same_bits(a.a, b.a);
}

// Vertices and what belongs to them are read by triangles in a list without indices.
size_t group_of(const Draw& draw) {
    return draw.topology == Topology::triangle_list && !draw.indices ? 3 : 0;
}

// Components of each vertex from `first` on; if all vertices are alike, as `constant`.
void add_values(TableText& table, const std::vector<glm::vec4>& values, uint32_t first,
                uint32_t count, size_t group) {
    std::vector<std::string> items;
    for (const glm::vec4& value : values) {
        std::vector<std::string> components;
        for (uint32_t k = first; k < std::min(first + count, 4U); ++k) {
            components.push_back(
                number_toml(value[static_cast<glm::vec4::length_type>(k)], Reading::nearest));
        }
        items.push_back(components.size() == 1 ? components[0] : list_toml(components, ","));
    }
    const bool is_constant =
        !items.empty() &&
        std::adjacent_find(items.begin(), items.end(), std::not_equal_to<>()) == items.end();
    if (is_constant) {
        table.add("constant", items[0]);
    } else {
        table.add("values", array_toml(items, group));
    }
}

std::string indices_text(const Draw& draw) {
    std::vector<std::string> items;
    for (const uint32_t index : *draw.indices) {
        items.push_back(draw.primitive_restart && index == kRestartIndex ? "\"restart\""
                                                                         : std::to_string(index));
    }
    return array_toml(items, draw.topology == Topology::triangle_list ? 3 : 0);
}

void add_viewport(TableText& table, const Viewport& v, const Target& target) {
    const Viewport whole = {
        0, 0, static_cast<float>(target.width), static_cast<float>(target.height), 0, 1};
    const bool is_whole = same_bits(v.x, whole.x) && same_bits(v.y, whole.y) &&
                          same_bits(v.width, whole.width) && same_bits(v.height, whole.height);
    const std::string rect = numbers({v.x, v.y, v.width, v.height});
    if (same_bits(v.min_depth, whole.min_depth) && same_bits(v.max_depth, whole.max_depth)) {
        if (!is_whole) {
            table.add("viewport", rect);
        }
        return;
    }
    TableText viewport(kViewportKeys);
    if (!is_whole) {
        viewport.add("rect", rect);
    }
    viewport.add("depth", numbers({v.min_depth, v.max_depth}));
    table.add("viewport", viewport);
}

void add_scissor(TableText& table, const Rect& s, const Target& target) {
    if (s.x != 0 || s.y != 0 || s.width != target.width || s.height != target.height) {
        table.add("scissor", fmt::format("[{}, {}, {}, {}]", s.x, s.y, s.width, s.height));
    }
}

void add_depth(TableText& table, const DepthState& depth) {
    TableText inner(kDepthKeys);
    inner.add_all(depth);
    if (depth.bias) {
        TableText bias(kBiasKeys);
        bias.add_all(*depth.bias);
        if (bias.is_empty()) {
            bias.add("constant", "0");  // enabled, and of no effect
        }
        inner.add("bias", bias);
    }
    if (depth.bounds) {
        inner.add("bounds", numbers({depth.bounds->min, depth.bounds->max}));
    }
    if (!inner.is_empty()) {
        table.add("depth", inner);
    }
    table.add_all(depth);
}

TableText frag_depth_text(const FragDepth& d) {
    TableText table(kFragDepthKeys);
    table.add_all(d);
    if (d.is_coord) {
        table.add("from", string_toml("frag-coord"));
    } else {
        table.add("value", number_toml(d.value, Reading::nearest));
    }
    if (d.where != Discard::none) {
        table.add("other", number_toml(d.other, Reading::nearest));
    }
    return table;
}

TableText face_text(const StencilFace& face) {
    TableText table(kStencilFaceKeys);
    table.add_all(face);
    if (table.is_empty()) {
        table.add("pass", string_toml(word_of(face.pass)));  // a state of its own all the same
    }
    return table;
}

void add_stencil(TableText& table, const StencilState& state) {
    if (state == StencilState{}) {
        return;
    }
    if (state.front == state.back) {
        table.add("stencil", face_text(state.front));
        return;
    }
    TableText faces(kStencilKeys);
    faces.add("front", face_text(state.front));
    faces.add("back", face_text(state.back));
    table.add("stencil", faces);
}

TableText equation_text(const BlendEquation& equation, const KeyTable& keys) {
    TableText table(keys);
    table.add_all(equation);
    if (table.is_empty()) {
        table.add("source", string_toml(word_of(equation.source)));
    }
    return table;
}

std::string blend_text(const Blend& blend) {
    for (size_t k = 1; k < kBlendWords.size(); ++k) {
        const Blend named = blend_of_word(k);
        if (named.color == blend.color && named.alpha == blend.alpha) {
            return string_toml(kBlendWords.at(k));
        }
    }
    TableText table = equation_text(blend.color, kBlendKeys);
    if (!(blend.alpha == blend.color)) {
        table.add("alpha", equation_text(blend.alpha, kBlendAlphaKeys));
    }
    return table.in_line();
}

std::string color_output_text(const Draw& draw, const ColorOutput& color) {
    TableText table(kColorKeys);
    table.add_all(color);
    if (color.attribute >= 0 && static_cast<size_t>(color.attribute) < draw.attributes.size()) {
        table.add("attribute",
                  string_toml(draw.attributes[static_cast<size_t>(color.attribute)].name));
    } else {
        table.add("value", color_text(color.value));
    }
    if (color.blend) {
        table.add("blend", blend_text(*color.blend));
        if (!same_color(color.blend->constants, Blend().constants)) {
            table.add("constants", color_text(color.blend->constants));
        }
        if (takes_second(*color.blend)) {
            table.add("second", color_text(color.blend->second));
        }
    }
    if (color.write_mask != ColorOutput().write_mask) {
        std::string letters;
        for (size_t k = 0; k < 4; ++k) {
            if ((static_cast<unsigned>(color.write_mask) >> k & 1U) != 0) {
                letters += std::string_view("rgba")[k];
            }
        }
        table.add("write_mask", string_toml(letters));
    }
    return table.in_line();
}

// A table, or a list of them in the order of the locations.
std::string colors_text(const Draw& draw, const Target& target) {
    if (target.other_colors.empty()) {
        return color_output_text(draw, draw.color);
    }
    std::vector<std::string> tables;
    for (uint32_t k = 0; k < target.color_count(); ++k) {
        tables.push_back(color_output_text(draw, output_at(target, draw, k)));
    }
    return list_toml(tables);
}

// The tables of clip or cull distances.
std::string distances_text(const char* name, const std::vector<glm::vec4>& distances,
                           uint32_t count, size_t group) {
    std::string out;
    for (uint32_t k = 0; k < std::min(count, 4U); ++k) {
        TableText table(kDistanceKeys);
        add_values(table, distances, k, 1, group);
        out += fmt::format("[[draw.{}]]\n{}", name, table.lines());
    }
    return out;
}

std::string attribute_text(const Attribute& attribute, size_t index, size_t group) {
    TableText table(kAttributeKeys);
    table.add_all(attribute);
    if (attribute.name != fmt::format("attribute{}", index)) {
        table.add("name", string_toml(attribute.name));
    }
    if (attribute.source == Source::vertex) {
        add_values(table, attribute.values, 0, attribute.components, group);
    }
    if (attribute.probe == Probe::at_sample) {
        table.add("sample", std::to_string(attribute.probe_sample));
    }
    if (attribute.probe == Probe::at_offset) {
        table.add("offset", numbers({attribute.probe_offset[0], attribute.probe_offset[1]}));
    }
    if (attribute.probe == Probe::lod) {
        table.add("texture",
                  fmt::format("[{}, {}]", attribute.texture_size[0], attribute.texture_size[1]));
    }
    return "[[draw.attribute]]\n" + table.lines();
}

}  // namespace

std::string color_text(const glm::vec4& color) {
    return numbers({color.r, color.g, color.b, color.a});
}

std::string draw_text(const Draw& draw, const Target& target) {
    const size_t group = group_of(draw);
    TableText table(kDrawKeys);
    table.add_all(draw);
    const VertexText vertices = vertex_text(draw);
    if (!vertices.is_pixels) {
        table.add("space", string_toml("clip"));
    }
    table.add("vertices", array_toml(vertices.vertices, group));
    if (draw.indices) {
        table.add("indices", indices_text(draw));
    }
    add_viewport(table, draw.viewport, target);
    add_scissor(table, draw.scissor, target);
    if (draw.fragment_size != Draw().fragment_size) {
        table.add("fragment_size",
                  fmt::format("[{}, {}]", draw.fragment_size[0], draw.fragment_size[1]));
    }
    if (discards_by_value(draw) && draw.discard_attribute != 0) {
        table.add("discard_attribute",
                  string_toml(draw.attributes.at(draw.discard_attribute).name));
    }
    if (draw.frag_depth) {
        table.add("frag_depth", frag_depth_text(*draw.frag_depth));
    }
    add_depth(table, draw.depth);
    add_stencil(table, draw.stencil);
    if (target.color) {
        table.add("color", colors_text(draw, target));
    }
    std::string out = "[[draw]]\n" + table.lines();
    const ClipDistances& d = draw.distances;
    out += distances_text("clip_distance", d.clip, d.clip_count, group);
    out += distances_text("cull_distance", d.cull, d.cull_count, group);
    for (size_t i = 0; i < draw.attributes.size(); ++i) {
        out += attribute_text(draw.attributes[i], i, group);
    }
    return out;
}

}  // namespace cases
