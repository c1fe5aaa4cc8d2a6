// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/draw_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <map>
#include <span>
#include <vector>

#include "shaders/shaders.hpp"
#include "shaders/spirv_variant.hpp"

namespace cli {

namespace {

constexpr std::array kTopologies = {"TRIANGLE_LIST", "TRIANGLE_STRIP", "TRIANGLE_FAN"};
constexpr std::array kCullModes = {"NONE", "FRONT_BIT", "BACK_BIT", "FRONT_AND_BACK"};
constexpr std::array kFrontFaces = {"COUNTER_CLOCKWISE", "CLOCKWISE"};
constexpr std::array kCompareOps = {
    "NEVER", "LESS", "EQUAL", "LESS_OR_EQUAL", "GREATER", "NOT_EQUAL", "GREATER_OR_EQUAL",
    "ALWAYS"};

template <class Enum>
std::string_view word(const auto& words, Enum value) {
    return words.at(static_cast<size_t>(value));
}

std::string array_text(std::string_view name, std::span<const uint32_t> words) {
    constexpr size_t kWordsInALine = 10;
    std::string text = fmt::format("static const uint32_t {}[] = {{", name);
    for (size_t k = 0; k < words.size(); ++k) {
        text += fmt::format("{}0x{:08x},", k % kWordsInALine == 0 ? "\n    " : " ", words[k]);
    }
    return text + (words.empty() ? "0};\n" : "\n};\n");
}

// Bits of binary32: the numbers may be NaN.
std::string vectors_text(std::string_view name, const std::vector<glm::vec4>& vectors) {
    std::vector<uint32_t> words;
    for (const glm::vec4& v : vectors) {
        for (int k = 0; k < 4; ++k) {
            words.push_back(std::bit_cast<uint32_t>(v[k]));
        }
    }
    return array_text(name, words);
}

// Arrays of SPIR-V, each written once; a name is the initialiser of a struct Code.
class Modules {
  public:
    std::string name(std::span<const uint32_t> code) {
        const auto [found, is_new] = names_.emplace(std::vector(code.begin(), code.end()),
                                                    fmt::format("kCode{}", names_.size()));
        if (is_new) {
            text_ += array_text(found->second, code);
        }
        return fmt::format("{{{0}, sizeof {0}}}", found->second);
    }
    const std::string& text() const { return text_; }

  private:
    std::map<std::vector<uint32_t>, std::string> names_;
    std::string text_;
};

// The draw's fragment shader, its inputs interpolated as the attributes are.
std::vector<uint32_t> fragment_code(const cases::Draw& d) {
    shaders::FragmentVariant variant;
    variant.attributes = static_cast<uint32_t>(d.attributes.size());
    variant.split = true;
    variant.mask_out = d.multisample.shader_mask.has_value();
    std::vector<shaders::InputChange> changes;
    for (uint32_t k = 0; k < variant.attributes; ++k) {
        const cases::Attribute& a = d.attributes[k];
        shaders::InputChange change;
        change.number = 1 + k;
        change.flat = a.interpolation == cases::Interpolation::flat;
        change.no_perspective = a.interpolation == cases::Interpolation::noperspective;
        change.centroid = a.auxiliary == cases::Auxiliary::centroid;
        if (change.flat || change.no_perspective || change.centroid) {
            changes.push_back(change);
        }
    }
    return shaders::change_inputs(shaders::capture_fragment(variant), changes).value();
}

// One row of kDraws; its arrays are added to `arrays`.
std::string draw_row(const cases::Draw& d, size_t number, Modules& modules, std::string& arrays) {
    const auto array = [&](const std::string& name, const std::vector<glm::vec4>& vectors) {
        const std::string full = fmt::format("k{}{}", name, number);
        arrays += vectors_text(full, vectors);
        return full;
    };
    constexpr size_t kFirstAttribute = 1, kClip = 5, kCull = 6;  // locations of capture.vert
    std::array<std::string, 7> inputs;
    inputs.fill("NULL");
    inputs[0] = array("Positions", d.positions);
    for (size_t k = 0; k < d.attributes.size(); ++k) {
        inputs.at(kFirstAttribute + k) =
            array(fmt::format("Attribute{}Of", k), d.attributes[k].values);
    }
    if (d.distances.clip_count > 0) {
        inputs[kClip] = array("Clip", d.distances.clip);
    }
    if (d.distances.cull_count > 0) {
        inputs[kCull] = array("Cull", d.distances.cull);
    }
    std::string indices = "NULL";
    if (d.indices) {
        indices = fmt::format("kIndices{}", number);
        arrays += array_text(indices, *d.indices);
    }
    const auto attributes = static_cast<uint32_t>(d.attributes.size());
    shaders::VertexVariant vertex;
    vertex.attributes = attributes;
    vertex.clip_count = d.distances.clip_count;
    vertex.cull_count = d.distances.cull_count;
    uint32_t flat = 0;
    for (uint32_t k = 0; k < attributes; ++k) {
        flat |= uint32_t{d.attributes[k].interpolation == cases::Interpolation::flat} << k;
    }
    const cases::Viewport& v = d.viewport;
    const cases::DepthBias bias = d.depth.bias.value_or(cases::DepthBias{});
    std::string text = fmt::format(
        "    {{VK_PRIMITIVE_TOPOLOGY_{}, {:d}, {}, {}, {}, {}, {}, 0x{:x}U,\n     {{{}}}, {},\n    "
        " {}, "
        "{},\n",
        word(kTopologies, d.topology), d.primitive_restart, d.positions.size(),
        d.indices ? d.indices->size() : d.positions.size(), attributes, vertex.clip_count,
        vertex.cull_count, flat, fmt::join(inputs, ", "), indices,
        modules.name(shaders::capture_vertex(vertex)), modules.name(fragment_code(d)));
    text += fmt::format(
        "     {{{:a}F, {:a}F, {:a}F, {:a}F, {:a}F, {:a}F}}, {{{{{}, {}}}, {{{}U, {}U}}}},\n", v.x,
        v.y, v.width, v.height, v.min_depth, v.max_depth, d.scissor.x, d.scissor.y, d.scissor.width,
        d.scissor.height);
    text +=
        fmt::format("     VK_CULL_MODE_{}, VK_FRONT_FACE_{}, {:d}, {:d}, {:d}, VK_COMPARE_OP_{},\n",
                    word(kCullModes, d.cull), word(kFrontFaces, d.front_face), d.rasterizer_discard,
                    d.depth.clamp, d.depth.write, word(kCompareOps, d.depth.compare));
    return text + fmt::format("     {:d}, {{{:a}F, {:a}F, {:a}F}}, 0x{:08x}U, 0x{:08x}U}},\n",
                              d.depth.bias.has_value(), bias.constant, bias.clamp, bias.slope,
                              d.multisample.sample_mask,
                              d.multisample.shader_mask.value_or(0xffffffffU));
}

}  // namespace

std::string draw_tables(const cases::Case& c) {
    Modules modules;
    std::string arrays, draws;
    for (size_t k = 0; k < c.draws.size(); ++k) {
        draws += draw_row(c.draws[k], k, modules, arrays);
    }
    std::vector<std::string> copies(3, "{NULL, 0}");  // by words of a sample / 2
    if (c.target.samples > 1) {
        copies = {modules.name(shaders::copy_samples(true, 1)),
                  modules.name(shaders::copy_samples(false, 2)),
                  modules.name(shaders::copy_samples(false, 4))};
    }
    return fmt::format(
        "// SPIR-V that glslang made of the test suite's shaders.\n{}\n"
        "// Copies the samples of a plane with 1 (depth), 2 or 4 numbers each.\n"
        "static const struct Code kCopyCodes[3] = {{{}}};\n\n"
        "{}\nstatic const struct Draw kDraws[] = {{\n{}}};\n\n",
        modules.text(), fmt::join(copies, ", "), arrays, draws);
}

}  // namespace cli
