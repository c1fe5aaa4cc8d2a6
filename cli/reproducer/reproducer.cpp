// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/reproducer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/format/depth_format.hpp"
#include "cli/reproducer/draw_tables.hpp"
#include "cli/reproducer/expected_tables.hpp"

namespace cli {

namespace {

constexpr std::string_view kTypes =
#include "embedded/types.c.inc"
    ;
constexpr std::string_view kDevice =
#include "embedded/device.c.inc"
    ;
constexpr std::string_view kDraw =
#include "embedded/draw.c.inc"
    ;
constexpr std::string_view kJudge =
#include "embedded/judge.c.inc"
    ;

// A feature that the program knows nothing of, and whether the case has it.
struct Missing {
    bool has = false;
    std::string_view name;
};

std::string_view first_of(std::initializer_list<Missing> features) {
    const auto* found =
        std::find_if(features.begin(), features.end(), [](const Missing& m) { return m.has; });
    return found == features.end() ? "" : found->name;
}

bool is_finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

std::string_view missing_of(const cases::Attribute& a) {
    const bool is_flat = a.interpolation == cases::Interpolation::flat;
    return first_of({
        {a.source != cases::Source::vertex, "an attribute that is a built-in"},
        {a.probe != cases::Probe::value, "an attribute that is looked at by a function"},
        {a.auxiliary == cases::Auxiliary::sample, "sample shading"},
        {is_flat && !std::all_of(a.values.begin(), a.values.end(), is_finite),
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
        {d.viewport_index != 0, "several viewports"},
        {d.provoking == cases::ProvokingVertex::last, "the last vertex as the provoking one"},
        {d.multisample.min_sample_shading.has_value(), "sample shading"},
        {d.depth.clip.has_value(), "depth clipping by VK_EXT_depth_clip_enable"},
        {d.depth.negative_one_to_one, "depths from -1 to 1 by VK_EXT_depth_clip_control"},
        {d.depth.bias && d.depth.bias->is_controlled(), "a bias by VK_EXT_depth_bias_control"},
    });
}

// The text inside a C string or comment: what could end either is left out.
std::string quoted(std::string_view text) {
    std::string out;
    for (const char letter : text) {
        const bool is_plain = letter >= ' ' && letter < 0x7f && letter != '"' && letter != '\\' &&
                              letter != '*' && letter != '?';
        out += is_plain ? letter : letter == '*' ? '+' : '\'';
    }
    return out;
}

std::string target_text(const cases::Target& t, const ref::Limits& limits, size_t draws,
                        size_t attributes) {
    // A UNORM format may round the clear value either way.
    const double steps = cases::depth_steps(t.depth_format);
    const double code = static_cast<double>(t.depth_clear) * steps;
    const auto clear = [&](double whole) {
        return steps > 0 ? cases::depth_of_code(static_cast<uint32_t>(whole), t.depth_format)
                         : t.depth_clear;
    };
    return fmt::format(
        "#define WIDTH {}\n#define HEIGHT {}\n#define SAMPLES {}\n#define DRAWS {}\n"
        "#define ATTRIBUTES {}\n#define SUBPIXEL_BITS {}\n#define HAS_DEPTH {:d}\n"
        "#define DEPTH_FORMAT VK_FORMAT_{}\n#define DEPTH_STEPS {:.1f}  // 0: floating point\n"
        "#define DEPTH_CLEAR {:a}F\n#define DEPTH_CLEAR_LOW {:a}F\n"
        "#define DEPTH_CLEAR_HIGH {:a}F\n\n",
        t.width, t.height, t.samples, draws, attributes, limits.subpixel_bits, t.has_depth,
        row_of(t.depth_format).vulkan_name, steps, t.depth_clear, clear(std::floor(code)),
        clear(std::ceil(code)));
}

}  // namespace

std::string_view undrawable_part(const cases::Case& c) {
    constexpr size_t kMaxDraws = 0x7fff;  // the shader packs their number into 16 bits
    const cases::Target& t = c.target;
    for (const cases::Draw& draw : c.draws) {
        if (const std::string_view missing = missing_of(draw); !missing.empty()) {
            return missing;
        }
    }
    return first_of({
        {c.blit.has_value(), "a blit"},
        {!c.relations.empty(), "a relation to another drawing of itself"},
        {t.color.has_value(), "a colour target"},
        {t.layers > 1, "several layers"},
        {!t.sample_locations.empty(), "sample locations of its own"},
        {t.has_stencil, "a stencil"},
        {t.depth_resolve != cases::Resolve::none, "a resolve"},
        {c.draws.size() > kMaxDraws, "more than 32,767 draws"},
    });
}

bool may_be_too_large(const cases::Case& c) {
    size_t attributes = 0;
    for (const cases::Draw& draw : c.draws) {
        attributes = std::max(attributes, draw.attributes.size());
    }
    const cases::Target& t = c.target;
    return size_t{t.width} * t.height * t.samples * (3 + 4 * attributes) > kMostRanges;
}

cases::Expected<std::string> reproducer(const cases::Case& c, const ref::Limits& limits,
                                        cases::Profile profile, std::string_view version) {
    if (const std::string_view missing = undrawable_part(c); !missing.empty()) {
        return cases::failure(fmt::format(
            "the case '{}' has {}, which a reproducer cannot draw; send the case file with the "
            "output of 'edgecase run' instead",
            c.id, missing));
    }
    const cases::Expected<std::string> expected = expected_tables(c, limits, profile);
    if (!expected) {
        return expected;
    }
    size_t attributes = 0;
    for (const cases::Draw& draw : c.draws) {
        attributes = std::max(attributes, draw.attributes.size());
    }
    const std::string id = quoted(c.id);
    return fmt::format(
               "// {}\n// {}\n//\n"
               "// Written by edgecase {}; https://www.apache.org/licenses/LICENSE-2.0 holds.\n"
               "// Draws the case and checks each sample: hits, the last triangle, FragCoord, "
               "depth, attributes.\n"
               "//     cc -std=c99 FILE.c -lvulkan && ./a.out [PART OF THE DEVICE'S NAME]\n"
               "// Exit code: 0 all samples are right, 1 some are wrong, 2 it could not be "
               "drawn.\n",
               id, quoted(c.description), version)
        .append(kTypes.substr(kTypes.find("#include")))
        .append(fmt::format("static const char kCase[] = \"{}\";\n"
                            "static const char kProfile[] = \"judged at profile {} with {} "
                            "subpixel bits\";\n",
                            id, to_string(profile), limits.subpixel_bits))
        .append(target_text(c.target, limits, c.draws.size(), attributes))
        .append(draw_tables(c))
        .append(*expected)
        .append(kDevice)
        .append(kDraw)
        .append(kJudge);
}

}  // namespace cli
