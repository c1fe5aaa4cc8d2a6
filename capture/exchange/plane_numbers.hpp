// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the numbers of one plane file. It is raw (.u8, .u32, .f32, little endian, with nothing else
// in it) or an image (.png, .tif, .exr), which the image module reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"

namespace capture {

struct PlaneSpec;

// The numbers are exact, because every u32 and binary32 is a binary64.
struct PlaneNumbers {
    size_t channels = 0;
    std::vector<double> numbers;  // [entry * channels + channel], in the order of the file
    double largest = 0;           // of formats of whole numbers: 255, 65535; else 0
    double at(size_t entry, size_t channel) const { return numbers[entry * channels + channel]; }
};

// How sentences name a file; printable.
std::string quoted(const std::filesystem::path& file);

// Reads a file of a plane. Errors, one sentence each, with both sizes: an ending that the plane
// does not have, a file that is too short or too long, an image of another size or number of
// channels, values in fewer bits than 32.
cases::Expected<PlaneNumbers> read_numbers(const std::filesystem::path& file, const PlaneSpec& spec,
                                           const cases::Target& target);

}  // namespace capture
