// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/signal_fd.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <utility>

namespace run {

namespace {

sigset_t run_signals() {
    sigset_t set;
    ::sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        ::sigaddset(&set, signal);
    }
    return set;
}

}  // namespace

SignalFd::SignalFd() {
    const sigset_t set = run_signals();
    ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
    fd_ = Fd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
    ::signal(SIGPIPE, SIG_IGN);
}

SignalFd::~SignalFd() {
    const sigset_t set = run_signals();
    ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

bool SignalFd::has_come() {
    signalfd_siginfo info{};
    while (::read(fd_.get(), &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
        come_ = true;
    }
    return come_;
}

}  // namespace run
