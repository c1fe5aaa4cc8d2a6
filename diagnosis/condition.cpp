// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace diagnosis {

namespace {

using Kind = Condition::Kind;

// How many triangles a draw has, without restarts.
size_t count_triangles(const cases::Draw& draw) {
    const size_t vertices = draw.element_count();
    return draw.topology == cases::Topology::triangle_list ? vertices / 3
                                                           : std::max<size_t>(vertices, 2) - 2;
}

bool is_written(const Spot& spot) {
    return spot.writer.draw < spot.of.draws.size() &&
           spot.writer.primitive != capture::kNoPrimitive;
}
bool is_triangle(const Spot& spot, uint32_t number) {
    return is_written(spot) && spot.writer.primitive == number;
}

// Beside those of places, which are made for a case.
const std::vector<Condition>& known_conditions() {
    static const std::vector<Condition> kAll = {
        {Kind::triangle, "first-triangle", "in the first triangle of a draw",
         [](const Spot& s) { return is_triangle(s, 0); }},
        {Kind::triangle, "second-triangle", "in the second triangle of a draw",
         [](const Spot& s) { return is_triangle(s, 1); }},
        {Kind::triangle, "last-triangle", "in the last triangle of a draw",
         [](const Spot& s) {
             return is_written(s) &&
                    s.writer.primitive + size_t{1} == count_triangles(s.of.draws[s.writer.draw]);
         }},
        {Kind::triangle, "odd-triangles", "in every other triangle of a draw, from the second on",
         [](const Spot& s) { return is_written(s) && s.writer.primitive % 2 == 1; }},
        {Kind::triangle, "later-triangles", "in all triangles of a draw but the first",
         [](const Spot& s) { return is_written(s) && s.writer.primitive > 0; }},
        {Kind::draw, "first-draw", "in the first draw",
         [](const Spot& s) { return s.writer.draw == 0; }},
        {Kind::draw, "second-draw", "in the second draw",
         [](const Spot& s) { return s.writer.draw == 1; }},
        {Kind::draw, "later-draws", "in all draws but the first",
         [](const Spot& s) { return s.writer.draw > 0 && is_written(s); }},
        {Kind::width, "odd-width", "where the target's width is odd",
         [](const Spot& s) { return s.of.target.width % 2 == 1; }},
        {Kind::width, "even-width", "where the target's width is even",
         [](const Spot& s) { return s.of.target.width % 2 == 0; }},
        {Kind::height, "odd-height", "where the target's height is odd",
         [](const Spot& s) { return s.of.target.height % 2 == 1; }},
        {Kind::height, "even-height", "where the target's height is even",
         [](const Spot& s) { return s.of.target.height % 2 == 0; }},
        {Kind::samples, "one-sample", "where a pixel has one sample",
         [](const Spot& s) { return s.of.target.samples == 1; }},
        {Kind::samples, "several-samples", "where a pixel has several samples",
         [](const Spot& s) { return s.of.target.samples > 1; }},
    };
    return kAll;
}

// The places that all these samples have in common, the narrowest first.
std::vector<Condition> places(const cases::Target& target, std::span<const cases::SampleId> ids) {
    std::vector<Condition> out;
    const cases::SampleId at = ids.front();
    const auto all = [&](const auto& is_like) { return std::ranges::all_of(ids, is_like); };
    const auto add = [&](bool is_common, std::string name, std::string what, auto holds) {
        if (is_common) {
            out.push_back({Kind::place, std::move(name), std::move(what), holds});
        }
    };
    const bool is_column = all([&](const auto& id) { return id.x == at.x; });
    const bool is_row = all([&](const auto& id) { return id.y == at.y; });
    add(is_column && is_row, fmt::format("pixel-{}-{}", at.x, at.y),
        fmt::format("at pixel ({}, {})", at.x, at.y),
        [at](const Spot& s) { return s.id.x == at.x && s.id.y == at.y; });
    add(is_column, fmt::format("column-{}", at.x), fmt::format("in column {}", at.x),
        [at](const Spot& s) { return s.id.x == at.x; });
    add(is_row, fmt::format("row-{}", at.y), fmt::format("in row {}", at.y),
        [at](const Spot& s) { return s.id.y == at.y; });
    for (const auto& [odd, word] : {std::pair(1U, "odd"), std::pair(0U, "even")}) {
        add(all([&, odd = odd](const auto& id) { return id.x % 2 == odd; }),
            fmt::format("{}-columns", word), fmt::format("in columns of {} number", word),
            [odd = odd](const Spot& s) { return s.id.x % 2 == odd; });
        add(all([&, odd = odd](const auto& id) { return id.y % 2 == odd; }),
            fmt::format("{}-rows", word), fmt::format("in rows of {} number", word),
            [odd = odd](const Spot& s) { return s.id.y % 2 == odd; });
    }
    add(target.samples > 1 && all([&](const auto& id) { return id.sample == at.sample; }),
        fmt::format("sample-{}", at.sample), fmt::format("in sample {} of a pixel", at.sample),
        [at](const Spot& s) { return s.id.sample == at.sample; });
    return out;
}

capture::Writer writer_of(const capture::Capture& right, const capture::Capture& drawn,
                          size_t index) {
    for (const capture::Capture* of : {&right, &drawn}) {
        if (index < of->writers.size() && of->writers[index].draw != capture::kClearId) {
            return of->writers[index];
        }
    }
    return {};
}

}  // namespace

std::vector<Condition> conditions_at(const Subject& subject, const capture::Capture& drawn) {
    const cases::Case& c = *subject.data;
    std::vector<Spot> spots;
    std::vector<cases::SampleId> ids;
    const std::vector<uint8_t>& marks = marks_of(*subject.record);
    for (size_t k = 0; k < marks.size(); ++k) {
        if (is_wrong_mark(marks[k])) {
            ids.push_back(cases::sample_at(c.target, k));
            spots.push_back({c, ids.back(), writer_of(subject.right, drawn, k)});
        }
    }
    std::vector<Condition> out;
    if (spots.empty()) {
        return out;
    }
    out = places(c.target, ids);
    std::ranges::copy_if(known_conditions(), std::back_inserter(out), [&](const Condition& known) {
        return std::ranges::all_of(spots, known.holds);
    });
    return out;
}

bool restrict_to(const Condition& condition, const cases::Case& c, const capture::Capture& right,
                 capture::Capture& drawn) {
    const cases::Target& target = c.target;
    const size_t samples = size_t{target.width} * target.rows() * target.samples;
    std::vector<bool> holds(samples);
    for (size_t k = 0; k < samples; ++k) {
        holds[k] = condition.holds({c, cases::sample_at(target, k), writer_of(right, drawn, k)});
    }
    // What is counted follows from what is shown, and is not judged where that is wrong.
    drawn.counted = right.counted;
    bool is_alike = true;
    capture::for_each_plane(
        [&](const capture::Plane& plane, const auto& from, auto& to) {
            is_alike = is_alike && from.size() == to.size();
            if (!is_alike || to.empty()) {
                return;
            }
            // A resolved pixel is taken by its first sample.
            const size_t step = samples / std::max<size_t>(1, plane.entries);
            for (size_t k = 0; k < to.size(); ++k) {
                if (k * step >= samples || !holds[k * step]) {
                    to[k] = from[k];
                }
            }
        },
        right, right, drawn);
    return is_alike;
}

}  // namespace diagnosis
