// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The heart of `edgecase run`: hands batches to workers, judges what they drew while they draw on,
// charges deaths to the right case, and settles every case exactly once.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "report/journal/journal.hpp"
#include "report/record/run.hpp"
#include "run/expected/expectation_file.hpp"
#include "run/judging.hpp"
#include "run/process/signal_fd.hpp"
#include "run/schedule.hpp"
#include "run/worker/start_pauses.hpp"
#include "run/worker/worker_client.hpp"

namespace run {

// One case of a run.
struct Task {
    cases::Case data;
    report::PlannedCase planned;  // of it
    std::optional<ExpectationLine> expected;
    std::string error;     // not empty: not rendered, status error
    bool alone = false;    // was in flight when an earlier run was cut off
    bool is_told = false;  // if it fails: whatever LoopConfig::most_told says
};

struct LoopConfig {
    Command command;  // starts a worker
    WorkerOptions worker;
    std::chrono::milliseconds timeout{30000};
    Schedule::Options schedule;  // its lanes: workers
    // How long the device may work on one submission; what the batches before took decides how
    // large the next one is. A case alone may take longer.
    std::optional<std::chrono::milliseconds> gpu_budget;
    JudgingOptions judging;
    // So many unexpected failures are judged with all that is told of them, and drawn again. Of
    // more, which a driver has that is wrong everywhere, the symptoms are known
    // (diff::Wanted::brief).
    size_t most_told = SIZE_MAX;
    bool requires_support = false;  // a case that is not supported counts as failed
    bool keeps_workers = false;     // take_workers() is asked for
    // Called with each verdict, as soon as it is there: a second drawing may make it a flake.
    std::function<void(const cases::Case& c, const report::CaseRecord& record)> judged = {};
    // Called with each final record before it is written: adds what else is to be told of it.
    std::function<void(const cases::Case& c, report::CaseRecord& record)> complete = {};
};

class RunLoop {
  public:
    // Called with each final record, in the order of settling; false ends the run, and the cases
    // that have no result by then are skipped.
    using OnRecord = std::function<bool(const report::CaseRecord&)>;
    // Called at least five times a second: cases settled, and those that are to be drawn again
    // because they have failed: whatever comes of that is no expected result. False ends the run as
    // on_record does.
    using OnProgress = std::function<bool(size_t settled, size_t unconfirmed)>;
    using Plan = std::shared_ptr<const std::vector<Task>>;

    // Without a journal the records go to `on_record` alone.
    RunLoop(LoopConfig config, Plan plan, report::Journal* journal, SignalFd& signals,
            OnRecord on_record, OnProgress on_progress);

    struct End {
        bool interrupted = false;
        std::string failure;  // why cases were left, or why the journal could not be written
    };
    // The first of the workers has answered with `device`; another worker with another device ends
    // the run.
    End run(std::vector<WorkerClient> workers, const capture::DeviceInfo& device);
    // After run() with keeps_workers: those that wait for work, for another run.
    std::vector<WorkerClient> take_workers();
    // After a run() that has ended early: judgements that go on are not waited for. They may take
    // minutes, of a case that needs rationals; the process ends as Pool::has_abandoned() says.
    void abandon_judgements() { judging_.abandon(); }

  private:
    struct Slot {
        std::optional<WorkerClient> client;
        std::optional<Batch> batch;
        bool sent = false;
        bool is_left_out = false;    // the system had no process for its worker
        std::vector<bool> answered;  // [k] of the batch has a result
        std::string failure;         // of the batch: why the first that failed has no result
        Clock::time_point since;
        std::vector<size_t> without_result() const;  // of the batch
    };

    void take_up(std::vector<WorkerClient> workers, const capture::DeviceInfo& device);
    void wait() const;
    void end_early();
    void feed(Slot& slot);
    void start_worker(Slot& slot);
    void advance(Slot& slot);
    void on_device(Slot& slot, const capture::DeviceInfo& device);
    void on_result(Slot& slot, CaseResult& result);
    void on_batch_done(Slot& slot);
    void on_death(Slot& slot, const Death& death);
    void on_start_failure(Slot& slot, const std::string& why);
    void judge(size_t k, CaseResult& result);
    void on_judged(size_t k, bool is_told, report::CaseRecord record);
    void settle(size_t k, report::CaseRecord record);
    void charge(report::CaseRecord& record, const Schedule::Released& death) const;
    void finish(size_t k, report::CaseRecord record);
    report::CaseRecord fresh_record(size_t k, report::Status status,
                                    const std::string& reason = {}) const;
    report::CaseRecord undrawn_record(const Slot& slot, size_t k,
                                      const capture::Rendered& rendered) const;
    report::CaseRecord flake_record(size_t k);
    bool is_unexpected(size_t k, const report::CaseRecord& record) const;
    // Of a case that an expectation knows all is told: it is compared with what it says.
    bool is_told(size_t k) const {
        return cases_[k].is_told || cases_[k].expected || failed_ < config_.most_told;
    }
    void keep_gpu_budget(const Slot& slot);
    void check(const cases::Expected<void>& written);
    void fail(const std::string& why);

    LoopConfig config_;
    Plan plan_;
    const std::vector<Task>& cases_;  // of plan_
    report::Journal* journal_;
    SignalFd& signals_;
    OnRecord on_record_;
    OnProgress on_progress_;
    Schedule schedule_;
    Judging judging_;
    std::vector<Slot> slots_;
    std::map<size_t, report::CaseRecord> judged_;  // waiting for more renderings
    std::map<size_t, report::CaseRecord> held_;    // waiting for the rest of a dead batch
    std::map<size_t, double> seconds_;
    capture::DeviceInfo device_;
    std::set<size_t> unconfirmed_;  // of judged_: unexpected failures
    size_t settled_ = 0;
    size_t failed_ = 0;              // unexpectedly; each is counted when it is judged
    std::vector<bool> is_finished_;  // [k] has its final record
    bool is_stopped_ = false;        // by on_record_ or on_progress_
    StartPauses start_pauses_;
    double seconds_per_byte_ = 0;  // of captures, while one batch is drawn; 0: not known yet
    std::future<void> ending_;     // of the workers, waited for at the end of the loop's life
    End end_;
};

}  // namespace run
