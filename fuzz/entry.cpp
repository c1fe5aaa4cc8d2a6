// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "cases/load/loader.hpp"
#include "cases/model/rule.hpp"
#include "diff/color.hpp"
#include "fuzz/document/document.hpp"
#include "fuzz/reduce/neighbours.hpp"
#include "fuzz/reduce/reduce.hpp"
#include "ref/exercise/exercise.hpp"
#include "ref/expectation/expectation.hpp"

namespace fuzz {

using report::CaseRecord;
using report::Status;

namespace {

// Whether at every profile some sample must be covered, and seen to be, as a suite's cases want it.
bool can_fail_everywhere(const cases::Case& c) {
    if (c.blit) {
        return true;
    }
    const ref::Expectation expectation = ref::expect(c, ref::Limits{}, cases::Profile::vulkan);
    return expectation.must_samples > 0 &&
           (c.target.has_instruments || !diff::may_stay_clear(c, expectation));
}

diff::FindingKind sort_of(diff::FindingKind kind) {
    return kind == diff::FindingKind::double_hit ? diff::FindingKind::extra : kind;
}

bool is_value(const Symptom& symptom) {
    return symptom.kind == diff::FindingKind::value;
}

// Whether a record shows something wrong of the symptom's sort, values or hits. What breaks more
// than Direct3D's rules has to go on doing so.
bool shows_like(const CaseRecord& record, const Symptom& symptom) {
    return record.status == Status::fail &&
           std::any_of(record.groups.begin(), record.groups.end(), [&](const auto& group) {
               return (group.kind == diff::FindingKind::value) == is_value(symptom) &&
                      group.level <= std::max(symptom.level, cases::Profile::practice);
           });
}

// The essentials that say something of a case's numbers only.
const std::set<std::string> kNumbers = {"behind the eye", "several draws", "several triangles",
                                        "sloping depth", "unequal w"};
const std::set<std::string> kSamples = {"several samples"};
const std::set<std::string> kThinToo = {"behind the eye", "several draws",     "several samples",
                                        "sloping depth",  "several triangles", "unequal w"};

bool is_within(const std::set<std::string>& part, const std::set<std::string>& whole) {
    return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

std::set<std::string> without(const std::set<std::string>& words,
                              const std::set<std::string>& left_out) {
    std::set<std::string> rest;
    std::set_difference(words.begin(), words.end(), left_out.begin(), left_out.end(),
                        std::inserter(rest, rest.end()));
    return rest;
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

// The reduced case once more, now by whichever rule it fails and with what only a suite wants of it
// left out: a clamped depth is told by another rule than one that is not, and a triangle that must
// be covered is a second one.
Document like_failure(const Document& document, const Symptom& symptom, const Draw& draw,
                      const ReduceOptions& options) {
    if (symptom.status != Status::fail) {
        return document;
    }
    const Shows shown = [&](const std::vector<std::string>& texts) {
        std::vector<bool> out(texts.size(), false);
        const auto [cases, of] = load_all(texts);
        const std::vector<CaseRecord> records =
            cases.empty() ? std::vector<CaseRecord>() : draw(cases);
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
std::vector<std::string> passing(const Document& document, const Draw& draw) {
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
        const std::vector<CaseRecord> records =
            cases.empty() ? std::vector<CaseRecord>() : draw(cases);
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

std::vector<Symptom> symptoms_of(const CaseRecord& record) {
    std::vector<Symptom> all;
    const std::optional<Symptom> gravest = symptom_of(record);
    if (!gravest || gravest->status != Status::fail) {
        return gravest ? std::vector<Symptom>{*gravest} : all;
    }
    for (const diff::FindingGroup& group : record.groups) {
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

bool explains(const Entry& entry, const Symptom& symptom,
              const std::set<std::string>& of_the_case) {
    if (!std::includes(of_the_case.begin(), of_the_case.end(), entry.essentials.begin(),
                       entry.essentials.end())) {
        return false;
    }
    if (symptom.status != Status::fail || entry.symptom.status != Status::fail) {
        return entry.symptom.status == symptom.status && entry.symptom.signal == symptom.signal;
    }
    // What breaks a looser profile than the entry does is news.
    if (entry.symptom.level > symptom.level) {
        return false;
    }
    // By which rule a sample is missing depends on the triangle that misses it, and whether one hit
    // too many is the only one on what else is drawn there: where the case has something special to
    // blame, too few or too many is enough.
    return std::any_of(entry.also.begin(), entry.also.end(), [&](const auto& known) {
        return is_value(symptom) || entry.essentials.empty()
                   ? known == std::pair(symptom.kind, symptom.rule)
                   : sort_of(known.first) == sort_of(symptom.kind);
    });
}

namespace {

// Whether a word says which fragments there are: a state of a draw, not what it writes.
bool decides_hits(const std::string& word) {
    return word.starts_with("draw.") && !word.starts_with("draw.attribute") &&
           !word.starts_with("draw.color");
}

// Whether an earlier entry hits too much or too little by something special that the fresh one
// needs, too: whatever hits write, and later draws find, is wrong with them. A stencil that counts
// where a scissor lets fragments through is the scissor's.
bool is_consequence(const Entry& earlier, const Entry& fresh) {
    const std::set<std::string> keys = without(earlier.essentials, kNumbers);
    return !is_value(earlier.symptom) && std::ranges::any_of(keys, decides_hits) &&
           is_within(keys, fresh.essentials);
}

// "draw.discard" of "draw.discard=front".
std::set<std::string> names_of(const std::set<std::string>& words) {
    std::set<std::string> names;
    for (const std::string& word : words) {
        names.insert(word.substr(0, word.find('=')));
    }
    return names;
}

// Whether a fresh entry shows the very same by the same keys with other words, or by all but one of
// several: that one was needed for the earlier case's numbers alone.
bool shows_the_same(const Entry& earlier, const Entry& fresh) {
    const std::set<std::string> keys = without(fresh.essentials, kNumbers);
    const std::set<std::string> others = without(earlier.essentials, kNumbers);
    if (earlier.symptom.kind != fresh.symptom.kind || earlier.symptom.rule != fresh.symptom.rule ||
        earlier.symptom.level != fresh.symptom.level) {
        return false;
    }
    const bool is_one_less =
        keys.size() >= 3 && others.size() == keys.size() + 1 && is_within(keys, others);
    return is_one_less || (keys.size() >= 2 && names_of(keys) == names_of(others));
}

}  // namespace

bool is_same_cause(const Entry& earlier, const Entry& fresh) {
    if (earlier.symptom.status != fresh.symptom.status ||
        earlier.symptom.signal != fresh.symptom.signal ||
        (earlier.is_known && earlier.symptom.level > fresh.symptom.level)) {
        return false;
    }
    if (fresh.symptom.status != Status::fail) {
        return earlier.essentials == fresh.essentials;
    }
    if (is_consequence(earlier, fresh)) {
        return true;
    }
    if (is_value(earlier.symptom) != is_value(fresh.symptom)) {
        return false;
    }
    if (shows_the_same(earlier, fresh)) {
        return true;
    }
    const bool is_same_rule =
        std::any_of(fresh.also.begin(), fresh.also.end(),
                    [&](const auto& one) { return earlier.also.contains(one); });
    if (earlier.essentials == fresh.essentials) {
        return is_same_rule || !fresh.essentials.empty();
    }
    // Whatever else of its numbers and samples a case needs in which a thin triangle fails is
    // chance: with other numbers another one would.
    if (earlier.essentials.contains(kThinTriangle) && fresh.essentials.contains(kThinTriangle)) {
        const std::set<std::string> a = without(earlier.essentials, kThinToo),
                                    b = without(fresh.essentials, kThinToo);
        return is_within(a, b) || is_within(b, a);
    }
    // What only Direct3D's rules forbid is mostly another thing.
    const bool are_grave =
        std::max(earlier.symptom.level, fresh.symptom.level) <= cases::Profile::practice;
    const std::set<std::string> keys = without(fresh.essentials, kNumbers);
    return (are_grave || earlier.symptom.level == fresh.symptom.level) &&
           without(earlier.essentials, kNumbers) == keys && !without(keys, kSamples).empty();
}

void merge(Entry& earlier, Entry fresh) {
    earlier.also.insert(fresh.also.begin(), fresh.also.end());
    if (earlier.is_known) {
        return;
    }
    std::set<std::string> both;
    std::set_intersection(earlier.essentials.begin(), earlier.essentials.end(),
                          fresh.essentials.begin(), fresh.essentials.end(),
                          std::inserter(both, both.end()));
    earlier.essentials = std::move(both);
    if (fresh.symptom.level < earlier.symptom.level) {
        fresh.also = std::move(earlier.also);
        fresh.essentials = std::move(earlier.essentials);
        fresh.count = earlier.count;
        fresh.stale_file = earlier.stale_file.empty() ? earlier.file : earlier.stale_file;
        earlier = std::move(fresh);
    }
}

std::optional<Entry> reduce_case(const std::string& text, const Symptom& symptom, const Draw& draw,
                                 size_t most_rounds) {
    const auto document = cases::read_toml(text, "reduced");
    const std::optional<cases::Case> original = load_one(text, "original");
    if (!document || !original) {
        return std::nullopt;
    }
    const bool is_sound = can_fail_everywhere(*original);
    std::optional<CaseRecord> last;  // of the smallest text that shows it
    std::string last_text;
    std::set<std::string> unsupported;  // texts that the device cannot draw
    const Shows shown = [&](const std::vector<std::string>& texts) {
        std::vector<bool> out(texts.size(), false);
        const auto [cases, of] = load_all(texts);
        const std::vector<CaseRecord> records =
            cases.empty() ? std::vector<CaseRecord>() : draw(cases);
        for (size_t k = 0; k < of.size(); ++k) {
            if (records[k].status == Status::unsupported) {
                unsupported.insert(texts[of[k]]);
            }
            out[of[k]] = shows(records[k], symptom) && (!is_sound || can_fail_everywhere(cases[k]));
            if (out[of[k]] && (!last || texts[of[k]].size() <= last_text.size())) {
                last = records[k];
                last_text = texts[of[k]];
            }
        }
        return out;
    };
    if (!shown({to_text(*document)}).front()) {
        return std::nullopt;
    }
    ReduceOptions options;
    options.most_rounds = most_rounds;
    const Reduced reduced = reduce(*document, shown, options);
    Entry entry;
    entry.symptom = symptom;
    // What the reducer brought in, as a constant for values, is no need of the cause.
    const std::set<std::string> before = essentials_of(text);
    const std::set<std::string> after =
        essentials_of(to_text(like_failure(reduced.document, symptom, draw, options)));
    std::set_intersection(after.begin(), after.end(), before.begin(), before.end(),
                          std::inserter(entry.essentials, entry.essentials.end()));
    entry.text = to_text(described(reduced.document, symptom));
    if (const auto c = load_one(entry.text, "reduced"); c && !can_fail_everywhere(*c)) {
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
    if (last && !last->findings.empty()) {
        // A run's line begins with the first finding of the gravest level.
        const diff::Finding& leading =
            *std::min_element(last->findings.begin(), last->findings.end(),
                              [](const auto& a, const auto& b) { return a.level < b.level; });
        const Symptom first{Status::fail, leading.kind, leading.rule, leading.level, {}};
        entry.shown_first = first == symptom ? "" : to_text(first);
    }
    if (last) {
        const auto shown_by = std::ranges::find_if(last->findings, [&](const diff::Finding& f) {
            return f.kind == symptom.kind && f.rule == symptom.rule;
        });
        entry.seen = shown_by == last->findings.end() ? "" : seen_text(*shown_by);
    }
    for (const Symptom& other : last ? symptoms_of(*last) : std::vector<Symptom>()) {
        entry.also.insert({other.kind, other.rule});
    }
    return entry;
}

}  // namespace fuzz
