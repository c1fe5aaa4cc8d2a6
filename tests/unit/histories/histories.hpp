// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// All histories of fragments that a sample may have, by trying every answer to what is open.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "device.hpp"
#include "planes.hpp"

namespace histories {

class Random {
  public:
    explicit Random(uint64_t seed) : numbers_(seed) {}
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(numbers_() % count); }
    bool chance(uint32_t of, uint32_t in) { return below(in) < of; }
    uint64_t bits() { return numbers_(); }
    template <class T>
    const T& of(const std::vector<T>& list) {
        return list[below(static_cast<uint32_t>(list.size()))];
    }

  private:
    std::mt19937_64 numbers_;
};

// What a sample may hold in the end, each outcome as often as histories have it.
std::vector<Seen> histories_of(const Scene& scene, const Place& place, const Freedom& freedom,
                               const Kept& kept, const Fault& fault = {});

// All decisions of a pixel's invocations whose sign is open, or one if there is none.
std::vector<Kept> decisions_of(const Scene& scene, const Place& place, const Freedom& freedom);

// A picture of a device that does what the profile leaves it, at random.
std::vector<Seen> picture_of(const Scene& scene, cases::Profile profile, Random& random);

// Whether some history of the sample's pixel shows what the planes of `picture` do, at all of its
// samples.
bool is_allowed(const Scene& scene, cases::Profile profile, const Planes& planes,
                const std::vector<Shown>& picture, size_t index);

}  // namespace histories
