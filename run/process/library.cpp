// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/process/library.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "run/process/frame.hpp"
#include "run/process/process.hpp"

namespace run {

namespace {

// What dlopen says; empty if the library loads.
std::string dlopen_error(const std::filesystem::path& library) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
        return {};
    }
    Fd read_end(ends[0]), write_end(ends[1]);
    ChildProcess child;
    child.pid = ::fork();
    if (child.pid == 0) {
        ::setpgid(0, 0);
        if (::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) {
            const char* why = ::dlerror();
            write_all(write_end.get(), why != nullptr ? why : "dlopen failed");
        }
        ::_exit(0);
    }
    write_end = Fd();
    if (child.pid < 0) {
        return {};
    }
    ::setpgid(child.pid, child.pid);
    // A library may hang while it is loaded, and what it starts may hold the pipe open for ever.
    constexpr int kSeconds = 10, kPollMs = 10;
    for (int waited = 0; waited < kSeconds * 1000 && !has_ended(child); waited += kPollMs) {
        ::poll(nullptr, 0, kPollMs);
    }
    const ExitStatus end = kill_and_reap(child, 0);
    std::string text(size_t{1} << 12, '\0');  // less than the pipe holds
    text.resize(static_cast<size_t>(
        std::max<ssize_t>(::read(read_end.get(), text.data(), text.size()), 0)));
    if (text.empty() && end.signalled) {
        return end.code == SIGKILL ? fmt::format("it had not ended after {} s", kSeconds)
                                   : "it was killed by " + signal_name(end.code);
    }
    return text;
}

}  // namespace

std::string load_problem(const capture::Driver& driver) {
    const bool has_library = driver.problem.empty() && !driver.path.empty();
    const std::string why = has_library ? dlopen_error(driver.path) : "";
    return why.empty() ? why : "the driver library '" + driver.library + "' does not load: " + why;
}

}  // namespace run
