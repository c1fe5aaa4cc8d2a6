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
#include "cases/model/texels.hpp"
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

// A value as it stands, by its type; structures by their lists of fields. Those of which an export
// says more, or says it otherwise, have functions of their own below.
template <class T>
Json told(const T& value);
Json told(const cases::Attribute& a);
Json told(const cases::DepthState& d);
Json told(const cases::ColorOutput& c);

Json distances(const std::vector<glm::vec4>& from, uint32_t count) {
    Vectors v = vectors(from, count);
    return {{"count", count}, {"values", v.values}, {"value_bits", v.bits}};
}

// All fields of a structure that alter the picture, put into `out`.
template <class T>
void tell_fields(const T& value, Json& out) {
    T::fields(
        [&out]<class M>(const cases::Field& field, const M& member) {
            if constexpr (std::is_same_v<M, cases::ClipDistances>) {
                out["clip_distances"] = distances(member.clip, member.clip_count);
                out["cull_distances"] = distances(member.cull, member.cull_count);
            } else if (!field.has(cases::kNotExported)) {
                out[field.name] = told(member);
            }
        },
        value);
}

template <class T>
Json told(const T& value) {
    if constexpr (cases::HasFields<T>) {
        Json out = Json::object();
        tell_fields(value, out);
        return out;
    } else if constexpr (std::is_same_v<T, float>) {
        return number(value);
    } else if constexpr (std::is_same_v<T, glm::vec4>) {
        return numbers(value, 4);
    } else if constexpr (std::is_enum_v<T>) {
        return cases::word_of(value);
    } else if constexpr (cases::is_optional<T>) {
        return value ? told(*value) : Json();
    } else if constexpr (cases::is_vector<T> || cases::is_array<T>) {
        Json list = Json::array();
        for (const auto& entry : value) {
            list.push_back(told(entry));
        }
        return list;
    } else {
        return value;
    }
}

// What only some probes and sources have is told of those alone.
Json told(const cases::Attribute& a) {
    Json out = Json::object();
    tell_fields(a, out);
    const auto drop = [&out](bool is_there, const char* key) {
        if (!is_there) {
            out.erase(key);
        }
    };
    drop(a.probe == cases::Probe::at_sample, "probe_sample");
    drop(a.probe == cases::Probe::at_offset, "probe_offset");
    drop(a.probe == cases::Probe::lod, "texture_size");
    drop(a.source == cases::Source::vertex, "values");
    if (a.source == cases::Source::vertex) {
        Vectors values = vectors(a.values, a.components);
        out["values"] = std::move(values.values);
        out["value_bits"] = std::move(values.bits);
    }
    return out;
}

Json told(const cases::DepthState& d) {
    Json out = Json::object();
    tell_fields(d, out);
    out["clip"] = d.clip.value_or(!d.clamp);
    out["volume"] = cases::kVolumeWords.at(d.negative_one_to_one ? 1 : 0);
    return out;
}

Json told(const cases::ColorOutput& c) {
    Json out = Json::object();
    tell_fields(c, out);
    if (c.attribute < 0) {
        out["attribute"] = nullptr;
    }
    if (c.from == cases::ColorFrom::texels) {
        out["texels"] = cases::kTexels;
    }
    return out;
}

Json draw_json(const cases::Draw& d, const std::vector<cases::Triangle>& triangles,
               const cases::Target& target) {
    // Number k of these is gl_PrimitiveID k, which begins again in each instance.
    Json assembled = Json::array(), provoking = Json::array();
    for (const cases::Triangle& t : triangles) {
        assembled.push_back(t.vertex);
        provoking.push_back(t.provoking);
    }
    Vectors positions = vectors(d.positions, 4);
    // What follows from fields stands beside them.
    Json out;
    for (const char* key : {"topology", "positions", "position_bits", "indices",
                            "primitive_restart", "triangles", "provoking_vertices"}) {
        out[key] = nullptr;
    }
    tell_fields(d, out);
    out["position_bits"] = std::move(positions.bits);
    out["triangles"] = std::move(assembled);
    out["provoking_vertices"] = std::move(provoking);
    if (d.instances == 1) {
        out.erase("instances");
    }
    if (!target.color) {
        out["color"] = nullptr;
    }
    if (!target.has_stencil) {
        out["stencil"] = nullptr;
    }
    return out;
}

Json target_json(const cases::Target& t) {
    Json locations = Json::array();
    for (const std::array<uint8_t, 2>& at : cases::sample_locations(t)) {
        locations.push_back({at[0] / 16.0, at[1] / 16.0});
    }
    Json out = told(t);
    out["sample_locations"] = std::move(locations);
    out["depth"] = nullptr;
    if (t.has_depth) {
        out["depth"] = {{"format", std::move(out["depth_format"])},
                        {"clear", std::move(out["depth_clear"])},
                        {"clear_bits", bits(glm::vec4(t.depth_clear), 1)}};
    }
    out.erase("depth_format");
    out.erase("depth_clear");
    return out;
}

Json blit_json(const cases::Blit& b) {
    Json out = {{"filter", nullptr}, {"source", nullptr}};
    tell_fields(b, out);
    // The texels instead of how they were made.
    out["source"] = {{"format", std::move(out["source_format"])},
                     {"width", b.source_width},
                     {"height", b.source_height},
                     {"codes", cases::blit_source(b)}};
    for (const char* key : {"source_format", "source_width", "source_height", "pattern", "seed"}) {
        out.erase(key);
    }
    return out;
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
        } else if (spec.kind == PlaneKind::byte) {
            clear = c.target.stencil_clear;
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

bool is_equal(float a, float b) {
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
        if (is_needed && std::ranges::find(words, name) == words.end()) {
            words.emplace_back(name);
        }
    }

    void add_draw(const cases::Draw& d, const cases::Target& t) {
        add(d.topology == cases::Topology::triangle_strip, "strip");
        add(d.topology == cases::Topology::triangle_fan, "fan");
        add(d.indices.has_value(), "indices");
        add(d.instances > 1, "instances");
        add(d.primitive_restart, "restart");
        add(d.primitive_restart && d.topology == cases::Topology::triangle_list, "restart-list");
        if (d.clear) {
            add(true, "clear");
            return;
        }
        add_positions(d);
        const cases::Viewport whole{0,
                                    0,
                                    static_cast<float>(t.width),
                                    static_cast<float>(t.height),
                                    d.viewport.min_depth,
                                    d.viewport.max_depth};
        add(!(d.viewport == whole), "viewport");
        add(!(is_equal(d.viewport.min_depth, 0) && is_equal(d.viewport.max_depth, 1)),
            "depth-range");
        add(!(d.scissor == cases::Rect{0, 0, t.width, t.height}), "scissor");
        add(d.cull != cases::CullMode::none, "cull");
        add(d.provoking == cases::ProvokingVertex::last, "provoking-last");
        add(d.rasterizer_discard, "rasterizer-discard");
        add(d.conservative != cases::Conservative::none, "conservative-rasterization");
        add(cases::asks_shading_rate(d), "fragment-size");
        add(d.discard != cases::Discard::none, "discard");
        add(d.early_tests, "early-tests");
        add(d.frag_depth.has_value(), "frag-depth");
        add(d.depth.compare != cases::CompareOp::always, "depth-test");
        add(!d.depth.write, "depth-write-mask");
        add(t.has_stencil && !(d.stencil == cases::StencilState{}), "stencil-test");
        add(d.depth.bias.has_value(), "depth-bias");
        add(d.depth.bias && d.depth.bias->is_controlled(), "depth-bias-control");
        add(d.depth.clamp || d.depth.clip.value_or(true) != true, "depth-clamp");
        add(d.depth.bounds.has_value(), "depth-bounds");
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
        add(t.color && d.color.blend && takes_second(*d.color.blend), "dual-source-blend");
        add(t.color && d.color.from == cases::ColorFrom::texels, "texels");
        add(t.color && d.color.alpha_to_coverage, "alpha-to-coverage");
        add(t.color && d.color.alpha_to_one, "alpha-to-one");
        add(t.color && d.color.logic, "logic-operation");
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
            add(!is_equal(p.w, 1), "perspective");
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
        add(!std::ranges::all_of(a.values, is_finite), "bad-numbers");
    }
};

}  // namespace

std::vector<std::string> needs_of(const cases::Case& c) {
    Needs needs;
    needs.add(c.blit.has_value(), "blit");
    needs.add(c.target.samples > 1, "samples");
    needs.add(!c.target.sample_locations.empty(), "sample-locations");
    needs.add(c.target.layers > 1, "layers");
    needs.add(c.target.has_depth && (c.target.depth_format != cases::DepthFormat::d32_float ||
                                     (c.target.has_stencil && c.target.names_depth)),
              "depth-format");
    needs.add(c.target.has_stencil, "stencil");
    needs.add(c.target.color.has_value(), "color");
    needs.add(resolves(c.target), "resolve");
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
        draws.push_back(draw_json(c.draws[k], triangles[k], c.target));
    }
    Json out = {{"schema", "edgecase-case-1"},
                {"id", c.id},
                {"description", c.claim.description},
                {"catches", c.claim.catches},
                {"rules", c.claim.rules},
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
