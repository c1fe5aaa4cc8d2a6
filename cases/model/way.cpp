// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/way.hpp"

#include <algorithm>
#include <array>

#include "cases/model/instances.hpp"
#include "cases/model/matrix.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/texels.hpp"

namespace cases {

namespace {

// Codes of 8 bits from 8 to 247, other ones for other numbers; 31, 67, 101 and 149 have no factor
// in common with 240.
glm::vec4 color_of(size_t number) {
    glm::vec4 color{};
    constexpr std::array<size_t, 4> kSteps = {31, 67, 101, 149};
    for (size_t k = 0; k < kSteps.size(); ++k) {
        const size_t code = 8 + (number * kSteps.at(k) + 60 * k) % 240;
        color[static_cast<int>(k)] = static_cast<float>(code) / 255.0F;
    }
    return color;
}

// No draw's: its codes are below all of theirs.
constexpr glm::vec4 kClear(0, 0, 0, 0);

// The case without instruments, queries and relations, which look at the case as it stands.
Case plain(const Case& c) {
    Case out = c;
    out.claim.expected_hits.reset();
    out.relations.clear();
    out.doors.clear();
    out.target.frame = Frame::copied;
    out.target.has_instruments = false;
    out.target.color_resolve = out.target.depth_resolve = out.target.stencil_resolve =
        Resolve::none;
    for (Draw& draw : out.draws) {
        draw.query = Query::none;
        draw.matrix = false;
    }
    return out;
}

// Whether the ways of a colour of their own take a case: one that has no colour.
bool is_colorless(const Case& c) {
    return !c.blit && c.target.has_instruments && !c.target.color;
}

// The attachment of depth goes, and all that looks at it; what clips or clamps by it stays.
void drop_depth(Case& c) {
    c.target.has_depth = c.target.names_depth = false;
    c.target.depth_format = DepthFormat::d32_float;
    c.target.depth_clear = kDepthClear;
    for (Draw& draw : c.draws) {
        draw.depth.compare = CompareOp::always;
        draw.depth.write = true;
        draw.depth.bounds.reset();
        draw.depth.bias.reset();
        draw.frag_depth.reset();
    }
}

void drop_stencil(Case& c) {
    c.target.has_stencil = false;
    c.target.stencil_clear = 0;
    for (Draw& draw : c.draws) {
        draw.stencil = {};
    }
}

void drop_color(Case& c) {
    c.target.color.reset();
    c.target.other_colors.clear();
    c.target.judged_color = 0;
    for (Draw& draw : c.draws) {
        draw.color = {};
        draw.other_colors.clear();
    }
}

bool tests_depth(const Case& c) {
    return c.target.has_depth && std::ranges::any_of(c.draws, [](const Draw& draw) {
               return draw.depth.compare != CompareOp::always || draw.depth.bounds;
           });
}

// The triangles to one rgba8-unorm colour and nothing else.
Case bare_color(const Case& c) {
    Case out = plain(c);
    drop_depth(out);
    drop_stencil(out);
    out.target.color = ColorTarget{ColorFormat::rgba8_unorm, kClear};
    for (size_t k = 0; k < out.draws.size(); ++k) {
        out.draws[k].color.value = color_of(k);
        out.draws[k].early_tests = false;
    }
    return out;
}

// Whether each sample may be judged by itself, or read through a buffer.
bool has_few_samples(const Case& c, uint64_t most = uint64_t{1} << 17U) {
    return uint64_t{c.target.width} * c.target.rows() * c.target.samples <= most;
}

// Texture coordinates of a vertex: corners of the texture by turns, a few texels inside, at other
// places in their texels.
glm::vec4 coordinates_of(size_t vertex) {
    const auto texels = [](size_t corner, size_t place) {
        const size_t sixteenths = 16 * (corner == 0 ? 5 : kTexels - 6) + 2 * (place % 8) + 1;
        return static_cast<float>(sixteenths) / (16.0F * kTexels);
    };
    return {texels(vertex % 2, 3 * vertex), texels(vertex / 2 % 2, 5 * vertex + vertex / 8), 0, 0};
}

// The values of the attribute by which a texture is read; all instances read the same.
Attribute read_at(ColorFrom from, const Draw& draw) {
    Attribute at;
    at.name = "at";
    at.components = 2;
    for (size_t k = 0; k < draw.positions.size(); ++k) {
        const size_t v = k % draw.vertex_count();
        // Of a mask a corner of each triangle is cut off.
        at.values.push_back(from == ColorFrom::mask
                                ? glm::vec4(v % 3 == 0 ? -0.375F : 0.625F, v / 3 % 2, 0, 0)
                            : from == ColorFrom::texels ? coordinates_of(v)
                                                        : glm::vec4(v % 2, v / 2 % 2, 0, 0));
    }
    return at;
}

template <ColorFrom kFrom>
std::optional<Case> from(const Case& c) {
    constexpr uint64_t kMostTexels = uint64_t{1} << 14U;  // their coordinates are judged one by one
    if (!is_colorless(c) || (kFrom > ColorFrom::rendered && !has_few_samples(c, kMostTexels))) {
        return std::nullopt;
    }
    Case out = bare_color(c);
    if constexpr (kFrom != ColorFrom::push_constant) {
        for (Draw& draw : out.draws) {
            // Their shader does nothing else.
            if (draw.discard != Discard::none || draw.multisample.shader_mask) {
                return std::nullopt;
            }
            draw.color.from = kFrom;
            draw.attributes.clear();
            if (is_texture(kFrom)) {
                draw.attributes.push_back(read_at(kFrom, draw));
            }
            if (kFrom == ColorFrom::mask) {
                draw.color.value.w = 1;
                draw.discard = Discard::negative;
                draw.discard_attribute = 0;
            } else if (kFrom == ColorFrom::texels) {
                draw.color.value = {};
                draw.color.attribute = 0;
            }
        }
    }
    return out;
}

bool has_tested_value(const Draw& draw) {
    return discards_by_value(draw);
}

// The colour is an input, another one at each vertex.
std::optional<Case> from_input(const Case& c, bool is_flat) {
    // Each sample has a colour of its own to judge.
    if (!is_colorless(c) || !has_few_samples(c) || std::ranges::any_of(c.draws, has_tested_value)) {
        return std::nullopt;
    }
    Case out = bare_color(c);
    for (size_t k = 0; k < out.draws.size(); ++k) {
        Draw& draw = out.draws[k];
        Attribute at;
        at.name = "color";
        at.components = 4;
        at.interpolation = is_flat ? Interpolation::flat : Interpolation::smooth;
        // A flat one is another in each instance, and not at each vertex.
        const bool is_of_instance = is_flat && draw.instances > 1;
        at.divisor = is_of_instance ? std::optional(1U) : std::nullopt;
        for (size_t v = 0; v < draw.positions.size(); ++v) {
            const size_t vertices = draw.vertex_count();
            at.values.push_back(color_of(16 * k + (is_of_instance ? v / vertices : v % vertices)));
        }
        draw.attributes = {std::move(at)};
        draw.color = {};
        draw.color.attribute = 0;
    }
    return out;
}

std::optional<Case> smooth(const Case& c) {
    return from_input(c, false);
}
std::optional<Case> flat(const Case& c) {
    return from_input(c, true);
}

// As sprites and user interfaces are drawn.
std::optional<Case> blended(const Case& c) {
    std::optional<Case> out = from<ColorFrom::push_constant>(c);
    if (!out) {
        return std::nullopt;
    }
    for (Draw& draw : out->draws) {
        using F = BlendFactor;
        draw.color.blend = Blend{{F::src_alpha, F::one_minus_src_alpha, BlendOp::add},
                                 {F::one, F::one_minus_src_alpha, BlendOp::add}};
    }
    return out;
}

// With the depth and the stencil that the case tests.
std::optional<Case> beside(const Case& c) {
    if (!is_colorless(c) || (!tests_depth(c) && !c.target.has_stencil)) {
        return std::nullopt;
    }
    Case out = plain(c);
    out.target.color = ColorTarget{ColorFormat::rgba8_unorm, kClear};
    for (size_t k = 0; k < out.draws.size(); ++k) {
        out.draws[k].color.value = color_of(k);
    }
    return out;
}

// A shadow map.
std::optional<Case> depth_alone(const Case& c) {
    const auto writes = [](const Draw& draw) { return draw.depth.write; };
    if (c.blit || !c.target.has_depth || !std::ranges::any_of(c.draws, writes)) {
        return std::nullopt;
    }
    Case out = plain(c);
    drop_stencil(out);
    drop_color(out);
    return out;
}

// Each fragment adds 1 to the stencil, or takes 1 away, as shadow volumes do, unless the case has a
// stencil of its own.
std::optional<Case> stencil_alone(const Case& c) {
    if (c.blit || tests_depth(c)) {
        return std::nullopt;
    }
    Case out = plain(c);
    drop_depth(out);
    drop_color(out);
    out.target.has_stencil = true;
    return out;
}

// All depths first, then the colours of what is nearest.
std::optional<Case> prepass(const Case& c) {
    const auto is_simple = [](const Draw& draw) {
        return draw.depth.write && draw.discard == Discard::none && !draw.frag_depth;
    };
    // At profile vulkan each second drawing may pass or fail, so that the paths of many triangles
    // at one sample are too many to follow.
    constexpr size_t kMostTriangles = 16;
    size_t triangles = 0;
    for (const Draw& draw : c.draws) {
        const size_t corners = draw.element_count();
        triangles += draw.instances * (draw.topology == Topology::triangle_list ? corners / 3
                                       : corners < 3                            ? 0
                                                                                : corners - 2);
    }
    if (!is_colorless(c) || !c.target.has_depth || c.target.has_stencil || tests_depth(c) ||
        triangles > kMostTriangles || !std::ranges::all_of(c.draws, is_simple)) {
        return std::nullopt;
    }
    Case out = plain(c);
    out.target.depth_clear = 1;
    out.target.color = ColorTarget{ColorFormat::rgba8_unorm, kClear};
    for (size_t k = 0; k < out.draws.size(); ++k) {
        out.draws[k].color.value = color_of(k);
        out.draws[k].depth.compare = CompareOp::less_or_equal;
    }
    std::vector<Draw> first = out.draws;
    for (Draw& draw : first) {
        draw.color.write_mask = 0;
    }
    for (Draw& draw : out.draws) {
        draw.depth.compare = CompareOp::equal;
        draw.depth.write = false;
    }
    out.draws.insert(out.draws.begin(), first.begin(), first.end());
    return out;
}

std::optional<Case> by_matrix(const Case& c) {
    const auto is_plain = [](const Draw& draw) {
        return draw.layer == 0 && draw.viewport_index == 0 && draw.distances.clip_count == 0 &&
               draw.distances.cull_count == 0 && !is_instanced(draw) &&
               takes_matrix(draw.positions);
    };
    std::optional<Case> out = from<ColorFrom::constant>(c);
    if (!out || !std::ranges::all_of(c.draws, is_plain)) {
        return std::nullopt;
    }
    for (Draw& draw : out->draws) {
        draw.matrix = true;
    }
    return out;
}

std::optional<Case> in_frame(Frame frame, const Case& c, std::optional<Case> out) {
    const bool is_read = c.target.samples == 1 && has_few_samples(c) &&
                         c.target.depth_format != DepthFormat::d24_unorm;
    if (!out || (frame == Frame::sampled && !is_read)) {
        return std::nullopt;
    }
    out->target.frame = frame;
    return out;
}
std::optional<Case> sampled(const Case& c) {
    return in_frame(Frame::sampled, c, from<ColorFrom::constant>(c));
}
std::optional<Case> depth_sampled(const Case& c) {
    return in_frame(Frame::sampled, c, depth_alone(c));
}
std::optional<Case> second(const Case& c) {
    return in_frame(Frame::second, c, from<ColorFrom::uniform>(c));
}

std::optional<Case> part(const Case& c) {
    return in_frame(Frame::part, c, from<ColorFrom::storage>(c));
}
std::optional<Case> depth_part(const Case& c) {
    return in_frame(Frame::part, c, depth_alone(c));
}

constexpr std::string_view kColorless = "cases without a colour target";
constexpr std::string_view kPlain = "cases without a colour target, discards and shader masks";
constexpr std::string_view kFewSamples =
    "cases of up to 16384 samples without a colour target, discards and shader masks";
constexpr std::string_view kOneSample =
    "cases of one sample a pixel, of up to 131072, without a colour target, discards and shader "
    "masks";
constexpr std::array kWays = {
    WayRow{"bare-color-push",
           "One rgba8-unorm colour alone is drawn to; each draw pushes its colour.", kColorless,
           from<ColorFrom::push_constant>},
    WayRow{"bare-color-constant",
           "One rgba8-unorm colour alone is drawn to; it is a specialization constant.", kPlain,
           from<ColorFrom::constant>},
    WayRow{"bare-color-uniform",
           "One rgba8-unorm colour alone is drawn to; it lies in a uniform buffer.", kPlain,
           from<ColorFrom::uniform>},
    WayRow{"bare-color-offset",
           "One rgba8-unorm colour alone is drawn to; it lies in a uniform buffer, at a dynamic "
           "offset.",
           kPlain, from<ColorFrom::uniform_offset>},
    WayRow{"bare-color-storage",
           "One rgba8-unorm colour alone is drawn to; it lies in a storage buffer.", kPlain,
           from<ColorFrom::storage>},
    WayRow{"bare-color-texture",
           "One rgba8-unorm colour alone is drawn to; it is read from a texture that was uploaded, "
           "at interpolated coordinates.",
           kPlain, from<ColorFrom::texture>},
    WayRow{"bare-color-rendered",
           "One rgba8-unorm colour alone is drawn to; it is read from an image that was rendered "
           "to before.",
           kPlain, from<ColorFrom::rendered>},
    WayRow{"bare-color-smooth",
           "One rgba8-unorm colour alone is drawn to; each vertex has a colour, which is "
           "interpolated.",
           "cases of up to 131072 samples without a colour target and discards by value", smooth},
    WayRow{"bare-color-flat",
           "One rgba8-unorm colour alone is drawn to; it is the provoking vertex's.",
           "cases of up to 131072 samples without a colour target and discards by value", flat},
    WayRow{"bare-color-texels",
           "One rgba8-unorm colour alone is drawn to; it is the texel at interpolated coordinates, "
           "which tells where it lies.",
           kFewSamples, from<ColorFrom::texels>},
    WayRow{"bare-color-mask",
           "One rgba8-unorm colour alone is drawn to; a mask texture cuts a corner off each "
           "triangle, where the shader discards.",
           kFewSamples, from<ColorFrom::mask>},
    WayRow{"bare-color-matrix",
           "One rgba8-unorm colour alone is drawn to; the vertex shader multiplies positions by a "
           "matrix of powers of two.",
           "cases without a colour target, discards, shader masks, layers, viewport indices, "
           "instances, clip and cull distances, and numbers near the ends of binary32",
           by_matrix},
    WayRow{"bare-color-sampled",
           "One rgba8-unorm colour alone is drawn to, an image without transfer usage, which a "
           "shader reads.",
           kOneSample, sampled},
    WayRow{"bare-color-second",
           "One rgba8-unorm colour alone is drawn to; the same commands are submitted a second "
           "time, with other vertices.",
           kPlain, second},
    WayRow{"bare-color-part",
           "One rgba8-unorm colour alone is drawn to, a part of one layer and mip level of an "
           "image.",
           kPlain, part},
    WayRow{"bare-color-blended",
           "One rgba8-unorm colour alone is drawn to; each draw pushes its colour, which is "
           "blended by alpha.",
           kColorless, blended},
    WayRow{"bare-beside",
           "The triangles are drawn to one rgba8-unorm colour beside the depth and the stencil of "
           "the case.",
           "cases without a colour target that test depths or have a stencil", beside},
    WayRow{"bare-depth",
           "Depth alone is attached, as for a shadow map; without discards and written depths "
           "there is no fragment shader.",
           "cases that write depths", depth_alone},
    WayRow{"bare-depth-sampled",
           "Depth alone is attached, an image without transfer usage, which a shader reads.",
           "cases of one sample a pixel that write depths, of d32-float or d16-unorm, of up to "
           "131072 samples",
           depth_sampled},
    WayRow{"bare-depth-part",
           "Depth alone is attached, a part of one layer and mip level of an image.",
           "cases that write depths", depth_part},
    WayRow{"bare-stencil",
           "A stencil alone is attached, which counts the fragments of front and back faces.",
           "cases that test no depths", stencil_alone},
    WayRow{"prepass",
           "All draws write their depths with LESS_OR_EQUAL and no colour, then all draw colours "
           "with EQUAL.",
           "cases of up to 16 triangles without colour target, stencil, depth test, discards and "
           "written depths",
           prepass},
};

}  // namespace

std::span<const WayRow> all_ways() {
    return kWays;
}

std::vector<std::string> way_words() {
    std::vector<std::string> words;
    for (const WayRow& way : kWays) {
        words.emplace_back(way.word);
    }
    return words;
}

std::optional<Case> by_way(const WayRow& way, const Case& c) {
    const auto is_clear = [](const Draw& draw) { return draw.clear.has_value(); };
    if (c.draws.empty() || c.target.has_operations() || std::ranges::any_of(c.draws, is_clear) ||
        !split_way(c.id).way.empty()) {
        return std::nullopt;
    }
    std::optional<Case> out = way.make(c);
    if (out) {
        out->id = c.id + "@" + std::string(way.word);
    }
    return out;
}

WayId split_way(std::string_view id) {
    const size_t at = id.rfind('@');
    if (at == std::string_view::npos || at == 0) {
        return {id, {}};
    }
    const std::string_view way = id.substr(at + 1);
    const bool is_word = std::ranges::all_of(way, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '*';
    });
    return is_word ? WayId{id.substr(0, at), way} : WayId{id, {}};
}

}  // namespace cases
