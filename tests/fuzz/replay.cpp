// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Feeds a target every file of the folders that are named and, from each, mutations: the same ones
// in every run. This is the smoke test where no libFuzzer is; it finds what a later change breaks.
//   usage: fuzz_NAME MUTATIONS FOLDER...   (MUTATIONS: a file)
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/input.hpp"

namespace {

using Bytes = std::vector<uint8_t>;

Bytes mutated(Bytes bytes, std::mt19937& random) {
    const auto below = [&](size_t n) { return n == 0 ? 0 : random() % n; };
    for (size_t edits = 1 + below(4); edits > 0; --edits) {
        const size_t at = below(bytes.size() + 1);
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        const auto rest = static_cast<size_t>(bytes.end() - place);
        const auto end = place + static_cast<std::ptrdiff_t>(std::min<size_t>(below(32), rest));
        switch (below(5)) {
            case 0:
                if (rest > 0) {
                    *place = static_cast<uint8_t>(random());
                }
                break;
            case 1:
                if (rest > 0) {
                    *place ^= static_cast<uint8_t>(1U << below(8));
                }
                break;
            case 2:
                bytes.insert(place, static_cast<uint8_t>(random()));
                break;
            case 3:
                bytes.erase(place, end);
                break;
            default: {
                const Bytes again(place, end);
                bytes.insert(place, again.begin(), again.end());
                break;
            }
        }
    }
    return bytes;
}

}  // namespace

int main(int argc, char** argv) {
    namespace fs = std::filesystem;
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s MUTATIONS FOLDER...\n", argv[0]);
        return 2;
    }
    const unsigned long mutations = std::strtoul(argv[1], nullptr, 10);
    std::vector<fs::path> files;
    for (int k = 2; k < argc; ++k) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(argv[k])) {
            if (entry.is_regular_file()) {
                files.push_back(entry.path());
            }
        }
    }
    std::sort(files.begin(), files.end());
    if (files.empty()) {
        std::fprintf(stderr, "no file to feed; name a folder that holds some\n");
        return 2;
    }
    size_t fed = 0;
    for (const fs::path& file : files) {
        std::ifstream in(file, std::ios::binary);
        const Bytes bytes{std::istreambuf_iterator<char>(in), {}};
        std::mt19937 random(static_cast<std::mt19937::result_type>(bytes.size()));
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
        for (unsigned long k = 0; k < mutations; ++k, ++fed) {
            const Bytes other = mutated(bytes, random);
            LLVMFuzzerTestOneInput(other.data(), other.size());
        }
    }
    std::printf("%zu files and %zu mutations\n", files.size(), fed);
    return 0;
}
