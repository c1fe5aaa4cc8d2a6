// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a driver prints is kept within its limit and made printable: valid UTF-8 without control
// characters, so no byte of it can steer a terminal or break a report.
#include "cases/base/printable.hpp"
#include "run/process/process.hpp"
#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    run::HeadAndTail kept;
    for (size_t at = 0; at < size; at += 61) {
        kept.add(fuzz::text_of(data + at, std::min<size_t>(61, size - at)));
    }
    const std::string text = kept.text();
    fuzz::require(text.size() <= run::HeadAndTail::kLimit + 200);
    fuzz::require(size > run::HeadAndTail::kLimit || text == fuzz::text_of(data, size));
    const std::string shown = cases::printable(text);
    for (const char c : shown) {
        const auto byte = static_cast<unsigned char>(c);
        fuzz::require((byte >= 0x20 || byte == '\n' || byte == '\t') && byte != 0x7f);
    }
    fuzz::require(cases::printable(shown) == shown);
    return 0;
}
