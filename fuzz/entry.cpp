// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "cases/load/loader.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/words.hpp"
#include "diff/color.hpp"
#include "fuzz/document/document.hpp"
#include "fuzz/reduce/neighbours.hpp"
#include "fuzz/reduce/reduce.hpp"
#include "ref/exercise/exercise.hpp"

namespace fuzz {

using report::CaseRecord;
using report::Status;

namespace {

// Whether at a profile and the stricter ones a device that draws nothing fails, as a suite's cases
// want it.
bool is_sound(const cases::Case& c, cases::Profile profile) {
    return c.blit || diff::fails_if_empty(c, profile);
}

// The loosest profile at which it is; nothing if there is none.
std::optional<cases::Profile> loosest_sound(const cases::Case& c) {
    for (const cases::Profile profile : cases::kProfiles) {
        if (is_sound(c, profile)) {
            return profile;
        }
    }
    return std::nullopt;
}

bool is_value(const Symptom& symptom) {
    return symptom.kind == diff::FindingKind::value;
}

// Whether a record shows something wrong of the symptom's sort, values or hits. What breaks more
// than Direct3D's rules has to go on doing so.
bool shows_like(const CaseRecord& record, const Symptom& symptom) {
    return record.status == Status::fail &&
           std::any_of(record.outcome.groups.begin(), record.outcome.groups.end(),
                       [&](const auto& group) {
                           return (group.kind == diff::FindingKind::value) == is_value(symptom) &&
                                  group.level <= std::max(symptom.level, cases::Profile::practice);
                       });
}

// The cases of the texts that are one, and their numbers among the texts.
std::pair<std::vector<cases::Case>, std::vector<size_t>> load_all(
    const std::vector<std::string>& texts) {
    std::pair<std::vector<cases::Case>, std::vector<size_t>> all;
    for (size_t k = 0; k < texts.size(); ++k) {
        if (std::optional<cases::Case> c = load_one(texts[k], std::to_string(k))) {
            all.first.push_back(std::move(*c));
            all.second.push_back(k);
        }
    }
    return all;
}

std::vector<CaseRecord> records_of(const run::DrawAndJudge& draw, std::vector<cases::Case> cases) {
    return cases.empty() ? std::vector<CaseRecord>() : draw(std::move(cases), {}).records;
}

// The reduced case once more, now by whichever rule it fails and with what only a suite wants of it
// left out: a clamped depth is told by another rule than one that is not, and a triangle that must
// be covered is a second one.
Document like_failure(const Document& document, const Symptom& symptom,
                      const run::DrawAndJudge& draw, const ReduceOptions& options) {
    if (symptom.status != Status::fail) {
        return document;
    }
    const Shows shown = [&](const std::vector<std::string>& texts) {
        std::vector<bool> out(texts.size(), false);
        const auto [cases, of] = load_all(texts);
        const std::vector<CaseRecord> records = records_of(draw, cases);
        for (size_t k = 0; k < of.size(); ++k) {
            out[of[k]] = shows_like(records[k], symptom);
        }
        return out;
    };
    return reduce(document, shown, options).document;
}

// The case as a file that can go into a suite: what it shows is what it claims, if lint agrees,
// else some rule that it does exercise.
Document described(Document document, const Symptom& symptom) {
    set(document, "description", text("A device showed here: " + to_text(symptom) + "."));
    const std::optional<cases::Case> c = load_one(to_text(document), "described");
    if (!c) {
        return document;
    }
    std::vector<std::string> rules;
    for (const cases::Rule& rule : cases::all_rules()) {
        rules.emplace_back(rule.id);
    }
    std::stable_partition(rules.begin(), rules.end(),
                          [&](const std::string& rule) { return rule == symptom.rule; });
    for (const ref::RuleShare& share :
         ref::exercise(*c, ref::Limits{}, rules, ref::Count::some).rules) {
        if (share.samples > 0) {
            set(document, "rules", list({text(std::string(share.rule))}));
            break;
        }
    }
    return document;
}

// What of a document's neighbours passes, in sentences.
std::vector<std::string> passing(const Document& document, const run::DrawAndJudge& draw) {
    constexpr size_t kAtOnce = 64;
    const std::vector<Neighbour> all = neighbours(document);
    std::vector<bool> judged(all.size(), false), passes(all.size(), false);
    for (size_t begin = 0; begin < all.size(); begin += kAtOnce) {
        std::vector<cases::Case> cases;
        std::vector<size_t> of;
        for (size_t k = begin; k < std::min(begin + kAtOnce, all.size()); ++k) {
            if (std::optional<cases::Case> c = load_one(all[k].text, std::to_string(k))) {
                cases.push_back(std::move(*c));
                of.push_back(k);
            }
        }
        const std::vector<CaseRecord> records = records_of(draw, cases);
        for (size_t k = 0; k < of.size(); ++k) {
            passes[of[k]] = records[k].status == Status::pass;
            judged[of[k]] = passes[of[k]] || symptom_of(records[k]).has_value();
        }
    }
    return sentences(all, judged, passes);
}

// "with 1 sample" of "not with 1 sample", of which a sentence would make a double negative.
std::string without_not(const std::string& need) {
    constexpr std::string_view kNot = "not ";
    return need.starts_with(kNot) ? need.substr(kNot.size()) : need;
}

// What a device left at the first sample that shows a symptom, for whoever reads the case without
// the device.
std::string seen_text(const diff::Finding& finding) {
    std::string text;
    if (!finding.of_case) {
        const std::string layer = finding.layer ? fmt::format("layer {}, ", *finding.layer) : "";
        text = fmt::format("{}pixel ({}, {}), sample {}: ", layer, finding.x, finding.y,
                           finding.sample);
    }
    const std::string& quantity =
        finding.quantity.empty() ? std::string(diff::to_string(finding.kind)) : finding.quantity;
    return text + fmt::format("{}: expected {}, got {}; {}", quantity, finding.expected,
                              finding.got, finding.why);
}

}  // namespace

std::string need_text(const Entry& entry) {
    std::string text;
    for (const std::string& need : entry.needs) {
        // What passes so says it, and more.
        const std::string words = without_not(need);
        const bool is_said = std::ranges::any_of(entry.passes, [&](const std::string& other) {
            return other == words || other.starts_with(words + " in place of ");
        });
        text += is_said ? "" : "# It passes, or fails otherwise, " + words + ".\n";
    }
    for (const std::string& other : entry.undrawn) {
        text += "# The device draws nothing " + other + ".\n";
    }
    for (const std::string& other : entry.passes) {
        text += "# It passes " + other + ".\n";
    }
    return text;
}

std::set<std::string> essentials_of(const std::string& text) {
    const auto document = cases::read_toml(text, "fuzz");
    std::set<std::string> words = document ? essentials(*document) : std::set<std::string>();
    if (const auto c = load_one(text, "fuzz"); c && has_thin_triangle(*c)) {
        words.insert(kThinTriangle);
    }
    return words;
}

std::set<std::string> facts_of(const std::string& text) {
    std::set<std::string> words = with_implied(essentials_of(text));
    if (const auto c = load_one(text, "fuzz"); c && c->target.color) {
        words.insert("format " + std::string(cases::word_of(c->target.color->format)));
    }
    return words;
}

std::vector<Symptom> symptoms_of(const CaseRecord& record) {
    std::vector<Symptom> all;
    const std::optional<Symptom> gravest = symptom_of(record);
    if (!gravest || gravest->status != Status::fail) {
        return gravest ? std::vector<Symptom>{*gravest} : all;
    }
    for (const diff::FindingGroup& group : record.outcome.groups) {
        const auto like = std::find_if(all.begin(), all.end(), [&](const Symptom& s) {
            return s.kind == group.kind && s.rule == group.rule;
        });
        if (like == all.end()) {
            all.push_back({Status::fail, group.kind, group.rule, group.level, {}});
        } else {
            like->level = std::min(like->level, group.level);
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [&](const Symptom& a, const Symptom& b) { return a.level < b.level; });
    return all;
}

std::string described(const std::string& text, const Symptom& symptom) {
    const auto document = cases::read_toml(text, "drawn");
    return document ? to_text(described(*document, symptom)) : text;
}

std::optional<Entry> reduce_case(const std::string& text, const Symptom& symptom,
                                 const run::DrawAndJudge& draw, size_t most_rounds,
                                 const std::function<bool()>& is_over) {
    const auto document = cases::read_toml(text, "reduced");
    const std::optional<cases::Case> original = load_one(text, "original");
    if (!document || !original) {
        return std::nullopt;
    }
    // A reduced case is as sound as the one that was drawn.
    const std::optional<cases::Profile> sound_at = loosest_sound(*original);
    std::set<std::string> unsupported;  // texts that the device cannot draw
    bool has_died = false;              // the last of what was drawn, in place of the symptom
    const auto is_at_end = [&] { return is_over && is_over(); };
    const Shows shown = [&](const std::vector<std::string>& texts) {
        std::vector<bool> out(texts.size(), false);
        const auto [cases, of] = load_all(texts);
        const std::vector<CaseRecord> records = records_of(draw, cases);
        for (size_t k = 0; k < of.size() && !is_at_end(); ++k) {
            if (records[k].status == Status::unsupported) {
                unsupported.insert(texts[of[k]]);
            }
            has_died = symptom.status == Status::fail && (records[k].status == Status::crash ||
                                                          records[k].status == Status::timeout ||
                                                          records[k].status == Status::device_lost);
            out[of[k]] = shows(records[k], symptom) && (!sound_at || is_sound(cases[k], *sound_at));
        }
        return out;
    };
    // A worker may die for another reason, and a death says nothing of a wrong picture.
    constexpr int kMostDeaths = 3;
    for (int deaths = 0; !shown({to_text(*document)}).front(); ++deaths) {
        if (!has_died || deaths == kMostDeaths || is_at_end()) {
            return std::nullopt;
        }
    }
    ReduceOptions options;
    options.most_rounds = most_rounds;
    options.is_over = is_over;
    const Reduced reduced = reduce(*document, shown, options);
    if (is_at_end()) {
        Entry cut;
        cut.symptom = symptom;
        cut.text = to_text(reduced.document);
        return cut;
    }
    // Once more, for what it shows is told.
    const std::optional<cases::Case> smallest = load_one(to_text(reduced.document), "reduced");
    const CaseRecord last = smallest ? records_of(draw, {*smallest}).front() : CaseRecord();
    Entry entry;
    entry.symptom = symptom;
    // What the reducer brought in, as a constant for values, is no need of the cause.
    const std::set<std::string> before = essentials_of(text);
    const std::set<std::string> after =
        essentials_of(to_text(like_failure(reduced.document, symptom, draw, options)));
    std::set_intersection(after.begin(), after.end(), before.begin(), before.end(),
                          std::inserter(entry.essentials, entry.essentials.end()));
    entry.text = to_text(described(reduced.document, symptom));
    if (const auto c = load_one(entry.text, "reduced");
        c && !is_sound(*c, cases::Profile::vulkan)) {
        entry.text =
            "# At profile vulkan a picture without a triangle would pass: a suite wants one "
            "more.\n" +
            entry.text;
    }
    for (size_t k = 0; k < reduced.needs.size(); ++k) {
        if (unsupported.contains(reduced.need_texts[k])) {
            entry.undrawn.push_back(without_not(reduced.needs[k]));
        } else {
            entry.needs.push_back(reduced.needs[k]);
        }
    }
    entry.passes = passing(reduced.document, draw);
    entry.is_minimal = reduced.is_minimal;
    entry.count = 1;
    entry.also.insert({symptom.kind, symptom.rule});
    if (!last.outcome.findings.empty()) {
        // A run's line begins with the first finding of the gravest level.
        const diff::Finding& leading =
            *std::min_element(last.outcome.findings.begin(), last.outcome.findings.end(),
                              [](const auto& a, const auto& b) { return a.level < b.level; });
        const Symptom first{Status::fail, leading.kind, leading.rule, leading.level, {}};
        entry.shown_first = first == symptom ? "" : to_text(first);
    }
    const auto shown_by = std::ranges::find_if(last.outcome.findings, [&](const diff::Finding& f) {
        return f.kind == symptom.kind && f.rule == symptom.rule;
    });
    entry.seen = shown_by == last.outcome.findings.end() ? "" : seen_text(*shown_by);
    for (const Symptom& other : symptoms_of(last)) {
        entry.also.insert({other.kind, other.rule});
    }
    return entry;
}

}  // namespace fuzz
