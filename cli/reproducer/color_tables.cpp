// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reproducer/color_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "cases/format/color_format.hpp"
#include "ref/color/color.hpp"
#include "ref/color/component.hpp"

namespace cli {

namespace {

using ref::color::Component;
using ref::color::Interval;

// Codes ordered as their values are: code_key of program/color.c, and back.
class Keys {
  public:
    explicit Keys(cases::ComponentFormat format) : format_(format) {}
    bool exists(int64_t key) const {
        const int64_t most = (int64_t{1} << (format_.bits - (is_signed() ? 1U : 0U))) - 1;
        return key <= most && key >= (is_signed() ? -most : 0);
    }
    uint32_t code(int64_t key) const {
        return key >= 0 ? static_cast<uint32_t>(key) : static_cast<uint32_t>(-key) | sign();
    }
    int64_t key(uint32_t code) const {
        return is_signed() && (code & sign()) != 0 ? -int64_t{code & ~sign()} : int64_t{code};
    }

  private:
    bool is_signed() const { return cases::is_floating(format_.kind); }
    uint32_t sign() const { return uint32_t{1} << (format_.bits - 1); }
    cases::ComponentFormat format_;
};

// The first and the last code, by key, that an interval of stored() allows.
std::array<int64_t, 2> codes_of(cases::ComponentFormat format, const Interval& stored) {
    if (Component::is_anything(stored)) {
        constexpr int64_t kAll = int64_t{1} << 40;  // beyond all keys
        return {-kAll, kAll};
    }
    const Component component(format);
    const Keys keys(format);
    const auto allows = [&](int64_t key) {
        return keys.exists(key) && component.allows(keys.code(key), stored);
    };
    int64_t low = keys.key(component.code_of(stored.low));
    int64_t high = keys.key(component.code_of(stored.high));
    // code_of rounds to the nearest: the ends are that code or a neighbour of it.
    while (!allows(low) && low < high) {
        ++low;
    }
    while (allows(low - 1)) {
        --low;
    }
    while (!allows(high) && high > low) {
        --high;
    }
    while (allows(high + 1)) {
        ++high;
    }
    return {low, high};
}

}  // namespace

std::vector<ColorRows::Sequence> ColorRows::sets_at(size_t index) const {
    const ref::SampleExpectation& sample = expectation_.samples[index];
    const auto fragments = expectation_.fragments_of(sample);
    if (!sample.is_open) {
        return {shown_at(expectation_, sample)};
    }
    if (sample.is_free) {
        return {};
    }
    std::vector<Sequence> out =
        shown_by(question_of(expectation_, case_, sample), ref::path::Observed{}).lists;
    if (out.size() > kMostSets) {
        return {};
    }
    for (Sequence& sequence : out) {
        for (uint32_t& m : sequence) {
            m = fragments[m].triangle;
        }
    }
    return out;
}

std::vector<std::string> ColorRows::rows(size_t index, const std::vector<Sequence>& sets) {
    const cases::SampleId id = cases::sample_at(case_.target, index);
    std::set<std::string> known;
    std::vector<std::string> out;
    for (const Sequence& sequence : sets) {
        std::string text = row(sequence, id);
        if (known.insert(text).second) {
            out.push_back(std::move(text));
        }
    }
    return out;
}

ref::color::Color ColorRows::source_of(uint32_t triangle, cases::SampleId id) {
    const cases::ColorOutput& output = output_of(triangle);
    ref::color::Color out;
    std::array<ref::ValueRange, 4> ranges;
    if (output.attribute >= 0) {
        ranges = values_.ranges(triangle, id, static_cast<size_t>(output.attribute));
    }
    for (size_t k = 0; k < 4; ++k) {
        const auto constant = static_cast<double>(output.value[static_cast<int>(k)]);
        out.at(k) = output.attribute < 0       ? ref::color::point(constant)
                    : ranges.at(k).is_promised ? Interval{ranges.at(k).low, ranges.at(k).high}
                                               : Component::anything();
    }
    return out;
}

std::string ColorRows::row(const Sequence& sequence, cases::SampleId id) {
    // Nothing is left of what a fragment replaces.
    size_t first = sequence.size();
    const auto replaces = [&](uint32_t triangle) {
        return !output_of(triangle).blend && output_of(triangle).write_mask == 0xf;
    };
    while (first > 0 && !replaces(sequence[--first])) {
    }
    ref::color::Color color = cleared_;
    for (size_t k = first; k < sequence.size(); ++k) {
        color = unit_.write(output_of(sequence[k]), source_of(sequence[k], id), color);
    }
    std::array<std::array<int64_t, 2>, 4> codes{};
    for (uint32_t k = 0; k < 4; ++k) {
        const cases::ComponentFormat format = cases::component_of(unit_.format, k);
        if (format.bits > 0) {
            codes.at(k) = codes_of(format, color.at(k));
        }
    }
    uint32_t draw = 0, vertex = 0;
    int32_t captured = 0;
    size_t hits = 0;
    if (!sequence.empty()) {
        const cases::Triangle& last = expectation_.triangles[sequence.back()];
        const cases::ColorOutput& output = output_of(sequence.back());
        draw = last.draw;
        if (case_.target.has_instruments) {
            vertex = last.provoking;
            hits = sequence.size();
            captured = output.blend ? 0 : output.attribute + 1;
        }
    }
    return fmt::format("{{{}, {}, {}, {}, {{{}, {}, {}, {}}}, {{{}, {}, {}, {}}}}},", hits, draw,
                       vertex, captured, codes[0][0], codes[1][0], codes[2][0], codes[3][0],
                       codes[0][1], codes[1][1], codes[2][1], codes[3][1]);
}

bool judges_bare_depth(const cases::Case& c) {
    return c.target.depth_format == cases::DepthFormat::d32_float &&
           std::ranges::all_of(c.draws,
                               [](const cases::Draw& d) { return d.depth == cases::DepthState{}; });
}

}  // namespace cli
