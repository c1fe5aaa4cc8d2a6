// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/exchange/plane_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>

#include "capture/exchange/plane_files.hpp"
#include "capture/image/image.hpp"
#include "cases/base/printable.hpp"

namespace capture {

namespace fs = std::filesystem;

namespace {

std::string size_text(const cases::Target& target) {
    return fmt::format("{} x {} pixels{}{}", target.width, target.height,
                       target.layers == 1 ? "" : fmt::format(", {} layers", target.layers),
                       target.samples == 1 ? "" : fmt::format(", {} samples", target.samples));
}

uint32_t little_endian(const unsigned char* bytes) {
    return bytes[0] | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
}

cases::Expected<PlaneNumbers> read_raw(const fs::path& file, const std::string& ending,
                                       const PlaneSpec& spec, const cases::Target& target) {
    const uint64_t entries = uint64_t{target.width} * target.rows() * target.samples;
    const size_t bytes = ending == "u8" ? 1 : 4;
    std::error_code error;
    const uint64_t size = fs::file_size(file, error);
    if (error) {
        return cases::failure("{} cannot be read: {}", quoted(file), error.message());
    }
    PlaneNumbers out;
    std::string sizes;
    for (size_t channels = spec.least_channels; channels <= spec.channels.size(); ++channels) {
        if (size == entries * channels * bytes) {
            out.channels = channels;
        }
        sizes += fmt::format("{}{} bytes ({} channel{} of {})", sizes.empty() ? "" : " or ",
                             entries * channels * bytes, channels, channels == 1 ? "" : "s",
                             bytes == 1 ? "1 byte" : "4 bytes");
    }
    if (out.channels == 0) {
        return cases::failure("{} has {} bytes; {} take {}", quoted(file), size, size_text(target),
                              sizes);
    }
    std::vector<unsigned char> raw(size);
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(raw.data()), static_cast<std::streamsize>(size))) {
        return cases::failure("{} cannot be read: {}", quoted(file), std::strerror(errno));
    }
    out.largest = ending == "u8" ? 255 : 0;
    out.numbers.reserve(entries * out.channels);
    for (size_t k = 0; k < entries * out.channels; ++k) {
        const unsigned char* at = &raw[k * bytes];
        out.numbers.push_back(ending == "u8" ? *at
                              : ending == "u32"
                                  ? little_endian(at)
                                  : static_cast<double>(std::bit_cast<float>(little_endian(at))));
    }
    return out;
}

// Which channel of the image is channel k of the plane: by the plane's own names, by those of
// colours or coordinates, or else by order.
std::vector<size_t> channels_of(const Image& image, const PlaneSpec& spec) {
    const auto lower = [](std::string name) {
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
        return name;
    };
    for (const std::vector<std::string>& names :
         {spec.channels, {"r", "g", "b", "a"}, {"x", "y", "z", "w"}}) {
        std::vector<size_t> order;
        for (size_t k = 0; k < std::min(names.size(), image.channels.size()); ++k) {
            for (size_t c = 0; c < image.channels.size(); ++c) {
                if (lower(image.channels[c]) == names[k]) {
                    order.push_back(c);
                }
            }
        }
        if (order.size() >= std::min(spec.channels.size(), image.channels.size())) {
            return order;
        }
    }
    std::vector<size_t> order(image.channels.size());
    for (size_t k = 0; k < order.size(); ++k) {
        order[k] = k;
    }
    return order;
}

// A picture in grey may have been written as one of three or four channels.
bool is_grey(const Image& image) {
    const size_t channels = image.channels.size();
    for (size_t k = 0; k < image.pixels.size(); k += channels) {
        for (size_t c = 1; c < 3; ++c) {
            if (!std::equal_to<>()(image.pixels[k], image.pixels[k + c])) {
                return false;
            }
        }
    }
    return true;
}

std::string wrong_channels(const fs::path& file, size_t count, const PlaneSpec& spec) {
    return fmt::format("{} has {} channel{}; the plane {} has {} ({})", quoted(file), count,
                       count == 1 ? "" : "s", spec.name, spec.channels.size(),
                       fmt::join(spec.channels, ", "));
}

cases::Expected<PlaneNumbers> read_picture(const fs::path& file, const PlaneSpec& spec,
                                           const cases::Target& target) {
    const cases::Expected<Image> image =
        read_image(file, target.width, target.rows() * target.samples);
    if (!image) {
        return tl::unexpected(image.error());
    }
    if (image->width != target.width || image->height != target.rows() * target.samples) {
        return cases::failure(
            "{} has {} x {} pixels; {} take an image of {} x {}{}{}", quoted(file), image->width,
            image->height, size_text(target), target.width, target.rows() * target.samples,
            target.layers == 1 ? "" : ", the rows of each layer below those of the one before",
            target.samples == 1 ? "" : ", the rows of each sample below those of the one before");
    }
    const bool needs_floats = spec.kind == PlaneKind::value || spec.kind == PlaneKind::id;
    const bool is_right_kind = needs_floats ? image->is_float && image->bits == 32
                               : spec.kind == PlaneKind::code
                                   ? !image->is_float && image->bits <= 16
                                   : image->is_float || image->bits <= 16;
    if (!is_right_kind) {
        return cases::failure("{} has {}-bit {}, which the plane {} does not take; write {}",
                              quoted(file), image->bits,
                              image->is_float ? "floats" : "whole numbers", spec.name,
                              needs_floats ? "32-bit floats" : "8 or 16 bits");
    }
    const size_t found = image->channels.size();
    const bool is_grey_picture =
        spec.kind == PlaneKind::mask && (found == 3 || found == 4) && is_grey(*image);
    const bool is_right =
        is_grey_picture || (found >= spec.least_channels && found <= spec.channels.size());
    if (!is_right) {
        return cases::failure(wrong_channels(file, found, spec));
    }
    PlaneNumbers out;
    out.channels = is_grey_picture ? 1 : found;
    out.largest = image->is_float ? 0 : std::ldexp(1.0, static_cast<int>(image->bits)) - 1;
    const std::vector<size_t> order = channels_of(*image, spec);
    const size_t entries = size_t{image->width} * image->height;
    for (size_t k = 0; k < entries; ++k) {
        for (size_t c = 0; c < out.channels; ++c) {
            const auto v =
                static_cast<double>(image->pixels[k * found + (is_grey_picture ? 0 : order[c])]);
            // Whole numbers come as v / largest, rounded to binary32: less than half a step off.
            out.numbers.push_back(image->is_float ? v : std::round(v * out.largest));
        }
    }
    return out;
}

}  // namespace

std::string quoted(const fs::path& file) {
    return "'" + cases::printable(file.string()) + "'";
}

cases::Expected<PlaneNumbers> read_numbers(const fs::path& file, const PlaneSpec& spec,
                                           const cases::Target& target) {
    const std::string ending = file.extension().empty() ? "" : file.extension().string().substr(1);
    if (std::ranges::find(spec.endings, ending) == spec.endings.end()) {
        return cases::failure("{} has no ending that the plane {} may have; use .{}", quoted(file),
                              spec.name, fmt::join(spec.endings, ", ."));
    }
    const bool is_raw = ending == "u8" || ending == "u32" || ending == "f32";
    return is_raw ? read_raw(file, ending, spec, target) : read_picture(file, spec, target);
}

}  // namespace capture
