// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/limits.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>

namespace cases {

namespace {

// "64", or "unlimited".
std::string limit_of(__rlimit_resource resource, rlim_t unit = 1) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
        return "unlimited";
    }
    return fmt::format("{}", limit.rlim_cur / unit);
}

}  // namespace

std::string process_limit(int error) {
    return fmt::format(
        "{}; the limit of processes (ulimit -u) is {}, and a container may have a lower one "
        "(pids.max); raise it, or take fewer --jobs",
        std::strerror(error), limit_of(RLIMIT_NPROC));
}

std::string descriptor_limit(int error) {
    return fmt::format("{}; the limit of open files (ulimit -n) is {}, and 64 are enough",
                       std::strerror(error), limit_of(RLIMIT_NOFILE));
}

std::string tight_limits() {
    struct Enough {
        __rlimit_resource resource;
        rlim_t enough, unit;
        const char* name;
    };
    // lavapipe starts a thread a core, maps some hundred megabytes and opens twenty files.
    constexpr std::array kEnough = {
        Enough{RLIMIT_NPROC, 64, 1, "processes (ulimit -u)"},
        Enough{RLIMIT_NOFILE, 64, 1, "open files (ulimit -n)"},
        Enough{RLIMIT_AS, rlim_t{4} << 30, 1024, "kB of address space (ulimit -v)"},
    };
    std::string text;
    for (const Enough& e : kEnough) {
        rlimit limit{};
        if (::getrlimit(e.resource, &limit) == 0 && limit.rlim_cur < e.enough) {
            text +=
                fmt::format("{}{} {}", text.empty() ? "" : ", ", limit.rlim_cur / e.unit, e.name);
        }
    }
    return text.empty() ? text : "a driver may fail for want of what is limited here: " + text;
}

void throw_if_limit(int error) {
    if (error == EMFILE || error == ENFILE) {
        throw std::system_error(error, std::generic_category());
    }
}

bool is_limit(const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    const int code = system != nullptr ? system->code().value() : 0;
    return code == EAGAIN || code == EMFILE || code == ENFILE ||
           dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

std::string reason_of(const std::exception& error) {
    constexpr rlim_t kKilobyte = 1024;
    if (!is_limit(error)) {
        return error.what();
    }
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system == nullptr) {
        return fmt::format(
            "memory ran out; the limit of address space (ulimit -v) is {} kB; raise it, or take "
            "fewer --jobs and fewer cases at once",
            limit_of(RLIMIT_AS, kKilobyte));
    }
    const int code = system->code().value();
    return code == EAGAIN ? "a thread could not be started: " + process_limit(code)
                          : "a descriptor could not be had: " + descriptor_limit(code);
}

}  // namespace cases
