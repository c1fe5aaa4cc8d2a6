// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Checksums of bytes, and how they are written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cases {

// 64 bits of any number of bytes (FNV-1a over 8-byte words, four lanes). `seed` tells kinds of
// bytes apart.
uint64_t checksum(uint64_t seed, std::string_view bytes);

// Sixteen hexadecimal digits.
std::string hex(uint64_t number);

// A number made of text, the same on every machine (64-bit FNV-1a with a finalizer): shards and
// shuffling hang on it.
uint64_t stable_hash(const std::string& text, uint64_t seed);

}  // namespace cases
