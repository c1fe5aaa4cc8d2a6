// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole suite, drawn by a software device and judged by the reference.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/profile.hpp"
#include "diff/verdict.hpp"
#include "mutants/software.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/expectation/expectation.hpp"

namespace mutants {

// A device that breaks no rule at its profile.
struct LegalDevice {
    std::string name;
    std::string what;  // it does, in a few words
    cases::Profile profile;
    Device device;
};
// Every freedom of the specifications one at a time, and some together.
std::vector<LegalDevice> legal_devices();

// The case's first finding as one line, or why it cannot be judged.
std::string describe(const cases::Case& c, const diff::Verdict& verdict);

// Calls work(k) for k = 0 .. count-1 on all processors, in no order.
void for_each_parallel(size_t count, const std::function<void(size_t)>& work);

// Draws and judges one case.
diff::Verdict judge(const cases::Case& c, const Device& device, cases::Profile profile);

// True if `id` is the case's id or its part before ':' (then every leaf of the matrix is meant).
bool is_named(const cases::Case& c, std::string_view id);

}  // namespace mutants
