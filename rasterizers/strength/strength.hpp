// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which faults of the software device a case catches.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/software/choice/device.hpp"
#include "ref/expectation/expectation.hpp"

namespace software {

// What the case's attachments hold after drawing; with a fault that the device has no code for,
// after drawing the case as a device with the fault takes it.
capture::Capture captured(const cases::Case& c, const Device& device);
// Its verdict, draws or blit.
diff::Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                      const capture::Capture& capture);
// False where a fault has nothing to change, or its code path is not run at all: no colour,
// stencil, resolve, distance, samples.
bool can_matter(Fault fault, const cases::Case& c);
// True if two renderings of a case have the same bits in every plane: they have the same verdict.
bool same_bits(const capture::Capture& a, const capture::Capture& b);

// Draws a case with each of the faults, and judges what was drawn at profile direct3d. Calls caught
// for each fault that has a finding, with its verdict. Nothing is tried of a case with which the
// faultless device has a finding itself; then that verdict is returned.
std::optional<diff::Verdict> try_faults(
    const cases::Case& c, std::span<const Fault> faults,
    const std::function<void(Fault, const diff::Verdict&)>& caught);

}  // namespace software
