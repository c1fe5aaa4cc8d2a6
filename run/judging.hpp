// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures that are judged on threads while the next ones are drawn, and the memory that waits.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "cases/model/case.hpp"
#include "report/record/run.hpp"
#include "run/judge.hpp"
#include "run/process/pool.hpp"
#include "run/worker/worker_client.hpp"

namespace run {

struct JudgingOptions {
    ref::Limits limits;  // of the device
    cases::Profile profile = cases::Profile::direct3d;
    KeepPictures pictures = KeepPictures::failed;
    Judge judge = {};  // empty: run::judge with these limits, profile and pictures
};

class Judging {
  public:
    explicit Judging(const JudgingOptions& options);
    // Judges what was drawn of a case, and gives collect() the record, its verdict included. A
    // judgement may outlive this object (abandon()), so it shares the case. `pictures`: what is
    // kept of this one, if that is not what the options say.
    void submit(std::shared_ptr<const cases::Case> c, CaseResult&& result,
                report::CaseRecord record, std::function<void(report::CaseRecord)> finish,
                std::optional<KeepPictures> pictures = {});
    // Whether captures of too many bytes wait for anything more to be drawn.
    bool is_full() const;
    // Of the pool (process/pool.hpp).
    int fd() const { return pool_.fd(); }
    void collect() { pool_.collect(); }
    void abandon() { pool_.abandon(); }

  private:
    JudgingOptions options_;
    uint64_t bytes_ = 0;  // of the captures that wait
    Pool pool_;
};

}  // namespace run
