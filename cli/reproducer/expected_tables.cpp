// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/expected_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "cli/reproducer/color_tables.hpp"
#include "cli/reproducer/probe_ranges.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/fragment/shading_rate.hpp"
#include "ref/value/reference.hpp"

namespace cli {

namespace {

// A C literal of the number, which it has in 9 digits.
std::string literal(float v) {
    if (std::isinf(v)) {
        return v > 0 ? "INFINITY" : "-INFINITY";
    }
    std::string text = fmt::format("{:.9g}", v);
    if (text.find_first_of(".e") == std::string::npos) {
        text += ".0";
    }
    return text + "F";
}

// The binary32 numbers from low to high: a device has no others, so rounding inwards loses none.
std::string range_text(const ref::ValueRange& range) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (!range.is_promised) {
        return "{1.0F, 0.0F}, ";
    }
    constexpr double kMost = std::numeric_limits<float>::max();
    if (std::isinf(range.low) && std::isinf(range.high)) {
        return "{-INFINITY, INFINITY}, ";
    }
    auto low = static_cast<float>(std::clamp(range.low, -kMost, kMost));
    auto high = static_cast<float>(std::clamp(range.high, -kMost, kMost));
    if (static_cast<double>(low) < range.low) {
        low = std::nextafter(low, kInfinity);
    }
    if (static_cast<double>(high) > range.high) {
        high = std::nextafter(high, -kInfinity);
    }
    return fmt::format("{{{}, {}}}, ", literal(low), literal(high));
}

// Rows of a table, each written once.
class Rows {
  public:
    // The number of the row, which is `size` entries long.
    size_t number(const std::string& row, size_t size = 1) {
        const auto [found, is_new] = numbers_.emplace(row, size_);
        if (is_new) {
            size_ += size;
            text_ += "    " + row + "\n";
        }
        return found->second;
    }
    size_t size() const { return size_; }
    // C has no empty arrays.
    std::string text(std::string_view none) const {
        return size_ > 0 ? text_ : fmt::format("    {}\n", none);
    }

  private:
    std::map<std::string, size_t> numbers_;
    std::string text_;
    size_t size_ = 0;
};

class Tables {
  public:
    Tables(const cases::Case& c, const ref::Limits& limits, cases::Profile profile)
        : case_(c),
          expectation_(ref::expect(c, limits, profile)),
          values_(c, limits, profile),
          probes_(c, limits, profile, expectation_.triangles) {
        if (c.target.color) {
            colors_.emplace(c, expectation_, values_);
        }
    }

    cases::Expected<std::string> text() {
        std::string runs, last;
        size_t run = 0;
        for (size_t k = 0; k < expectation_.samples.size(); ++k) {
            std::string row = sample_row(k);
            if (ranges_.size() + color_rows_.size() > kMostRanges) {
                return cases::failure(fmt::format(
                    "the case '{}' has more than {} ranges of values, too many for a C file; take "
                    "a case with fewer samples that fails alike",
                    case_.id, kMostRanges));
            }
            if (run > 0 && row != last) {
                runs += fmt::format("    {{{}, {}}},\n", run, last);
                run = 0;
            }
            last = std::move(row);
            ++run;
        }
        runs += fmt::format("    {{{}, {}}},\n", run, last);
        return fmt::format(
            "static const struct Bounds kBounds[] = {{\n{}}};\n\n"
            "static const struct Range kRanges[] = {{\n{}}};\n\n"
            "static const struct Writer kWriters[] = {{\n{}}};\n\n"
            "static const struct Color kColors[] = {{\n{}}};\n\n"
            "static const struct Expected kExpected[] = {{\n{}}};\n\n",
            bounds_.text(""), ranges_.text("{0, 0},"), writers_.text("{0, 0, 0},"),
            color_rows_.text("{0, 0, 0, 0, {0}, {0}},"), runs);
    }

  private:
    std::string sample_row(size_t index) {
        const ref::SampleExpectation& s = expectation_.samples[index];
        const ref::HitBounds& h = s.hits;
        const size_t bounds = bounds_.number(
            fmt::format("{{{}, {}, {}, {}, {}, {}, {}, {}}},", h.front_min, h.front_max, h.back_min,
                        h.back_max, h.signed_min, h.signed_max, h.total_min, h.total_max));
        std::string writers, depths;
        std::vector<ColorRows::Sequence> sets;
        size_t colors = 0;
        std::string color_text;
        if (colors_) {
            sets = colors_->sets_at(index);
            for (const std::string& row : colors_->rows(index, sets)) {
                color_text += row + " ";
                ++colors;
            }
        }
        if (!case_.target.has_instruments) {
            const BareDepth bare = bare_depth(index, sets);
            return fmt::format("{}, 0, 0, {}, {}, {:d}, {}, {}", bounds,
                               bare.count > 0 ? ranges_.number(bare.text, bare.count) : 0,
                               bare.count, bare.may_be_clear,
                               colors > 0 ? color_rows_.number(color_text, colors) : 0, colors);
        }
        for (uint32_t k = 0; k < s.writers_count; ++k) {
            const uint32_t t = expectation_.writers[s.writers_begin + k];
            const cases::Triangle& triangle = expectation_.triangles[t];
            writers += fmt::format("{{{}, {}, {}}}, ", triangle.draw, triangle.provoking,
                                   ranges_of(t, index));
        }
        for (uint32_t k = 0; k < s.depth_count; ++k) {
            depths += depth_text(expectation_.depth_writers[s.depth_begin + k], index);
        }
        return fmt::format(
            "{}, {}, {}, {}, {}, {:d}, {}, {}", bounds,
            s.writers_count > 0 ? writers_.number(writers, s.writers_count) : 0, s.writers_count,
            s.depth_count > 0 ? ranges_.number(depths, s.depth_count) : 0, s.depth_count,
            s.depth_may_be_clear, colors > 0 ? color_rows_.number(color_text, colors) : 0, colors);
    }

    // The depth of a target that only the colour tells of: that of the last of any set.
    struct BareDepth {
        std::string text;
        size_t count = 0;
        bool may_be_clear = false;
    };
    BareDepth bare_depth(size_t index, const std::vector<ColorRows::Sequence>& sets) {
        BareDepth out;
        if (!case_.target.has_depth || sets.empty() || !judges_bare_depth(case_)) {
            return {range_text({}), 1, true};
        }
        for (const ColorRows::Sequence& sequence : sets) {
            if (sequence.empty()) {
                out.may_be_clear = true;
                continue;
            }
            out.text += depth_text(sequence.back(), index);
            ++out.count;
        }
        return out;
    }

    std::string depth_text(uint32_t t, size_t index) {
        return range_text(
            values_.range(t, cases::sample_at(case_.target, index), ref::QuantityId{}));
    }

    // The first of the ranges of a triangle's values at a sample.
    size_t ranges_of(uint32_t t, size_t index) {
        const cases::SampleId id = cases::sample_at(case_.target, index);
        const cases::Draw& draw = case_.draws[expectation_.triangles[t].draw];
        const ref::ValueRange z = values_.range(t, id, ref::QuantityId::of_frag_coord(2));
        std::string row = range_text(z) +
                          range_text(values_.range(t, id, ref::QuantityId::of_frag_coord(3))) +
                          depth_text(t, index);
        if (draw.depth.bias) {
            row +=
                range_text(z.has_biased ? ref::ValueRange{true, z.biased_low, z.biased_high} : z);
        }
        const auto& attributes = draw.attributes;
        for (size_t a = 0; a < attributes.size(); ++a) {
            for (const ref::ValueRange& range : attribute_ranges(t, id, a)) {
                row += range_text(range);
            }
        }
        return ranges_.number(row, 3 + size_t{draw.depth.bias.has_value()} + 4 * attributes.size());
    }

    std::array<ref::ValueRange, 4> attribute_ranges(uint32_t t, cases::SampleId id, size_t a) {
        const cases::Attribute& attribute =
            case_.draws[expectation_.triangles[t].draw].attributes[a];
        if (attribute.source == cases::Source::sample_mask_in) {
            return {mask_range(t, id), {}, {}, {}};
        }
        const bool is_value =
            attribute.probe == cases::Probe::value || attribute.probe == cases::Probe::at_centroid;
        return is_value ? values_.ranges(t, id, a) : probes_.of(t, id, a);
    }

    // The samples that gl_SampleMaskIn must have, and those that it may have
    // (ref/value/sample_values.cpp).
    ref::ValueRange mask_range(uint32_t t, cases::SampleId id) {
        const cases::Draw& draw = case_.draws[expectation_.triangles[t].draw];
        const ref::PixelCoverage& coverage = probes_.coverage(t, id);
        const uint32_t own = 1U << id.sample;
        uint32_t must = own;
        uint32_t may = (coverage.may & draw.multisample.sample_mask) | own;
        switch (ref::value::shading_rate(draw, case_.target.samples)) {
            case ref::value::ShadingRate::fragment:
                must |= coverage.is_one_fragment ? coverage.must & draw.multisample.sample_mask : 0;
                break;
            case ref::value::ShadingRate::sample:
                may = expectation_.profile == cases::Profile::vulkan ? may : own;
                break;
            case ref::value::ShadingRate::may_split:
            case ref::value::ShadingRate::some:
                break;
        }
        return {true, static_cast<double>(must), static_cast<double>(may)};
    }

    const cases::Case& case_;
    ref::Expectation expectation_;
    ref::ValueReference values_;
    ProbeRanges probes_;
    std::optional<ColorRows> colors_;
    Rows bounds_, ranges_, writers_, color_rows_;
};

}  // namespace

cases::Expected<std::string> expected_tables(const cases::Case& c, const ref::Limits& limits,
                                             cases::Profile profile) {
    return Tables(c, limits, profile).text();
}

}  // namespace cli
