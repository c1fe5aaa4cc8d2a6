// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Threads beside a loop that waits on descriptors.
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace run {

// Threads that work through tasks; a descriptor becomes readable when results wait.
class Pool {
  public:
    // Fewer threads where a limit leaves fewer; without any, collect() does a task at each call.
    explicit Pool(unsigned threads);
    ~Pool();  // tasks not begun are dropped, those that run are waited for
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    // `work` runs on a thread, `finish` later on the thread that calls collect().
    void submit(std::function<void()> work, std::function<void()> finish);
    // Runs the `finish` of all tasks whose work is done. Throws what the work of one has thrown.
    void collect();
    // Tasks submitted and not yet collected.
    size_t outstanding() const { return outstanding_; }
    int fd() const;
    // Waits until a result can be collected.
    void wait() const;
    // Leaves the tasks that run to themselves: nothing waits for them, and they are destroyed when
    // their work is done. All that `work` uses must belong to it. Nothing can be submitted any
    // more.
    void abandon();
    // Whether threads that were left to themselves are still at work. Such a process must not be
    // ended by destroying what they use: std::_Exit does not.
    static bool has_abandoned();

  private:
    struct State;
    // Does the next task. False if there is none; `waits`: only at the pool's end.
    static bool do_next(State& state, bool waits);
    std::shared_ptr<State> state_;  // the threads' own, too
    size_t outstanding_ = 0;        // of the submitting thread alone
    std::vector<std::thread> threads_;
};

}  // namespace run
