// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "cases/base/number_text.hpp"
#include "cases/format/color_format.hpp"
#include "cases/model/rule_ids.hpp"
#include "ref/color/component.hpp"

namespace diff {

namespace {

using cases::ComponentKind;
using cases::Profile;
using cases::Resolve;
using ref::color::Component;

constexpr double kFloatStep = 0x1p-23;
constexpr double kFloatNormal = 0x1p-126;  // the smallest normal number

// What samples are averaged as: floating point by its value, all else by its code; of SNORM's two
// codes that are read as -1 by the one that is.
double number_of(const Component& component, uint32_t code) {
    const double least = component.kind() == ComponentKind::snorm
                             ? std::round(-1 / component.step().get_d())
                             : -HUGE_VAL;
    return is_floating(component.kind()) ? component.number(code)
                                         : std::max(component.whole_of(code), least);
}

struct Range {
    double min = 0, max = 0;
};

// What the average of samples may be. At profile vulkan Vulkan's text leaves the precision open
// ("Render Pass Resolve Operations"), and min..max is all that can be said; from practice on it is
// the mean, within one step of the format (not of sRGB: the space it is taken in is left open).
//
// Floats are added in binary32, in any order: partial sum k of n is at most k * M, M the largest
// magnitude, and its rounding (even by truncation) errs by k * M * 2^-23 at most. The sum over
// k = 2..n over n is below M * 2^-23 * (n + 1) / 2; half a step more for the terms of second
// order. Storing a half adds a step of M. The same sum may leave min..max, so it widens that too.
// A denormal number may become 0 wherever one appears: the n samples together, the n - 1 partial
// sums and the mean move it by less than 2^-126 each (NVIDIA's resolve takes the mean of 0 and
// 2^-126 for 0).
Range range_of(const std::vector<double>& samples, const Component& component, Profile profile) {
    const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
    const auto n = static_cast<double>(samples.size());
    double sum = 0;
    for (const double sample : samples) {
        sum += sample;
    }
    const double mean = sum / n;
    if (is_floating(component.kind())) {
        const double magnitude = std::max(std::abs(*least), std::abs(*greatest));
        const double storing =
            component.kind() == ComponentKind::half ? component.least_step(magnitude) : 0;
        const double error = magnitude * kFloatStep * (n + 2) / 2 + storing + 3 * kFloatNormal;
        return profile == Profile::vulkan ? Range{*least - error, *greatest + error}
                                          : Range{mean - error, mean + error};
    }
    if (profile == Profile::vulkan || component.kind() == ComponentKind::srgb) {
        return {*least, *greatest};
    }
    return {std::max(mean - 1, *least), std::min(mean + 1, *greatest)};
}

// The loosest profile at which `got` is no average; nothing if it is one.
std::optional<Profile> wrong_average(const std::vector<double>& samples, double got,
                                     const Component& component, Profile profile) {
    for (const Profile p : {Profile::vulkan, Profile::practice}) {
        const Range range = range_of(samples, component, p);
        if (p <= profile && !(got >= range.min && got <= range.max)) {
            return p;
        }
    }
    return std::nullopt;
}

double select(const std::vector<double>& samples, Resolve mode) {
    switch (mode) {
        case Resolve::min:
            return *std::min_element(samples.begin(), samples.end());
        case Resolve::max:
            return *std::max_element(samples.begin(), samples.end());
        default:
            return samples.front();
    }
}

std::string to_text(const std::vector<double>& samples) {
    std::string out;
    for (const double sample : samples) {
        out += (out.empty() ? "" : ", ") + cases::number_text(sample);
    }
    return out;
}

// One resolved number against the samples that it comes from.
std::optional<Finding> judge_number(const std::vector<double>& samples, double got, Resolve mode,
                                    const Component& component, Profile profile) {
    const auto wrong = [&](std::string_view rule, Profile level, std::string expected) {
        Finding finding;
        finding.kind = FindingKind::value;
        finding.rule = rule;
        finding.level = level;
        finding.expected = std::move(expected);
        finding.got = cases::number_text(got);
        finding.why =
            fmt::format("the samples of the pixel, read singly, are {}", to_text(samples));
        return std::optional(std::move(finding));
    };
    if (mode != Resolve::average) {
        const double expected = select(samples, mode);
        return std::equal_to<>()(got, expected)
                   ? std::nullopt
                   : wrong(cases::rule::resolve_select, Profile::vulkan,
                           cases::number_text(expected));
    }
    // Nothing is known of a sum with infinities or NaN.
    const bool is_known =
        std::ranges::all_of(samples, [](double sample) { return std::isfinite(sample); });
    const auto level = is_known ? wrong_average(samples, got, component, profile) : std::nullopt;
    if (!level) {
        return std::nullopt;
    }
    const Range range = range_of(samples, component, *level);
    return wrong(cases::rule::resolve_average, *level,
                 cases::number_text(range.min) + " .. " + cases::number_text(range.max));
}

capture::ColorCodes average_codes(std::span<const capture::ColorCodes> samples,
                                  cases::ColorFormat format) {
    capture::ColorCodes out{};
    for (uint32_t k = 0; k < out.size(); ++k) {
        const Component component(cases::component_of(format, k));
        double sum = 0;
        for (const capture::ColorCodes& sample : samples) {
            sum += number_of(component, sample.at(k));
        }
        const double mean = sum / static_cast<double>(samples.size());
        if (!std::isfinite(mean)) {  // no number: neither is the first sample that makes it so
            const auto at = std::find_if(samples.begin(), samples.end(), [&](const auto& sample) {
                return !std::isfinite(number_of(component, sample.at(k)));
            });
            out.at(k) = at->at(k);
            continue;
        }
        out.at(k) = is_floating(component.kind()) ? component.code_of(mpq_class(mean))
                    : component.kind() == ComponentKind::snorm
                        ? component.code_of(mpq_class(mean) * component.step())
                        : static_cast<uint32_t>(mean + 0.5);
    }
    return out;
}

class Judge {
  public:
    Judge(const capture::CaptureView& capture, Profile profile,
          const std::function<void(Finding)>& add)
        : capture_(capture), target_(capture.target), profile_(profile), add_(add) {}

    std::string run() {
        const size_t pixels = size_t{target_.width} * target_.rows();
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            if (!judge_resolved(pixel)) {
                return fmt::format(
                    "the resolved pixel ({}, {}) was not copied from the device: it "
                    "still holds the read-back memory's fill pattern",
                    pixel % target_.width, pixel / target_.width);
            }
        }
        return {};
    }

    // What the samples of a pixel were resolved into; false if it was not copied.
    bool judge_resolved(size_t pixel) {
        const size_t first = pixel * target_.samples;
        if (capture::resolves_color(target_)) {
            const capture::ColorCodes& resolved = capture_.resolved_color[pixel];
            if (resolved == capture::ColorCodes{capture::kPoison, capture::kPoison,
                                                capture::kPoison, capture::kPoison}) {
                return false;
            }
            for (uint32_t k = 0; k < resolved.size(); ++k) {
                judge_color(pixel, k, resolved.at(k));
            }
        }
        if (capture::resolves_depth(target_)) {
            const float resolved = capture_.resolved_depth[pixel];
            if (std::bit_cast<uint32_t>(resolved) == capture::kPoison) {
                return false;
            }
            const auto depths = capture_.depth.subspan(first, target_.samples);
            // UNORM depth is compared by codes: floats of codes are no multiples of each other.
            const double steps = cases::depth_steps(target_.depth_format);
            const auto scaled = [steps](float z) {
                return steps > 0 ? std::round(static_cast<double>(z) * steps)
                                 : static_cast<double>(z);
            };
            std::vector<double> samples;
            for (const float depth : depths) {
                samples.push_back(scaled(depth));
            }
            report(judge_number(samples, scaled(resolved), target_.depth_resolve,
                                cases::ComponentFormat{
                                    steps > 0 ? ComponentKind::unorm : ComponentKind::binary32, 32},
                                profile_),
                   pixel, "resolved depth");
        }
        if (capture::resolves_stencil(target_)) {
            const uint32_t resolved = capture_.resolved_stencil[pixel];
            if (resolved == capture::kPoison) {
                return false;
            }
            const auto stencils = capture_.stencil.subspan(first, target_.samples);
            report(
                judge_number({stencils.begin(), stencils.end()}, resolved, target_.stencil_resolve,
                             cases::ComponentFormat{ComponentKind::uint, 8}, profile_),
                pixel, "resolved stencil");
        }
        return true;
    }

  private:
    void judge_color(size_t pixel, uint32_t component, uint32_t code) {
        const Component stored(cases::component_of(target_.color->format, component));
        if (!stored.exists()) {
            return;
        }
        std::vector<double> samples;
        for (const capture::ColorCodes& codes :
             capture_.color.subspan(pixel * target_.samples, target_.samples)) {
            samples.push_back(number_of(stored, codes.at(component)));
        }
        report(
            judge_number(samples, number_of(stored, code), target_.color_resolve, stored, profile_),
            pixel, fmt::format("resolved color.{}", "rgba"[component]));
    }

    void report(std::optional<Finding> finding, size_t pixel, std::string quantity) {
        if (finding) {
            const uint32_t sample = finding->sample;
            set_sample(*finding, target_,
                       cases::sample_at(target_, pixel * target_.samples + sample));
            finding->quantity = std::move(quantity);
            add_(std::move(*finding));
        }
    }

    const capture::CaptureView& capture_;
    const cases::Target& target_;
    Profile profile_;
    const std::function<void(Finding)>& add_;
};

}  // namespace

bool is_resolved_rightly(const capture::CaptureView& capture, size_t pixel, Profile profile) {
    bool is_right = true;
    const std::function<void(Finding)> add = [&is_right](const Finding&) { is_right = false; };
    return Judge(capture, profile, add).judge_resolved(pixel) && is_right;
}

uint32_t stencil_of(const glm::vec4& hits) {
    // Counts are whole and below 2^23 (sample_state); two's complement wraps as the stencil does.
    return (static_cast<uint32_t>(hits.x) - static_cast<uint32_t>(hits.y)) & 0xffU;
}

std::optional<Finding> judge_count(const capture::CaptureView& capture, size_t index,
                                   const ref::path::SeenHits& seen) {
    const uint32_t got = capture.stencil[index];
    const uint32_t expected = (seen.front - seen.back) & 0xffU;
    if (seen.detail != ref::path::SeenHits::Detail::faces || got == expected) {
        return std::nullopt;
    }
    Finding finding =
        finding_at(FindingKind::value, capture.target, cases::sample_at(capture.target, index));
    finding.rule = cases::rule::stencil_count;
    finding.level = Profile::vulkan;
    finding.quantity = "stencil";
    finding.expected = fmt::format("{}", expected);
    finding.got = fmt::format("{}", got);
    finding.why = fmt::format("at this sample the hit counter saw {} front and {} back faces",
                              seen.front, seen.back);
    return finding;
}

std::string judge_dependent_planes(const capture::CaptureView& capture, Profile profile,
                                   const std::function<void(Finding)>& add) {
    const cases::Target& target = capture.target;
    const bool has_planes =
        (capture::resolves_color(target) && !capture.resolved_color.empty()) ||
        (capture::resolves_depth(target) && !capture.resolved_depth.empty()) ||
        (capture::resolves_stencil(target) && !capture.resolved_stencil.empty());
    return has_planes ? Judge(capture, profile, add).run() : std::string();
}

void add_dependent_planes(capture::Capture& capture) {
    const cases::Target& target = capture.target;
    const size_t pixels = size_t{target.width} * target.rows();
    if (target.has_stencil && capture.stencil.empty()) {
        capture.stencil.resize(capture.sample_count());
        std::transform(capture.hits.begin(), capture.hits.end(), capture.stencil.begin(),
                       stencil_of);
    }
    capture.resolved_color.resize(capture::resolves_color(target) ? pixels : 0);
    for (size_t pixel = 0; pixel < capture.resolved_color.size(); ++pixel) {
        const auto samples =
            std::span(capture.color).subspan(pixel * target.samples, target.samples);
        capture.resolved_color[pixel] = target.color_resolve == Resolve::average
                                            ? average_codes(samples, target.color->format)
                                            : samples.front();
    }
    capture.resolved_depth.resize(capture::resolves_depth(target) ? pixels : 0);
    for (size_t pixel = 0; pixel < capture.resolved_depth.size(); ++pixel) {
        const auto depths =
            std::span(capture.depth).subspan(pixel * target.samples, target.samples);
        const std::vector<double> samples(depths.begin(), depths.end());
        double sum = 0;
        for (const double sample : samples) {
            sum += sample;
        }
        const double mean = sum / target.samples;
        const double steps = cases::depth_steps(target.depth_format);
        const auto average = steps > 0
                                 ? cases::depth_of_code(static_cast<uint32_t>(mean * steps + 0.5),
                                                        target.depth_format)
                                 : static_cast<float>(mean);
        capture.resolved_depth[pixel] =
            target.depth_resolve == Resolve::average
                ? average
                : static_cast<float>(select(samples, target.depth_resolve));
    }
    capture.resolved_stencil.resize(capture::resolves_stencil(target) ? pixels : 0);
    for (size_t pixel = 0; pixel < capture.resolved_stencil.size(); ++pixel) {
        const auto stencils =
            std::span(capture.stencil).subspan(pixel * target.samples, target.samples);
        capture.resolved_stencil[pixel] = static_cast<uint32_t>(
            select(std::vector<double>(stencils.begin(), stencils.end()), target.stencil_resolve));
    }
}

}  // namespace diff
