// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads UTF-8 of untrusted bytes (The Unicode Standard, table 3-7: no overlong forms, surrogates).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cases {

// One step through bytes: a code point, or one byte that begins none.
struct CodePoint {
    uint32_t value = 0;
    size_t length = 1;   // bytes
    bool valid = false;  // else value is the byte
};
// The code point at `at`, which must be less than bytes.size().
CodePoint code_point_at(std::string_view bytes, size_t at);

bool is_utf8(std::string_view bytes);

}  // namespace cases
