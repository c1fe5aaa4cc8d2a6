// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From a case and what was drawn of it to the record that the reports show.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/consistency.hpp"
#include "diff/delivered.hpp"
#include "ref/position/limits.hpp"
#include "report/record/run.hpp"
#include "run/process/process.hpp"

namespace cli {

enum class KeepPictures { none, failed, all };

// The record of a case before it has run: what the file says of it.
report::CaseRecord make_record(const cases::Case& c);

// What a worker has found besides the capture: in comparing the case's derived renderings with it,
// one result a derivation, and beside the attachments' memory.
struct WorkerFindings {
    std::span<const diff::Consistency> consistency;
    std::span<const diff::StrayWrite> stray_writes;
};

// Judges a capture, and what the worker has found besides, into `record`: pass, fail, or error if
// the case or the capture cannot be judged.
void judge(report::CaseRecord& record, const cases::Case& c, const diff::CaptureView& capture,
           const WorkerFindings& found, const ref::Limits& limits, cases::Profile profile,
           KeepPictures pictures);

// The same of what another program delivered: at least one plane, sizes as the case's target.
void judge_delivered(report::CaseRecord& record, const cases::Case& c,
                     const diff::Delivered& planes, const ref::Limits& limits,
                     cases::Profile profile, KeepPictures pictures);

// What can be said of a case before any device is asked: empty, or why the reference disagrees with
// the picture drawn by hand.
std::string check_before_running(const cases::Case& c);

// A hash of every bit of a capture.
uint64_t capture_bits(const diff::CaptureView& capture);
// Sixteen hexadecimal digits.
std::string hex(uint64_t number);
// Bytes that a case's capture takes.
uint64_t capture_bytes(const cases::Case& c);

// Threads that work through tasks; a descriptor becomes readable when results wait.
class Pool {
  public:
    explicit Pool(unsigned threads);
    ~Pool();  // tasks not begun are dropped
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    // `work` runs on a thread, `finish` later on the thread that calls collect().
    void submit(std::function<void()> work, std::function<void()> finish);
    // Runs the `finish` of all tasks whose work is done.
    void collect();
    // Tasks submitted and not yet collected.
    size_t outstanding() const { return outstanding_; }
    int fd() const { return event_.get(); }
    // Waits until a result can be collected.
    void wait() const;

  private:
    struct Task {
        std::function<void()> work, finish;
    };
    void run();
    Fd event_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task> waiting_, done_;
    bool stop_ = false;
    size_t outstanding_ = 0;  // of the submitting thread alone
    std::vector<std::thread> threads_;
};

}  // namespace cli
