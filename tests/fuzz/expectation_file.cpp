// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// An expectation file of any bytes, of either format, parses or is refused; what parses can be
// asked. So does a file of pictures, which is the same once it is written.
#include "run/expected/expectation_file.hpp"

#include "run/expected/seen_pictures.hpp"
#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    for (const bool for_update : {false, true}) {
        const auto file =
            run::parse_expectations(fuzz::text_of(data, size), "f.txt", "2026-01-01", for_update);
        if (!file) {
            fuzz::require(!file.error().empty());
            continue;
        }
        capture::DeviceInfo device;
        device.name = "llvmpipe (LLVM 15.0.6, 256 bits)";
        device.driver_info = "Mesa 22.3.6 (LLVM 15.0.6)";
        (void)run::mismatch(*file, device, cases::Profile::vulkan);
        (void)run::resolve_expectations({*file}, {"ties/a", "ties/a:k=1", "depth/b"}, false);
    }
    const auto pictures = run::parse_pictures(fuzz::text_of(data, size), "f.pictures");
    if (!pictures) {
        fuzz::require(!pictures.error().empty());
        return 0;
    }
    const std::string text = run::to_text(*pictures);
    const auto again = run::parse_pictures(text, "f.pictures");
    fuzz::require(again && again->bits == pictures->bits && run::to_text(*again) == text);
    return 0;
}
