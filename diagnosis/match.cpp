// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/match.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "cases/model/sample.hpp"
#include "diff/delivered.hpp"
#include "rasterizers/strength/strength.hpp"

namespace diagnosis {

namespace {

struct Words {
    std::vector<std::string> words;
    std::vector<double> numbers;
};

// Splits a text at spaces and commas; what stands in parentheses is left out.
Words words_of(std::string_view text) {
    Words out;
    int depth = 0;
    std::string word;
    const auto end_word = [&] {
        if (word.empty()) {
            return;
        }
        char* end = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        if (*end == '\0') {
            out.numbers.push_back(number);
        } else {
            out.words.push_back(word);
        }
        word.clear();
    };
    for (const char c : text) {
        depth += c == '(' ? 1 : 0;
        if (depth > 0) {
            depth -= c == ')' ? 1 : 0;
        } else if (c == ' ' || c == ',') {
            end_word();
        } else {
            word += c;
        }
    }
    end_word();
    return out;
}

bool is_same_number(double expected, double device, double other) {
    if (!std::isfinite(device) || !std::isfinite(other)) {
        return std::isnan(device) ? std::isnan(other) : std::equal_to<>()(device, other);
    }
    const double apart = std::abs(device - other);
    const bool is_code = !(device > std::floor(device)) && !(other > std::floor(other));
    return apart <= std::abs(device - expected) / 16 || (is_code && apart <= 1);
}

// Findings of one case with the same key are about the same thing.
auto key_of(const diff::Finding& f) {
    return std::tuple(f.layer.value_or(0), f.y, f.x, f.sample, std::string_view(f.quantity));
}

}  // namespace

const std::vector<uint8_t>& marks_of(const report::CaseRecord& record) {
    const report::Pictures& p = record.evidence.pictures;
    return p.plain_marks.empty() ? p.marks : p.plain_marks;
}

bool is_wrong_mark(uint8_t mark) {
    return mark > static_cast<uint8_t>(diff::SampleMark::either);
}

bool is_same_value(std::string_view expected, std::string_view device, std::string_view other) {
    const Words d = words_of(device);
    const Words o = words_of(other);
    const Words e = words_of(expected);
    if (d.words != o.words || d.numbers.size() != o.numbers.size()) {
        return false;
    }
    for (size_t k = 0; k < d.numbers.size(); ++k) {
        // Of 'r 158 to 161, g 47' and of 'a value between ...' no number is taken.
        const double nominal =
            e.numbers.size() == d.numbers.size() || (d.numbers.size() == 1 && !e.numbers.empty())
                ? e.numbers[k]
                : d.numbers[k] * (1 - 0x1p-6);
        if (!is_same_number(nominal, d.numbers[k], o.numbers[k])) {
            return false;
        }
    }
    return true;
}

std::optional<Subject> make_subject(const cases::Case& filed, const report::CaseRecord& record,
                                    const ref::Limits& limits, cases::Profile profile) {
    Subject out;
    out.data = &filed;
    out.record = &record;
    const std::optional<cases::Case> placed = ref::as_drawn(filed, limits);
    const cases::Case& c = placed ? *placed : filed;
    const bool is_whole = record.drawn.is_delivered && !c.blit && !c.target.has_instruments;
    if (placed || is_whole) {
        auto altered = std::make_shared<cases::Case>(c);
        altered->target.has_instruments = c.target.has_instruments || is_whole;
        out.altered = std::move(altered);
        out.data = out.altered.get();
    }
    out.expectation = c.blit ? ref::Expectation{} : ref::expect(c, limits, profile);
    out.expectation.profile = profile;
    software::Device right;
    right.subpixel_bits = limits.subpixel_bits;
    out.right = software::captured(*out.data, right);
    if (!verdict_of(out, out.right).ok()) {
        return std::nullopt;
    }
    return out;
}

diff::Verdict verdict_of(const Subject& subject, const capture::Capture& picture) {
    const cases::Case& c = *subject.data;
    const std::vector<std::string>& left_out = subject.record->drawn.not_judged;
    return c.blit || !subject.record->drawn.is_delivered
               ? software::compare(c, subject.expectation, picture)
               : diff::compare_delivered(c, subject.expectation,
                                         diff::judged_planes(c, picture, left_out));
}

bool can_match(const cases::Case& c, const report::CaseRecord& record) {
    const report::Pictures& p = record.evidence.pictures;
    const bool is_whole =
        p.width == c.target.width && p.height == c.target.rows() && !p.marks.empty();
    const auto& groups = record.outcome.groups;
    return is_whole &&
           std::ranges::none_of(groups,
                                [](const auto& g) {
                                    return g.rule.starts_with("repeat.") ||
                                           g.rule.starts_with("write.");
                                }) &&
           !std::ranges::all_of(groups, [](const auto& g) { return !g.door.empty(); });
}

std::optional<double> number_at(const capture::Capture& capture, size_t index,
                                std::string_view quantity) {
    const auto of = [&](const std::vector<glm::vec4>& plane) -> std::optional<double> {
        const size_t c = std::string_view("xyzw").find(quantity.back());
        if (c == std::string_view::npos || index >= plane.size()) {
            return std::nullopt;
        }
        return plane[index][static_cast<glm::vec4::length_type>(c)];
    };
    if (quantity == "depth") {
        return index < capture.depth.size() ? std::optional<double>(capture.depth[index])
                                            : std::nullopt;
    }
    if (quantity.starts_with("frag_coord.")) {
        return of(capture.frag_coord);
    }
    if (quantity.starts_with("attribute ") && quantity.size() == 13) {
        const auto number = static_cast<size_t>(quantity[10] - '0');
        return number < cases::kMaxAttributes ? of(capture.attributes[number]) : std::nullopt;
    }
    return std::nullopt;
}

bool may_match(const Subject& subject, const capture::Capture& drawn) {
    const report::Pictures& pictures = subject.record->evidence.pictures;
    const std::vector<uint8_t>& marks = marks_of(*subject.record);
    uint64_t wrong = 0;
    uint64_t other = 0;
    // Hits that nobody counted are those that the reference allows.
    const bool counts_hits =
        std::ranges::find(subject.record->drawn.not_judged, "number of hits") ==
        subject.record->drawn.not_judged.end();
    for (size_t k = 0; k < marks.size() && counts_hits; ++k) {
        if (is_wrong_mark(marks[k]) && k < pictures.device_hits.size() && k < drawn.hits.size()) {
            ++wrong;
            const float hits = std::min(255.0F, drawn.hits[k].x + drawn.hits[k].y);
            other += pictures.device_hits[k] == static_cast<uint8_t>(hits) ? 0U : 1U;
        }
    }
    if (16 * other > wrong) {
        return false;
    }
    uint64_t values = 0;
    other = 0;
    for (const diff::Finding& f : subject.record->outcome.findings) {
        const size_t index = cases::index_of(subject.data->target, diff::sample_of(f));
        const std::optional<double> number = f.kind == diff::FindingKind::value && f.door.empty()
                                                 ? number_at(drawn, index, f.quantity)
                                                 : std::nullopt;
        if (number) {
            ++values;
            const double got = std::strtod(f.got.c_str(), nullptr);
            const double expected = number_at(subject.right, index, f.quantity).value_or(0);
            other += is_same_number(expected, got, *number) ? 0U : 1U;
        }
    }
    return 2 * other <= values;
}

Match match(const report::CaseRecord& device, const diff::Verdict& other) {
    Match out;
    const std::vector<uint8_t>& marks = marks_of(device);
    for (size_t k = 0; k < marks.size(); ++k) {
        const auto mark =
            k < other.marks.size() ? static_cast<uint8_t>(other.marks[k]) : uint8_t{0};
        const bool has_hits =
            k < device.evidence.pictures.device_hits.size() && k < other.device_hits.size();
        const bool same_hits =
            !has_hits || device.evidence.pictures.device_hits[k] == other.device_hits[k];
        out.wrong += is_wrong_mark(marks[k]) ? 1U : 0U;
        out.same += is_wrong_mark(marks[k]) && mark == marks[k] && same_hits ? 1U : 0U;
        out.beyond += is_wrong_mark(mark) && !is_wrong_mark(marks[k]) ? 1U : 0U;
    }
    std::vector<const diff::Finding*> told;
    for (const diff::Finding& f : other.findings) {
        told.push_back(&f);
    }
    const auto key = [](const diff::Finding* f) { return key_of(*f); };
    std::ranges::sort(told, {}, key);
    for (const diff::Finding& f : device.outcome.findings) {
        if (!f.door.empty()) {
            continue;
        }
        const auto at = std::ranges::lower_bound(told, key_of(f), {}, key);
        const bool is_told = at != told.end() && key_of(**at) == key_of(f);
        const bool is_kept_by_both = is_told || other.findings.size() < diff::kMaxFindings;
        if (!is_kept_by_both) {
            continue;  // which findings are kept, beyond a number, depends on the others
        }
        ++out.values;
        out.same_values +=
            is_told && (*at)->kind == f.kind && is_same_value(f.expected, f.got, (*at)->got) ? 1U
                                                                                             : 0U;
    }
    return out;
}

}  // namespace diagnosis
