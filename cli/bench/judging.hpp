// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The half of "bench" that needs no driver: what judging costs on one thread, with pictures of the
// software device, which is right but for the fault that it is given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cases/model/case.hpp"

namespace cli {

// Seconds, or what is counted in one second.
struct JudgingFigures {
    double reference = 0, compare = 0;  // over all cases
    // Every second one of the cases that `run --quick` takes, judged and recorded: right pictures,
    // and those of a device whose vertices are half a pixel off.
    size_t quick_cases = 0, broken_cases = 0;  // the second: how many of them fail
    double right = 0, broken = 0;

    struct Size {
        uint32_t side = 0;              // of a square target, pixels
        double reference = 0, all = 0;  // samples of one plain triangle
    };
    std::vector<Size> sizes;  // ascending
    struct Small {
        uint32_t side = 0, triangles = 0;
        double cases = 0;
    };
    std::vector<Small> small;
    struct Megapixel {
        std::string what;
        double seconds = 0;
    };
    std::vector<Megapixel> megapixels;
};

// Notes on stderr: cases whose right picture is not accepted.
JudgingFigures time_judging(std::span<const cases::Case> cases, std::span<const size_t> quick);

// How much more a sample of one size costs than one of another, at most.
double spread_of(std::span<const JudgingFigures::Size> sizes);

}  // namespace cli
