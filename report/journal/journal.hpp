// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// journal.jsonl: one JSON object a line, each written by one write(2), so that a crash, a hang or a
// power cut loses at most the batches in flight. Records: "run" (header and the selected ids),
// "device", "begin" (a case is handed to a worker), "end" (a CaseRecord), "stop" (how the run
// ended).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "report/record/run.hpp"

namespace report {

class Journal {
  public:
    // Creates DIR/journal.jsonl (DIR must exist); `append` continues one. Error: a sentence with
    // errno.
    static cases::Expected<Journal> open(const std::filesystem::path& dir, bool append);
    ~Journal();
    Journal(Journal&&) noexcept;
    Journal& operator=(Journal&&) noexcept;

    // Each returns an error sentence if the disk is full or the file is gone.
    cases::Expected<void> write_run(
        const Run& header);  // without results; run.cases carry id, file, line, ...
    cases::Expected<void> write_device(const capture::DeviceInfo& device);
    cases::Expected<void> write_begin(const std::string& id, uint32_t attempt);
    cases::Expected<void> write_end(const CaseRecord& record);
    cases::Expected<void> write_stop(const Run& run);  // ended, seconds, interrupted

  private:
    explicit Journal(int fd) : fd_(fd) {}
    cases::Expected<void> write_line(const std::string& line);
    int fd_ = -1;
    std::string file_;
};

// Renames DIR/journal.jsonl to journal.jsonl.old, so that no command takes the run that it tells of
// for one that did not begin. False: there is none, or another run is writing it.
bool put_aside_journal(const std::filesystem::path& dir);

// Rebuilds a run from DIR/journal.jsonl. A torn last line is ignored; anything else malformed is an
// error with its line. A case with a begin but no end stays not_run; `in_flight` receives those
// ids.
cases::Expected<Run> load_journal(const std::filesystem::path& dir,
                                  std::vector<std::string>* in_flight = nullptr);
// The same for reports, with a bound on memory beside what each case takes at least: when so many
// bytes of cases that ended have been read, those that ended later keep their status, counts and
// first findings alone. Run::shortened_cases tells how many lost something.
inline constexpr size_t kDetailedBytes = size_t{64} << 20;
cases::Expected<Run> load_for_reports(const std::filesystem::path& dir,
                                      size_t detailed_bytes = kDetailedBytes);

}  // namespace report
