// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "folders.hpp"
#include "fuzz/document/document.hpp"

namespace fuzz {

struct SuiteDocument {
    std::string name;
    std::string text;
};

// All case files of the suite, by name.
inline std::vector<SuiteDocument> suite_documents() {
    std::vector<SuiteDocument> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             test_support::source_dir() + "/cases/suite")) {
        if (entry.path().extension() == ".toml") {
            std::ostringstream content;
            content << std::ifstream(entry.path()).rdbuf();
            files.push_back({entry.path().filename().string(), content.str()});
        }
    }
    std::ranges::sort(files, {}, [](const SuiteDocument& d) { return std::pair(d.name, d.text); });
    return files;
}

}  // namespace fuzz
