// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/pixel_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "ref/value/fragment/quantities.hpp"
#include "ref/value/places.hpp"

namespace diff {

namespace {

// The samples of a pixel that one triangle wrote last.
struct Fragment {
    const cases::Triangle* triangle = nullptr;
    std::vector<uint32_t> samples;
};

std::vector<Fragment> fragments_of(const ref::Expectation& e, const capture::CaptureView& capture,
                                   size_t first) {
    std::vector<Fragment> out;
    for (uint32_t s = 0; s < capture.target.samples; ++s) {
        const size_t index = first + s;
        if (capture::sample_state(capture, index) != capture::SampleState::drawn) {
            continue;
        }
        const cases::Triangle* t = written_triangle(e, capture, index);
        if (t == nullptr) {
            continue;
        }
        const auto same = std::find_if(out.begin(), out.end(),
                                       [t](const Fragment& f) { return f.triangle == t; });
        if (same == out.end()) {
            out.push_back({t, {s}});
        } else {
            same->samples.push_back(s);
        }
    }
    return out;
}

Finding finding_of(const cases::Target& target, cases::SampleId pixel, uint32_t s,
                   const cases::Triangle& t) {
    pixel.sample = s;
    Finding finding = finding_at(FindingKind::value, target, pixel);
    finding.level = cases::Profile::vulkan;
    finding.why = fmt::format("triangle {} of draw {}: ", t.primitive, t.draw);
    return finding;
}

bool has_distinct_locations(const cases::Target& target) {
    const auto locations = cases::sample_locations(target);
    return std::set<std::array<uint8_t, 2>>(locations.begin(), locations.end()).size() ==
           locations.size();
}

std::optional<Finding> check_invocations(const cases::Draw& draw,
                                         const capture::CaptureView& capture, const Fragment& f,
                                         size_t first, cases::SampleId pixel) {
    const uint32_t least = ref::value::least_invocations(draw, capture.target.samples);
    const auto rate = ref::value::shading_rate(draw, capture.target.samples);
    const bool is_on =
        rate == ref::value::ShadingRate::some || rate == ref::value::ShadingRate::sample;
    // A sample that the fragment does not cover may have had an invocation of its own.
    if (!is_on || f.samples.size() != capture.target.samples ||
        !has_distinct_locations(capture.target)) {
        return std::nullopt;
    }
    std::set<std::pair<float, float>> places;
    for (const uint32_t s : f.samples) {
        const glm::vec4& at = capture.frag_coord[first + s];
        places.insert({at.x, at.y});
    }
    if (places.size() >= least) {
        return std::nullopt;
    }
    Finding finding = finding_of(capture.target, pixel, f.samples.front(), *f.triangle);
    finding.rule = cases::rule::sample_shading;
    finding.quantity = "invocations";
    finding.expected = fmt::format("at least {} places of FragCoord.xy in the pixel", least);
    finding.got = fmt::format("{}", places.size());
    finding.why += "too few invocations of the fragment shader";
    return finding;
}

// gl_SampleMaskIn of two samples: of one invocation, or without a common sample.
std::optional<Finding> check_masks(const cases::Draw& draw, const capture::CaptureView& capture,
                                   const Fragment& f, size_t first, uint32_t attribute,
                                   cases::SampleId pixel) {
    // Vulkan allows several invocations of a fragment of several pixels (fragment_check.hpp).
    const bool is_one = ref::value::shading_rate(draw, capture.target.samples) ==
                            ref::value::ShadingRate::fragment &&
                        !cases::has_large_fragments(draw);
    const auto mask_of = [&](uint32_t s) -> uint32_t {
        const float v = capture.attributes[attribute][first + s].x;
        return v >= 0.0F && v < 0x1p16F ? static_cast<uint32_t>(v) : 0U;
    };
    for (size_t k = 0; k < f.samples.size() * f.samples.size(); ++k) {
        const uint32_t before = f.samples[k % f.samples.size()];
        const uint32_t s = f.samples[k / f.samples.size()];
        const uint32_t other = mask_of(before);
        const uint32_t mask = mask_of(s);
        if (before >= s || mask == other || (!is_one && (mask & other) == 0)) {
            continue;
        }
        Finding finding = finding_of(capture.target, pixel, s, *f.triangle);
        finding.rule = cases::rule::sample_mask_in;
        finding.quantity = fmt::format("attribute {}.x", attribute);
        finding.expected = fmt::format("{:#b} as at sample {}{}", other, before,
                                       is_one ? "" : ", or no sample of it");
        finding.got = fmt::format("{:#b}", mask);
        finding.why += "each covered sample is set in exactly one invocation";
        return finding;
    }
    return std::nullopt;
}

}  // namespace

const cases::Triangle* written_triangle(const ref::Expectation& e,
                                        const capture::CaptureView& capture, size_t index) {
    // Without gl_PrimitiveID triangles with the same provoking vertex cannot be told apart.
    const ref::SampleExpectation& expected = e.samples[index];
    const capture::Writer& writer = capture.writers[index];
    const cases::Triangle* found = nullptr;
    for (uint32_t k = 0; k < expected.writers_count; ++k) {
        const cases::Triangle& t = e.triangles[e.writers[expected.writers_begin + k]];
        if (writer.draw == t.draw && writer.provoking_vertex == t.provoking &&
            (!capture.has_primitive || writer.primitive == t.primitive)) {
            if (found != nullptr) {
                return nullptr;
            }
            found = &t;
        }
    }
    return found;
}

bool has_pixel_rules(const cases::Case& c) {
    return c.target.samples > 1 &&
           std::any_of(c.draws.begin(), c.draws.end(), [&](const cases::Draw& draw) {
               return ref::value::least_invocations(draw, c.target.samples) > 1 ||
                      std::any_of(
                          draw.attributes.begin(), draw.attributes.end(),
                          [](const auto& a) { return a.source == cases::Source::sample_mask_in; });
           });
}

std::vector<Finding> check_pixel(const cases::Case& c, const ref::Expectation& expectation,
                                 const capture::CaptureView& capture, cases::SampleId pixel) {
    std::vector<Finding> out;
    pixel.sample = 0;
    const size_t first = cases::index_of(c.target, pixel);
    for (const Fragment& f : fragments_of(expectation, capture, first)) {
        const cases::Draw& draw = c.draws[f.triangle->draw];
        // Devices may make several fragments of the pieces of a clipped triangle.
        if (ref::value::make_primitive(c, *f.triangle).needs_clipping) {
            continue;
        }
        if (auto finding = check_invocations(draw, capture, f, first, pixel)) {
            out.push_back(std::move(*finding));
        }
        for (uint32_t a = 0; a < draw.attributes.size(); ++a) {
            if (draw.attributes[a].source != cases::Source::sample_mask_in) {
                continue;
            }
            if (auto finding = check_masks(draw, capture, f, first, a, pixel)) {
                out.push_back(std::move(*finding));
            }
        }
    }
    return out;
}

}  // namespace diff
