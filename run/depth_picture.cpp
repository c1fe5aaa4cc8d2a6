// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/depth_picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "cases/model/sample.hpp"
#include "ref/value/value.hpp"

namespace run {

namespace {

constexpr double kNone = HUGE_VAL;

double device_depth(const cases::Case& c, const capture::CaptureView& capture, size_t index) {
    const bool is_drawn = index < capture.depth.size() && std::isfinite(capture.depth[index]) &&
                          !capture::is_clear_depth(c.target, capture.depth[index]);
    return is_drawn ? static_cast<double>(capture.depth[index]) : kNone;
}

double expected_depth(const cases::Case& c, const ref::Expectation& expectation,
                      ref::ValueReference& values, size_t index) {
    const ref::SampleExpectation& sample = expectation.samples[index];
    if (!sample.hits.is_decided() || sample.hits.total_min == 0 || sample.depth_may_be_clear) {
        return kNone;
    }
    double low = HUGE_VAL, high = -HUGE_VAL;
    const std::span<const uint32_t> writers = sample.depth_count > 0
                                                  ? expectation.depth_writers_of(sample)
                                                  : expectation.writers_of(sample);
    for (const uint32_t t : writers) {
        const ref::ValueRange range =
            values.range(t, cases::sample_at(c.target, index), ref::QuantityId{});
        if (!range.is_promised) {
            return kNone;
        }
        low = std::min(low, range.low);
        high = std::max(high, range.high);
    }
    return low <= high ? low + (high - low) / 2 : kNone;
}

bool is_about_depth(const diff::Finding& finding) {
    return finding.quantity == "depth" || finding.quantity == "frag_coord.z";
}

}  // namespace

void add_depths(report::Pictures& pictures, const PictureWindow& window, const cases::Case& c,
                const diff::Verdict& verdict, const ref::Expectation& expectation,
                const capture::CaptureView& capture) {
    std::vector<double> device, expected;
    window.for_each([&](uint32_t, uint32_t, uint32_t, size_t k) {
        device.push_back(device_depth(c, capture, k));
    });
    if (std::ranges::any_of(verdict.findings, is_about_depth)) {
        ref::ValueReference values(c, expectation.limits, expectation.profile);
        window.for_each([&](uint32_t, uint32_t, uint32_t, size_t k) {
            expected.push_back(expected_depth(c, expectation, values, k));
        });
    }
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto* depths : {&device, &expected}) {
        for (const double depth : *depths) {
            low = std::min(low, depth);
            high = depth < kNone ? std::max(high, depth) : high;
        }
    }
    if (!(low < high)) {
        return;
    }
    const auto codes = [&](const std::vector<double>& depths) {
        std::vector<uint8_t> out;
        out.reserve(depths.size());
        for (const double depth : depths) {
            out.push_back(depth < kNone ? static_cast<uint8_t>(
                                              std::lround(1 + 254 * ((depth - low) / (high - low))))
                                        : uint8_t{0});
        }
        return out;
    };
    pictures.depth_low = low;
    pictures.depth_high = high;
    pictures.device_depths = codes(device);
    pictures.expected_depths = codes(expected);
}

}  // namespace run
