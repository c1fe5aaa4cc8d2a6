// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface of the module edgecase-image-io. It crosses no C++ type, so that a module built
// by another compiler, or found by mistake, is refused and never misread.
#pragma once

#include <cstddef>
#include <cstdint>

inline constexpr uint32_t kImageIoVersion = 4;

extern "C" {

// pixels[(j * width + i) * channels + c]
struct EdgecaseImage {
    uint32_t width, height, channels;
    const char* const* names;  // [channels]
    const float* pixels;
    uint32_t bits;      // of a number in the file read: 8, 16, 32; ignored when writing
    uint32_t is_float;  // 1: floats in the file read; 0: whole numbers, divided by the largest
};
using EdgecaseImageSink = void (*)(void* context, const EdgecaseImage* image);
using EdgecaseByteSink = void (*)(void* context, const void* bytes, size_t size);

uint32_t edgecase_image_io_version();
// Of an image that has not `width` x `height` pixels, `pixels` is null: a file of a few bytes may
// claim gigabytes. Each returns 0, or 1 with one sentence in `error` (zero-terminated, cut to
// `size` bytes). What is written is the contents of a file of such a name; the caller keeps it.
int edgecase_write_image(const char* name, const EdgecaseImage* image, EdgecaseByteSink sink,
                         void* context, char* error, size_t size);
int edgecase_read_image(const char* path, uint32_t width, uint32_t height, EdgecaseImageSink sink,
                        void* context, char* error, size_t size);
}
