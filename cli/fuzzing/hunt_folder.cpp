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
#include "cli/options/stop.hpp"
#include "cli/prepare/outputs.hpp"

namespace cli {

namespace fs = std::filesystem;
using fuzz::Entry;

HuntFolder::HuntFolder(fs::path path, fuzz::Ledger& ledger)
    : path_(std::move(path)), ledger_(ledger) {
    // What is kept below them is written, and some of it deleted: of this hunt's folder alone.
    for (const char* name : {fuzz::kFound, fuzz::kKnown, fuzz::kEarlier}) {
        std::error_code none;
        if (name != fuzz::kFound && !fs::exists(fs::symlink_status(path_ / name, none))) {
            continue;  // made when it is needed
        }
        if (auto made = cases::make_folders(path_, path_ / name / "file"); !made) {
            throw stop_with(report::kExitUsage, made.error().message + "; choose another with -o");
        }
    }
    const int fd = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0 && ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(fd);
        throw stop_with(report::kExitUsage, "another hunt is writing to '" + path_.string() +
                                                "'; name another folder with -o");
    }
}

void HuntFolder::write(const std::string& name, const std::string& text) const {
    must(cases::make_folders(path_, path_ / name), report::kExitInternal);
    must(replace_text(path_ / name, text), report::kExitInternal);
}

void HuntFolder::write_ledger() const {
    must(replace_text(path_ / fuzz::kLedgerFile, fuzz::to_json(ledger_)), report::kExitInternal);
}

void HuntFolder::name_file(Entry& entry, const std::string& below) const {
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
    } while (std::ranges::any_of(ledger_.entries, is_taken) ||
             fs::exists(path_ / entry.file, none));
}

void HuntFolder::keep_earlier() {
    for (Entry& entry : ledger_.entries) {
        if (entry.file.empty()) {
            name_file(entry, fuzz::kEarlier);
            write(entry.file, entry.text);
        }
    }
    write_ledger();
}

void HuntFolder::take_out_not_reduced() {
    std::erase_if(ledger_.entries, [&](const Entry& entry) {
        if (!entry.is_reduced) {
            not_reduced_.insert(entry.file);
        }
        return !entry.is_reduced;
    });
}

void HuntFolder::keep(fuzz::Hunt& hunter, const std::function<void(const Entry&)>& tell) {
    std::set<std::string> stale;
    for (Entry& entry : hunter.entries()) {
        if (!entry.file.empty()) {
            continue;
        }
        name_file(entry, entry.is_known ? fuzz::kKnown : fuzz::kFound);
        write(entry.file, found_text(entry, ledger_));
        tell(entry);
        if (!entry.stale_file.empty()) {
            stale.insert(std::exchange(entry.stale_file, ""));
        }
    }
    ledger_.entries = hunter.entries();
    keep_not_reduced(hunter);
    ledger_.waiting = hunter.waiting();
    ledger_.left = hunter.left();
    write_ledger();
    for (const std::string& file : stale) {
        std::error_code none;
        fs::remove(path_ / file, none);
    }
}

// The files of what is not reduced change with each step: those that are reduced meanwhile go.
void HuntFolder::keep_not_reduced(const fuzz::Hunt& hunter) {
    const std::set<std::string> before = std::exchange(not_reduced_, {});
    for (Entry& entry : hunter.not_reduced()) {
        entry.file = fuzz::file_of_not_reduced(entry.first_case);
        not_reduced_.insert(entry.file);
        if (!before.contains(entry.file)) {
            entry.text = fuzz::described(entry.text, entry.symptom);
            write(entry.file, found_text(entry, ledger_));
        }
        ledger_.entries.push_back(std::move(entry));
    }
    for (const std::string& file : before) {
        std::error_code none;
        if (!not_reduced_.contains(file)) {
            fs::remove(path_ / file, none);
        }
    }
}

}  // namespace cli
