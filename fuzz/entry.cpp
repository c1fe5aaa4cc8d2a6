// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "cases/base/parallel.hpp"
#include "cases/model/rule.hpp"
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
           std::ranges::any_of(record.outcome.groups, [&](const auto& group) {
               return (group.kind == diff::FindingKind::value) == is_value(symptom) &&
                      group.level <= std::max(symptom.level, cases::Profile::practice);
           });
}

// The records of candidates, which are drawn under their numbers.
std::vector<CaseRecord> drawn(const std::vector<Candidate>& candidates,
                              const run::DrawAndJudge& draw) {
    std::vector<cases::Case> cases;
    for (const Candidate& candidate : candidates) {
        cases.push_back(candidate.data);
        cases.back().id = std::to_string(cases.size() - 1);
    }
    return draw(std::move(cases), {}).records;
}

// The reduced case once more, now by whichever rule it fails and with what only a suite wants of it
// left out: a clamped depth is told by another rule than one that is not, and a triangle that must
// be covered is a second one.
Document like_failure(const Document& document, const Symptom& symptom,
                      const run::DrawAndJudge& draw, const ReduceOptions& options) {
    if (symptom.status != Status::fail) {
        return document;
    }
    const Shows shown = [&](const std::vector<Candidate>& candidates) {
        const std::vector<CaseRecord> records = drawn(candidates, draw);
        std::vector<bool> out;
        for (const CaseRecord& record : records) {
            out.push_back(shows_like(record, symptom));
        }
        return out;
    };
    return reduce(document, shown, options).document;
}

// The case as a file that can go into a suite: what it shows is what it claims, if lint agrees,
// else some rule that it does exercise.
Document described(Document document, const Symptom& symptom) {
    set(document, "description", text("A device showed here: " + to_text(symptom) + "."));
    const std::optional<cases::Case> c = load_one(document, "described");
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
    std::vector<Neighbour> all = neighbours(document);
    std::vector<bool> judged(all.size(), false), passes(all.size(), false);
    for (size_t begin = 0; begin < all.size(); begin += kAtOnce) {
        std::vector<cases::Case> cases;
        for (size_t k = begin; k < std::min(begin + kAtOnce, all.size()); ++k) {
            cases.push_back(std::move(all[k].data));
            cases.back().id = std::to_string(k);
        }
        const size_t count = cases.size();
        const std::vector<CaseRecord> records = draw(std::move(cases), {}).records;
        for (size_t k = 0; k < count; ++k) {
            passes[begin + k] = records[k].status == Status::pass;
            judged[begin + k] = passes[begin + k] || symptom_of(records[k]).has_value();
        }
    }
    return sentences(all, judged, passes);
}

// Whether some attribute may differ from vertex to vertex: the only one of a case may be the same
// everywhere.
bool has_varying_attribute(const Document& document) {
    size_t count = 0, constants = 0;
    if (const Document* draws = document.find("draw")) {
        for (const Document& one : draws->array) {
            if (const Document* attributes = one.find("attribute")) {
                count += attributes->array.size();
                constants += static_cast<size_t>(std::ranges::count_if(
                    attributes->array,
                    [](const Document& a) { return a.find("constant") != nullptr; }));
            }
        }
    }
    return count != 1 || constants != 1;
}

// The word for the format of a document's colours; empty without one.
std::string format_of(const Document& document) {
    const Document* target = document.find("target");
    const Document* color = target == nullptr ? nullptr : target->find("color");
    const Document* format = color == nullptr ? nullptr : color->find("format");
    return format == nullptr ? "" : format->string;
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

Facts facts_of(const std::string& text) {
    Facts facts;
    if (const auto document = cases::read_toml(text, "fuzz")) {
        facts.essentials = essentials(*document);
        facts.has_varying_attribute = has_varying_attribute(*document);
    }
    if (const auto c = load_one(text, "fuzz")) {
        if (has_thin_triangle(*c)) {
            facts.essentials.insert({Trait::thin_triangle});
        }
        if (c->target.color) {
            facts.format = c->target.color->format;
        }
    }
    return facts;
}

void Entry::set_text(std::string other) {
    text = std::move(other);
    facts = facts_of(text);
}

std::vector<Symptom> symptoms_of(const CaseRecord& record) {
    std::vector<Symptom> all;
    const std::optional<Symptom> gravest = symptom_of(record);
    if (!gravest || gravest->status != Status::fail) {
        return gravest ? std::vector<Symptom>{*gravest} : all;
    }
    for (const diff::FindingGroup& group : record.outcome.groups) {
        const auto like = std::ranges::find_if(
            all, [&](const Symptom& s) { return s.kind == group.kind && s.rule == group.rule; });
        if (like == all.end()) {
            all.push_back({Status::fail, group.kind, group.rule, group.level, {}});
        } else {
            like->level = std::min(like->level, group.level);
        }
    }
    std::ranges::stable_sort(all,
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
    const Shows shown = [&](const std::vector<Candidate>& candidates) {
        const std::vector<CaseRecord> records = drawn(candidates, draw);
        std::vector<char> is_shown(candidates.size(), 0);  // threads write it
        for (size_t k = 0; k < records.size() && !is_at_end(); ++k) {
            if (records[k].status == Status::unsupported) {
                unsupported.insert(candidates[k].text);
            }
            has_died = symptom.status == Status::fail && (records[k].status == Status::crash ||
                                                          records[k].status == Status::timeout ||
                                                          records[k].status == Status::device_lost);
            is_shown[k] = shows(records[k], symptom) ? 1 : 0;
        }
        cases::for_each_index(is_at_end() ? 0 : is_shown.size(), [&](size_t k) {
            if (is_shown[k] != 0 && sound_at) {
                is_shown[k] = is_sound(candidates[k].data, *sound_at) ? 1 : 0;
            }
        });
        return std::vector<bool>(is_shown.begin(), is_shown.end());
    };
    // A worker may die for another reason, and a death says nothing of a wrong picture.
    constexpr int kMostDeaths = 3;
    for (int deaths = 0; !shown({{to_text(*document), *original}}).front(); ++deaths) {
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
        cut.set_text(to_text(reduced.document));
        return cut;
    }
    // Once more, for what it shows is told.
    const std::optional<cases::Case> smallest = load_one(to_text(reduced.document), "reduced");
    const CaseRecord last = smallest ? draw({*smallest}, {}).records.front() : CaseRecord();
    Entry entry;
    entry.symptom = symptom;
    // What the reducer brought in, as a constant for values, is no need of the cause.
    const Essentials before = facts_of(text).essentials;
    const Essentials after =
        facts_of(to_text(like_failure(reduced.document, symptom, draw, options))).essentials;
    std::ranges::set_intersection(after, before,
                                  std::inserter(entry.essentials, entry.essentials.end()));
    std::string kept = to_text(described(reduced.document, symptom));
    if (const auto c = load_one(kept, "reduced"); c && !is_sound(*c, cases::Profile::vulkan)) {
        kept =
            "# At profile vulkan a picture without a triangle would pass: a suite wants one "
            "more.\n" +
            kept;
    }
    entry.set_text(std::move(kept));
    for (size_t k = 0; k < reduced.needs.size(); ++k) {
        if (unsupported.contains(reduced.need_texts[k])) {
            entry.undrawn.push_back(without_not(reduced.needs[k]));
        } else {
            const auto asked = cases::read_toml(reduced.need_texts[k], "asked");
            const std::string format = asked ? format_of(*asked) : "";
            entry.needs_format =
                entry.needs_format || (!format.empty() && format != format_of(reduced.document));
            entry.needs.push_back(reduced.needs[k]);
        }
    }
    entry.passes = passing(reduced.document, draw);
    entry.is_minimal = reduced.is_minimal;
    entry.count = 1;
    entry.also.insert({symptom.kind, symptom.rule});
    if (!last.outcome.findings.empty()) {
        // A run's line begins with the first finding of the gravest level.
        const diff::Finding& leading = *std::ranges::min_element(
            last.outcome.findings, [](const auto& a, const auto& b) { return a.level < b.level; });
        const Symptom first{Status::fail, leading.kind, leading.rule, leading.level, {}};
        entry.shown_first = first == symptom ? std::nullopt : std::optional(first);
    }
    const auto shown_by = std::ranges::find_if(last.outcome.findings, [&](const diff::Finding& f) {
        return f.kind == symptom.kind && f.rule == symptom.rule;
    });
    if (shown_by != last.outcome.findings.end()) {
        entry.seen = seen_text(*shown_by);
        entry.overflows = shown_by->overflows;
    }
    for (const Symptom& other : symptoms_of(last)) {
        entry.also.insert({other.kind, other.rule});
    }
    return entry;
}

}  // namespace fuzz
