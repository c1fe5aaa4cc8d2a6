// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/image/image_io/image_io.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <vector>

namespace {

constexpr uint64_t kMaxValues = uint64_t{1} << 30;

int fail(const std::string& sentence, char* error, size_t size) {
    if (size > 0) {
        const size_t length = std::min(sentence.size(), size - 1);
        std::copy_n(sentence.begin(), length, error);
        error[length] = '\0';
    }
    return 1;
}

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string write(const char* name, const EdgecaseImage& image, std::vector<unsigned char>& bytes) {
    const auto output = OIIO::ImageOutput::create(name);
    if (!output || output->supports("ioproxy") == 0) {
        return "no writer for this kind of file: " + OIIO::geterror();
    }
    // Into memory: the writers of some formats do not tell what the file system refuses.
    OIIO::Filesystem::IOVecOutput memory(bytes);
    output->set_ioproxy(&memory);
    const bool png = ends_with(name, ".png");
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                         static_cast<int>(image.channels),
                         png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    spec.channelnames.assign(image.names, image.names + image.channels);
    std::vector<float> clean;
    const float* pixels = image.pixels;
    if (png) {
        // binary32 -> unorm8: what an 8-bit file cannot hold is black, and nothing wraps around.
        const size_t count = size_t{image.width} * image.height * image.channels;
        clean.assign(pixels, pixels + count);
        for (float& value : clean) {
            value = std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
        }
        pixels = clean.data();
    } else {
        spec.attribute("compression", "zip");  // lossless for every bit of a float
    }
    if (!output->open(name, spec) || !output->write_image(OIIO::TypeDesc::FLOAT, pixels) ||
        !output->close()) {
        const std::string reason = output->geterror();
        return reason.empty() ? "unknown error" : reason;
    }
    return {};
}

std::string read(const char* path, uint32_t wanted_width, uint32_t wanted_height,
                 EdgecaseImageSink sink, void* context) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &config);
    if (!input) {
        const std::string reason = OIIO::geterror();
        return reason.empty() ? "unknown error" : reason;
    }
    const OIIO::ImageSpec& spec = input->spec();
    const auto width = static_cast<uint64_t>(std::max(spec.width, 0));
    const auto height = static_cast<uint64_t>(std::max(spec.height, 0));
    const auto channels = static_cast<uint64_t>(std::max(spec.nchannels, 0));
    if (width == 0 || height == 0 || channels == 0 || channels > 64 ||
        width * height > kMaxValues / channels || spec.depth > 1) {
        return "the image has an unusable size";
    }
    const bool is_wanted = width == wanted_width && height == wanted_height;
    std::vector<float> pixels(is_wanted ? static_cast<size_t>(width * height * channels) : 0);
    if (is_wanted &&
        !input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data())) {
        return input->geterror();
    }
    std::vector<const char*> names;
    for (const std::string& name : spec.channelnames) {
        names.push_back(name.c_str());
    }
    names.resize(static_cast<size_t>(channels), "");
    const EdgecaseImage image{static_cast<uint32_t>(width),
                              static_cast<uint32_t>(height),
                              static_cast<uint32_t>(channels),
                              names.data(),
                              is_wanted ? pixels.data() : nullptr,
                              static_cast<uint32_t>(spec.format.basesize() * 8),
                              spec.format.is_floating_point() ? 1U : 0U};
    sink(context, &image);
    return {};
}

}  // namespace

uint32_t edgecase_image_io_version() {
    // The first call after the module is loaded. Pictures here are small, and threads of a library
    // that is never closed outlive the program's end, where a leak checker may trip over them.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    return kImageIoVersion;
}

int edgecase_write_image(const char* name, const EdgecaseImage* image, EdgecaseByteSink sink,
                         void* context, char* error, size_t size) {
    try {
        std::vector<unsigned char> bytes;
        const std::string sentence = write(name, *image, bytes);
        if (!sentence.empty()) {
            return fail(sentence, error, size);
        }
        sink(context, bytes.data(), bytes.size());
        return 0;
    } catch (const std::exception& e) {
        return fail(e.what(), error, size);
    }
}

int edgecase_read_image(const char* path, uint32_t width, uint32_t height, EdgecaseImageSink sink,
                        void* context, char* error, size_t size) {
    try {
        const std::string sentence = read(path, width, height, sink, context);
        return sentence.empty() ? 0 : fail(sentence, error, size);
    } catch (const std::exception& e) {
        return fail(e.what(), error, size);
    }
}
