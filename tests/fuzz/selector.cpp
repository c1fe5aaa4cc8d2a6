// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Selectors of any bytes, one a line, choose cases or are refused in one sentence.
#include "cases/select/selector.hpp"

#include <sstream>

#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::vector<cases::Case> all(3);
    all[0].id = "ties/apex-up";
    all[1].id = "ties/diagonal-edge:rotate=0,samples=4";
    all[2].id = "depth/less";
    std::vector<std::string> selectors;
    std::istringstream lines{std::string(fuzz::text_of(data, size))};
    for (std::string line; std::getline(lines, line);) {
        selectors.push_back(line);
    }
    std::istringstream input("ties/apex-up\n");
    const auto chosen = cases::select(all, selectors, input);
    fuzz::require(chosen ? chosen->size() <= all.size() : !chosen.error().message.empty());
    return 0;
}
