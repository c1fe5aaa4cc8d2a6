// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/image/image.hpp"

#include <dlfcn.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <future>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "capture/image/image_io/image_io.hpp"
#include "cases/base/limits.hpp"
#include "cases/base/output_file.hpp"
#include "cases/base/parallel.hpp"
#include "cases/base/printable.hpp"

namespace capture {

namespace {

constexpr const char* kModule = "edgecase-image-io.so";
constexpr const char* kVariable = "EDGECASE_IMAGE_IO";

struct Module {
    decltype(&edgecase_write_image) write = nullptr;
    decltype(&edgecase_read_image) read = nullptr;
};

// The module of EDGECASE_IMAGE_IO, if set; else the first there is next to the program: installed,
// or in the folder of a build.
cases::Expected<std::filesystem::path> find_module() {
    if (const char* named = std::getenv(kVariable); named != nullptr && *named != '\0') {
        return std::filesystem::path(named);
    }
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto dir = program.parent_path();
    for (const auto& candidate : {dir.parent_path() / "lib" / "edgecase" / kModule,
                                  dir.parent_path() / "lib" / kModule, dir / kModule}) {
        if (!error && std::filesystem::exists(candidate, error)) {
            return candidate;
        }
    }
    return cases::failure(
        "image files need the module {}, which is neither in {} nor in {}; "
        "get it by 'sudo apt install libopenimageio-dev && scripts/build release', or set {} to "
        "its path",
        kModule, (dir.parent_path() / "lib").string(), dir.string(), kVariable);
}

// Whether the system has so many threads more.
bool has_threads(size_t count) {
    std::promise<void> end;
    const std::shared_future<void> ends = end.get_future().share();
    std::vector<std::thread> threads;
    while (threads.size() < count) {
        std::optional<std::thread> thread = cases::try_thread([ends] { ends.wait(); });
        if (!thread) {
            break;
        }
        threads.push_back(std::move(*thread));
    }
    end.set_value();
    for (std::thread& thread : threads) {
        thread.join();
    }
    return threads.size() == count;
}

// Libraries behind OpenImageIO start five threads while they are loaded. Where the system has
// fewer, one of them (log4cplus 2.0) ends the process, or waits for ever with all signals blocked:
// hence the look before, and a thread of its own, which leaves the caller's signals alone.
cases::Expected<Module> open_module() {
    const auto path = find_module();
    if (!path) {
        return tl::unexpected(path.error());
    }
    constexpr size_t kThreads = 8;
    static std::atomic<bool> is_loaded = false;
    if (!is_loaded && !has_threads(kThreads)) {
        return cases::failure("image files need threads that cannot be started: {}",
                              cases::process_limit(EAGAIN));
    }
    // Never closed: OpenImageIO keeps threads and thread-local objects of its own.
    std::string why;
    void* const handle = cases::beside([&] {
                             void* const opened = ::dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
                             why = opened == nullptr ? ::dlerror() : "";
                             return opened;
                         }).get();
    if (handle == nullptr) {
        return cases::failure("cannot load {}: {}", path->string(), why);
    }
    is_loaded = true;
    const auto version = reinterpret_cast<decltype(&edgecase_image_io_version)>(
        ::dlsym(handle, "edgecase_image_io_version"));
    Module module;
    module.write =
        reinterpret_cast<decltype(&edgecase_write_image)>(::dlsym(handle, "edgecase_write_image"));
    module.read =
        reinterpret_cast<decltype(&edgecase_read_image)>(::dlsym(handle, "edgecase_read_image"));
    if (version == nullptr || module.write == nullptr || module.read == nullptr ||
        version() != kImageIoVersion) {
        return cases::failure("{} is not the image module of this edgecase; build both together",
                              path->string());
    }
    return module;
}

cases::Expected<void> check_format(const std::filesystem::path& file, size_t channels) {
    const std::string extension = file.extension().string();
    if (extension != ".exr" && extension != ".png" && extension != ".tif") {
        return cases::failure("cannot tell the format of {} by its ending; use .exr, .png or .tif",
                              cases::printable(file.string()));
    }
    if (extension == ".png" && channels > 4) {
        return cases::failure("{} would need {} channels, and a PNG file holds at most 4; use .exr",
                              cases::printable(file.string()), channels);
    }
    return {};
}

void keep(void* context, const EdgecaseImage* from) {
    Image& to = *static_cast<Image*>(context);
    to.width = from->width;
    to.height = from->height;
    to.channels.assign(from->names, from->names + from->channels);
    if (from->pixels != nullptr) {
        const size_t count = size_t{from->width} * from->height * from->channels;
        to.pixels.assign(from->pixels, from->pixels + count);
    }
    to.bits = from->bits;
    to.is_float = from->is_float != 0;
}

}  // namespace

cases::Expected<void> write_image(const std::filesystem::path& file, const Image& image) {
    if (auto known = check_format(file, image.channels.size()); !known) {
        return known;
    }
    constexpr uint32_t kMaxSide = 1U << 16;
    const size_t count = size_t{image.width} * image.height * image.channels.size();
    if (count == 0 || image.pixels.size() != count || image.width > kMaxSide ||
        image.height > kMaxSide) {
        return cases::failure("an image of {} x {} pixels and {} channels cannot have {} values",
                              image.width, image.height, image.channels.size(),
                              image.pixels.size());
    }
    const auto module = open_module();
    if (!module) {
        return tl::unexpected(module.error());
    }
    std::vector<const char*> names;
    for (const std::string& name : image.channels) {
        names.push_back(name.c_str());
    }
    const EdgecaseImage plain{image.width,
                              image.height,
                              static_cast<uint32_t>(names.size()),
                              names.data(),
                              image.pixels.data(),
                              32,
                              1};
    std::array<char, 1024> error{};
    std::string bytes;
    const auto keep_bytes = [](void* context, const void* from, size_t size) {
        static_cast<std::string*>(context)->assign(static_cast<const char*>(from), size);
    };
    const bool is_made =
        module->write(file.c_str(), &plain, keep_bytes, &bytes, error.data(), error.size()) == 0;
    const cases::Expected<void> written =
        is_made ? cases::write_file(file, cases::Link::followed,
                                    [&bytes](const cases::Put& put) { put(bytes); })
                : cases::failure(std::string(error.data()));
    return written ? written
                   : cases::failure("cannot write {}: {}", cases::printable(file.string()),
                                    cases::printable(written.error().message));
}

cases::Expected<Image> read_image(const std::filesystem::path& file, uint32_t width,
                                  uint32_t height) {
    if (auto known = check_format(file, 1); !known) {
        return tl::unexpected(known.error());
    }
    const auto module = open_module();
    if (!module) {
        return tl::unexpected(module.error());
    }
    Image image;
    std::array<char, 1024> error{};
    if (module->read(file.c_str(), width, height, keep, &image, error.data(), error.size()) != 0) {
        return cases::failure("cannot read {}: {}", cases::printable(file.string()),
                              cases::printable(error.data()));
    }
    return image;
}

}  // namespace capture
