// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

namespace fuzz {

// Random choices that are the same on every machine: std::mt19937_64 is specified bit for bit, the
// distributions of the standard library are not and are not used. Two of one expression are in no
// order (operands, arguments of a function): each gets a statement of its own.
class Dice {
  public:
    // A stream of its own for each (seed, stream, number).
    Dice(uint64_t seed, uint64_t stream, uint64_t number)
        : engine_(mix(mix(mix(seed) ^ stream) ^ number)) {}

    // 0 .. n-1; n > 0. The bias of the remainder is below n / 2^64.
    uint64_t below(uint64_t n) { return engine_() % n; }
    int64_t between(int64_t low, int64_t high) {  // both included
        return low + static_cast<int64_t>(below(static_cast<uint64_t>(high - low) + 1));
    }
    // A multiple of 1/parts from low to high, in these units.
    double fraction(int64_t low, int64_t high, int64_t parts) {
        return static_cast<double>(between(low, high)) / static_cast<double>(parts);
    }
    bool one_in(uint64_t n) { return below(n) == 0; }
    template <class T, size_t N>
    const T& of(const std::array<T, N>& list) {
        return list[below(N)];
    }

  private:
    // The finalizer of SplitMix64 [Steele, Lea, Flood, "Fast Splittable Pseudorandom Number
    // Generators", OOPSLA 2014].
    static uint64_t mix(uint64_t x) {
        x += 0x9e3779b97f4a7c15U;
        x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
        x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
        return x ^ (x >> 31U);
    }
    std::mt19937_64 engine_;
};

}  // namespace fuzz
