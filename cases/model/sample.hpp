// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The samples of a target: their numbers, locations and masks; and what a draw's fragments do to
// them, pixel by pixel: those that the shader discards, depths that it writes, depth bounds.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"

namespace cases {

// Names a sample of a target by its pixel (x, y) in a layer.
struct SampleId {
    uint32_t x = 0, y = 0, sample = 0, layer = 0;
    friend bool operator==(const SampleId&, const SampleId&) = default;
};

// Where a sample stands in planes, expectations and pictures, and back: the layers are stacked,
// layer 0 first, ((layer * height + y) * width + x) * samples + s.
inline size_t index_of(const Target& target, const SampleId& s) {
    return ((size_t{s.layer} * target.height + s.y) * target.width + s.x) * target.samples +
           s.sample;
}
inline SampleId sample_at(const Target& target, size_t index) {
    const size_t pixel = index / target.samples;
    const size_t row = pixel / target.width;
    return {static_cast<uint32_t>(pixel % target.width), static_cast<uint32_t>(row % target.height),
            static_cast<uint32_t>(index % target.samples),
            static_cast<uint32_t>(row / target.height)};
}

// Sample locations inside a pixel in 1/16 pixel, sample 0 first, one a sample.
using SampleLocations = std::vector<std::array<uint8_t, 2>>;

// Those that Vulkan names, which a device promises by standardSampleLocations. Source: Vulkan
// specification, "Multisampling". `samples` is 1, 2, 4, 8 or 16.
std::span<const std::array<uint8_t, 2>> standard_sample_locations(uint32_t samples);

// Lists as words, each location as x,y: "4,4;12,12 6,2;14,6;2,10;10,14", one list a sample count.
std::string to_text(std::span<const SampleLocations> lists);
// Lists of 2, 4, 8 or 16 locations, or what is wrong with the text.
Expected<std::vector<SampleLocations>> parse_sample_locations(std::string_view text);

// The locations of a target: its own (VK_EXT_sample_locations) or else the standard ones.
std::span<const std::array<uint8_t, 2>> sample_locations(const Target& target);

// Whether the sample mask lets sample s be written (Vulkan specification, "Sample Mask Test": bit s
// of word 0). The shader's mask is the same for every fragment here, so that it is one more AND.
bool is_in_mask(const Multisample& state, uint32_t s);

// Names the pixel of a sample: "pixel (3, 4)", in a target of several layers "layer 1, pixel (3,
// 4)".
std::string pixel_text(const Target& target, const SampleId& id);
// The same, in a target of several samples with the sample: "pixel (3, 4), sample 2".
std::string sample_text(const Target& target, const SampleId& id);

// Fragments that the fragment shader discards. Source: Vulkan specification, "Fragment Shading" and
// "Early Fragment Test Mode"; SPIR-V specification, OpKill and EarlyFragmentTests; docs/rules.md.
//
// A discarded fragment has no effect on any attachment. Which are discarded is exact by the pixel,
// whose integer coordinates the shader takes from gl_FragCoord, and by the face; by an attribute it
// is as sure as the attribute's value is (ref/value/sign.cpp). So where the tests come after the
// shader, or nothing is tested, the draw covers fewer samples. With early tests such a fragment
// covers its sample, and is tested and stored like any other; no hit and no value shows it.

inline bool discards_pixel(Discard discard, uint32_t x, uint32_t y) {
    switch (discard) {
        case Discard::odd_columns:
            return x % 2 == 1;
        case Discard::odd_rows:
            return y % 2 == 1;
        case Discard::checker:
            return (x + y) % 2 == 1;
        default:
            return false;
    }
}

inline bool discards_face(Discard discard, bool front) {
    return discard == (front ? Discard::front : Discard::back);
}

inline bool discards_by_value(const Draw& draw) {
    return draw.discard == Discard::negative;
}
inline bool discards_by_value(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) { return discards_by_value(draw); });
}
// Numbers nearer to 0 may be taken for 0 ("Denormalized values": a device may flush them).
inline constexpr float kLeastNormal = 0x1p-126F;

// Whether what a draw discards has been tested and stored before. What a clear stores is no
// fragment either.
inline bool stores_discarded(const Draw& draw) {
    return draw.clear || (draw.early_tests && draw.discard != Discard::none);
}
inline bool stores_discarded(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) { return stores_discarded(draw); });
}

// Depths that the fragment shader writes (Vulkan specification, "Depth Replacement": they replace
// the fragment's own in each of its samples, and are what is tested; no bias is added to them).
// With early tests the depth has been tested and stored before, and nothing that is written counts.
inline bool replaces_depth(const Draw& draw) {
    return draw.frag_depth && !draw.early_tests;
}
// Whether it is gl_FragCoord.z.
inline bool replaces_depth_by_coord(const Draw& draw) {
    return replaces_depth(draw) && draw.frag_depth->is_coord;
}
// The number that every fragment of the pixel then has, clamped if depth is; nothing if it is not
// written or gl_FragCoord.z.
inline std::optional<float> written_depth(const Draw& draw, uint32_t x, uint32_t y) {
    if (!replaces_depth(draw) || draw.frag_depth->is_coord) {
        return std::nullopt;
    }
    const FragDepth& d = *draw.frag_depth;
    const float z = discards_pixel(d.where, x, y) ? d.other : d.value;
    const auto [low, high] = std::minmax(draw.viewport.min_depth, draw.viewport.max_depth);
    return draw.depth.clamp ? std::clamp(z, low, high) : z;
}

// Whether a draw tests what is stored by its depth bounds ("If ... there is no depth attachment,
// the coverage mask is unmodified by this operation": Vulkan specification, "Depth Bounds Test").
inline bool tests_bounds(const Case& c) {
    return c.target.has_depth && std::ranges::any_of(c.draws, [](const Draw& draw) {
               return draw.depth.bounds.has_value();
           });
}

// Whether some draw has a query.
inline bool asks_queries(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) { return draw.query != Query::none; });
}
inline bool is_statistic(Query query) {
    return query >= Query::input_vertices;
}
inline bool is_occlusion(Query query) {
    return query == Query::occlusion || query == Query::occlusion_precise;
}
// Whether what a query gives depends on what becomes of fragments at each sample, and whether some
// draw has such a one.
inline bool counts_fragments(Query query) {
    return is_occlusion(query) || query == Query::fragment_invocations;
}
inline bool counts_fragments(const Case& c) {
    return std::ranges::any_of(c.draws,
                               [](const Draw& draw) { return counts_fragments(draw.query); });
}

// Fragments of several pixels (VK_KHR_fragment_shading_rate): a block whose first pixel has
// coordinates that are multiples of its sides. Source: Vulkan specification, "Multisampling", where
// pixel (x, y) of the framebuffer is p_x = x % f_w, p_y = y % f_h of its fragment.
struct PixelBlock {
    uint32_t x = 0, y = 0, width = 1, height = 1;  // the last ones may lie beyond the target
    friend bool operator==(const PixelBlock&, const PixelBlock&) = default;
};
inline bool has_large_fragments(const Draw& draw) {
    return draw.fragment_size[0] > 1 || draw.fragment_size[1] > 1;
}
inline bool has_large_fragments(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) { return has_large_fragments(draw); });
}
inline PixelBlock fragment_block(const Draw& draw, uint32_t x, uint32_t y) {
    const auto [width, height] = draw.fragment_size;
    return {x - x % width, y - y % height, width, height};
}
// The samples of all of its pixels.
inline constexpr uint32_t kMaxFragmentSamples = 32;  // of the cases here
inline uint32_t samples_of_fragment(const Draw& draw, const Target& target) {
    return draw.fragment_size[0] * draw.fragment_size[1] * target.samples;
}
// The coverage index of a sample in its fragment: j = i + r ((f_w f_h) - 1 - p), p = p_x + p_y f_w
// (ibid.): the last pixel's samples come first.
inline uint32_t coverage_index(const PixelBlock& block, const Target& target, const SampleId& id) {
    const uint32_t p = (id.x - block.x) + (id.y - block.y) * block.width;
    return id.sample + target.samples * (block.width * block.height - 1 - p);
}
// gl_ShadingRateEXT: log2 of the width, times 4, and log2 of the height (SPIR-V, "Fragment Shading
// Rate": Vertical2Pixels 1, Vertical4Pixels 2, Horizontal2Pixels 4, Horizontal4Pixels 8).
inline uint32_t shading_rate_bits(const Draw& draw) {
    return draw.fragment_size[0] / 2 * 4 + draw.fragment_size[1] / 2;
}
// Whether anything asks for the extension: a fragment of several pixels, or its rate.
inline bool asks_shading_rate(const Draw& draw) {
    return has_large_fragments(draw) ||
           std::ranges::any_of(draw.attributes,
                               [](const Attribute& a) { return a.source == Source::shading_rate; });
}

// What alpha to coverage leaves of a fragment's coverage: all of it, none, or any part. Source:
// Vulkan specification, "Multisample Coverage": a mask of which each bit is determined by alpha is
// ANDed, by no specific algorithm; skipped if the output is of integers. Direct3D 11.3, 17.18: no
// sample where alpha is 0 or less or NaN, all where it is 1 or more; off where the shader writes a
// mask. What one sample a pixel comes to is left open: Vulkan's text says of it what it says of
// several, and of Direct3D's nothing is taken for it.
enum class AlphaCoverage : uint8_t { all, none, any };
AlphaCoverage alpha_coverage(const Draw& draw, const Target& target, Profile profile);

// Whether a fragment is as if it had never been.
inline bool takes_away_pixel(const Draw& draw, uint32_t x, uint32_t y) {
    return !draw.early_tests && discards_pixel(draw.discard, x, y);
}
inline bool takes_away_by_value(const Draw& draw) {
    return !draw.early_tests && discards_by_value(draw);
}
inline bool takes_away_face(const Draw& draw, bool front) {
    return !draw.early_tests && discards_face(draw.discard, front);
}
// Whether some fragments of some draw are taken away by their pixel, or by a value there.
inline bool takes_away_pixels(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) {
        return takes_away_pixel(draw, 1, 0) || takes_away_pixel(draw, 0, 1) ||
               takes_away_by_value(draw);
    });
}

}  // namespace cases
