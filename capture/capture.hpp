// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What any renderer produced for a case, sample by sample, float bits as they are. A sample's index
// is cases::index_of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
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

// Memory beside an attachment's own that a rendering has changed, before or after it, or texels
// beside it in its image.
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
    std::string texel = {};  // of texels, the first: "(67, 3) of layer 0, level 1"; words: how many
    static void fields(auto&& visit, auto&... w) {
        visit("attachment", w.attachment...);
        visit("is_before", w.is_before...);
        visit("distance", w.distance...);
        visit("expected", w.expected...);
        visit("got", w.got...);
        visit("words", w.words...);
        visit("renderings", w.renderings...);
        visit("texel", w.texel...);
    }
    friend bool operator==(const StrayWrite&, const StrayWrite&) = default;
};

// In place of a count: the query never had a result.
inline constexpr uint64_t kNotCounted = UINT64_MAX;
// The same in a derived rendering: its queries of pipeline statistics are not asked.
inline constexpr uint64_t kNotAsked = UINT64_MAX - 1;

// What was captured, and a plane of each kind; a Store is a vector of entries or a view of them. A
// plane that the target lacks is empty (for_each_plane says which).
template <template <class> class Store>
struct Planes {
    cases::Target target;
    bool has_primitive = false;  // Writer::primitive is meaningful
    uint32_t attribute_count = 0;
    // What the draws' queries counted, one number a draw, 0 where a draw has none: samples where an
    // occlusion query is precise, else 0 or 1 for any; a statistic; kNotCounted where it never had
    // a result. Empty if no draw of the case has a query.
    std::vector<uint64_t> counted;

    Store<glm::vec4> hits;        // front hits, back hits, kHitGuard, kHitGuard + hits
    Store<Writer> writers;        // last writer
    Store<glm::vec4> frag_coord;  // of the last writer
    std::array<Store<glm::vec4>, cases::kMaxAttributes> attributes;  // of the last writer
    Store<float> depth;                // of the last writer whose draw writes depth
    Store<ColorCodes> color;           // Target::color
    Store<uint32_t> stencil;           // Target::has_stencil; 0..255 or kPoison
    Store<ColorCodes> resolved_color;  // one a pixel: Target::color_resolve
    Store<float> resolved_depth;       // one a pixel: Target::depth_resolve
    Store<uint32_t> resolved_stencil;  // one a pixel: Target::stencil_resolve; 0..255 or kPoison

    size_t sample_count() const { return size_t{target.width} * target.rows() * target.samples; }
    // All but the planes, which travel as they lie (for_each_plane).
    static void fields(auto&& visit, auto&... p) {
        visit("target", p.target...);
        visit("has_primitive", p.has_primitive...);
        visit("attribute_count", p.attribute_count...);
        visit("counted", p.counted...);
    }
};

// The numbers of the planes, in the order of for_each_plane.
inline constexpr uint32_t kHitsPlane = 0;
inline constexpr uint32_t kWritersPlane = 1;
inline constexpr uint32_t kFragCoordPlane = 2;
inline constexpr uint32_t kAttributePlane = 3;  // of attribute 0; the others follow
inline constexpr uint32_t kDepthPlane = kAttributePlane + cases::kMaxAttributes;
inline constexpr uint32_t kColorPlane = kDepthPlane + 1;
inline constexpr uint32_t kStencilPlane = kColorPlane + 1;
inline constexpr uint32_t kResolvedColorPlane = kStencilPlane + 1;
inline constexpr uint32_t kResolvedDepthPlane = kResolvedColorPlane + 1;
inline constexpr uint32_t kResolvedStencilPlane = kResolvedDepthPlane + 1;
inline constexpr uint32_t kPlaneNumbers = kResolvedStencilPlane + 1;

// A plane of the list below: its number, how reports call it and how many entries it has, one a
// sample or one a resolved pixel; 0 if the target has no such plane.
struct Plane {
    uint32_t number = 0;
    const char* name = "";
    size_t entries = 0;
};

// The one list of planes, in the order in which they lie in memory: calls visit(plane, p...) with
// the vector or span of each. `shape` says which planes there are: anything with the target and the
// attribute count. Without instruments only colour, depth and what hangs on them are there.
template <class Shape, class... P>
void for_each_plane(auto&& visit, const Shape& shape, P&... p) {
    static constexpr std::array<const char*, cases::kMaxAttributes> kAttributeNames = {
        "attribute 0", "attribute 1", "attribute 2", "attribute 3"};
    const cases::Target& target = shape.target;
    const size_t pixels = size_t{target.width} * target.rows();
    const size_t samples = pixels * target.samples;
    const auto if_there = [](bool is_there, size_t entries) { return is_there ? entries : 0; };
    const size_t instruments = if_there(target.has_instruments, samples);
    uint32_t number = 0;
    const auto add = [&](const char* name, size_t entries, auto&... planes) {
        visit(Plane{number++, name, entries}, planes...);
    };
    add("hits", instruments, p.hits...);
    add("writers", instruments, p.writers...);
    add("frag_coord", instruments, p.frag_coord...);
    for (uint32_t a = 0; a < cases::kMaxAttributes; ++a) {
        add(kAttributeNames[a], if_there(a < shape.attribute_count, instruments),
            p.attributes[a]...);
    }
    add("depth", if_there(target.has_depth, samples), p.depth...);
    add("color", if_there(target.color.has_value(), samples), p.color...);
    add("stencil", if_there(target.has_stencil, samples), p.stencil...);
    add("resolved_color", if_there(target.color_resolve != cases::Resolve::none, pixels),
        p.resolved_color...);
    add("resolved_depth", if_there(target.depth_resolve != cases::Resolve::none, pixels),
        p.resolved_depth...);
    add("resolved_stencil", if_there(target.stencil_resolve != cases::Resolve::none, pixels),
        p.resolved_stencil...);
}

// "hits", "attribute 1", ...; empty for a number that no plane has.
std::string_view name_of_plane(uint32_t number);

namespace detail {
template <class T>
using Vector = std::vector<T>;
template <class T>
using ConstSpan = std::span<const T>;
template <class T>
using Span = std::span<T>;
}  // namespace detail

struct Capture : Planes<detail::Vector> {};

// Planes that lie anywhere, to be written.
struct PlaneSpans : Planes<detail::Span> {
    PlaneSpans() = default;
    explicit PlaneSpans(Capture& c);
};

// A capture whose planes lie anywhere: in a Capture, or in memory shared with another process.
struct CaptureView : Planes<detail::ConstSpan> {
    CaptureView() = default;
    CaptureView(const Capture& c);  // not explicit: a capture is a view of itself
};

// With planes of its own.
Capture copy_of(const CaptureView& view);

inline bool resolves_color(const cases::Target& target) {
    return target.color_resolve != cases::Resolve::none;
}
inline bool resolves_depth(const cases::Target& target) {
    return target.depth_resolve != cases::Resolve::none;
}
inline bool resolves_stencil(const cases::Target& target) {
    return target.stencil_resolve != cases::Resolve::none;
}
inline bool resolves(const cases::Target& target) {
    return resolves_color(target) || resolves_depth(target) || resolves_stencil(target);
}

// Bytes of all planes of a capture, one after the other: those that the target has.
uint64_t plane_bytes(const cases::Target& target, uint32_t attribute_count);

// The capture whose planes lie at `planes`: plane_bytes() bytes, aligned to 16.
CaptureView view_planes(const cases::Target& target, bool has_primitive, uint32_t attribute_count,
                        const std::byte* planes);
// The same, to be written.
PlaneSpans planes_at(const cases::Target& target, uint32_t attribute_count, std::byte* planes);

// True if the planes are those that the target has, one entry a sample or resolved pixel.
bool has_all_planes(const CaptureView& c);

// What the sample's bits say before any expectation is asked.
enum class SampleState : uint8_t {
    clear,         // nothing hit it, every attachment holds its clear value
    drawn,         // hits are whole numbers and agree with the guards and the writer
    depth_only,    // nothing hit it, and it is clear but for its depth
    not_copied,    // poison: read-back failed
    inconsistent,  // anything else: the attachments contradict each other
};
// Without instruments: `drawn`, which then says nothing, or `not_copied`.
SampleState sample_state(const CaptureView& capture, size_t index);

// Whether a captured depth is the target's clear value as its format stores it: the bits of D32,
// either neighbour of UNORM.
bool is_clear_depth(const cases::Target& target, float depth);

}  // namespace capture
