// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "scene_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace histories {

namespace {

constexpr std::array<const char*, 8> kCompares = {
    "never", "less", "equal", "less-or-equal", "greater", "not-equal", "greater-or-equal",
    "always"};
constexpr std::array<const char*, 8> kStencilOps = {
    "keep",   "zero",           "replace",       "increment-clamp", "decrement-clamp",
    "invert", "increment-wrap", "decrement-wrap"};
constexpr std::array<const char*, 19> kFactors = {"zero",
                                                  "one",
                                                  "src-color",
                                                  "one-minus-src-color",
                                                  "dst-color",
                                                  "one-minus-dst-color",
                                                  "src-alpha",
                                                  "one-minus-src-alpha",
                                                  "dst-alpha",
                                                  "one-minus-dst-alpha",
                                                  "constant-color",
                                                  "one-minus-constant-color",
                                                  "constant-alpha",
                                                  "one-minus-constant-alpha",
                                                  "src-alpha-saturate",
                                                  "src1-color",
                                                  "one-minus-src1-color",
                                                  "src1-alpha",
                                                  "one-minus-src1-alpha"};
constexpr std::array<const char*, 5> kBlendOps = {"add", "subtract", "reverse-subtract", "min",
                                                  "max"};
constexpr std::array<const char*, 16> kLogicOps = {
    "clear",         "and",         "and-reverse", "copy",       "and-inverted", "no-op",
    "xor",           "or",          "nor",         "equivalent", "invert",       "or-reverse",
    "copy-inverted", "or-inverted", "nand",        "set"};
constexpr std::array<const char*, 7> kDiscards = {"none",  "odd-columns", "odd-rows", "checker",
                                                  "front", "back",        "negative"};
constexpr std::array<const char*, 3> kDiscardBy = {"kill", "demote", "terminate"};
constexpr std::array<const char*, 3> kDepths = {"d32-float", "d24-unorm", "d16-unorm"};

const char* word(bool is_true) {
    return is_true ? "true" : "false";
}

std::string numbers(const Numbers& n) {
    return fmt::format("[{}]", fmt::join(n, ", "));
}

std::string target_text(const Scene& scene) {
    std::string out =
        fmt::format("[target]\nsize = [{}, {}]\nsamples = {}\nlayers = {}\ndepth_clear = {}\n",
                    scene.width, scene.height, scene.samples, scene.layers, scene.depth_clear);
    if (scene.depth) {
        out += fmt::format("depth = \"{}\"\n", kDepths[static_cast<size_t>(*scene.depth)]);
    }
    if (scene.has_stencil) {
        out += fmt::format("stencil = true\nstencil_clear = {}\n", scene.stencil_clear);
    }
    if (!scene.has_instruments()) {
        out += fmt::format("attachments = \"{}\"\n", scene.has_depth() ? "color+depth" : "color");
    }
    std::vector<std::string> colors;
    for (const ColorTarget& color : scene.colors) {
        colors.push_back(fmt::format("{{ format = \"{}\", clear = {} }}", color.about().name,
                                     numbers(color.clear)));
    }
    if (colors.size() == 1) {
        out += "color = " + colors[0] + "\n";
    } else if (!colors.empty()) {
        out += fmt::format("color = [{}]\njudged = {}\n", fmt::join(colors, ", "), scene.judged);
    }
    return out;
}

std::string blend_part(const BlendPart& part) {
    return fmt::format("source = \"{}\", destination = \"{}\", op = \"{}\"",
                       kFactors[static_cast<size_t>(part.source)],
                       kFactors[static_cast<size_t>(part.destination)],
                       kBlendOps[static_cast<size_t>(part.op)]);
}

bool takes_second(const std::array<BlendPart, 2>& blend) {
    return blend[0].source >= Factor::src1 || blend[0].destination >= Factor::src1 ||
           blend[1].source >= Factor::src1 || blend[1].destination >= Factor::src1;
}

std::string color_text(const Draw& draw, const ColorState& color) {
    std::string out = fmt::format("{{ value = {}", numbers(color.value));
    if (color.blend) {
        out += fmt::format(", blend = {{ {}, alpha = {{ {} }} }}, constants = {}",
                           blend_part((*color.blend)[0]), blend_part((*color.blend)[1]),
                           numbers(draw.constants));
        out += takes_second(*color.blend) ? ", second = " + numbers(draw.second) : "";
    }
    if (draw.logic) {
        out += fmt::format(", logic = \"{}\"", kLogicOps[*draw.logic]);
    }
    out += draw.alpha_to_one ? ", alpha_to_one = true" : "";
    out += draw.alpha_to_coverage ? ", alpha_to_coverage = true" : "";
    if (color.write_mask != 15) {
        std::string letters;
        for (size_t c = 0; c < 4; ++c) {
            letters += (color.write_mask >> c & 1) != 0 ? std::string(1, "rgba"[c]) : "";
        }
        out += fmt::format(", write_mask = \"{}\"", letters);
    }
    return out + " }";
}

std::string face_text(const StencilFace& face) {
    return fmt::format(
        "{{ compare = \"{}\", fail = \"{}\", depth_fail = \"{}\", pass = \"{}\", compare_mask = "
        "{}, write_mask = {}, reference = {} }}",
        kCompares[face.compare], kStencilOps[static_cast<size_t>(face.fail)],
        kStencilOps[static_cast<size_t>(face.depth_fail)],
        kStencilOps[static_cast<size_t>(face.pass)], face.compare_mask, face.write_mask,
        face.reference);
}

std::string tests_text(const Scene& scene, const Draw& draw) {
    std::string out;
    if (scene.has_depth()) {
        out += fmt::format("depth = {{ compare = \"{}\", write = {}", kCompares[draw.compare],
                           word(draw.writes_depth));
        if (draw.bounds) {
            out += fmt::format(", bounds = [{}, {}]", (*draw.bounds)[0], (*draw.bounds)[1]);
        }
        out += " }\n";
    }
    if (draw.stencil) {
        out += fmt::format("stencil = {{ front = {}, back = {} }}\n", face_text((*draw.stencil)[0]),
                           face_text((*draw.stencil)[1]));
    }
    if (draw.discard != Discard::none) {
        out += fmt::format("discard = \"{}\"\ndiscard_by = \"{}\"\n",
                           kDiscards[static_cast<size_t>(draw.discard)],
                           kDiscardBy[static_cast<size_t>(draw.discard_by)]);
        out += draw.discard == Discard::negative ? "discard_attribute = \"a\"\n" : "";
    }
    if (draw.query != Query::none) {
        out += draw.query == Query::precise ? "query = \"occlusion-precise\"\n"
                                            : "query = \"occlusion\"\n";
    }
    out += draw.has_sample_shading ? "min_sample_shading = 1\n" : "";
    out += draw.early ? "early_tests = true\n" : "";
    if (draw.frag_depth) {
        out += fmt::format("frag_depth = {{ value = {}", draw.frag_depth->value);
        if (draw.frag_depth->where != Discard::none) {
            out += fmt::format(", other = {}, where = \"{}\"", draw.frag_depth->other,
                               kDiscards[static_cast<size_t>(draw.frag_depth->where)]);
        }
        out += " }\n";
    }
    return out;
}

std::string clear_text(const Scene& scene, const Draw& draw) {
    std::string out = "[[draw]]\nclear = { ";
    const auto [x, y, width, height] =
        draw.scissor.value_or(std::array<uint32_t, 4>{0, 0, scene.width, scene.height});
    out += fmt::format("rects = [[{}, {}, {}, {}]]", x, y, std::min(width, scene.width - x),
                       std::min(height, scene.height - y));
    if (draw.clear->has_color) {
        out += ", color = " + numbers(draw.colors[scene.judged].value);
    }
    out += draw.clear->depth ? fmt::format(", depth = {}", *draw.clear->depth) : "";
    out += draw.clear->stencil ? fmt::format(", stencil = {}", *draw.clear->stencil) : "";
    return out + fmt::format(" }}\nlayer = {}\n", draw.layer);
}

std::string draw_text(const Scene& scene, size_t number) {
    const Draw& draw = scene.draws[number];
    if (draw.clear) {
        return clear_text(scene, draw);
    }
    std::vector<std::string> vertices, values;
    for (size_t t = 0; t < draw.triangles.size(); ++t) {
        const Triangle& triangle = draw.triangles[t];
        for (const auto& [x, y] : corners_of(triangle)) {
            vertices.push_back(fmt::format("[{}, {}, {}]", x, y,
                                           triangle.z0 + triangle.slope * (x - triangle.x0)));
            values.push_back(fmt::format("{}", value_of(number, t)));
        }
    }
    std::string out = fmt::format("[[draw]]\nvertices = [{}]\n", fmt::join(vertices, ", "));
    out += draw.has_wide_viewport ? "viewport = [-16, -16, 32, 32]\n" : "";
    if (draw.scissor) {
        out += fmt::format("scissor = [{}]\n", fmt::join(*draw.scissor, ", "));
    }
    if (draw.culls_front || draw.culls_back) {
        out += fmt::format("cull = \"{}\"\n", !draw.culls_back    ? "front"
                                              : !draw.culls_front ? "back"
                                                                  : "front-and-back");
    }
    out += draw.clockwise ? "front_face = \"clockwise\"\n" : "";
    out += draw.rasterizer_discard ? "rasterizer_discard = true\n" : "";
    out += draw.layer != 0 ? fmt::format("layer = {}\n", draw.layer) : "";
    out += tests_text(scene, draw);
    out += draw.sample_mask != ~0U ? fmt::format("sample_mask = {}\n", draw.sample_mask) : "";
    out += draw.shader_mask ? fmt::format("shader_mask = {}\n", *draw.shader_mask) : "";
    std::vector<std::string> colors;
    for (const ColorState& color : draw.colors) {
        colors.push_back(color_text(draw, color));
    }
    if (colors.size() == 1) {
        out += "color = " + colors[0] + "\n";
    } else if (!colors.empty()) {
        out += fmt::format("color = [{}]\n", fmt::join(colors, ", "));
    }
    out += fmt::format(
        "[[draw.attribute]]\nname = \"v\"\ninterpolation = \"flat\"\nvalues = [{}]\n"
        "[[draw.attribute]]\nname = \"a\"\n",
        fmt::join(values, ", "));
    if (draw.discard == Discard::negative) {
        out += fmt::format("plane = [\"{}\"]\n", draw.sign > 0 ? fmt::format("x-{}", draw.zero)
                                                               : fmt::format("{}-x", draw.zero));
    } else {
        out += "constant = 1\n";
    }
    return out;
}

}  // namespace

std::string text_of(const Scene& scene) {
    std::string out =
        "format = 1\ndescription = \"A small case whose histories are enumerated.\"\n"
        "rules = [\"cover.inside\"]\n" +
        target_text(scene);
    for (size_t draw = 0; draw < scene.draws.size(); ++draw) {
        out += draw_text(scene, draw);
    }
    return out;
}

}  // namespace histories
