// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Preloaded (LD_PRELOAD) into the program and its workers:
//   EDGECASE_CHAOS_CLOCK=SEED   the clock of the day jumps by up to decades, to and fro, at one
//                               asking in three; the one that measures times stays
//   EDGECASE_CHAOS_FRAMES=HOW   of what a worker writes to its parent: `twice` (every frame),
//                               `hello-twice` (the first), `short` (a few bytes a call), `bit`
//                               (one bit of a frame is another), `cut` (the process ends half-way)
//   EDGECASE_CHAOS_STARTS=N     only of the first N workers (EDGECASE_HOSTILE_FOLDER counts them)
//   EDGECASE_CHAOS_FRAME=N      from which frame on (of `bit` and `cut`: which), else the second
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

namespace {

constexpr int kResults = 4;  // a worker's descriptor, run/process/process.hpp

std::atomic<uint64_t> asked = 0;

// Seconds that the clock of the day is wrong by at this asking.
time_t jump() {
    static const char* seed = std::getenv("EDGECASE_CHAOS_CLOCK");
    if (seed == nullptr) {
        return 0;
    }
    uint64_t x = std::strtoull(seed, nullptr, 10) + ++asked / 3 * 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x ^= x >> 27;
    constexpr int64_t kDecades = int64_t{30} * 365 * 86400;
    return static_cast<time_t>(static_cast<int64_t>(x % (2 * kDecades)) - kDecades);
}

ssize_t write_really(int fd, const void* bytes, size_t size) {
    return ::syscall(SYS_write, fd, bytes, size);
}

// Whether this worker is one of the first that are chosen.
bool is_chosen() {
    const char* starts = std::getenv("EDGECASE_CHAOS_STARTS");
    const char* folder = std::getenv("EDGECASE_HOSTILE_FOLDER");
    if (starts == nullptr || folder == nullptr) {
        return true;
    }
    const std::string path = std::string(folder) + "/workers";
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const bool is_counted = fd >= 0 && write_really(fd, ".", 1) == 1;
    const off_t number = ::lseek(fd, 0, SEEK_END);
    ::close(fd);
    return is_counted && number <= std::strtol(starts, nullptr, 10);
}

// Which of its kinds this process does to its results; nullptr if it is no worker.
const char* frames() {
    static const char* how = [] {
        const char* words = std::getenv("EDGECASE_CHAOS_FRAMES");
        const char* name = std::strrchr(program_invocation_name, '/');
        char target[16];
        // A parent may have a file of its own at this number; a worker has a pipe.
        const bool is_pipe = ::readlink("/proc/self/fd/4", target, sizeof target) > 4 &&
                             std::memcmp(target, "pipe", 4) == 0;
        return words != nullptr && name != nullptr && is_pipe && is_chosen() ? words : nullptr;
    }();
    return how;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, timespec* out) noexcept {
    const auto result = static_cast<int>(::syscall(SYS_clock_gettime, clock, out));
    if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
        out->tv_sec += jump();
    }
    return result;
}

__attribute__((visibility("default"))) time_t time(time_t* out) noexcept {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    if (out != nullptr) {
        *out = now.tv_sec;
    }
    return now.tv_sec;
}

__attribute__((visibility("default"))) int gettimeofday(timeval* out, void* /*zone*/) noexcept {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    *out = {now.tv_sec, now.tv_nsec / 1000};
    return 0;
}

__attribute__((visibility("default"))) ssize_t write(int fd, const void* bytes, size_t size) {
    const char* how = fd == kResults ? frames() : nullptr;
    if (how == nullptr) {
        return write_really(fd, bytes, size);
    }
    static const char* number = std::getenv("EDGECASE_CHAOS_FRAME");
    static const uint64_t chosen = number != nullptr ? std::strtoull(number, nullptr, 10) : 2;
    static std::atomic<uint64_t> written = 0;
    const uint64_t frame = ++written;
    const std::string word = how;
    if ((word == "twice" && frame >= chosen) || (word == "hello-twice" && frame == 1)) {
        std::string both(static_cast<const char*>(bytes), size);
        both += both;  // in one, so that the reader has them together
        write_really(fd, both.data(), both.size());
        return static_cast<ssize_t>(size);
    }
    if (word == "short") {
        return write_really(fd, bytes, std::min<size_t>(size, 1 + frame % 7));
    }
    if (word == "bit" && frame == chosen) {
        std::string other(static_cast<const char*>(bytes), size);
        other[(frame * 31) % size] ^= 0x10;
        return write_really(fd, other.data(), size);
    }
    if (word == "cut" && frame == chosen) {
        write_really(fd, bytes, size / 2);
        ::_exit(0);
    }
    return write_really(fd, bytes, size);
}

}  // extern "C"
