// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/expected_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "ref/expectation/expectation.hpp"
#include "ref/value/value.hpp"

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
        : case_(c), expectation_(ref::expect(c, limits, profile)), values_(c, limits, profile) {}

    cases::Expected<std::string> text() {
        std::string runs, last;
        size_t run = 0;
        for (size_t k = 0; k < expectation_.samples.size(); ++k) {
            std::string row = sample_row(k);
            if (ranges_.size() > kMostRanges) {
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
            "static const struct Expected kExpected[] = {{\n{}}};\n\n",
            bounds_.text(""), ranges_.text("{0, 0},"), writers_.text("{0, 0, 0},"), runs);
    }

  private:
    std::string sample_row(size_t index) {
        const ref::SampleExpectation& s = expectation_.samples[index];
        const ref::HitBounds& h = s.hits;
        const size_t bounds = bounds_.number(
            fmt::format("{{{}, {}, {}, {}, {}, {}, {}, {}}},", h.front_min, h.front_max, h.back_min,
                        h.back_max, h.signed_min, h.signed_max, h.total_min, h.total_max));
        std::string writers, depths;
        for (uint32_t k = 0; k < s.writers_count; ++k) {
            const uint32_t t = expectation_.writers[s.writers_begin + k];
            const cases::Triangle& triangle = expectation_.triangles[t];
            writers += fmt::format("{{{}, {}, {}}}, ", triangle.draw, triangle.provoking,
                                   ranges_of(t, index));
        }
        for (uint32_t k = 0; k < s.depth_count; ++k) {
            depths += depth_text(expectation_.depth_writers[s.depth_begin + k], index);
        }
        return fmt::format("{}, {}, {}, {}, {}, {:d}", bounds,
                           s.writers_count > 0 ? writers_.number(writers, s.writers_count) : 0,
                           s.writers_count,
                           s.depth_count > 0 ? ranges_.number(depths, s.depth_count) : 0,
                           s.depth_count, s.depth_may_be_clear);
    }

    std::string depth_text(uint32_t t, size_t index) {
        return range_text(
            values_.range(t, cases::sample_at(case_.target, index), ref::QuantityId{}));
    }

    // The first of the ranges of a triangle's values at a sample.
    size_t ranges_of(uint32_t t, size_t index) {
        const cases::SampleId id = cases::sample_at(case_.target, index);
        const auto& attributes = case_.draws[expectation_.triangles[t].draw].attributes;
        std::string row = range_text(values_.range(t, id, ref::QuantityId::of_frag_coord(2))) +
                          range_text(values_.range(t, id, ref::QuantityId::of_frag_coord(3))) +
                          depth_text(t, index);
        for (size_t a = 0; a < attributes.size(); ++a) {
            for (const ref::ValueRange& range : values_.ranges(t, id, a)) {
                row += range_text(range);
            }
        }
        return ranges_.number(row, 3 + 4 * attributes.size());
    }

    const cases::Case& case_;
    ref::Expectation expectation_;
    ref::ValueReference values_;
    Rows bounds_, ranges_, writers_;
};

}  // namespace

cases::Expected<std::string> expected_tables(const cases::Case& c, const ref::Limits& limits,
                                             cases::Profile profile) {
    return Tables(c, limits, profile).text();
}

}  // namespace cli
