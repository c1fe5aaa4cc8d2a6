// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "cases/base/limits.hpp"

namespace run {

void HeadAndTail::add(std::string_view bytes) {
    constexpr size_t kHalf = kLimit / 2;
    if (head_.size() < kHalf) {
        const size_t n = std::min(kHalf - head_.size(), bytes.size());
        head_.append(bytes.substr(0, n));
        bytes.remove_prefix(n);
    }
    tail_.append(bytes);
    if (tail_.size() > 2 * kHalf) {  // trimmed in large steps, so that adding stays linear
        dropped_ += tail_.size() - kHalf;
        tail_.erase(0, tail_.size() - kHalf);
    }
}

void HeadAndTail::clear() {
    head_.clear();
    tail_.clear();
    dropped_ = 0;
}

std::string HeadAndTail::text() const {
    constexpr size_t kHalf = kLimit / 2;
    const size_t extra = tail_.size() > kHalf ? tail_.size() - kHalf : 0;
    if (dropped_ + extra == 0) {
        return head_ + tail_;
    }
    return head_ + "\n[" + std::to_string(dropped_ + extra) + " bytes left out]\n" +
           tail_.substr(extra);
}

Fd& Fd::operator=(Fd&& other) noexcept {
    if (this != &other) {
        reset();
        fd_ = other.release();
    }
    return *this;
}

int Fd::release() {
    return std::exchange(fd_, -1);
}

void Fd::reset() {
    if (fd_ >= 0) {
        ::close(std::exchange(fd_, -1));
    }
}

std::string signal_name(int signal) {
    const char* name = ::sigabbrev_np(signal);
    return name != nullptr ? "SIG" + std::string(name) : "signal " + std::to_string(signal);
}

namespace {

struct Pipe {
    Fd read_end, write_end;
};

// Both ends above the numbers that the child's fixed descriptors take.
bool make_pipe(Pipe& pipe) {
    std::array<int, 2> raw{};
    if (::pipe2(raw.data(), O_CLOEXEC) != 0) {
        return false;
    }
    const Fd low_read(raw[0]);
    const Fd low_write(raw[1]);
    pipe.read_end = Fd(::fcntl(raw[0], F_DUPFD_CLOEXEC, 10));
    pipe.write_end = Fd(::fcntl(raw[1], F_DUPFD_CLOEXEC, 10));
    return pipe.read_end.is_open() && pipe.write_end.is_open();
}

// The groups of children that live, for the handler of a signal. A child more than there are places
// dies with this process, too, but not what it has started.
std::array<std::atomic<pid_t>, 64> groups{};
std::atomic<int> debuggers = 0;

void exchange_group(pid_t from, pid_t to) {
    for (std::atomic<pid_t>& group : groups) {
        pid_t expected = from;
        if (group.compare_exchange_strong(expected, to)) {
            return;
        }
    }
}

void set_nonblocking(int fd) {
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
}

// In the child between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* argv, bool keeps_terminal, pid_t parent, int request,
                         int result, int output, int shared) {
    if (!keeps_terminal) {
        ::setpgid(0, 0);
    }
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) {
        ::_exit(127);  // the parent died before prctl
    }
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) {  // SignalFd's are the parent's
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
            ::signal(signal, SIG_DFL);
        }
    }
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::signal(SIGPIPE, SIG_DFL);
    ::signal(SIGXFSZ, SIG_DFL);
    if (!keeps_terminal) {
        const int null = ::open("/dev/null", O_RDONLY);
        ::dup2(null, STDIN_FILENO);
        ::dup2(output, STDOUT_FILENO);
        ::dup2(output, STDERR_FILENO);
    }
    ::dup2(request, kRequestFd);
    ::dup2(result, kResultFd);
    if (shared >= 0) {
        ::dup2(shared, kSharedFd);
    }
    ::execv(argv[0], argv);
    constexpr char kMessage[] = "edgecase: a worker could not be started: ";
    const char* reason = ::strerrordesc_np(errno);
    if (::write(STDERR_FILENO, kMessage, sizeof kMessage - 1) < 0 ||
        ::write(STDERR_FILENO, reason, std::strlen(reason)) < 0) {
        ::_exit(126);
    }
    ::_exit(127);
}

}  // namespace

cases::Expected<ChildProcess> spawn(const Command& command, int shared) {
    Pipe request;
    Pipe result;
    Pipe output;
    if (!make_pipe(request) || !make_pipe(result) || !make_pipe(output)) {
        return cases::failure("no pipe for a worker: " + cases::descriptor_limit(errno));
    }
    std::vector<std::string> words = command.words;
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const pid_t parent = ::getpid();
    sigset_t all;
    sigset_t before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);  // no handler of ours runs in the child
    const pid_t pid = ::fork();
    const int error = errno;
    if (pid == 0) {
        become(argv.data(), command.keeps_terminal, parent, request.read_end.get(),
               result.write_end.get(), output.write_end.get(), shared);
    }
    if (pid > 0 && !command.keeps_terminal) {
        ::setpgid(pid, pid);  // in both, so that neither has to wait for the other
        exchange_group(0, pid);
    }
    debuggers += pid > 0 && command.keeps_terminal ? 1 : 0;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (pid < 0) {
        return cases::failure("a worker could not be started: " + cases::process_limit(error));
    }
    constexpr int kPipeBytes = 1 << 20;
    ::fcntl(result.read_end.get(), F_SETPIPE_SZ, kPipeBytes);  // fewer switches; may be refused
    ChildProcess child;
    child.pid = pid;
    child.keeps_terminal = command.keeps_terminal;
    child.request = std::move(request.write_end);
    child.result = std::move(result.read_end);
    child.output = std::move(output.read_end);
    for (const Fd* fd : {&child.request, &child.result, &child.output}) {
        set_nonblocking(fd->get());
    }
    return child;
}

bool has_ended(const ChildProcess& child) {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child.pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid == child.pid;
}

bool has_debugger() {
    return debuggers > 0;
}

void kill_all_children() {
    for (const std::atomic<pid_t>& group : groups) {
        if (const pid_t pid = group; pid > 0) {
            ::kill(-pid, SIGKILL);
        }
    }
}

ExitStatus kill_and_reap(ChildProcess& child, int grace_ms) {
    const pid_t pid = child.pid;
    for (int waited = 0; !child.keeps_terminal && waited < grace_ms && !has_ended(child);
         ++waited) {
        const timespec one_ms{0, 1000000};
        ::nanosleep(&one_ms, nullptr);
    }
    // The leader is not reaped yet, so the group's number cannot belong to anyone else.
    if (child.keeps_terminal) {
        child.request.reset();  // a worker that still runs sees that it is not needed
    } else {
        ::kill(-pid, SIGKILL);
        ::kill(pid, SIGKILL);
    }
    exchange_group(pid, 0);  // soon the number is another's
    int status = 0;
    while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    debuggers -= child.keeps_terminal ? 1 : 0;
    if (WIFSIGNALED(status)) {
        return {true, WTERMSIG(status)};
    }
    return {false, WEXITSTATUS(status)};
}

}  // namespace run
