// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/signal_fd.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <utility>

namespace run {

namespace {

// timeout(1) sends its signal to the process and to its group, which is one wish.
constexpr int kSameWishMs = 500;
constexpr int kExitOfSignal = 128;

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
    stop_ = Fd(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
    ::signal(SIGPIPE, SIG_IGN);
}

SignalFd::~SignalFd() {
    if (waits_for_another_.joinable()) {
        ::eventfd_write(stop_.get(), 1);
        waits_for_another_.join();
    }
    const sigset_t set = run_signals();
    ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

bool SignalFd::has_come() {
    if (come_) {
        return true;
    }
    signalfd_siginfo info{};
    while (::read(fd_.get(), &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
        come_ = true;
    }
    if (come_) {
        waits_for_another_ = std::thread([this] { end_by_another(); });
    }
    return come_;
}

void SignalFd::end_by_another() const {
    std::array<pollfd, 2> fds = {{{stop_.get(), POLLIN, 0}, {fd_.get(), POLLIN, 0}}};
    if (::poll(fds.data(), 1, kSameWishMs) > 0) {
        return;
    }
    signalfd_siginfo info{};
    while (::read(fd_.get(), &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
    }
    while (::poll(fds.data(), fds.size(), -1) < 0) {
    }
    if (fds[0].revents == 0 &&
        ::read(fd_.get(), &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
        ::_exit(kExitOfSignal + static_cast<int>(info.ssi_signo));
    }
}

}  // namespace run
