// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/exchange/export_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "capture/capture.hpp"
#include "capture/exchange/plane_files.hpp"
#include "cases/model/blit_source.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"
#include "cases/model/words.hpp"

namespace capture {

namespace {

using Json = nlohmann::ordered_json;

// A binary32 as the shortest decimal text of the same binary64, so that it comes back bit for bit
// through either format; what JSON cannot hold as a word.
Json number(float v) {
    if (std::isfinite(v)) {
        return static_cast<double>(v);
    }
    return std::isnan(v) ? "nan" : v > 0 ? "inf" : "-inf";
}

Json numbers(const glm::vec4& v, uint32_t count) {
    Json out = Json::array();
    for (glm::vec4::length_type k = 0; k < static_cast<glm::vec4::length_type>(count); ++k) {
        out.push_back(number(v[k]));
    }
    return out;
}

// "3f800000 00000000": the bits of each number.
std::string bits(const glm::vec4& v, uint32_t count) {
    std::string out;
    for (glm::vec4::length_type k = 0; k < static_cast<glm::vec4::length_type>(count); ++k) {
        out += fmt::format("{}{:08x}", k == 0 ? "" : " ", std::bit_cast<uint32_t>(v[k]));
    }
    return out;
}

struct Vectors {
    Json values = Json::array(), bits = Json::array();
};
Vectors vectors(const std::vector<glm::vec4>& from, uint32_t count) {
    Vectors out;
    for (const glm::vec4& v : from) {
        out.values.push_back(numbers(v, count));
        out.bits.push_back(bits(v, count));
    }
    return out;
}

Json attribute_json(const cases::Attribute& a) {
    Json out = {{"name", a.name},
                {"interpolation", cases::word_of(a.interpolation)},
                {"auxiliary", cases::word_of(a.auxiliary)},
                {"source", cases::word_of(a.source)},
                {"probe", cases::word_of(a.probe)},
                {"components", a.components}};
    if (a.probe == cases::Probe::at_sample) {
        out["probe_sample"] = a.probe_sample;
    } else if (a.probe == cases::Probe::at_offset) {
        out["probe_offset"] = {number(a.probe_offset[0]), number(a.probe_offset[1])};
    } else if (a.probe == cases::Probe::lod) {
        out["texture_size"] = a.texture_size;
    }
    if (a.source == cases::Source::vertex) {
        Vectors values = vectors(a.values, a.components);
        out["values"] = std::move(values.values);
        out["value_bits"] = std::move(values.bits);
    }
    return out;
}

Json depth_json(const cases::DepthState& d) {
    Json out = {{"compare", cases::word_of(d.compare)},
                {"write", d.write},
                {"bias", nullptr},
                {"clamp", d.clamp},
                {"clip", d.clip.value_or(!d.clamp)},
                {"volume", cases::kVolumeWords.at(d.negative_one_to_one ? 1 : 0)}};
    if (d.bias) {
        out["bias"] = {{"constant", number(d.bias->constant)},
                       {"slope", number(d.bias->slope)},
                       {"clamp", number(d.bias->clamp)},
                       {"representation", cases::word_of(d.bias->representation)},
                       {"exact", d.bias->is_exact}};
    }
    return out;
}

Json equation_json(const cases::BlendEquation& e) {
    return {{"source", cases::word_of(e.source)},
            {"destination", cases::word_of(e.destination)},
            {"op", cases::word_of(e.op)}};
}

Json color_json(const cases::ColorOutput& c) {
    Json out = {{"value", numbers(c.value, 4)},
                {"attribute", nullptr},
                {"blend", nullptr},
                {"write_mask", c.write_mask}};
    if (c.attribute >= 0) {
        out["attribute"] = c.attribute;
    }
    if (c.blend) {
        out["blend"] = {{"color", equation_json(c.blend->color)},
                        {"alpha", equation_json(c.blend->alpha)},
                        {"constants", numbers(c.blend->constants, 4)}};
    }
    return out;
}

Json draw_json(const cases::Draw& d, const std::vector<cases::Triangle>& triangles,
               bool has_color) {
    Vectors positions = vectors(d.positions, 4);
    // Number k of these is gl_PrimitiveID k.
    Json assembled = Json::array(), provoking = Json::array();
    for (const cases::Triangle& t : triangles) {
        assembled.push_back(t.vertex);
        provoking.push_back(t.provoking);
    }
    Json out = {
        {"topology", cases::word_of(d.topology)},     {"positions", std::move(positions.values)},
        {"position_bits", std::move(positions.bits)}, {"indices", nullptr},
        {"primitive_restart", d.primitive_restart},   {"triangles", std::move(assembled)},
        {"provoking_vertices", std::move(provoking)}};
    if (d.indices) {
        out["indices"] = *d.indices;
    }
    out["viewport"] = {{"x", number(d.viewport.x)},
                       {"y", number(d.viewport.y)},
                       {"width", number(d.viewport.width)},
                       {"height", number(d.viewport.height)},
                       {"min_depth", number(d.viewport.min_depth)},
                       {"max_depth", number(d.viewport.max_depth)}};
    out["viewport_index"] = d.viewport_index;
    out["layer"] = d.layer;
    out["scissor"] = {{"x", d.scissor.x},
                      {"y", d.scissor.y},
                      {"width", d.scissor.width},
                      {"height", d.scissor.height}};
    out["cull"] = cases::word_of(d.cull);
    out["front_face"] = cases::word_of(d.front_face);
    out["provoking_vertex"] = cases::word_of(d.provoking);
    out["depth"] = depth_json(d.depth);
    Json multisample = {{"sample_mask", d.multisample.sample_mask},
                        {"shader_mask", nullptr},
                        {"min_sample_shading", nullptr}};
    if (d.multisample.shader_mask) {
        multisample["shader_mask"] = *d.multisample.shader_mask;
    }
    if (d.multisample.min_sample_shading) {
        multisample["min_sample_shading"] = number(*d.multisample.min_sample_shading);
    }
    out["multisample"] = std::move(multisample);
    const auto distances = [](const std::vector<glm::vec4>& from, uint32_t count) {
        Vectors v = vectors(from, count);
        return Json{{"count", count}, {"values", v.values}, {"value_bits", v.bits}};
    };
    out["clip_distances"] = distances(d.distances.clip, d.distances.clip_count);
    out["cull_distances"] = distances(d.distances.cull, d.distances.cull_count);
    out["color"] = has_color ? color_json(d.color) : Json();
    out["attributes"] = Json::array();
    for (const cases::Attribute& a : d.attributes) {
        out["attributes"].push_back(attribute_json(a));
    }
    return out;
}

Json target_json(const cases::Target& t) {
    Json locations = Json::array();
    for (const std::array<uint8_t, 2>& at : cases::sample_locations(t)) {
        locations.push_back({at[0] / 16.0, at[1] / 16.0});
    }
    Json out = {{"width", t.width},
                {"height", t.height},
                {"samples", t.samples},
                {"layers", t.layers},
                {"sample_locations", std::move(locations)},
                {"depth", nullptr},
                {"color", nullptr},
                {"stencil", t.has_stencil},
                {"color_resolve", cases::word_of(t.color_resolve)},
                {"depth_resolve", cases::word_of(t.depth_resolve)}};
    if (t.has_depth) {
        out["depth"] = {{"format", cases::word_of(t.depth_format)},
                        {"clear", number(t.depth_clear)},
                        {"clear_bits", bits(glm::vec4(t.depth_clear), 1)}};
    }
    if (t.color) {
        out["color"] = {{"format", cases::word_of(t.color->format)},
                        {"clear", numbers(t.color->clear, 4)}};
    }
    return out;
}

Json corners_json(const cases::Corners& c) {
    return {{"x0", c.x0}, {"y0", c.y0}, {"x1", c.x1}, {"y1", c.y1}};
}

Json blit_json(const cases::Blit& b) {
    return {{"filter", cases::word_of(b.filter)},
            {"source",
             {{"format", cases::word_of(b.source_format)},
              {"width", b.source_width},
              {"height", b.source_height},
              {"codes", cases::blit_source(b)}}},
            {"source_region", corners_json(b.source)},
            {"destination_region", corners_json(b.destination)}};
}

Json planes_json(const cases::Case& c) {
    Json planes = Json::array();
    for (const PlaneSpec& spec : planes_of(c)) {
        Json clear = 0;
        if (spec.kind == PlaneKind::id) {
            clear = -1;
        } else if (spec.name == "depth") {
            clear = number(c.target.depth_clear);
        } else if (spec.kind == PlaneKind::value) {
            clear = number(kClearValue);
        } else if (spec.kind == PlaneKind::code) {
            clear = nullptr;
        }
        Json files = Json::array();
        for (const std::string& ending : spec.endings) {
            files.push_back(spec.name + "." + ending);
        }
        planes.push_back({{"name", spec.name},
                          {"channels", spec.channels},
                          {"least_channels", spec.least_channels},
                          {"clear", std::move(clear)},
                          {"files", std::move(files)},
                          {"what", spec.what}});
    }
    return planes;
}

bool is_same(float a, float b) {
    return std::equal_to<>()(a, b);
}

bool is_finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// The words of one draw.
class Needs {
  public:
    std::vector<std::string> words;

    void add(bool is_needed, const char* name) {
        if (is_needed && std::find(words.begin(), words.end(), name) == words.end()) {
            words.emplace_back(name);
        }
    }

    void add_draw(const cases::Draw& d, const cases::Target& t) {
        add(d.topology == cases::Topology::triangle_strip, "strip");
        add(d.topology == cases::Topology::triangle_fan, "fan");
        add(d.indices.has_value(), "indices");
        add(d.primitive_restart, "restart");
        add_positions(d);
        const cases::Viewport whole{0,
                                    0,
                                    static_cast<float>(t.width),
                                    static_cast<float>(t.height),
                                    d.viewport.min_depth,
                                    d.viewport.max_depth};
        add(!(d.viewport == whole), "viewport");
        add(!(is_same(d.viewport.min_depth, 0) && is_same(d.viewport.max_depth, 1)), "depth-range");
        add(!(d.scissor == cases::Rect{0, 0, t.width, t.height}), "scissor");
        add(d.cull != cases::CullMode::none, "cull");
        add(d.provoking == cases::ProvokingVertex::last, "provoking-last");
        add(d.depth.compare != cases::CompareOp::always, "depth-test");
        add(!d.depth.write, "depth-write-mask");
        add(d.depth.bias.has_value(), "depth-bias");
        add(d.depth.bias && d.depth.bias->is_controlled(), "depth-bias-control");
        add(d.depth.clamp || d.depth.clip.value_or(true) != true, "depth-clamp");
        add(d.depth.negative_one_to_one, "depth-volume");
        add(d.distances.clip_count > 0, "clip-distance");
        add(d.distances.cull_count > 0, "cull-distance");
        add(d.multisample.sample_mask != 0xffffffffU || d.multisample.shader_mask.has_value(),
            "sample-mask");
        add(d.multisample.min_sample_shading.has_value(), "sample-shading");
        add(d.layer > 0, "layers");
        add(d.viewport_index > 0, "viewport-index");
        for (const cases::Attribute& a : d.attributes) {
            add_attribute(a);
        }
        add(t.color && d.color.blend, "blend");
        add(t.color && d.color.write_mask != 0xf, "color-write-mask");
    }

  private:
    void add_positions(const cases::Draw& d) {
        for (const glm::vec4& p : d.positions) {
            if (!is_finite(p)) {
                add(true, "bad-numbers");
                continue;
            }
            const float near = d.depth.negative_one_to_one ? -p.w : 0.0F;
            add(!is_same(p.w, 1), "perspective");
            add(p.w <= 0 || p.z < near || p.z > p.w, "clip");
            add(std::fabs(p.x) > p.w || std::fabs(p.y) > p.w, "beyond-viewport");
        }
    }

    void add_attribute(const cases::Attribute& a) {
        add(a.source == cases::Source::barycentric, "barycentrics");
        add(a.source != cases::Source::barycentric && a.source != cases::Source::vertex,
            "sample-inputs");
        add(a.auxiliary != cases::Auxiliary::none, "auxiliary");
        const bool is_at =
            a.probe >= cases::Probe::at_centroid && a.probe <= cases::Probe::at_offset;
        add(is_at, "interpolate-at");
        add(a.probe == cases::Probe::lod, "query-lod");
        add(!is_at && a.probe != cases::Probe::value && a.probe != cases::Probe::lod,
            "derivatives");
        add(!std::all_of(a.values.begin(), a.values.end(), is_finite), "bad-numbers");
    }
};

}  // namespace

std::vector<std::string> needs_of(const cases::Case& c) {
    Needs needs;
    needs.add(c.blit.has_value(), "blit");
    needs.add(c.target.samples > 1, "samples");
    needs.add(!c.target.sample_locations.empty(), "sample-locations");
    needs.add(c.target.layers > 1, "layers");
    needs.add(c.target.has_depth && c.target.depth_format != cases::DepthFormat::d32_float,
              "depth-format");
    needs.add(c.target.has_stencil, "stencil");
    needs.add(c.target.color.has_value(), "color");
    needs.add(resolves_color(c.target) || resolves_depth(c.target), "resolve");
    for (const cases::Draw& d : c.draws) {
        needs.add_draw(d, c.target);
    }
    return needs.words;
}

std::string export_case(const cases::Case& c) {
    std::vector<std::vector<cases::Triangle>> triangles(c.draws.size());
    for (const cases::Triangle& t : cases::assemble(c)) {
        triangles.at(t.draw).push_back(t);
    }
    Json draws = Json::array();
    for (size_t k = 0; k < c.draws.size(); ++k) {
        draws.push_back(draw_json(c.draws[k], triangles[k], c.target.color.has_value()));
    }
    Json out = {{"schema", "edgecase-case-1"},
                {"id", c.id},
                {"description", c.description},
                {"catches", c.catches},
                {"rules", c.rules},
                {"needs", needs_of(c)},
                {"target", target_json(c.target)},
                {"draws", std::move(draws)},
                {"blit", c.blit ? blit_json(*c.blit) : Json()},
                {"captures", {{"folder", folder_of(c.id)}, {"planes", planes_json(c)}}}};
    // A member a line, a draw a line: short to read, and numbers do not fill lines of their own.
    const auto dump = [](const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    std::string text;
    for (const auto& [key, value] : out.items()) {
        text += (text.empty() ? "{\n" : ",\n") + dump(key) + ": ";
        if (key != "draws" || value.empty()) {
            text += dump(value);
            continue;
        }
        for (size_t k = 0; k < value.size(); ++k) {
            text += (k == 0 ? "[\n" : ",\n") + dump(value[k]);
        }
        text += "\n]";
    }
    return text + "\n}\n";
}

}  // namespace capture
