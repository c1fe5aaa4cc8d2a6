// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the fuzz targets share. A target is a function of some bytes that returns whatever they are;
// a crash, a sanitizer's report or require() is a bug. clang's libFuzzer feeds it (scripts/fuzz);
// other builds feed it the corpus and a fixed number of mutations of it (replay.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace fuzz {

inline std::string_view text_of(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// A promise of the parser that does not hold: ends the program, so that the input is kept.
inline void require(bool holds) {
    if (!holds) {
        std::abort();
    }
}

// A valid message with the edits that the input holds, four bytes each: two of a place, one that
// says what is done there, one new byte. A parser of bytes with a checksum or many lengths is not
// reached by random bytes; by these it is.
inline std::string edited(std::string whole, std::string_view edits) {
    for (; edits.size() >= 4 && !whole.empty(); edits.remove_prefix(4)) {
        const auto byte = [&](size_t k) { return static_cast<unsigned char>(edits[k]); };
        const size_t at = (byte(0) * size_t{256} + byte(1)) % whole.size();
        switch (byte(2) % 4) {
            case 0:
                whole[at] = edits[3];
                break;
            case 1:
                whole.resize(at);
                break;
            case 2:
                whole.insert(at, 1, edits[3]);
                break;
            default:
                whole.erase(at, byte(3));
                break;
        }
    }
    return whole;
}

}  // namespace fuzz
