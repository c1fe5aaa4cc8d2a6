// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals that end a run, and waiting for a worker without missing them.
#pragma once

#include <thread>

#include "run/process/process.hpp"

namespace run {

// Delivered signals as a descriptor. Signals are blocked while it lives, so construct it before any
// thread.
class SignalFd {
  public:
    SignalFd();
    ~SignalFd();
    SignalFd(const SignalFd&) = delete;
    SignalFd& operator=(const SignalFd&) = delete;
    int fd() const { return fd_.get(); }
    // True once SIGINT, SIGTERM or SIGHUP has come. From the first call that says so on another
    // one ends the process at once: whoever asks twice does not wait for what is being written.
    bool has_come();

  private:
    void end_by_another() const;

    Fd fd_, stop_;  // stop_: another one is not waited for any more
    bool come_ = false;
    std::thread waits_for_another_;
};

}  // namespace run
