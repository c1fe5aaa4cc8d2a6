// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Threads beside a loop that waits on descriptors.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "run/process/process.hpp"

namespace run {

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

}  // namespace run
