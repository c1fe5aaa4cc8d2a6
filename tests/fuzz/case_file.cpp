// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case file of any bytes loads or is refused with errors; what loads goes through a worker's
// bytes and back unchanged.
#include "cases/load/loader.hpp"
#include "cases/wire/case_bytes.hpp"
#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto loaded = cases::load_text(fuzz::text_of(data, size), "case.toml", "case");
    if (!loaded) {
        fuzz::require(!loaded.error().empty());
        return 0;
    }
    for (const cases::Case& c : *loaded) {
        const std::string bytes = cases::to_bytes(c);
        const auto back = cases::from_bytes(bytes);
        fuzz::require(back && cases::to_bytes(*back) == bytes);
    }
    return 0;
}
