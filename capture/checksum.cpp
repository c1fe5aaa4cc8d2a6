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
    uint64_t sum = 0;
    const auto add = [&](std::string_view bytes) {
        sum = sum * 0x9e3779b97f4a7c15U + cases::checksum(kResultSeed, bytes);
    };
    add(raw(capture.hits));
    add(raw(capture.writers));
    add(raw(capture.frag_coord));
    add(raw(capture.depth));
    for (const std::span<const glm::vec4> attribute : capture.attributes) {
        add(raw(attribute));
    }
    add(raw(capture.color));
    add(raw(capture.stencil));
    add(raw(capture.resolved_color));
    add(raw(capture.resolved_depth));
    return sum;
}

uint64_t hit_bits(const CaptureView& capture) {
    return cases::checksum(kResultSeed, raw(capture.hits));
}

uint64_t capture_bytes(const cases::Case& c) {
    return plane_bytes(c.target, cases::attributes_of(c));
}

}  // namespace capture
