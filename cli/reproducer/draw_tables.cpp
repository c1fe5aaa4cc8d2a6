// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/draw_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <span>
#include <vector>

#include "cases/model/derive.hpp"
#include "cli/reproducer/shader_inputs.hpp"
#include "ref/value/fragment/shading_rate.hpp"
#include "shaders/shaders.hpp"

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

// Arrays by their names: "kPositions0", of another drawing "kPositions0b"; each is written once.
class Arrays {
  public:
    // The name of the first array with these words.
    std::string add(const std::string& name, std::span<const uint32_t> words) {
        const auto [found, is_new] = names_.emplace(std::vector(words.begin(), words.end()), name);
        if (is_new) {
            text_ += array_text(name, words);
        }
        return found->second;
    }
    size_t size() const { return names_.size(); }
    const std::string& text() const { return text_; }

  private:
    std::map<std::vector<uint32_t>, std::string> names_;
    std::string text_;
};

// SPIR-V in one of these arrays, as the initialiser of a struct Code.
std::string code_text(std::span<const uint32_t> code, Arrays& modules) {
    return fmt::format("{{{0}, sizeof {0}}}",
                       modules.add(fmt::format("kCode{}", modules.size()), code));
}

// Places of FragCoord.xy (ref/value/sample_values.cpp).
std::string_view places_of(const cases::Draw& d, uint32_t samples, cases::Profile profile) {
    const bool is_vulkan = profile == cases::Profile::vulkan;
    switch (ref::value::shading_rate(d, samples)) {
        case ref::value::ShadingRate::fragment:
            break;
        case ref::value::ShadingRate::may_split:
            return is_vulkan ? "AT_CENTRE | AT_ANY_SAMPLE" : "AT_CENTRE | AT_OWN_SAMPLE";
        case ref::value::ShadingRate::some:
            return ref::value::least_invocations(d, samples) == 1 ? "AT_CENTRE | AT_ANY_SAMPLE"
                                                                  : "AT_ANY_SAMPLE";
        case ref::value::ShadingRate::sample:
            return is_vulkan ? "AT_ANY_SAMPLE" : "AT_OWN_SAMPLE";
    }
    return "AT_CENTRE";
}

std::string_view kind_of(const cases::Attribute& a) {
    switch (a.source) {
        case cases::Source::sample_id:
            return "SAMPLE_ID";
        case cases::Source::sample_position:
            return "SAMPLE_POSITION";
        case cases::Source::sample_mask_in:
            return "SAMPLE_MASK";
        case cases::Source::shading_rate:  // of no case that becomes a program
        case cases::Source::barycentric:
        case cases::Source::vertex:
            break;
    }
    return a.probe == cases::Probe::lod ? "LEVEL" : "INPUT";
}

std::string mix_text(const cases::ColorOutput& color) {
    if (!color.blend) {
        return fmt::format("     .mix = {{.colorWriteMask = {:#x}}},\n", color.write_mask);
    }
    const auto equation = [](const cases::BlendEquation& e) {
        return fmt::format("(VkBlendFactor){}, (VkBlendFactor){}, (VkBlendOp){}",
                           static_cast<int>(e.source), static_cast<int>(e.destination),
                           static_cast<int>(e.op));
    };
    const glm::vec4& k = color.blend->constants;
    return fmt::format(
        "     .mix = {{1, {}, {}, {:#x}}},\n     .mix_constants = {{{:a}F, {:a}F, {:a}F, "
        "{:a}F}},\n",
        equation(color.blend->color), equation(color.blend->alpha), color.write_mask, k.x, k.y, k.z,
        k.w);
}

// What few draws have.
std::string rare_text(const cases::Case& c, const cases::Draw& d, const Inputs& inputs,
                      cases::Profile profile) {
    std::string text = fmt::format("     .places = {},\n", places_of(d, c.target.samples, profile));
    std::array<std::string, cases::kMaxAttributes> kinds, offsets;
    kinds.fill("INPUT");
    offsets.fill("{0}");
    std::array<uint32_t, cases::kMaxAttributes> numbers{};
    std::array<int64_t, cases::kMaxAttributes + 1> choices{};
    choices.back() =
        inputs.has_instruments ? d.color.attribute : std::min(d.color.attribute, int32_t{0});
    bool has_rate = false, has_barycentrics = false;
    for (size_t k = 0; k < inputs.attributes.size(); ++k) {
        choices.at(k) = inputs.choice(k);
        if (inputs.attributes[k] == nullptr) {
            continue;
        }
        const cases::Attribute& a = *inputs.attributes[k];
        kinds.at(k) = kind_of(a);
        numbers.at(k) = a.probe_sample;
        offsets.at(k) = fmt::format("{{{:a}F, {:a}F}}", a.probe_offset[0], a.probe_offset[1]);
        const bool is_located = a.probe == cases::Probe::at_centroid ||
                                a.probe == cases::Probe::at_sample ||
                                a.probe == cases::Probe::at_offset;
        has_rate = has_rate || is_located || a.auxiliary == cases::Auxiliary::sample ||
                   a.source == cases::Source::sample_id ||
                   a.source == cases::Source::sample_position;
        has_barycentrics = has_barycentrics || a.source == cases::Source::barycentric;
        if (a.probe == cases::Probe::lod) {
            text +=
                fmt::format("     .texture = {{{}, {}}},\n", a.texture_size[0], a.texture_size[1]);
        }
    }
    text += fmt::format(
        "     .kinds = {{{}}}, .choices = {{{}}},\n     .offsets = {{{}}}, .sample_numbers = "
        "{{{}}},\n",
        fmt::join(kinds, ", "), fmt::join(choices, ", "), fmt::join(offsets, ", "),
        fmt::join(numbers, ", "));
    if (profile != cases::Profile::vulkan) {
        text += "     .own_only = 0xf,\n";
    }
    if (has_rate) {
        text += "     .has_sample_rate = 1,\n";
    }
    if (has_barycentrics) {
        text += "     .has_barycentrics = 1,\n";
    }
    if (d.multisample.min_sample_shading) {
        text += fmt::format("     .shades_samples = 1, .least_shading = {:a}F,\n",
                            *d.multisample.min_sample_shading);
    }
    if (d.layer > 0) {
        text += fmt::format("     .layer = {},\n", d.layer);
    }
    if (d.provoking == cases::ProvokingVertex::last) {
        text += "     .last_provokes = 1,\n";
    }
    if (d.depth.negative_one_to_one) {
        text += "     .is_symmetric = 1,\n";
    }
    if (d.depth.clip) {
        text += fmt::format("     .depth_clip = {},\n", *d.depth.clip ? 2 : 1);
    }
    if (c.target.color) {
        std::array<uint32_t, 4> bits{};
        for (int k = 0; k < 4; ++k) {
            const float v = d.color.value[k];
            bits.at(static_cast<size_t>(k)) = inputs.color == shaders::ColorKind::integer
                                                  ? static_cast<uint32_t>(v)
                                                  : std::bit_cast<uint32_t>(v);
        }
        text += fmt::format("     .colors = {{{:#x}U, {:#x}U, {:#x}U, {:#x}U}},\n", bits[0],
                            bits[1], bits[2], bits[3]);
        text += mix_text(d.color);
    }
    return text;
}

std::vector<uint32_t> words_of(const std::vector<glm::vec4>& vectors) {
    std::vector<uint32_t> words;
    for (const glm::vec4& v : vectors) {
        for (int k = 0; k < 4; ++k) {
            words.push_back(std::bit_cast<uint32_t>(v[k]));  // the numbers may be NaN
        }
    }
    return words;
}

// One row of a table of draws; `name` ends the names of its arrays.
std::string draw_row(const cases::Case& c, const cases::Draw& d, const std::string& name,
                     cases::Profile profile, Arrays& modules, Arrays& arrays) {
    constexpr size_t kFirstAttribute = 1, kClip = 5, kCull = 6;  // locations of capture.vert
    const Inputs shader = inputs_of(c, d);
    std::array<std::string, 7> inputs;
    inputs.fill("NULL");
    inputs[0] = arrays.add("kPositions" + name, words_of(d.positions));
    for (size_t k = 0; k < shader.attributes.size(); ++k) {
        const cases::Attribute* a = shader.attributes[k];
        constexpr float kNothing = -1;  // what attachments are cleared to
        const bool is_given = a != nullptr && a->source == cases::Source::vertex;
        inputs.at(kFirstAttribute + k) = arrays.add(
            fmt::format("kAttribute{}Of{}", k, name),
            words_of(is_given ? a->values
                              : std::vector<glm::vec4>(d.positions.size(),
                                                       glm::vec4(a != nullptr ? 0 : kNothing))));
    }
    if (d.distances.clip_count > 0) {
        inputs[kClip] = arrays.add("kClip" + name, words_of(d.distances.clip));
    }
    if (d.distances.cull_count > 0) {
        inputs[kCull] = arrays.add("kCull" + name, words_of(d.distances.cull));
    }
    const std::string indices = d.indices ? arrays.add("kIndices" + name, *d.indices) : "NULL";
    const size_t judged = shader.has_instruments ? d.attributes.size() : 0;
    uint32_t flat = 0;
    for (size_t k = 0; k < judged; ++k) {
        flat |= uint32_t{d.attributes[k].interpolation == cases::Interpolation::flat} << k;
    }
    const cases::Viewport& v = d.viewport;
    const cases::DepthBias bias = d.depth.bias.value_or(cases::DepthBias{});
    std::string text = fmt::format(
        "    {{VK_PRIMITIVE_TOPOLOGY_{}, {:d}, {}, {}, {}, {}, {}, 0x{:x}U,\n     {{{}}}, {},\n    "
        " {}, "
        "{},\n",
        word(kTopologies, d.topology), d.primitive_restart, d.positions.size(),
        d.indices ? d.indices->size() : d.positions.size(), judged, d.distances.clip_count,
        d.distances.cull_count, flat, fmt::join(inputs, ", "), indices,
        code_text(vertex_code(c, d), modules), code_text(shader.fragment_code(d), modules));
    text += fmt::format(
        "     {{{:a}F, {:a}F, {:a}F, {:a}F, {:a}F, {:a}F}}, {{{{{}, {}}}, {{{}U, {}U}}}},\n", v.x,
        v.y, v.width, v.height, v.min_depth, v.max_depth, d.scissor.x, d.scissor.y, d.scissor.width,
        d.scissor.height);
    text +=
        fmt::format("     VK_CULL_MODE_{}, VK_FRONT_FACE_{}, {:d}, {:d}, {:d}, VK_COMPARE_OP_{},\n",
                    word(kCullModes, d.cull), word(kFrontFaces, d.front_face), d.rasterizer_discard,
                    d.depth.clamp, d.depth.write, word(kCompareOps, d.depth.compare));
    text += fmt::format("     {:d}, {{{:a}F, {:a}F, {:a}F}}, 0x{:08x}U, 0x{:08x}U,\n",
                        d.depth.bias.has_value(), bias.constant, bias.clamp, bias.slope,
                        d.multisample.sample_mask, d.multisample.shader_mask.value_or(0xffffffffU));
    return text + rare_text(c, d, shader, profile) + "    },\n";
}

std::string drawing_row(const std::string& name, const std::string& draws, const cases::Case& c) {
    const cases::Variation& v = c.variation;
    return fmt::format("    {{\"{}\", {}, {}, {{{}, {}}}, {:d}, {:d}, 0x{:x}U, {:d}, {:d}}},\n",
                       name, draws, c.target.has_instruments ? cases::attributes_of(c) : 0,
                       v.tile[0], v.tile[1], v.other_clears, v.other_depth_clear, v.masked,
                       v.masks_depth, v.later);
}

}  // namespace

std::string draw_tables(const cases::Case& c, cases::Profile profile) {
    Arrays modules, arrays;
    std::string tables, drawings;
    const auto add_draws = [&](const cases::Case& drawn, const std::string& suffix) {
        tables += fmt::format("static const struct Draw kDraws{}[] = {{\n", suffix);
        for (size_t k = 0; k < drawn.draws.size(); ++k) {
            tables += draw_row(drawn, drawn.draws[k], fmt::format("{}{}", k, suffix), profile,
                               modules, arrays);
        }
        tables += "};\n\n";
    };
    add_draws(c, "");
    drawings += drawing_row("the case", "kDraws", c);
    size_t number = 0;
    for (const cases::Derivation& derivation : cases::derivations(c)) {
        const cases::Case drawn = cases::derive(c, derivation);
        std::string draws = "kDraws";
        // Only those of attributes draw otherwise.
        if (derivation.kind == cases::RelationKind::fewer_attributes ||
            derivation.kind == cases::RelationKind::more_attributes) {
            const std::string suffix = fmt::format("Of{}", ++number);
            add_draws(drawn, suffix);
            draws += suffix;
        }
        drawings += drawing_row(derivation.name, draws, drawn);
    }
    std::vector<std::string> copies(4, "{NULL, 0}");  // by words of a sample / 2; the depth
    if (c.target.samples > 1) {
        copies = {code_text(shaders::copy_samples(false, 1), modules),
                  code_text(shaders::copy_samples(false, 2), modules),
                  code_text(shaders::copy_samples(false, 4), modules),
                  code_text(shaders::copy_samples(true, 1), modules)};
    }
    return fmt::format(
        "// SPIR-V that glslang made of the test suite's shaders.\n{}\n"
        "// Copies the samples of a plane with 1, 2 or 4 numbers each, or of the depth.\n"
        "static const struct Code kCopyCodes[4] = {{{}}};\n\n"
        "{}\n{}static const struct Drawing kDrawings[] = {{\n{}}};\n\n",
        modules.text(), fmt::join(copies, ", "), arrays.text(), tables, drawings);
}

}  // namespace cli
