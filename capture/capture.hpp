// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What any renderer produced for a case, sample by sample, float bits as they are. A sample's index
// is (j * width + i) * samples + s. All but sample_state() is header only, so that the harness
// needs nothing else of this room.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cases/model/case.hpp"

namespace capture {

// Attachments are cleared to values that no case can draw (kMaxAttributeMagnitude is smaller), and
// read-back memory is filled with the poison first: 'not drawn', 'drawn with zero' and 'not copied'
// never look alike.
inline constexpr float kClearValue = -0x1.5p127F;
inline constexpr float kClearDepth = cases::kDepthClear;  // unless Target::depth_clear is another
inline constexpr uint32_t kClearId = 0xfffffff0U;
inline constexpr uint32_t kPoison = 0xffbadbadU;  // as a float: a NaN with a payload
// The two spare channels of the hits plane: kHitGuard, and kHitGuard plus all hits, so that a
// broken clear or blend is seen.
inline constexpr float kHitGuard = 4096.0F;

// What attachments are cleared to in a rendering with other clear values (cases::Variation).
inline constexpr float kOtherClearValue = -0x1.25p127F;
inline constexpr float kOtherClearDepth = 0.625F;
inline constexpr uint32_t kOtherClearId = 0xffffffedU;
inline constexpr float kOtherHitGuard = 2 * kHitGuard;

// The last fragment's origin.
struct Writer {
    uint32_t draw = kClearId;
    uint32_t primitive = kClearId;  // gl_PrimitiveID, kNoPrimitive if the device has none
    uint32_t provoking_vertex =
        kClearId;               // gl_VertexIndex of the provoking vertex, by a flat input
    uint32_t spare = kClearId;  // always kClearId
    friend bool operator==(const Writer&, const Writer&) = default;
};
inline constexpr uint32_t kNoPrimitive = 0xffffffefU;

// The stored code of each component of the colour target, widened to 32 bits: UNORM codes, float
// and half bits, integers. Components that the format lacks are 0. kPoison in all four: not copied.
using ColorCodes = std::array<uint32_t, 4>;

// Memory beside an attachment's own that a rendering has changed, before or after it.
struct StrayWrite {
    std::string attachment;  // "depth", "attribute 1"
    bool is_before = false;
    // Of the nearest word that changed: bytes from it to the attachment's first byte, or from the
    // end of the attachment's memory to it.
    uint64_t distance = 0;
    uint32_t expected = 0;  // that word
    uint32_t got = 0;
    uint64_t words = 0;       // that changed
    uint32_t renderings = 1;  // in the submission, any of which may have done it
    friend bool operator==(const StrayWrite&, const StrayWrite&) = default;
};

// Which planes a target has. Without instruments only `color` and `depth` are there.
struct Capture {
    cases::Target target;
    bool has_primitive = false;  // Writer::primitive is meaningful
    uint32_t attribute_count = 0;

    std::vector<glm::vec4> hits;        // front hits, back hits, kHitGuard, kHitGuard + hits
    std::vector<Writer> writers;        // last writer
    std::vector<glm::vec4> frag_coord;  // of the last writer
    std::vector<float> depth;           // of the last writer whose draw writes depth
    std::array<std::vector<glm::vec4>, cases::kMaxAttributes> attributes;  // of the last writer
    std::vector<ColorCodes> color;                                         // Target::color
    std::vector<uint32_t> stencil;           // Target::has_stencil; 0..255 or kPoison
    std::vector<ColorCodes> resolved_color;  // one a pixel: Target::color_resolve
    std::vector<float> resolved_depth;       // one a pixel: Target::depth_resolve

    size_t sample_count() const { return size_t{target.width} * target.rows() * target.samples; }
};

// A capture whose planes lie anywhere: in a Capture, or in memory shared with another process.
struct CaptureView {
    cases::Target target;
    bool has_primitive = false;
    uint32_t attribute_count = 0;
    std::span<const glm::vec4> hits;
    std::span<const Writer> writers;
    std::span<const glm::vec4> frag_coord;
    std::span<const float> depth;
    std::array<std::span<const glm::vec4>, cases::kMaxAttributes> attributes;
    std::span<const ColorCodes> color;
    std::span<const uint32_t> stencil;
    std::span<const ColorCodes> resolved_color;
    std::span<const float> resolved_depth;

    CaptureView() = default;
    CaptureView(const Capture& c)  // not explicit: a capture is a view of itself
        : target(c.target),
          has_primitive(c.has_primitive),
          attribute_count(c.attribute_count),
          hits(c.hits),
          writers(c.writers),
          frag_coord(c.frag_coord),
          depth(c.depth),
          color(c.color),
          stencil(c.stencil),
          resolved_color(c.resolved_color),
          resolved_depth(c.resolved_depth) {
        for (size_t a = 0; a < attributes.size(); ++a) {
            attributes[a] = c.attributes[a];
        }
    }
    size_t sample_count() const { return size_t{target.width} * target.rows() * target.samples; }
};

inline bool resolves_color(const cases::Target& target) {
    return target.color_resolve != cases::Resolve::none;
}
inline bool resolves_depth(const cases::Target& target) {
    return target.depth_resolve != cases::Resolve::none;
}

// Bytes of all planes of a capture, one after the other: hits, writers, frag_coord, attributes,
// color, depth, stencil, resolved colour and depth; those that the target has.
inline uint64_t plane_bytes(const cases::Target& target, uint32_t attribute_count) {
    const uint64_t samples = uint64_t{target.width} * target.rows() * target.samples;
    const uint64_t instruments =
        target.has_instruments
            ? sizeof(glm::vec4) * (2 + uint64_t{attribute_count}) + sizeof(Writer)
            : 0;
    const uint64_t pixels = uint64_t{target.width} * target.rows();
    const auto size_if = [](bool present, uint64_t bytes) { return present ? bytes : 0; };
    return samples * (instruments + size_if(target.color.has_value(), sizeof(ColorCodes)) +
                      size_if(target.has_depth, sizeof(float)) +
                      size_if(target.has_stencil, sizeof(uint32_t))) +
           pixels * (size_if(resolves_color(target), sizeof(ColorCodes)) +
                     size_if(resolves_depth(target), sizeof(float)));
}

// The capture whose planes lie at `planes`: plane_bytes() bytes, aligned to 16.
inline CaptureView view_planes(const cases::Target& target, bool has_primitive,
                               uint32_t attribute_count, const std::byte* planes) {
    CaptureView view;
    view.target = target;
    view.has_primitive = has_primitive;
    view.attribute_count = attribute_count;
    const size_t count = view.sample_count();
    // Storage of bytes holds whatever objects were written there (C++20, implicit object creation).
    const auto take_some = [&]<class T>(std::span<const T>& plane, size_t entries) {
        plane = std::span(reinterpret_cast<const T*>(planes), entries);
        planes += entries * sizeof(T);
    };
    const auto take = [&](auto& plane) { take_some(plane, count); };
    if (target.has_instruments) {
        take(view.hits);
        take(view.writers);
        take(view.frag_coord);
        for (uint32_t a = 0; a < attribute_count; ++a) {
            take(view.attributes[a]);
        }
    }
    if (target.color) {
        take(view.color);
    }
    if (target.has_depth) {
        take(view.depth);
    }
    if (target.has_stencil) {
        take(view.stencil);
    }
    const size_t pixels = size_t{target.width} * target.rows();
    if (resolves_color(target)) {
        take_some(view.resolved_color, pixels);
    }
    if (resolves_depth(target)) {
        take_some(view.resolved_depth, pixels);
    }
    return view;
}

// True if the planes are those that the target has, one entry a sample or resolved pixel.
inline bool has_all_planes(const CaptureView& c) {
    const size_t count = c.sample_count();
    const size_t pixels = size_t{c.target.width} * c.target.rows();
    const size_t instruments = c.target.has_instruments ? count : 0;
    bool fits = c.hits.size() == instruments && c.writers.size() == instruments &&
                c.frag_coord.size() == instruments &&
                c.color.size() == (c.target.color ? count : 0) &&
                c.depth.size() == (c.target.has_depth ? count : 0) &&
                c.stencil.size() == (c.target.has_stencil ? count : 0) &&
                c.resolved_color.size() == (resolves_color(c.target) ? pixels : 0) &&
                c.resolved_depth.size() == (resolves_depth(c.target) ? pixels : 0);
    for (uint32_t a = 0; a < c.attribute_count; ++a) {
        fits = fits && c.attributes[a].size() == instruments;
    }
    return fits;
}

// What the sample's bits say before any expectation is asked.
enum class SampleState : uint8_t {
    clear,         // nothing hit it, every attachment holds its clear value
    drawn,         // hits are whole numbers and agree with the guards and the writer
    not_copied,    // poison: read-back failed
    inconsistent,  // anything else: the attachments contradict each other
};
// Without instruments: `drawn`, which then says nothing, or `not_copied`.
SampleState sample_state(const CaptureView& capture, size_t index);

// Whether a captured depth is the target's clear value as its format stores it: the bits of D32,
// either neighbour of UNORM.
bool is_clear_depth(const cases::Target& target, float depth);

}  // namespace capture
