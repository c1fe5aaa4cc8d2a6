// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Values of a run, which are filtered on many lanes at once, have the bits that each has by itself.
#include "ref/value/accept/filter_run.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace ref::value {
namespace {

constexpr double kFactor = 2;

class AnyRun {
  public:
    explicit AnyRun(uint64_t seed) : random_(seed) {}

    double between(double low, double high) {
        const double unit = static_cast<double>(random_() >> 11U) * 0x1p-53;
        return low + (high - low) * unit;
    }
    bool one_in(uint64_t n) { return random_() % n == 0; }
    size_t below(size_t n) { return random_() % n; }

    FilterPlane plane(double least) {
        const double budget = std::ldexp(between(1, 2), static_cast<int>(between(-30, -10)));
        FilterPlane p;
        p.x = between(-1, 1) / 64;
        p.y = between(-1, 1) / 64;
        p.c = between(least, least + 1);
        p.ex = budget * 0x1p-20;
        p.ey = budget * 0x1p-21;
        p.ec = one_in(4) ? budget : budget * 0x1p-10;
        p.budget = budget;
        return p;
    }

    // Near what the plane has, within the budgets or a little outside; or no number.
    float device(double exact, double budget) {
        if (one_in(200)) {
            return one_in(2) ? std::numeric_limits<float>::quiet_NaN()
                             : std::numeric_limits<float>::infinity();
        }
        return static_cast<float>(exact + budget * between(-1, 1) * (one_in(20) ? 4 : 1));
    }

  private:
    std::mt19937_64 random_;
};

// Of each fragment: its largest error by filter_accepts(), which looks at one fragment.
double one_by_one(const Filter& filter, const std::vector<Quantity>& quantities,
                  const RunPoints& points, size_t k, const FragmentValues& device) {
    const auto moved = [k](Point<double> p) {
        p.x += static_cast<double>(k);
        return p;
    };
    WorstError worst;
    const bool is_accepted = filter_accepts(
        filter, quantities, {moved(points.centre), moved(points.sample), moved(points.centre)},
        device, kFactor, worst);
    return is_accepted ? worst.ratio : HUGE_VAL;
}

TEST(FilterRun, HasTheBitsOfEachFragmentByItself) {
    size_t accepted = 0, refused = 0;
    for (uint64_t seed = 1; seed <= 400; ++seed) {
        AnyRun run(seed);
        Filter filter;
        filter.usable = true;
        filter.planes = {run.plane(run.one_in(5) ? -0.5 : 2), run.plane(0), run.plane(-1)};
        ASSERT_EQ(kPlaneInvW, 0U);
        std::vector<Quantity> quantities(2);
        quantities[0].kind = run.one_in(3) ? Kind::linear : Kind::perspective;
        quantities[0].plane = 1;
        quantities[0].id = {.of = QuantityId::Of::attribute, .attribute = 0, .component = 1};
        quantities[1].kind = run.one_in(3) ? Kind::linear : Kind::perspective;
        quantities[1].at_sample = true;
        quantities[1].plane = 2;
        quantities[1].id = {.of = QuantityId::Of::attribute, .attribute = 1, .component = 3};
        const size_t n = run.one_in(4) ? kRunLength : 1 + run.below(kRunLength);
        const RunPoints points = {{0.5, 7.5}, {0.5 + 1 / 16.0, 7.5 - 3 / 16.0}};
        std::vector<FragmentValues> devices(n);
        std::vector<glm::vec4> first(n), second(n);
        for (size_t k = 0; k < n; ++k) {
            for (const Quantity& q : quantities) {
                Point<double> p = q.at_sample ? points.sample : points.centre;
                p.x += static_cast<double>(k);
                const double w = q.kind == Kind::linear ? 1 : evaluate(filter.planes[0], p).v;
                const FilterPlane& plane = filter.planes[q.plane];
                number_of(devices[k], q.id) =
                    run.device(evaluate(plane, p).v / w, plane.budget / std::fabs(w));
            }
            first[k].y = number_of(devices[k], quantities[0].id);
            second[k].w = number_of(devices[k], quantities[1].id);
        }
        const std::array values = {RunValue{quantities.data(), &first.front().y, 4},
                                   RunValue{&quantities[1], &second.front().w, 4}};
        std::vector<double> ratios(n);
        filter_run(filter, values, points, kFactor, ratios);
        for (size_t k = 0; k < n; ++k) {
            const double expected = one_by_one(filter, quantities, points, k, devices[k]);
            ASSERT_EQ(std::bit_cast<uint64_t>(ratios[k]), std::bit_cast<uint64_t>(expected))
                << "seed " << seed << ", fragment " << k << ": " << ratios[k] << ", " << expected;
            ++(std::isinf(expected) ? refused : accepted);
        }
    }
    EXPECT_GT(accepted, 5000U);
    EXPECT_GT(refused, 2000U);
}

}  // namespace
}  // namespace ref::value
