// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run drew through doors (cases/model/door.hpp) and by ways (cases/model/way.hpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/record/run.hpp"

namespace report {

struct DoorCount {
    std::string door;
    size_t pictures = 0;  // drawn and compared
    size_t left_out = 0;  // cases that cannot take it
    size_t closed = 0;    // cases that could, on another device
    std::string reason;   // of the first of those
    std::string bug;      // why a set of doors left it out
};

// Of every door that the run or a file asks for, in the order of the table of doors.
std::vector<DoorCount> door_counts(const Run& run);

// "doors: ..." with the sum; a line for each of them with `verbose`. Empty if no door was asked
// for.
std::string doors_text(const Run& run, bool verbose);

// "ways: 2197 pictures by 14 ways"; empty if no case was drawn by any.
std::string ways_text(const Run& run);

}  // namespace report
