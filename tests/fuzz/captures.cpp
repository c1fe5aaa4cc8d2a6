// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A delivered plane of any bytes is read or refused. The input's first byte says which plane of the
// case it is, the second in which raw format; pictures are the image library's.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "capture/exchange/plane_files.hpp"
#include "cases/load/loader.hpp"
#include "tests/fuzz/input.hpp"

namespace {

struct Delivery {
    std::filesystem::path path;
    cases::Case c;
    std::vector<capture::PlaneSpec> planes;
    Delivery() {
        std::string name =
            (std::filesystem::temp_directory_path() / "edgecase-fuzz-XXXXXX").string();
        path = ::mkdtemp(name.data());
        auto loaded = cases::load_text(
            "format = 1\ndescription = \"A triangle.\"\nrules = [\"cover.inside\"]\n[target]\n"
            "size = [4, 4]\n[[draw]]\nvertices = [[0,0], [4,0], [0,4]]\n",
            "case.toml", "case");
        fuzz::require(loaded.has_value());
        c = std::move(loaded->front());
        planes = capture::planes_of(c);
    }
    ~Delivery() { std::filesystem::remove_all(path); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Delivery delivery;
    if (size < 2) {
        return 0;
    }
    const capture::PlaneSpec& plane = delivery.planes[data[0] % delivery.planes.size()];
    constexpr const char* kRaw[] = {"u8", "u32", "f32"};
    const std::filesystem::path folder = delivery.path / capture::folder_of(delivery.c.id);
    std::filesystem::create_directories(folder);
    const std::filesystem::path file = folder / (plane.name + "." + kRaw[data[1] % 3]);
    std::ofstream(file, std::ios::binary) << fuzz::text_of(data + 2, size - 2);
    const auto read = capture::read_planes(folder, delivery.c);
    fuzz::require(read.has_value() || !read.error().message.empty());
    std::filesystem::remove(file);
    return 0;
}
