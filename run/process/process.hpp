// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One child process with its own process group, a request pipe, a result pipe, and its standard
// output and error caught.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"

namespace run {

// Descriptors of a worker.
inline constexpr int kRequestFd = 3;
inline constexpr int kResultFd = 4;
inline constexpr int kSharedFd = 5;  // memory for captures, may be closed

// Keeps the first and the last half of what would be more than kLimit bytes.
class HeadAndTail {
  public:
    static constexpr size_t kLimit = size_t{64} << 10;  // bytes
    void add(std::string_view bytes);
    void clear();
    std::string text() const;

  private:
    std::string head_, tail_;
    size_t dropped_ = 0;
};

// A file descriptor that closes itself.
class Fd {
  public:
    explicit Fd(int fd = -1) : fd_(fd) {}
    ~Fd() { reset(); }
    Fd(Fd&& other) noexcept : fd_(other.release()) {}
    Fd& operator=(Fd&& other) noexcept;
    int get() const { return fd_; }
    bool is_open() const { return fd_ >= 0; }
    int release();
    void reset();

  private:
    int fd_;
};

struct ExitStatus {
    bool signalled = false;
    int code = 0;  // exit status, or the signal's number
};

// "SIGSEGV", ...
std::string signal_name(int signal);

// What starts a child.
struct Command {
    std::vector<std::string> words;  // the first is a path
    // The child keeps the standard input, output and error of this process, and its process group:
    // a debugger, which a person ends.
    bool keeps_terminal = false;
};

struct ChildProcess {
    pid_t pid = -1;
    bool keeps_terminal = false;
    Fd request;  // write end, non-blocking
    Fd result;   // read end, non-blocking
    Fd output;   // read end of the child's stdout and stderr, non-blocking; closed if it keeps them
};

// Starts a command: own process group, killed when the calling thread's process dies, no core file,
// stdin from /dev/null, the worker's fds 3 and 4 connected, `shared` (if not -1) as its fd 5,
// everything else closed on exec.
cases::Expected<ChildProcess> spawn(const Command& command, int shared = -1);

// Whether the child itself has ended, whatever it has started and whoever holds its pipes.
bool has_ended(const ChildProcess& child);

// Whether a child that keeps the terminal lives: ctrl-c is a word to the debugger then.
bool has_debugger();

// Kills the process groups of all children of this process, and reaps none: for the handler of a
// signal, which ends the process.
void kill_all_children();

// Kills the child's whole process group and reaps the child. A child that is dying by itself is
// given `grace_ms` to do so, and its own status is told. A child that keeps the terminal is not
// killed but waited for.
ExitStatus kill_and_reap(ChildProcess& child, int grace_ms);

}  // namespace run
