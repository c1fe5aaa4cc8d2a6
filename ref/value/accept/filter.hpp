// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// This is the first of three stages of every decision: it uses plain binary64, accepts only what is
// proven to be within K budgets, and answers in a few nanoseconds. What it does not accept is
// decided with Balls, and what those cannot decide in rationals.
#pragma once

#include <span>
#include <vector>

#include "ref/number/plane_budget.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace ref::value {

struct FilterPlane {
    double x = 0, y = 0, c = 0;     // midpoints of the plane
    double ex = 0, ey = 0, ec = 0;  // their bounds, rounding of the evaluation included
    double budget = 0;              // a lower bound on the budget anywhere
};

struct Filter {
    bool usable = false;
    std::vector<FilterPlane> planes;
};

inline constexpr double kDown = 1.0 - 0x1p-48;  // pays for the rounding of a bound's evaluation
inline constexpr double kUp = 1.0 + 0x1p-48;

// Evaluated plane: |exact - v| <= e.
struct Evaluated {
    double v, e;
};
Evaluated evaluate(const FilterPlane& plane, const Point<double>& p);

Filter make_filter(const Basis<Ball>& basis);

// Where the inputs are evaluated, exact in binary64 (multiples of 1/16): without decoration (and
// FragCoord.z and w), the sample, centroid.
struct FilterPoints {
    Point<double> centre, sample, centroid;
};

// True if every numeric value (linear or perspective) is proven to be within `factor` budgets.
// `worst` then is the largest error, rounded (for reports only).
bool filter_accepts(const Filter& filter, std::span<const Quantity> quantities,
                    const FilterPoints& places, const FragmentValues& device, double factor,
                    WorstError& worst);

struct ProbePlace;

// The same for the probes (Kind::probe), at one sample a pixel: one arrangement of the quad
// explains all of them. `worst` grows to their largest error.
bool filter_accepts_probes(const Filter& filter, std::span<const Quantity> quantities,
                           const ProbePlace& place, const FragmentValues& device, double factor,
                           WorstError& worst);

}  // namespace ref::value
