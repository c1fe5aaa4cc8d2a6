// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/checksum.hpp"

#include <span>
#include <string_view>

#include "cases/base/checksum.hpp"
#include "cases/model/derive.hpp"

namespace capture {

namespace {

// Any number would do; this one keeps the checksums of older reports.
constexpr uint64_t kResultSeed = 8;

template <class T>
std::string_view raw(std::span<const T> v) {
    return {reinterpret_cast<const char*>(v.data()), v.size_bytes()};
}

}  // namespace

uint64_t capture_bits(const CaptureView& capture) {
    // In older reports depth came before the attributes, so it does here, and no stencil was
    // resolved.
    std::vector<uint64_t> sums;
    for_each_plane(
        [&sums](const Plane& plane, const auto& entries) {
            if (plane.number == kResolvedStencilPlane && entries.empty()) {
                return;
            }
            const auto at =
                plane.number == kDepthPlane ? sums.begin() + kAttributePlane : sums.end();
            sums.insert(at, cases::checksum(kResultSeed, raw(entries)));
        },
        capture, capture);
    constexpr uint64_t kFactor = 0x9e3779b97f4a7c15U;
    uint64_t sum = 0;
    for (const uint64_t of_plane : sums) {
        sum = sum * kFactor + of_plane;
    }
    if (!capture.counted.empty()) {
        sum = sum * kFactor + cases::checksum(kResultSeed, raw(std::span(capture.counted)));
    }
    return sum;
}

uint64_t hit_bits(const CaptureView& capture) {
    return cases::checksum(kResultSeed, raw(capture.hits));
}

uint64_t capture_bytes(const cases::Case& c) {
    return plane_bytes(c.target, cases::attributes_of(c));
}

}  // namespace capture
