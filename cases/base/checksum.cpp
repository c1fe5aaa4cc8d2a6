// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/checksum.hpp"

#include <fmt/format.h>

#include <cstring>

namespace cases {

uint64_t checksum(uint64_t seed, std::string_view bytes) {
    constexpr uint64_t kPrime = 0x100000001b3U;
    // FNV alone never carries high bits of a word downwards.
    const auto add = [](uint64_t lane, uint64_t word_or_lane) {
        lane = (lane ^ word_or_lane) * kPrime;
        return lane ^ (lane >> 29);
    };
    // Four sums side by side, because each step waits for the last; every step is a bijection of
    // the sum, so one changed word always changes the result.
    constexpr uint64_t kBasis = 0xcbf29ce484222325U;
    uint64_t a = kBasis ^ seed;
    uint64_t b = kBasis + 1;
    uint64_t c = kBasis + 2;
    uint64_t d = kBasis + 3;
    const char* const data = bytes.data();
    const auto word = [data](size_t offset) {
        uint64_t w = 0;
        std::memcpy(&w, data + offset, sizeof w);
        return w;
    };
    size_t at = 0;
    for (; at + 32 <= bytes.size(); at += 32) {
        a = add(a, word(at));
        b = add(b, word(at + 8));
        c = add(c, word(at + 16));
        d = add(d, word(at + 24));
    }
    uint64_t sum = add(add(add(a, b), c), d);
    for (; at < bytes.size(); ++at) {
        sum = add(sum, static_cast<unsigned char>(bytes[at]));
    }
    return sum ^ bytes.size();
}

std::string hex(uint64_t number) {
    return fmt::format("{:016x}", number);
}

uint64_t stable_hash(const std::string& text, uint64_t seed) {
    uint64_t h = 0xcbf29ce484222325U ^ (seed * 0x9e3779b97f4a7c15U);
    for (const char c : text) {
        h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    // splitmix64's finalizer: the low bits decide the shard
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    return h ^ (h >> 31);
}

}  // namespace cases
