// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/capture.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "cases/base/float_bits.hpp"

namespace capture {

namespace {

bool is_poison(float value) {
    return std::bit_cast<uint32_t>(value) == kPoison;
}

bool is_poison(const glm::vec4& v) {
    return is_poison(v.x) || is_poison(v.y) || is_poison(v.z) || is_poison(v.w);
}

bool is_poison(const ColorCodes& codes) {
    return codes == ColorCodes{kPoison, kPoison, kPoison, kPoison};
}

using cases::same_bits;

bool is_clear(const glm::vec4& v) {
    return same_bits(v.x, kClearValue) && same_bits(v.y, kClearValue) &&
           same_bits(v.z, kClearValue) && same_bits(v.w, kClearValue);
}

bool same_bits(const glm::vec4& a, const glm::vec4& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// A count that additive blending of ones can have reached exactly.
bool is_count(float value) {
    return value >= 0.0F && value <= 0x1p23F && same_bits(value, std::floor(value));
}

template <class To, class From>
void view(From& from, To& to) {
    cases::copy_like_fields(from, to);
    for_each_plane([](const Plane&, auto& source, auto& span) { span = source; }, from, from, to);
}

// Storage of bytes holds whatever objects were written there (C++20, implicit object creation).
template <class To, class Byte>
void lay(To& to, Byte* planes) {
    for_each_plane(
        [&planes](const Plane& plane, auto& span) {
            using Span = std::remove_reference_t<decltype(span)>;
            span = Span(reinterpret_cast<typename Span::pointer>(planes), plane.entries);
            planes += span.size_bytes();
        },
        to, to);
}

}  // namespace

PlaneSpans::PlaneSpans(Capture& c) {
    view(c, *this);
}

CaptureView::CaptureView(const Capture& c) {
    view(c, *this);
}

Capture copy_of(const CaptureView& view) {
    Capture copy;
    cases::copy_like_fields(view, copy);
    for_each_plane([](const Plane&, const auto& source,
                      auto& plane) { plane.assign(source.begin(), source.end()); },
                   view, view, copy);
    return copy;
}

std::string_view name_of_plane(uint32_t number) {
    std::string_view name;
    for_each_plane(
        [&](const Plane& plane) {
            if (plane.number == number) {
                name = plane.name;
            }
        },
        Capture());
    return name;
}

uint64_t plane_bytes(const cases::Target& target, uint32_t attribute_count) {
    CaptureView shape;
    shape.target = target;
    shape.attribute_count = attribute_count;
    uint64_t bytes = 0;
    for_each_plane([&bytes]<class T>(const Plane& plane,
                                     const std::span<T>&) { bytes += plane.entries * sizeof(T); },
                   shape, shape);
    return bytes;
}

CaptureView view_planes(const cases::Target& target, bool has_primitive, uint32_t attribute_count,
                        const std::byte* planes) {
    CaptureView out;
    out.target = target;
    out.has_primitive = has_primitive;
    out.attribute_count = attribute_count;
    lay(out, planes);
    return out;
}

PlaneSpans planes_at(const cases::Target& target, uint32_t attribute_count, std::byte* planes) {
    PlaneSpans out;
    out.target = target;
    out.attribute_count = attribute_count;
    lay(out, planes);
    return out;
}

bool has_all_planes(const CaptureView& c) {
    bool fits = true;
    for_each_plane([&fits](const Plane& plane,
                           const auto& span) { fits = fits && span.size() == plane.entries; },
                   c, c);
    return fits;
}

namespace {

// The usual clear sample, in few comparisons. False says nothing.
bool is_all_clear(const CaptureView& capture, size_t index) {
    static const glm::vec4 kNoHits(0, 0, kHitGuard, kHitGuard);
    static const glm::vec4 kCleared(kClearValue);
    bool clear = same_bits(capture.hits[index], kNoHits) && capture.writers[index] == Writer{} &&
                 same_bits(capture.frag_coord[index], kCleared) &&
                 (capture.depth.empty() || is_clear_depth(capture.target, capture.depth[index]));
    clear = clear && (capture.color.empty() || !is_poison(capture.color[index]));
    for (uint32_t a = 0; clear && a < capture.attribute_count; ++a) {
        clear = same_bits(capture.attributes[a][index], kCleared);
    }
    return clear;
}

}  // namespace

bool is_clear_depth(const cases::Target& target, float depth) {
    if (target.depth_load == cases::LoadOp::dont_care ||
        target.depth_store == cases::StoreOp::dont_care) {
        return true;  // whatever it is
    }
    const double steps = depth_steps(target.depth_format);
    if (target.depth_format == cases::DepthFormat::d32_float) {
        return same_bits(depth, target.depth_clear);
    }
    const double ideal = static_cast<double>(target.depth_clear) * steps;
    return same_bits(depth, depth_of_code(static_cast<uint32_t>(ideal), target.depth_format)) ||
           same_bits(depth,
                     depth_of_code(static_cast<uint32_t>(std::ceil(ideal)), target.depth_format));
}

SampleState sample_state(const CaptureView& capture, size_t index) {
    if (!capture.target.has_instruments) {
        const bool poison = (!capture.color.empty() && is_poison(capture.color[index])) ||
                            (!capture.depth.empty() && is_poison(capture.depth[index]));
        return poison ? SampleState::not_copied : SampleState::drawn;
    }
    if (is_all_clear(capture, index)) {
        return SampleState::clear;
    }
    const glm::vec4& hits = capture.hits[index];
    const Writer& writer = capture.writers[index];
    const glm::vec4& frag_coord = capture.frag_coord[index];
    const float depth = capture.depth.empty() ? kClearDepth : capture.depth[index];

    bool poison = (!capture.color.empty() && is_poison(capture.color[index])) || is_poison(hits) ||
                  is_poison(frag_coord) || is_poison(depth) || writer.draw == kPoison ||
                  writer.primitive == kPoison || writer.provoking_vertex == kPoison ||
                  writer.spare == kPoison;
    bool attributes_clear = true;
    for (uint32_t a = 0; a < capture.attribute_count; ++a) {
        poison = poison || is_poison(capture.attributes[a][index]);
        attributes_clear = attributes_clear && is_clear(capture.attributes[a][index]);
    }
    if (poison) {
        return SampleState::not_copied;
    }

    const bool guards_hold = same_bits(hits.z, kHitGuard) && is_count(hits.x) && is_count(hits.y) &&
                             same_bits(hits.w, kHitGuard + hits.x + hits.y);
    if (!guards_hold || writer.spare != kClearId) {
        return SampleState::inconsistent;
    }
    const bool nothing_written = writer == Writer{} && is_clear(frag_coord) && attributes_clear;
    if (same_bits(hits.x + hits.y, 0.0F)) {
        return !nothing_written ? SampleState::inconsistent
               : capture.depth.empty() || is_clear_depth(capture.target, depth)
                   ? SampleState::clear
                   : SampleState::depth_only;
    }
    const bool written = writer.draw != kClearId && writer.primitive != kClearId &&
                         writer.provoking_vertex != kClearId && !is_clear(frag_coord);
    return written ? SampleState::drawn : SampleState::inconsistent;
}

}  // namespace capture
