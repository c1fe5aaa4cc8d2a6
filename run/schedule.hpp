// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which case is rendered next, with which others, and how often: pure bookkeeping, no processes.
//
// Cases are first rendered in batches. When a batch dies, its cases without a result are rendered
// one by one in fresh workers, so that only the culprit is charged, confirmed alone; if none of
// them dies alone, the first of them is charged as a flake, because the death must not be
// lost. Failures are rendered again, unexpected ones alone; different bits make a flake.
//
// Each worker has a lane of cases that follow each other in the suite: neighbours share pipelines,
// and what one worker has compiled no other compiles again. A worker whose lane is empty takes over
// the back half of the longest one.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "report/record/run.hpp"

namespace run {

struct Batch {
    std::vector<size_t> cases;
    uint32_t attempt = 1;
    bool fresh = false;  // needs a worker that has rendered nothing yet
};

class Schedule {
  public:
    struct Options {
        size_t batch = 16;                         // cases at most
        uint64_t batch_bytes = uint64_t{8} << 20;  // of captures, a case alone may be larger
        uint32_t repeat = 1;                       // renderings of each case
        uint32_t retries = 1;                      // more renderings of a failure
        size_t lanes = 1;                          // workers
        bool suspects_first = false;  // settle failures and deaths before new cases are drawn
    };

    // `bytes[k]` is the size of case k's capture.
    Schedule(std::vector<uint64_t> bytes, const Options& options);

    // Puts a case into the first round, or into the round of fresh workers.
    void add(size_t k) { lanes_.front().cases.push_back(k); }
    void add_alone(size_t k) { fresh_.push_back(k); }

    // From now on a batch of several cases has captures of so many bytes at most.
    void set_batch_bytes(uint64_t bytes) { options_.batch_bytes = bytes; }
    // The next batch of the worker of this lane, or nothing (yet).
    std::optional<Batch> next(size_t lane = 0);
    // A batch that was not drawn, and the lane that it is of, which has no worker, go to another.
    void hand_over(size_t from, size_t to, const Batch& batch);
    // True while a case waits for its batch.
    bool has_waiting() const;

    // A case was drawn; `bits` is a hash of its capture.
    enum class Drawn { judge, same, differs };
    Drawn drawn(size_t k, uint64_t bits);
    // A drawn case was judged: true if it is finished, false if it has been queued again. An
    // unexpected failure is drawn again alone, a known one with others, which costs little.
    enum class Judged { good, known_failure, unexpected_failure };
    bool judged(size_t k, Judged as);
    // A case drawn again with the same bits: true if it is finished, false if it has been queued
    // again.
    bool confirmed(size_t k);

    // The cases of a dead batch that have no result. True: `charge` it (a fresh worker died over
    // this case alone); false: they have been queued for fresh workers.
    bool died(const Batch& batch, const std::vector<size_t>& without_result,
              const std::string& reason, const std::string& signal = {},
              const std::string& step = {});

    uint32_t attempts(size_t k) const { return states_[k].attempts; }

    // Called with the final status of each case; k's record must be held back while is_held(k).
    // release() then says which case a death that no case repeated alone is charged to, as a flake.
    void settled(size_t k, report::Status status);
    bool is_held(size_t k) const;
    // Records that are no longer held, in the order of settling, with the reason to charge, if any,
    // how the worker died, and the cases that it drew together.
    struct Released {
        size_t k = 0;
        std::string unrepeated_death, signal, step;
        std::vector<size_t> suspects;
    };
    std::vector<Released> release();

  private:
    struct State {
        uint32_t attempts = 0;  // handed out
        uint32_t drawn = 0;
        uint32_t needed = 1;
        std::optional<uint64_t> bits;
        int group = -1;  // the first death it was in
    };
    // A death and the cases that may have caused it.
    struct Group {
        std::vector<size_t> open;  // not settled
        std::vector<size_t> held;  // settled, in order
        bool repeated = false;
        size_t charged = 0;
        std::vector<size_t> suspects;  // the batch
        std::string reason, signal, step;
        bool released = false;
    };

    struct Lane {
        std::deque<size_t> cases;
        bool has_worker = false;  // has handed out a batch
    };

    std::optional<Batch> take(std::deque<size_t>& queue, size_t count, bool fresh);
    std::optional<Batch> take_again();
    void refill(Lane& lane);

    std::vector<uint64_t> bytes_;
    Options options_;
    std::vector<State> states_;
    std::vector<Lane> lanes_;
    std::deque<size_t> again_, retry_, fresh_;
    std::vector<Group> groups_;
};

}  // namespace run
