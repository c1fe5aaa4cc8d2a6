// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device may do wrong, as something that can be drawn: the software device with a fault or
// another choice, or with its values or positions moved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace diagnosis {

struct Hypothesis {
    std::string name;  // a word of its own, for scripts
    std::string what;  // the device does: a sentence without its full stop
    software::Device device = {};
    // All positions are moved by so much before they are snapped, in pixels.
    float moved_x = 0, moved_y = 0;
};

// All that are known beforehand, the plainest first: faults that change a case, then choices, then
// those that the software device has code for. A device of so many subpixel bits is asked about.
std::vector<Hypothesis> known_hypotheses(int subpixel_bits);

// What a device that is so draws of the case; nothing where the error has no part in it.
std::optional<capture::Capture> draw(const Hypothesis& hypothesis, const cases::Case& c);

}  // namespace diagnosis
