// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of pictures in which alone an error may hold: a place, some triangles of a draw, targets of
// odd width.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "diagnosis/match.hpp"

namespace diagnosis {

// A sample, and who wrote it: in a right picture, or else in that of the error.
struct Spot {
    const cases::Case& of;
    cases::SampleId id;
    capture::Writer writer;  // draw is kClearId where nobody did, or where nobody tells
};

struct Condition {
    // Of two conditions of one kind the earlier is the narrower one, where both fit it is told.
    enum class Kind : uint8_t { place, triangle, draw, width, height, samples };
    Kind kind = Kind::place;
    std::string name;  // a word for scripts
    std::string what;  // follows the error's sentence: "at pixel (5, 5)"
    std::function<bool(const Spot&)> holds;
};

// Those that hold for all wrong samples of the case, of the picture that an error draws of it.
std::vector<Condition> conditions_at(const Subject& subject, const capture::Capture& drawn);

// The error's picture where the condition holds, the right one elsewhere; false if the two pictures
// have not the same planes.
bool restrict_to(const Condition& condition, const cases::Case& c, const capture::Capture& right,
                 capture::Capture& drawn);

}  // namespace diagnosis
