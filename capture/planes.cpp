// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is done to all planes of a capture alike, by their list.
#include <type_traits>

#include "capture/capture.hpp"

namespace capture {

namespace {

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

}  // namespace capture
