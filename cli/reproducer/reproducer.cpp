// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/reproducer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "capture/capture.hpp"
#include "cases/format/color_format.hpp"
#include "cases/format/depth_format.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/instances.hpp"
#include "cases/model/sample.hpp"
#include "cli/reproducer/draw_tables.hpp"
#include "cli/reproducer/expected_tables.hpp"
#include "cli/reproducer/shader_inputs.hpp"

namespace cli {

namespace {

constexpr std::string_view kTypes =
#include "embedded/types.c.inc"
    ;
constexpr std::string_view kDevice =
#include "embedded/device.c.inc"
    ;
constexpr std::string_view kImage =
#include "embedded/image.c.inc"
    ;
constexpr std::string_view kPipeline =
#include "embedded/pipeline.c.inc"
    ;
constexpr std::string_view kDraw =
#include "embedded/draw.c.inc"
    ;
constexpr std::string_view kColor =
#include "embedded/color.c.inc"
    ;
constexpr std::string_view kJudge =
#include "embedded/judge.c.inc"
    ;
constexpr std::string_view kCompare =
#include "embedded/compare.c.inc"
    ;

// A feature that the program knows nothing of, and whether the case has it.
struct Missing {
    bool has = false;
    std::string_view name;
};

std::string_view first_of(std::initializer_list<Missing> features) {
    const auto* found = std::ranges::find_if(features, &Missing::has);
    return found == features.end() ? "" : found->name;
}

bool is_finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

std::string_view missing_of(const cases::Attribute& a) {
    const bool is_flat = a.interpolation == cases::Interpolation::flat;
    return first_of({
        {is_flat && !std::ranges::all_of(a.values, is_finite),
         "a flat attribute that is no finite number"},
    });
}

std::string_view missing_of(const cases::Draw& d) {
    for (const cases::Attribute& a : d.attributes) {
        if (const std::string_view missing = missing_of(a); !missing.empty()) {
            return missing;
        }
    }
    return first_of({
        {d.clear.has_value(), "a clear among the draws"},
        {cases::is_instanced(d), "instances"},
        {d.viewport_index != 0, "several viewports"},
        {d.conservative != cases::Conservative::none, "conservative rasterization"},
        {cases::asks_shading_rate(d), "a fragment size"},
        {d.discard != cases::Discard::none || d.early_tests,
         "fragments that the shader discards, or early tests"},
        {d.frag_depth.has_value(), "a depth that the shader writes"},
        {d.query != cases::Query::none, "a query"},
        {d.depth.bounds.has_value(), "a depth bounds test"},
        {d.color.from != cases::ColorFrom::push_constant, "a colour that is no push constant"},
        {d.color.logic.has_value(), "a logical operation"},
        {d.color.alpha_to_one, "alpha to one"},
        {d.color.alpha_to_coverage, "alpha to coverage"},
        {d.color.blend && cases::takes_second(*d.color.blend), "dual-source blending"},
        {!d.other_colors.empty(), "several colour targets"},
        {d.depth.bias && d.depth.bias->is_controlled(), "a bias by VK_EXT_depth_bias_control"},
    });
}

// The text inside a C string or comment: what could end either is left out.
std::string c_text(std::string_view text) {
    std::string out;
    for (const char letter : text) {
        const bool is_plain = letter >= ' ' && letter < 0x7f && letter != '"' && letter != '\\' &&
                              letter != '*' && letter != '?';
        out += is_plain ? letter : letter == '*' ? '+' : '\'';
    }
    return out;
}

// `has_own_places`: the device's, which it does not have to promise.
std::string target_text(const cases::Target& t, bool has_own_places) {
    // A UNORM format may round the clear value either way.
    const double steps = cases::depth_steps(t.depth_format);
    const double code = static_cast<double>(t.depth_clear) * steps;
    const auto clear = [&](double whole) {
        return steps > 0 ? cases::depth_of_code(static_cast<uint32_t>(whole), t.depth_format)
                         : t.depth_clear;
    };
    std::string places;
    for (const auto& place : cases::sample_locations(t)) {
        places += fmt::format("{{{}, {}}}, ", place[0], place[1]);
    }
    return fmt::format(
        "#define WIDTH {}\n#define HEIGHT {}  // of a layer\n#define LAYERS {}\n#define SAMPLES "
        "{}\n"
        "#define HAS_INSTRUMENTS {:d}  // hits, the last triangle, FragCoord and attributes\n"
        "#define HAS_DEPTH {:d}\n#define DEPTH_FORMAT VK_FORMAT_{}\n"
        "#define DEPTH_STEPS {:.1f}  // 0: floating point\n#define DEPTH_CLEAR {:a}F\n"
        "#define DEPTH_CLEAR_LOW {:a}F\n#define DEPTH_CLEAR_HIGH {:a}F\n"
        "// Of samples in their pixel, in 1/16 pixel.\n"
        "static const uint8_t kPlaces[SAMPLES][2] = {{{}}};\n"
        "#define HAS_STANDARD_PLACES {:d}\n",
        t.width, t.height, t.layers, t.samples, t.has_instruments, t.has_depth,
        row_of(t.depth_format).vulkan_name, steps, t.depth_clear, clear(std::floor(code)),
        clear(std::ceil(code)), places, !has_own_places);
}

std::string color_text(const cases::Case& c, cases::Profile profile) {
    const bool is_blended = std::ranges::any_of(
        c.draws, [&](const auto& d) { return c.target.color && d.color.blend.has_value(); });
    const cases::ColorTarget target = c.target.color.value_or(cases::ColorTarget{});
    const cases::ColorFormatRow& row = row_of(target.format);
    std::array<uint32_t, 4> clear{};
    for (int k = 0; k < 4; ++k) {
        clear.at(static_cast<size_t>(k)) = cases::is_integer(target.format)
                                               ? static_cast<uint32_t>(target.clear[k])
                                               : std::bit_cast<uint32_t>(target.clear[k]);
    }
    // Direct3D allows 0.6 of a unit where a shader's number is stored.
    return fmt::format(
        "#define HAS_COLOR {:d}\n#define COLOR_FORMAT (VkFormat){}  // {}\n"
        "#define COLOR_BYTES {}\n#define COLOR_KIND {}  // enum Kind\n"
        "#define COLOR_IS_BLENDED {:d}\n#define COLOR_SLACK {}\n"
        "static const uint32_t kColorClear[4] = {{{:#x}U, {:#x}U, {:#x}U, {:#x}U}};\n"
        "static const uint8_t kColorBits[4] = {{{}}}, kColorFirst[4] = {{{}}};\n",
        c.target.color.has_value(), row.vulkan, row.word, cases::bytes_of(target.format),
        static_cast<int>(row.kind), is_blended, profile == cases::Profile::direct3d ? "0.6" : "0",
        clear[0], clear[1], clear[2], clear[3], fmt::join(row.bits, ", "),
        fmt::join(row.first_bit, ", "));
}

}  // namespace

std::string_view undrawable_part(const cases::Case& c) {
    constexpr size_t kMaxDraws = 0x7fff;  // the shader packs their number into 16 bits
    const cases::Target& t = c.target;
    const bool claims_doors = std::ranges::any_of(
        c.relations, [](const cases::Relation& r) { return r.kind == cases::RelationKind::door; });
    for (const cases::Draw& draw : c.draws) {
        if (const std::string_view missing = missing_of(draw); !missing.empty()) {
            return missing;
        }
    }
    return first_of({
        {c.blit.has_value(), "a blit"},
        {claims_doors, "doors"},
        {t.color && !cases::can_be_blitted(t.color->format),
         "a colour of signed codes or of floats without a sign"},
        {!t.sample_locations.empty(), "sample locations of its own"},
        {t.has_operations(), "load and store operations"},
        {t.has_stencil, "a stencil"},
        {t.frame != cases::Frame::copied,
         "a picture that is not copied, of a second frame, or a part of an image"},
        {!t.has_instruments && !t.color, "depth alone"},
        // What a shader reads of them is no code by itself (vk_harness/depth_codes.hpp).
        {t.has_depth && t.depth_format == cases::DepthFormat::d24_unorm && t.samples > 1,
         "several samples of D24"},
        {capture::resolves(t), "a resolve"},
        {c.draws.size() > kMaxDraws, "more than 32,767 draws"},
        {!has_shaders(c), "outputs for which no shader was made"},
    });
}

bool may_be_too_large(const cases::Case& c) {
    size_t attributes = 0;
    for (const cases::Draw& draw : c.draws) {
        attributes = std::max(attributes, draw.attributes.size());
    }
    const cases::Target& t = c.target;
    return size_t{t.width} * t.rows() * t.samples * (3 + 4 * attributes) > kMostRanges;
}

cases::Expected<std::string> reproducer(const cases::Case& filed, const ref::Limits& limits,
                                        cases::Profile profile, std::string_view version) {
    if (const std::string_view missing = undrawable_part(filed); !missing.empty()) {
        return cases::failure(fmt::format(
            "the case '{}' has {}, which a reproducer cannot draw; send the case file with the "
            "output of 'edgecase run' instead",
            filed.id, missing));
    }
    const cases::Case c = ref::as_drawn(filed, limits).value_or(filed);
    const cases::Expected<std::string> expected = expected_tables(c, limits, profile);
    if (!expected) {
        return expected;
    }
    const std::string id = c_text(c.id);
    return fmt::format(
               "// {}\n// {}\n//\n"
               "// Written by edgecase {}; https://www.apache.org/licenses/LICENSE-2.0 holds.\n"
               "// Draws the case and checks each sample: hits, the last triangle, FragCoord, "
               "depth, attributes, colour;\n"
               "// and other drawings of it, if it claims that they have the same bits.\n"
               "//     cc -std=c99 FILE.c -lvulkan -lm && ./a.out [PART OF THE DEVICE'S NAME]\n"
               "// Exit code: 0 all samples are right, 1 some are wrong, 2 it could not be "
               "drawn.\n",
               id, c_text(c.claim.description), version)
        .append(kTypes.substr(kTypes.find("#include")))
        .append(fmt::format("static const char kCase[] = \"{}\";\n"
                            "static const char kProfile[] = \"judged at profile {} with {} "
                            "subpixel bits\";\n",
                            id, to_string(profile), limits.subpixel_bits))
        .append(fmt::format("#define DRAWS {}\n#define DRAWINGS {}\n#define SUBPIXEL_BITS {}\n",
                            c.draws.size(), 1 + cases::derivations(c).size(), limits.subpixel_bits))
        .append(target_text(c.target, !c.target.sample_locations.empty()))
        .append(color_text(c, profile))
        .append("\n")
        .append(draw_tables(c, profile))
        .append(*expected)
        .append(kDevice)
        .append(kImage)
        .append(kPipeline)
        .append(kDraw)
        .append(kColor)
        .append(kJudge)
        .append(kCompare);
}

}  // namespace cli
