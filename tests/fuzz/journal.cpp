// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A journal of any bytes loads or is refused; every report can be made of what loads.
#include "report/journal/journal.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "report/files/json.hpp"
#include "report/files/junit.hpp"
#include "report/page/html.hpp"
#include "tests/fuzz/input.hpp"

namespace {

struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string name =
            (std::filesystem::temp_directory_path() / "edgecase-fuzz-XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Folder folder;
    std::ofstream(folder.path / "journal.jsonl", std::ios::binary) << fuzz::text_of(data, size);
    std::vector<std::string> in_flight;
    const auto run = report::load_journal(folder.path, &in_flight);
    if (!run) {
        fuzz::require(!run.error().message.empty());
        return 0;
    }
    (void)report::to_json(*run);
    (void)report::to_junit(*run);
    (void)report::to_html(*run);
    return 0;
}
