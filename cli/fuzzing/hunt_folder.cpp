// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/hunt_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "cases/base/output_file.hpp"
#include "fuzz/ledger.hpp"

namespace cli {

namespace fs = std::filesystem;
using fuzz::Entry;

void open_hunt_folder(const fs::path& path) {
    // What is kept below them is written, and some of it deleted: of this hunt's folder alone.
    for (const char* name : {fuzz::kFound, fuzz::kKnown, fuzz::kEarlier}) {
        std::error_code none;
        if (name != fuzz::kFound && !fs::exists(fs::symlink_status(path / name, none))) {
            continue;  // made when it is needed
        }
        if (auto made = cases::make_folders(path, path / name / "file"); !made) {
            throw stop_with(report::kExitUsage, made.error().message + "; choose another with -o");
        }
    }
    const int fd = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0 && ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(fd);
        throw stop_with(report::kExitUsage, "another hunt is writing to '" + path.string() +
                                                "'; name another folder with -o");
    }
}

void name_file(Entry& entry, const std::string& below, const std::vector<Entry>& entries,
               const fs::path& folder) {
    const std::string what = entry.symptom.status == report::Status::fail
                                 ? entry.symptom.rule
                                 : std::string(report::to_string(entry.symptom.status));
    size_t number = 1;
    std::error_code none;
    const auto is_taken = [&](const Entry& other) {
        return &other != &entry && other.file == entry.file;
    };
    do {
        entry.file = fmt::format("{}/{:03}-{}.toml", below, number++, what);
    } while (std::any_of(entries.begin(), entries.end(), is_taken) ||
             fs::exists(folder / entry.file, none));
}

}  // namespace cli
