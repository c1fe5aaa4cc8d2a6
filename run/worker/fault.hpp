// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults on purpose, so that the runner can be tested without a broken driver: EDGECASE_FAULT holds
// words FAULT[+N][@ID-GLOB] separated by commas, obeyed by workers only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"

namespace run {

enum class FaultKind {
    segv,           // dies while a batch with a matching case is drawn
    abort,          // likewise, by SIGABRT
    hang,           // never comes back
    flood,          // prints without end
    oom,            // allocates without end under a memory limit, then dies as the allocator does
    exit0,          // leaves with status 0 and without a result
    truncate,       // sends half of the matching case's result, then leaves
    garbage,        // sends bytes that are no frame
    flip_pixel,     // changes one sample of the matching case's capture
    shift_value,    // changes one number of a fragment of the matching case's capture
    flake,          // as flip_pixel, only in the first attempt
    flip_derived,   // changes one sample of each of the case's derived renderings
    device_lost,    // answers device_lost for the whole batch
    unsupported,    // says that the device cannot draw the case
    noise,          // prints bytes that break XML, HTML and terminals
    segv_at_start,  // dies before the device is ready
    hang_at_start,
    no_device,  // says that there is no device
};

struct Fault {
    FaultKind kind = FaultKind::segv;
    std::string glob;  // of case ids; "**" without one
    // Of flip_pixel and shift_value: how many drawn samples, from the middle of the target on, stay
    // as they are before the one that is changed ("flip-pixel+12"); around again after the last.
    uint32_t skipped = 0;
};

// The faults of a list as EDGECASE_FAULT holds it; an unknown word is an error that names the
// nearest.
cases::Expected<std::vector<Fault>> parse_faults(std::string_view list);

// The first fault of that kind that matches the id; null if there is none.
const Fault* find_fault(const std::vector<Fault>& faults, FaultKind kind, std::string_view id);

inline bool has_fault(const std::vector<Fault>& faults, FaultKind kind, std::string_view id) {
    return find_fault(faults, kind, id) != nullptr;
}

// Carries out segv, abort, hang, oom and exit0; the others do nothing here.
void commit(FaultKind kind);

}  // namespace run
