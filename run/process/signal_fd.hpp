// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals that end a command: SIGINT, SIGTERM, SIGHUP.
#pragma once

#include <string_view>

#include "run/process/process.hpp"

namespace run {

// While one lives, a signal asks for an end: its descriptor becomes and stays readable, and
// whoever waits for something else waits for it, too. What has not ended the process a second
// later, whatever it does, is ended with exit code 130, and so is what gets another signal. Nothing
// but the handlers is needed for that, no thread that a limit may refuse. A person who works with a
// debugger is waited for. SIGHUP that is ignored
// (nohup) stays ignored.
class SignalFd {
  public:
    SignalFd();
    ~SignalFd();  // after a signal its handlers stay: the command is at its end
    SignalFd(const SignalFd&) = delete;
    SignalFd& operator=(const SignalFd&) = delete;
    int fd() const { return fd_.get(); }
    // True once a signal has come.
    static bool has_come();
    // What the process says if it is ended a second after a signal, one sentence: what is missing
    // then, and how to have it. At most 500 bytes.
    static void set_last_words(std::string_view sentence);

  private:
    Fd fd_;
};

}  // namespace run
