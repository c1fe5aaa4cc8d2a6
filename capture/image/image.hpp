// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Image files, through the module edgecase-image-io (OpenImageIO), opened only when one is read or
// written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cases/base/error.hpp"

namespace capture {

struct Image {
    uint32_t width = 0, height = 0;
    std::vector<std::string> channels;  // names, in order
    std::vector<float> pixels;          // [(j * width + i) * channels + c]
    // As the file has it; whole numbers stand in `pixels` divided by the largest one.
    uint32_t bits = 32;
    bool is_float = true;
};
// Format by extension: .exr (binary32), .png (8 bits, values 0..1), .tif. Errors: module missing,
// unknown format, unwritable path.
cases::Expected<void> write_image(const std::filesystem::path& file, const Image& image);
// Reads such a file; floats keep their bits, but a NaN may lose its payload. Colours are not
// multiplied by alpha.
cases::Expected<Image> read_image(const std::filesystem::path& file);

}  // namespace capture
