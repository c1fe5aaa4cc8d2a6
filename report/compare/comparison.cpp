// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "cases/base/printable.hpp"
#include "cases/model/device.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

constexpr std::array<std::string_view, kChanges> kNames = {
    "regression",     "vanished",     "fix",          "fails otherwise", "fails alike",
    "other coverage", "other values", "only in some", "judged in none",  "same"};

// How bad a status is; nothing for what was not judged.
std::optional<int> severity(const CaseRecord* record) {
    if (record == nullptr) {
        return std::nullopt;
    }
    constexpr std::array kOrder = {Status::pass,        Status::flake,   Status::fail,
                                   Status::device_lost, Status::timeout, Status::crash};
    const auto at = std::ranges::find(kOrder, actual_status(*record));
    return at == kOrder.end() ? std::nullopt : std::optional(static_cast<int>(at - kOrder.begin()));
}

// A run has no such case, its device does not support it, or somebody wants it not to be drawn.
bool is_lacking(const CaseRecord* record) {
    return record == nullptr || actual_status(*record) == Status::unsupported ||
           (record->status == Status::skip && record->known.expected == Status::skip);
}

// Nothing is known of what the case would have done: besides the above, a run that ended early
// (--fail-fast).
bool is_gone(const CaseRecord* record) {
    return is_lacking(record) || record->status == Status::skip;
}

// "3 value of interp.linear [vulkan]", for each group of b's findings that a has not, or has fewer
// of.
std::vector<std::string> news_of(const CaseRecord& a, const CaseRecord& b) {
    std::vector<std::string> news;
    for (const diff::FindingGroup& g : b.outcome.groups) {
        const auto same =
            std::ranges::find_if(a.outcome.groups, [&](const diff::FindingGroup& other) {
                return g.kind == other.kind && g.rule == other.rule && g.level == other.level &&
                       g.door == other.door;
            });
        const uint64_t before = same == a.outcome.groups.end() ? 0 : same->count;
        if (g.count > before) {
            news.push_back(fmt::format("{} {} of {} [{}]{}", g.count, diff::to_string(g.kind),
                                       g.rule.empty() ? "no told rule" : g.rule,
                                       cases::to_string(g.level),
                                       before > 0 ? fmt::format(" instead of {}", before) : ""));
        }
    }
    return news;
}

// How often a brief record breaks a rule is not known.
bool have_counts(const CaseRecord& a, const CaseRecord& b) {
    return !a.drawn.is_brief && !b.drawn.is_brief;
}

// What identifies how a case fails, as far as both runs tell it.
bool fails_alike(const CaseRecord& a, const CaseRecord& b) {
    return (a.outcome.counts == b.outcome.counts || !have_counts(a, b)) &&
           a.outcome.level == b.outcome.level && a.death.signal == b.death.signal &&
           a.drawn.bits == b.drawn.bits && actual_status(a) == actual_status(b);
}

// Whether b fails in a way in which a does not; nothing is said of journals without groups.
bool fails_anew(const CaseRecord& a, const CaseRecord& b) {
    if (actual_status(a) != actual_status(b) || a.death.signal != b.death.signal) {
        return actual_status(a) == actual_status(b);
    }
    return have_counts(a, b) ? !a.outcome.groups.empty() && !news_of(a, b).empty()
                             : b.outcome.level < a.outcome.level;
}

// The first later run that has another case under the id than the first run, by what is drawn; 0:
// none. Versions of the program put cases into other bytes, and older ones told nothing.
size_t run_with_other_case(const std::vector<const CaseRecord*>& records,
                           const std::vector<NamedRun>& runs) {
    for (size_t k = 1; k < records.size(); ++k) {
        const CaseRecord *a = records.front(), *b = records[k];
        if (a != nullptr && b != nullptr && !a->content.empty() && !b->content.empty() &&
            a->content != b->content && runs[0].run.tool_version == runs[k].run.tool_version) {
            return k;
        }
    }
    return 0;
}

Change change_of(const ComparedCase& c) {
    const std::vector<const CaseRecord*>& records = c.records;
    const std::optional<int> first = severity(records.front());
    if (c.other != 0) {
        return first ? Change::vanished : Change::only_in_some;
    }
    bool worse = false, better = false, gone = false, some = false, all = true;
    for (const CaseRecord* record : records) {
        const std::optional<int> s = severity(record);
        some = some || s;
        all = all && s;
        worse = worse || (first && s && *s > *first);
        better = better || (first && s && *s < *first);
        worse = worse ||
                (first && s && *s == *first && *s > 0 && fails_anew(*records.front(), *record));
        gone = gone || (first && is_gone(record));
    }
    if (worse) {
        return Change::regression;
    }
    if (gone) {
        return Change::vanished;
    }
    if (better) {
        return Change::fix;
    }
    if (!all) {
        return some ? Change::only_in_some : Change::judged_in_none;
    }
    bool alike = true, same_bits = true, same_hits = true;
    for (const CaseRecord* record : records) {
        alike = alike && fails_alike(*records.front(), *record);
        same_bits = same_bits && record->drawn.bits == records.front()->drawn.bits;
        same_hits = same_hits && record->drawn.hit_bits == records.front()->drawn.hit_bits;
    }
    if (*first > 0) {
        return alike ? Change::fails_alike : Change::fails_otherwise;
    }
    return !same_hits ? Change::other_coverage : !same_bits ? Change::other_values : Change::same;
}

// "3 of 64 samples are hit otherwise in A and B, first (3,4)", from the kept pictures.
std::string picture_detail(const CaseRecord& a, const CaseRecord& b, const std::string& names) {
    const Pictures &p = a.evidence.pictures, &q = b.evidence.pictures;
    const size_t samples = p.device_hits.size() / (size_t{p.width} * p.height);
    size_t count = 0, first = 0;
    for (size_t k = 0; k < p.device_hits.size(); ++k) {
        if (p.device_hits[k] != q.device_hits[k]) {
            first = count == 0 ? k : first;
            ++count;
        }
    }
    if (count == 0) {
        return {};
    }
    const size_t pixel = first / samples;
    return fmt::format("{} of {} samples hit otherwise in {}, first ({},{})", count,
                       p.device_hits.size(), names, p.left + pixel % p.width,
                       p.top + pixel / p.width);
}

// What a bad result is known by: "1 missing of 64 samples, tie.top-left [direct3d]".
std::string short_reason(const CaseRecord& record) {
    if (record.outcome.findings.empty()) {
        return record.death.signal.empty() ? why_it_happened(record)
                                           : cases::printable(record.death.signal);
    }
    const diff::Finding& f = leading_finding(record);
    return cases::printable(
        fmt::format("{}, {} [{}]", counts_text(record), f.rule, cases::to_string(f.level)));
}

std::string detail_of(const ComparedCase& c, const std::vector<std::string>& letters) {
    const CaseRecord* first = c.records.front();
    switch (c.change) {
        case Change::regression:
        case Change::fix:
        case Change::fails_otherwise:
        case Change::fails_alike: {
            // The worst one says why.
            size_t worst = 0;
            for (size_t k = 1; k < c.records.size(); ++k) {
                const auto s = severity(c.records[k]);
                worst = s && *s > severity(c.records[worst]).value_or(-1) ? k : worst;
            }
            std::string text = letters[worst] + ": " + short_reason(*c.records[worst]);
            for (size_t k = 1; c.change == Change::regression && k < c.records.size(); ++k) {
                if (severity(first) == severity(c.records[k]) && severity(first) > 0) {
                    if (const auto news = news_of(*first, *c.records[k]); !news.empty()) {
                        return fmt::format("{}: new: {}", letters[k], fmt::join(news, ", "));
                    }
                    worst = k;
                    text = letters[worst] + ": " + short_reason(*c.records[worst]);
                }
            }
            if (c.change == Change::fails_otherwise && worst == 0) {
                text += "; " + letters[1] + ": " + short_reason(*c.records[1]);
            }
            return text;
        }
        case Change::other_coverage: {
            for (size_t k = 1; k < c.records.size(); ++k) {
                if (show_same_hits(first->evidence.pictures, c.records[k]->evidence.pictures)) {
                    const std::string text =
                        picture_detail(*first, *c.records[k], letters[0] + " and " + letters[k]);
                    if (!text.empty()) {
                        return text;
                    }
                }
            }
            // Each by its own subpixel grid.
            std::string text;
            for (size_t k = 0; k < c.records.size(); ++k) {
                if (c.records[k] != nullptr) {
                    text += fmt::format("{}{} of {} samples are free in {}", k == 0 ? "" : ", ",
                                        c.records[k]->outcome.either_samples,
                                        c.records[k]->outcome.compared_samples, letters[k]);
                }
            }
            return text;
        }
        case Change::vanished:
        case Change::only_in_some:
        case Change::judged_in_none:
            if (c.other != 0) {
                return letters[c.other] + ": another case under the same id";
            }
            for (size_t k = 0; k < c.records.size(); ++k) {
                if (c.records[k] != nullptr && !severity(c.records[k])) {
                    return letters[k] + ": " + why_it_happened(*c.records[k]);
                }
            }
            return {};
        case Change::other_values:
        case Change::same:
            break;
    }
    return {};
}

std::string letter(size_t k) {
    return k < 26 ? std::string(1, static_cast<char>('A' + k)) : fmt::format("R{}", k + 1);
}

}  // namespace

bool show_same_hits(const Pictures& a, const Pictures& b) {
    return a.width > 0 && a.height > 0 && a.width == b.width && a.height == b.height &&
           a.left == b.left && a.top == b.top && a.device_hits.size() == b.device_hits.size() &&
           !a.device_hits.empty() && a.device_hits.size() % (size_t{a.width} * a.height) == 0;
}

std::string_view to_string(Change change) {
    return kNames.at(static_cast<size_t>(change));
}

cases::Expected<Comparison> compare_runs(const std::vector<NamedRun>& runs, Strictness strictness) {
    if (runs.size() < 2) {
        return cases::failure("comparing needs the folders of at least two runs");
    }
    Comparison result;
    result.strictness = strictness;
    const Run& first = runs.front().run;
    for (size_t k = 0; k < runs.size(); ++k) {
        const Run& run = runs[k].run;
        result.letters.push_back(letter(k));
        if (run.profile != first.profile) {
            return cases::failure(
                "{} is judged at profile {} and {} at {}; compare runs of one profile",
                runs.front().folder, cases::to_string(first.profile), runs[k].folder,
                cases::to_string(run.profile));
        }
        result.unjudged += run.missing_shards.size();  // of at least one case each
        if (run.suite_hash != first.suite_hash) {
            result.remarks.push_back(fmt::format(
                "the suites of {} and {} are not the same: a case may ask something else",
                result.letters.front(), result.letters[k]));
        }
        if (run.device.subpixel_bits != first.device.subpixel_bits) {
            result.remarks.push_back(
                fmt::format("{} has {} subpixel bits and {} has {}: vertices snap to other places",
                            result.letters.front(), first.device.subpixel_bits, result.letters[k],
                            run.device.subpixel_bits));
        }
    }
    std::map<std::string, size_t> index;
    for (size_t k = 0; k < runs.size(); ++k) {
        for (const CaseRecord& record : runs[k].run.cases) {
            const auto [at, fresh] = index.emplace(record.id, result.cases.size());
            if (fresh) {
                result.cases.push_back({record.id, Change::same, {}, {}, 0});
                result.cases.back().records.resize(runs.size(), nullptr);
            }
            result.cases[at->second].records[k] = &record;
            const Status status = actual_status(record);
            result.unjudged += status == Status::error || status == Status::not_run ? 1U : 0U;
        }
    }
    // A run tells of the device's limits only where one is wrong, or where somebody asks.
    static const CaseRecord kRightLimits = [] {
        CaseRecord record;
        record.id = cases::kLimitsCase;
        record.status = Status::pass;
        return record;
    }();
    if (const auto at = index.find(cases::kLimitsCase); at != index.end()) {
        auto& records = result.cases[at->second].records;
        std::ranges::replace(records, static_cast<const CaseRecord*>(nullptr), &kRightLimits);
    }
    for (ComparedCase& c : result.cases) {
        c.other = run_with_other_case(c.records, runs);
    }
    if (strictness.common) {
        std::erase_if(result.cases, [](const ComparedCase& c) {
            return c.other != 0 || std::ranges::any_of(c.records, is_lacking);
        });
    }
    for (ComparedCase& c : result.cases) {
        c.change = change_of(c);
        c.detail = detail_of(c, result.letters);
        std::ranges::replace(c.detail, '\n', ' ');
        ++result.counts.at(static_cast<size_t>(c.change));
    }
    return result;
}

size_t compared_cases(const Comparison& comparison) {
    size_t compared = comparison.cases.size();
    for (const Change change : {Change::vanished, Change::only_in_some, Change::judged_in_none}) {
        compared -= comparison.counts.at(static_cast<size_t>(change));
    }
    return compared;
}

int exit_code(const Comparison& comparison) {
    const auto count = [&](Change change) {
        return comparison.counts.at(static_cast<size_t>(change));
    };
    const bool differs = comparison.cases.size() > count(Change::same) +
                                                       count(Change::fails_alike) +
                                                       count(Change::judged_in_none);
    if (count(Change::regression) + count(Change::vanished) > 0 ||
        (comparison.strictness.strict && differs)) {
        return kExitUnexpected;
    }
    if (comparison.unjudged > 0) {
        return kExitInternal;
    }
    return compared_cases(comparison) == 0 ? kExitNothingSelected : kExitOk;
}

}  // namespace report
