// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws and judges cases on one device, call by call, with the isolation of a run and with workers
// that live on from call to call: for whoever decides by results what is drawn next.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "report/record/run.hpp"
#include "run/run_loop.hpp"

namespace run {

class Session {
  public:
    // `first` is a worker that has answered with `device`, whose limits the config has.
    Session(LoopConfig config, WorkerClient first, capture::DeviceInfo device, SignalFd& signals);

    struct Results {
        std::vector<report::CaseRecord> records;  // of the cases, in their order
        bool interrupted = false;                 // by a signal; then some are not_run
        std::string failure;                      // why some are not_run: no device any more
    };
    // The ids of the cases differ. `on_progress` is called at least five times a second with the
    // number of cases that are done; false ends the call, and what has no result by then is
    // skipped. Judgements that an end finds at work are not waited for, nor is one by a signal.
    Results draw(std::vector<cases::Case> cases,
                 const std::function<bool(size_t done)>& on_progress = {});

    // Draws cases whose ids differ, without judging them.
    struct Pictures {
        std::vector<capture::Drawn> pictures;  // of the cases, in their order
        bool interrupted = false;
        std::string failure;
    };
    Pictures pictures(std::vector<cases::Case> cases);

  private:
    LoopConfig config_;
    std::vector<WorkerClient> workers_;
    capture::DeviceInfo device_;
    SignalFd& signals_;
};

// As Session::draw, by whatever draws.
using DrawAndJudge = std::function<Session::Results(
    std::vector<cases::Case> cases, const std::function<bool(size_t done)>& on_progress)>;

}  // namespace run
