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
    // The file's own format; whole numbers stand in `pixels` divided by the largest one.
    uint32_t bits = 32;
    bool is_float = true;
};
// Writes the format that the extension names: .exr (binary32), .png (8 bits, values 0..1) or .tif.
// It is an error if the module is missing, the format unknown or the path cannot be written.
cases::Expected<void> write_image(const std::filesystem::path& file, const Image& image);
// Reads such a file; floats keep their bits, but a NaN may lose its payload. Colours are not
// multiplied by alpha. Of an image of another size than width x height, `pixels` is empty: nothing
// is decoded.
cases::Expected<Image> read_image(const std::filesystem::path& file, uint32_t width,
                                  uint32_t height);

}  // namespace capture
