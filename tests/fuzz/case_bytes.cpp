// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes of a case, changed anywhere, are refused or read as a case.
#include "cases/wire/case_bytes.hpp"

#include "cases/load/loader.hpp"
#include "tests/fuzz/input.hpp"

namespace {

constexpr std::string_view kCase = R"(format = 1
description = "A triangle with what has a list of its own."
rules = ["cover.inside"]
[target]
size = [8, 8]
samples = 4
[[draw]]
space = "clip"
vertices = [[-1,-1,0,1], [1,-1,0,1], [-1,1,0,1]]
attributes = [{ values = [0, 1, 2] }]
[draw.scissor]
rect = [0, 0, 4, 4]
)";

std::string whole_case() {
    std::string text(kCase);
    auto loaded = cases::load_text(text, "case.toml", "case");
    if (!loaded) {  // an optional part that has another form now: the rest still is a case
        text.resize(text.find("attributes"));
        loaded = cases::load_text(text, "case.toml", "case");
    }
    fuzz::require(loaded && loaded->size() == 1);
    return cases::to_bytes(loaded->front());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const std::string whole = whole_case();
    const std::string bytes = fuzz::edited(whole, fuzz::text_of(data, size));
    if (const auto back = cases::from_bytes(bytes)) {
        (void)cases::to_bytes(*back);
    }
    return 0;
}
