// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/fault.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <utility>

#include "cases/select/selector.hpp"

namespace run {

namespace {

constexpr std::array<std::pair<const char*, FaultKind>, 18> kNames = {{
    {"segv", FaultKind::segv},
    {"abort", FaultKind::abort},
    {"hang", FaultKind::hang},
    {"flood", FaultKind::flood},
    {"oom", FaultKind::oom},
    {"exit0", FaultKind::exit0},
    {"truncate", FaultKind::truncate},
    {"garbage", FaultKind::garbage},
    {"flip-pixel", FaultKind::flip_pixel},
    {"shift-value", FaultKind::shift_value},
    {"flake", FaultKind::flake},
    {"flip-derived", FaultKind::flip_derived},
    {"device-lost", FaultKind::device_lost},
    {"unsupported", FaultKind::unsupported},
    {"noise", FaultKind::noise},
    {"segv-at-start", FaultKind::segv_at_start},
    {"hang-at-start", FaultKind::hang_at_start},
    {"no-device", FaultKind::no_device},
}};

// The kind of a word without its "+N".
std::optional<FaultKind> kind_of(std::string_view word) {
    word = word.substr(0, word.find('+'));
    const auto row = std::find_if(kNames.begin(), kNames.end(),
                                  [word](const auto& known) { return known.first == word; });
    return row == kNames.end() ? std::nullopt : std::optional(row->second);
}

void use_up_memory() {
    const rlimit limit{rlim_t{1} << 30, rlim_t{1} << 30};
    ::setrlimit(RLIMIT_AS, &limit);
    for (;;) {
        volatile char* block = new char[size_t{1} << 24];
        block[0] = 1;  // std::bad_alloc, uncaught, ends the worker
    }
}

}  // namespace

cases::Expected<std::vector<Fault>> parse_faults(std::string_view list) {
    std::vector<Fault> faults;
    while (!list.empty()) {
        // ids hold commas, so a comma separates faults only before the name of one
        size_t end = list.size();
        for (size_t comma = list.find(','); comma != std::string_view::npos;
             comma = list.find(',', comma + 1)) {
            const std::string_view rest = list.substr(comma + 1);
            const std::string_view word = rest.substr(0, rest.find_first_of(",@"));
            if (kind_of(word)) {
                end = std::min(end, comma);
            }
        }
        const std::string_view item = list.substr(0, end);
        list.remove_prefix(std::min(list.size(), end + 1));
        const size_t at = item.find('@');
        const std::string_view word = item.substr(0, at);
        const std::optional<FaultKind> kind = kind_of(word);
        if (!kind) {
            std::vector<std::string> names;
            std::ranges::transform(kNames, std::back_inserter(names),
                                   &std::pair<const char*, FaultKind>::first);
            const std::string nearest = cases::nearest_name(std::string(word), names);
            return cases::failure("EDGECASE_FAULT names an unknown fault '{}'; {}", word,
                                  nearest.empty()
                                      ? fmt::format("there are {}", fmt::join(names, ", "))
                                      : "did you mean '" + nearest + "'?");
        }
        Fault fault;
        fault.kind = *kind;
        fault.glob = at == std::string_view::npos ? "**" : item.substr(at + 1);
        if (const size_t plus = word.find('+'); plus != std::string_view::npos) {
            const char* const stop = word.data() + word.size();
            const auto read = std::from_chars(word.data() + plus + 1, stop, fault.skipped);
            const bool has_place =
                *kind == FaultKind::flip_pixel || *kind == FaultKind::shift_value;
            if (read.ec != std::errc() || read.ptr != stop || !has_place) {
                return cases::failure(
                    "EDGECASE_FAULT: '{}' is not understood; '+N' with a number stands after "
                    "flip-pixel and shift-value only",
                    word);
            }
        }
        faults.push_back(std::move(fault));
    }
    return faults;
}

const Fault* find_fault(const std::vector<Fault>& faults, FaultKind kind, std::string_view id) {
    const auto at = std::find_if(faults.begin(), faults.end(), [&](const Fault& fault) {
        return fault.kind == kind && (fault.glob == "**" || cases::glob_matches(fault.glob, id));
    });
    return at == faults.end() ? nullptr : &*at;
}

void commit(FaultKind kind) {
    switch (kind) {
        case FaultKind::segv:
        case FaultKind::segv_at_start:
            ::signal(SIGSEGV, SIG_DFL);
            ::raise(SIGSEGV);
            break;
        case FaultKind::abort:
            std::abort();
        case FaultKind::hang:
        case FaultKind::hang_at_start:
            for (;;) {
                ::pause();
            }
        case FaultKind::flood: {
            const std::string text(size_t{1} << 16, 'f');
            while (::write(STDERR_FILENO, text.data(), text.size()) >= 0 || errno == EINTR) {
            }
            break;
        }
        case FaultKind::oom:
            use_up_memory();
            break;
        case FaultKind::exit0:
            ::_exit(0);
        default:
            break;
    }
}

}  // namespace run
