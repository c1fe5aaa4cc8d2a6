// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/draw_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "cases/base/float_bits.hpp"
#include "cases/load/color.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/instances.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"
#include "cases/write/table_tree.hpp"
#include "cases/write/vertex_tree.hpp"

namespace cases {

namespace {

TomlValue numbers(std::initializer_list<float> values) {
    std::vector<TomlValue> items;
    for (const float value : values) {
        items.push_back(number_value(value, Reading::nearest));
    }
    return tree::list(std::move(items));
}

// Components of each vertex from `first` on; if all vertices are alike, as `constant`.
void add_values(TableTree& table, const std::vector<glm::vec4>& values, uint32_t first,
                uint32_t count) {
    std::vector<TomlValue> items;
    bool is_constant = !values.empty();
    for (const glm::vec4& value : values) {
        std::vector<TomlValue> components;
        for (uint32_t k = first; k < std::min(first + count, 4U); ++k) {
            const auto at = static_cast<glm::vec4::length_type>(k);
            components.push_back(number_value(value[at], Reading::nearest));
            is_constant = is_constant && same_bits(value[at], values.front()[at]);
        }
        items.push_back(components.size() == 1 ? components[0] : tree::list(components));
    }
    if (is_constant) {
        table.add("constant", items[0]);
    } else {
        table.add("values", tree::list(std::move(items)));
    }
}

TomlValue indices_of(const Draw& draw) {
    std::vector<TomlValue> items;
    for (const uint32_t index : *draw.indices) {
        items.push_back(draw.primitive_restart && index == kRestartIndex ? tree::text("restart")
                                                                         : tree::number(index));
    }
    return tree::list(std::move(items));
}

void add_viewport(TableTree& table, const Viewport& v, const Target& target) {
    const Viewport whole = {
        0, 0, static_cast<float>(target.width), static_cast<float>(target.height), 0, 1};
    const bool is_whole = same_bits(v.x, whole.x) && same_bits(v.y, whole.y) &&
                          same_bits(v.width, whole.width) && same_bits(v.height, whole.height);
    const TomlValue rect = numbers({v.x, v.y, v.width, v.height});
    if (same_bits(v.min_depth, whole.min_depth) && same_bits(v.max_depth, whole.max_depth)) {
        if (!is_whole) {
            table.add("viewport", rect);
        }
        return;
    }
    TableTree viewport(kViewportKeys);
    if (!is_whole) {
        viewport.add("rect", rect);
    }
    viewport.add("depth", numbers({v.min_depth, v.max_depth}));
    table.add("viewport", viewport);
}

void add_scissor(TableTree& table, const Rect& s, const Target& target) {
    if (s.x != 0 || s.y != 0 || s.width != target.width || s.height != target.height) {
        table.add("scissor", whole_numbers({s.x, s.y, s.width, s.height}));
    }
}

void add_depth(TableTree& table, const DepthState& depth) {
    TableTree inner(kDepthKeys);
    inner.add_all(depth);
    if (depth.bias) {
        TableTree bias(kBiasKeys);
        bias.add_all(*depth.bias);
        if (bias.is_empty()) {
            bias.add("constant", tree::number(0));  // enabled, and of no effect
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

TableTree clear_tree(const Clear& clear, const Target& target) {
    TableTree table(kClearKeys);
    table.add_all(clear);
    if (clear.rects != std::vector{Rect{0, 0, target.width, target.height}}) {
        std::vector<TomlValue> rects;
        for (const Rect& r : clear.rects) {
            rects.push_back(whole_numbers({r.x, r.y, r.width, r.height}));
        }
        table.add("rects", tree::list(std::move(rects)));
    }
    if (clear.color) {
        table.add("color", color_value(*clear.color));
    }
    return table;
}

TableTree frag_depth_tree(const FragDepth& d) {
    TableTree table(kFragDepthKeys);
    table.add_all(d);
    if (d.is_coord) {
        table.add("from", tree::text("frag-coord"));
    } else {
        table.add("value", number_value(d.value, Reading::nearest));
    }
    if (d.where != Discard::none) {
        table.add("other", number_value(d.other, Reading::nearest));
    }
    return table;
}

TableTree face_tree(const StencilFace& face) {
    TableTree table(kStencilFaceKeys);
    table.add_all(face);
    if (table.is_empty()) {
        table.add("pass",
                  tree::text(word_of(face.pass)));  // a state of its own all the same
    }
    return table;
}

void add_stencil(TableTree& table, const StencilState& state) {
    if (state == StencilState{}) {
        return;
    }
    if (state.front == state.back) {
        table.add("stencil", face_tree(state.front));
        return;
    }
    TableTree faces(kStencilKeys);
    faces.add("front", face_tree(state.front));
    faces.add("back", face_tree(state.back));
    table.add("stencil", faces);
}

TableTree equation_tree(const BlendEquation& equation, const KeyTable& keys) {
    TableTree table(keys);
    table.add_all(equation);
    if (table.is_empty()) {
        table.add("source", tree::text(word_of(equation.source)));
    }
    return table;
}

TomlValue blend_value(const Blend& blend) {
    for (size_t k = 1; k < kBlendWords.size(); ++k) {
        const Blend named = blend_of_word(k);
        if (named.color == blend.color && named.alpha == blend.alpha) {
            return tree::text(kBlendWords.at(k));
        }
    }
    TableTree table = equation_tree(blend.color, kBlendKeys);
    if (!(blend.alpha == blend.color)) {
        table.add("alpha", equation_tree(blend.alpha, kBlendAlphaKeys));
    }
    return table.value();
}

TomlValue color_output_value(const Draw& draw, const ColorOutput& color) {
    TableTree table(kColorKeys);
    table.add_all(color);
    if (color.attribute >= 0 && static_cast<size_t>(color.attribute) < draw.attributes.size()) {
        table.add("attribute",
                  tree::text(draw.attributes[static_cast<size_t>(color.attribute)].name));
    } else {
        table.add("value", color_value(color.value));
    }
    if (color.blend) {
        table.add("blend", blend_value(*color.blend));
        if (!same_color(color.blend->constants, Blend().constants)) {
            table.add("constants", color_value(color.blend->constants));
        }
        if (takes_second(*color.blend)) {
            table.add("second", color_value(color.blend->second));
        }
    }
    if (color.write_mask != ColorOutput().write_mask) {
        std::string letters;
        for (size_t k = 0; k < 4; ++k) {
            if ((static_cast<unsigned>(color.write_mask) >> k & 1U) != 0) {
                letters += std::string_view("rgba")[k];
            }
        }
        table.add("write_mask", tree::text(letters));
    }
    return table.value();
}

// A table, or a list of them in the order of the locations.
TomlValue colors_value(const Draw& draw, const Target& target) {
    if (target.other_colors.empty()) {
        return color_output_value(draw, draw.color);
    }
    std::vector<TomlValue> tables;
    for (uint32_t k = 0; k < target.color_count(); ++k) {
        tables.push_back(color_output_value(draw, output_at(target, draw, k)));
    }
    return tree::list(std::move(tables));
}

// The tables of clip or cull distances.
void add_distances(TableTree& table, const char* name, const Draw& draw,
                   const std::vector<glm::vec4>& distances, uint32_t count) {
    std::vector<TomlValue> tables;
    for (uint32_t k = 0; k < std::min(count, 4U); ++k) {
        TableTree one(kDistanceKeys);
        add_values(one, elements_read(draw, distances, std::nullopt), k, 1);
        tables.push_back(one.value());
    }
    if (!tables.empty()) {
        table.add(name, tree::list(std::move(tables)));
    }
}

TomlValue attribute_tree(const Draw& draw, size_t index) {
    const Attribute& attribute = draw.attributes[index];
    TableTree table(kAttributeKeys);
    table.add_all(attribute);
    if (attribute.name != fmt::format("attribute{}", index)) {
        table.add("name", tree::text(attribute.name));
    }
    if (attribute.source == Source::vertex) {
        add_values(table, elements_read(draw, attribute.values, attribute.divisor), 0,
                   attribute.components);
    }
    if (attribute.probe == Probe::at_sample) {
        table.add("sample", tree::number(attribute.probe_sample));
    }
    if (attribute.probe == Probe::at_offset) {
        table.add("offset", numbers({attribute.probe_offset[0], attribute.probe_offset[1]}));
    }
    if (attribute.probe == Probe::lod) {
        table.add("texture", whole_numbers({attribute.texture_size[0], attribute.texture_size[1]}));
    }
    return table.value();
}

}  // namespace

bool same_color(const glm::vec4& a, const glm::vec4& b) {
    return same_bits(a.r, b.r) && same_bits(a.g, b.g) && same_bits(a.b, b.b) && same_bits(a.a, b.a);
}

TomlValue color_value(const glm::vec4& color) {
    return numbers({color.r, color.g, color.b, color.a});
}

TomlValue draw_tree(const Draw& draw, const Target& target) {
    TableTree table(kDrawKeys);
    if (draw.clear) {
        table.add("clear", clear_tree(*draw.clear, target));
        if (draw.layer != 0) {
            table.add("layer", tree::number(draw.layer));
        }
        return table.value();
    }
    table.add_all(draw);
    VertexTree vertices = vertex_tree(draw);
    if (!vertices.is_pixels) {
        table.add("space", tree::text("clip"));
    }
    table.add("vertices", tree::list(std::move(vertices.vertices)));
    if (draw.indices) {
        table.add("indices", indices_of(draw));
    }
    std::vector<TomlValue> offsets;
    for (const glm::vec4& offset : draw.offsets) {
        offsets.push_back(color_value(offset));
    }
    if (!offsets.empty()) {
        table.add("offsets", tree::list(std::move(offsets)));
    }
    add_viewport(table, draw.viewport, target);
    add_scissor(table, draw.scissor, target);
    if (draw.fragment_size != Draw().fragment_size) {
        table.add("fragment_size", whole_numbers({draw.fragment_size[0], draw.fragment_size[1]}));
    }
    if (discards_by_value(draw) && draw.discard_attribute != 0) {
        table.add("discard_attribute", tree::text(draw.attributes.at(draw.discard_attribute).name));
    }
    if (draw.frag_depth) {
        table.add("frag_depth", frag_depth_tree(*draw.frag_depth));
    }
    add_depth(table, draw.depth);
    add_stencil(table, draw.stencil);
    if (target.color) {
        table.add("color", colors_value(draw, target));
    }
    const ClipDistances& d = draw.distances;
    add_distances(table, "clip_distance", draw, d.clip, d.clip_count);
    add_distances(table, "cull_distance", draw, d.cull, d.cull_count);
    std::vector<TomlValue> attributes;
    for (size_t i = 0; i < draw.attributes.size(); ++i) {
        attributes.push_back(attribute_tree(draw, i));
    }
    if (!attributes.empty()) {
        table.add("attribute", tree::list(std::move(attributes)));
    }
    return table.value();
}

}  // namespace cases
