// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/signal_fd.hpp"

#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

namespace run {

namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
// timeout(1) sends its signal to the process and to its group, which is one wish.
constexpr int64_t kSameWishMs = 500;
constexpr unsigned kSecondsToEnd = 1;
constexpr int kExitInterrupted = 130;

// All that the handlers read and write.
std::atomic<int> came = 0;  // the first signal
std::atomic<int64_t> came_ms = 0;
std::atomic<int> told_fd = -1;
std::array<char, 512> last_words{};
std::atomic<size_t> last_words_size = 0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<int64_t>::is_always_lock_free);

int64_t now_ms() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

[[noreturn]] void end_at_once(int /*signal*/) {
    kill_all_children();
    if (::write(STDERR_FILENO, last_words.data(), last_words_size) < 0) {
        // Nobody reads it.
    }
    ::_exit(kExitInterrupted);
}

void on_signal(int signal) {
    const int error = errno;
    int none = 0;
    if (came.compare_exchange_strong(none, signal)) {
        came_ms = now_ms();
        if (!has_debugger()) {
            ::alarm(kSecondsToEnd);
        }
        ::eventfd_write(told_fd, 1);
    } else if (now_ms() - came_ms > kSameWishMs && !has_debugger()) {
        end_at_once(signal);
    }
    errno = error;
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

SignalFd::SignalFd() : fd_(::eventfd(has_come() ? 1 : 0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!fd_.is_open()) {
        throw std::system_error(errno, std::generic_category());
    }
    set_last_words("interrupted");
    told_fd = fd_.get();
    handle(SIGALRM, end_at_once);
    for (const int signal : kSignals) {
        if (signal != SIGHUP || !is_ignored(signal)) {
            handle(signal, on_signal);
        }
    }
    ::signal(SIGPIPE, SIG_IGN);
}

SignalFd::~SignalFd() {
    for (const int signal : kSignals) {
        if (!has_come() && !is_ignored(signal)) {
            handle(signal, SIG_DFL);
        }
    }
    told_fd = -1;
}

bool SignalFd::has_come() {
    return came != 0;
}

void SignalFd::set_last_words(std::string_view sentence) {
    constexpr std::string_view kProgram = "edgecase: ";
    last_words_size = 0;  // while it is being written
    const size_t size = std::min(sentence.size(), last_words.size() - kProgram.size() - 1);
    std::memcpy(last_words.data(), kProgram.data(), kProgram.size());
    std::memcpy(last_words.data() + kProgram.size(), sentence.data(), size);
    last_words[kProgram.size() + size] = '\n';
    last_words_size = kProgram.size() + size + 1;
}

}  // namespace run
