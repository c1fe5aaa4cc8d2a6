// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals that end a run, and waiting for a worker without missing them.
#pragma once

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
    // True once SIGINT, SIGTERM or SIGHUP has come.
    bool has_come();

  private:
    Fd fd_;
    bool come_ = false;
};

}  // namespace run
