// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/runs.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace capture {

namespace {

template <class T>
bool same_bytes(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// How many entries have the bytes of the first one. A stretch in which every entry has those of its
// neighbour is compared at once.
template <class T>
size_t count_same(const T* at, size_t count) {
    constexpr size_t kStretch = 256;
    size_t done = std::min<size_t>(count, 1);
    while (done < count) {
        const size_t more = std::min(kStretch, count - done);
        if (std::memcmp(at + done - 1, at + done, more * sizeof(T)) == 0) {
            done += more;
            continue;
        }
        while (same_bytes(at[done], at[done - 1])) {
            ++done;
        }
        return done;
    }
    return done;
}

template <class T>
size_t count_equal(const T* at, size_t count, const T& value) {
    return count > 0 && same_bytes(*at, value) ? count_same(at, count) : 0;
}

// How many vectors have no component with the bits of the read-back memory's fill pattern.
size_t count_copied(const glm::vec4* at, size_t count) {
    constexpr size_t kStretch = 64;
    for (size_t done = 0; done < count; done += kStretch) {
        const size_t end = std::min(done + kStretch, count);
        uint32_t poisoned = 0;
        for (size_t k = done; k < end; ++k) {
            const auto bits = std::bit_cast<std::array<uint32_t, 4>>(at[k]);
            for (const uint32_t b : bits) {
                poisoned |= b == kPoison ? 1U : 0U;
            }
        }
        if (poisoned != 0) {
            return done;
        }
    }
    return count;
}

// Of a colour plane, if there is one: how many leading codes were copied from the device.
size_t count_copied_color(const CaptureView& c, size_t first, size_t count) {
    constexpr ColorCodes kNotCopied{kPoison, kPoison, kPoison, kPoison};
    if (c.color.empty()) {
        return count;
    }
    const auto begin = c.color.begin() + static_cast<std::ptrdiff_t>(first);
    return static_cast<size_t>(
        std::find(begin, begin + static_cast<std::ptrdiff_t>(count), kNotCopied) - begin);
}

}  // namespace

size_t count_clear(const CaptureView& c, size_t first, size_t count) {
    static const glm::vec4 kNoHits(0, 0, kHitGuard, kHitGuard);
    static const glm::vec4 kCleared(kClearValue);
    count = count_equal(&c.hits[first], count, kNoHits);
    count = count_equal(&c.writers[first], count, Writer{});
    count = count_equal(&c.frag_coord[first], count, kCleared);
    for (uint32_t a = 0; a < c.attribute_count; ++a) {
        count = count_equal(&c.attributes[a][first], count, kCleared);
    }
    if (!c.depth.empty()) {
        count = is_clear_depth(c.target, c.depth[first]) ? count_same(&c.depth[first], count) : 0;
    }
    return count_copied_color(c, first, count);
}

size_t count_hit_once(const CaptureView& c, size_t first, size_t count, bool is_front,
                      const Writer& writer) {
    const glm::vec4 hits(is_front ? 1 : 0, is_front ? 0 : 1, kHitGuard, kHitGuard + 1);
    count = count_equal(&c.hits[first], count, hits);
    count = count_equal(&c.writers[first], count, writer);
    for (uint32_t a = 0; a < c.attribute_count; ++a) {
        count = count_copied(&c.attributes[a][first], count);
    }
    return count_copied_color(c, first, count);
}

size_t count_same_color(const CaptureView& c, size_t first, size_t count) {
    return count_same(&c.color[first], count);
}

}  // namespace capture
