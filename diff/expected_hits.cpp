// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hand-drawn pictures of case files against the reference.
#include <fmt/format.h>

#include <sstream>

#include "cases/base/input_file.hpp"
#include "diff/attribution.hpp"
#include "diff/verdict.hpp"

namespace diff {

namespace {

// Where the file has a character of a picture's row, if each picture is a string whose quotes end a
// line, so that a line a row follows; else where the pictures begin.
cases::SourceLocation place_of(const cases::Case& c, size_t row, size_t x) {
    const cases::ExpectedHits& picture = *c.claim.expected_hits;
    std::istringstream file(cases::read_file(picture.where.file).value_or(""));
    std::string line;
    size_t next = 0;       // row
    bool is_open = false;  // the line is one
    for (uint32_t number = 1; std::getline(file, line); ++number) {
        if (is_open && !line.starts_with(picture.rows[next])) {
            break;
        }
        if (is_open && next++ == row) {
            return {picture.where.file, number, static_cast<uint32_t>(x + 1)};
        }
        line.erase(line.find_last_not_of('\r') + 1);
        is_open =
            (is_open && next % c.target.height != 0) ||
            (number >= picture.where.line && (line.ends_with("\"\"\"") || line.ends_with("'''")));
    }
    return picture.where;
}

}  // namespace

std::optional<cases::Error> check_expected_hits(const cases::Case& c) {
    if (!c.claim.expected_hits) {
        return std::nullopt;
    }
    const ref::Expectation e = ref::expect(c, ref::Limits{8}, cases::Profile::direct3d);
    // Row (layer * samples + s) * height + y is row y of sample s of a layer.
    const std::vector<std::string>& rows = c.claim.expected_hits->rows;
    for (size_t row = 0; row < rows.size(); ++row) {
        const auto picture = static_cast<uint32_t>(row / c.target.height);
        cases::SampleId id{0, static_cast<uint32_t>(row % c.target.height),
                           picture % c.target.samples, picture / c.target.samples};
        for (size_t x = 0; x < c.target.width; ++x) {
            id.x = static_cast<uint32_t>(x);
            const ref::HitBounds& b = e.samples[cases::index_of(c.target, id)].hits;
            const char drawn = rows[row][x];
            const char reference = b.total_min != b.total_max ? '?'
                                   : b.total_min == 0         ? '.'
                                   : b.total_min <= 9         ? static_cast<char>('0' + b.total_min)
                                                              : '#';
            if (drawn != reference) {
                return cases::Error{
                    place_of(c, row, x),
                    fmt::format(
                        "the picture has '{}' at {}, the reference says {}", drawn,
                        cases::sample_text(c.target, id),
                        to_text(b) + (b.total_min == 1 && b.total_max == 1 ? " hit" : " hits"))};
            }
        }
    }
    return std::nullopt;
}

}  // namespace diff
