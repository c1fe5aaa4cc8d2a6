// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/plane_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/sample.hpp"
#include "diff/resolve.hpp"
#include "ref/path/path.hpp"
#include "ref/stencil/values.hpp"
#include "ref/value/reference.hpp"

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

struct Span {
    double low = HUGE_VAL, high = -HUGE_VAL;
};

// The ends of what two pictures show; nothing if both show nothing.
std::optional<Span> span_of(const std::vector<double>& one, const std::vector<double>& other) {
    Span span;
    for (const auto* numbers : {&one, &other}) {
        for (const double number : *numbers) {
            span.low = std::min(span.low, number);
            span.high = number < kNone ? std::max(span.high, number) : span.high;
        }
    }
    return span.low <= span.high ? std::optional(span) : std::nullopt;
}

// 1 at the low end to 255 at the high one; 0 where nothing is shown.
std::vector<uint8_t> codes_of(const std::vector<double>& numbers, const Span& span) {
    const double size = span.high > span.low ? span.high - span.low : 1;
    std::vector<uint8_t> out;
    out.reserve(numbers.size());
    for (const double number : numbers) {
        out.push_back(number < kNone ? static_cast<uint8_t>(
                                           std::lround(1 + 254 * ((number - span.low) / size)))
                                     : uint8_t{0});
    }
    return out;
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
    const std::optional<Span> span = span_of(device, expected);
    if (!span || !(span->low < span->high)) {
        return;
    }
    pictures.depth_low = span->low;
    pictures.depth_high = span->high;
    pictures.device_depths = codes_of(device, *span);
    pictures.expected_depths = codes_of(expected, *span);
}

void add_stencils(report::Pictures& pictures, const PictureWindow& window, const cases::Case& c,
                  const diff::Verdict& verdict, const ref::Expectation& expectation,
                  const capture::CaptureView& capture) {
    const bool is_told = std::ranges::any_of(
        verdict.findings, [](const diff::Finding& f) { return f.quantity == "stencil"; });
    if (!is_told || capture.stencil.empty() || expectation.samples.size() == 0) {
        return;
    }
    std::vector<double> device, expected;
    window.for_each([&](uint32_t, uint32_t, uint32_t, size_t k) {
        device.push_back(capture.stencil[k] <= cases::kStencilBits
                             ? static_cast<double>(capture.stencil[k])
                             : kNone);
        const ref::SampleExpectation& sample = expectation.samples[k];
        if (ref::stencil::is_needed(c)) {
            const ref::stencil::Values values = stencils_at(expectation, sample, std::nullopt);
            expected.push_back(
                values.count() == 1 ? static_cast<double>(ref::stencil::least_of(values)) : kNone);
        } else {  // it counts front faces up and back faces down
            const glm::vec4 hits(sample.hits.front_min, sample.hits.back_min, 0, 0);
            expected.push_back(
                sample.hits.is_decided() ? static_cast<double>(diff::stencil_of(hits)) : kNone);
        }
    });
    const std::optional<Span> span = span_of(device, expected);
    if (!span) {
        return;
    }
    pictures.stencil_low = static_cast<uint32_t>(span->low);
    pictures.stencil_high = static_cast<uint32_t>(span->high);
    pictures.device_stencils = codes_of(device, *span);
    pictures.expected_stencils = codes_of(expected, *span);
}

}  // namespace run
