// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hunt.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "cases/load/loader.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/triangle.hpp"
#include "fuzz/document/document.hpp"
#include "fuzz/generate/generator.hpp"
#include "fuzz/reduce/reduce.hpp"
#include "ref/exercise/exercise.hpp"
#include "ref/expectation/expectation.hpp"

namespace fuzz {

using report::CaseRecord;
using report::Status;
using Clock = std::chrono::steady_clock;

namespace {

// Compiling a pose costs a driver as much as drawing this many cases.
constexpr uint64_t kGeometries = 128;
constexpr size_t kPosesOfChunk = 8;
// So many failing cases with one symptom are reduced after each chunk: the others wait for a case
// that shows the same, which a cause that is not rare soon has.
constexpr size_t kReductionsOfSymptom = 2;
constexpr size_t kReductionsOfChunk = 6;
constexpr size_t kMostUnjudged = 20;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::optional<cases::Case> load(const std::string& text, const std::string& id) {
    auto loaded = cases::load_text(text, "fuzz", id);
    if (!loaded || loaded->size() != 1) {
        return std::nullopt;
    }
    return std::move(loaded->front());
}

// A picture without anything in it could pass, so the judge refuses the case.
bool is_empty(const CaseRecord& record) {
    return record.reason.find("a black picture would pass") != std::string::npos;
}

// Whether some sample must be covered at every profile, as a suite's cases want it.
bool can_fail_everywhere(const cases::Case& c) {
    return c.blit || ref::expect(c, ref::Limits{}, cases::Profile::vulkan).must_samples > 0;
}

std::set<std::string> essentials_of(const std::string& text) {
    const auto document = cases::read_toml(text, "fuzz");
    return document ? essentials(*document) : std::set<std::string>();
}

// All that a record shows, each in the gravest way.
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

diff::FindingKind sort_of(diff::FindingKind kind) {
    return kind == diff::FindingKind::double_hit ? diff::FindingKind::extra : kind;
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
    const bool is_value = symptom.kind == diff::FindingKind::value;
    return std::any_of(entry.also.begin(), entry.also.end(), [&](const auto& known) {
        return is_value || entry.essentials.empty() ? known == std::pair(symptom.kind, symptom.rule)
                                                    : sort_of(known.first) == sort_of(symptom.kind);
    });
}

// The case as a file that can go into a suite: what it shows is what it claims, if lint agrees,
// else some rule that it does exercise.
Document described(Document document, const Symptom& symptom) {
    set(document, "description", text("A device showed here: " + to_text(symptom) + "."));
    const std::optional<cases::Case> c = load(to_text(document), "described");
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

}  // namespace

std::string text_of_case(uint64_t seed, uint64_t number) {
    Poses poses(seed);
    Pose pose;
    for (uint64_t k = 0; k <= number / kGeometries; ++k) {
        pose = poses.next([&](const Pose& candidate) { return is_case(seed, candidate, k); });
    }
    return case_text(seed, pose, number / kGeometries, number);
}

Hunt::Hunt(HuntOptions options, run::Session& session, std::vector<Entry> known,
           OnProgress on_progress)
    : options_(options),
      session_(session),
      on_progress_(std::move(on_progress)),
      poses_(options.seed),
      entries_(std::move(known)) {
    counts_.next_case = options_.first_case;
}

bool Hunt::is_over() const {
    return options_.deadline && Clock::now() >= *options_.deadline;
}

Hunt::Chunk Hunt::make_chunk() {
    Chunk chunk;
    const uint64_t end = options_.most_cases == 0 ? UINT64_MAX : options_.most_cases;
    size_t poses = 0;
    while (poses < kPosesOfChunk && next_case_ < end) {
        const uint64_t number = next_case_ / kGeometries;
        const Pose pose = poses_.next(
            [&](const Pose& candidate) { return is_case(options_.seed, candidate, number); });
        const uint64_t begin = next_case_;
        next_case_ = begin + kGeometries;
        if (number % options_.shards != options_.shard - 1 || next_case_ <= options_.first_case) {
            continue;
        }
        ++poses;
        for (uint64_t k = std::max(begin, options_.first_case); k < std::min(next_case_, end);
             ++k) {
            std::string text = case_text(options_.seed, pose, number, k);
            if (std::optional<cases::Case> c = load(text, std::to_string(k))) {
                chunk.made.push_back({std::move(text), k});
                chunk.cases.push_back(std::move(*c));
            }
        }
    }
    chunk.next_case = std::min(next_case_, end);
    chunk.poses = poses_.count();
    chunk.pairs = poses_.pairs();
    return chunk;
}

run::Session::Results Hunt::draw(std::vector<cases::Case> cases) {
    run::Session::Results results = session_.draw(std::move(cases), [this](size_t) {
        on_progress_(counts_, entries_.size());
        return true;
    });
    is_interrupted_ = is_interrupted_ || results.interrupted;
    if (failure_.empty()) {
        failure_ = results.failure;
    }
    return results;
}

Hunt::State Hunt::step() {
    if (!ahead_.valid()) {
        ahead_ = std::async(std::launch::async, [this] { return make_chunk(); });
    }
    Chunk chunk = ahead_.get();
    if (chunk.made.empty() && options_.most_cases != 0 && chunk.next_case >= options_.most_cases) {
        return State::done;
    }
    ahead_ = std::async(std::launch::async, [this] { return make_chunk(); });
    const Clock::time_point begin = Clock::now();
    for (const cases::Case& c : chunk.cases) {
        counts_.triangles += cases::assemble(c).size();
    }
    const run::Session::Results results = draw(std::move(chunk.cases));
    counts_.drawing_seconds += seconds_since(begin);
    if (is_interrupted_ || !failure_.empty()) {
        return is_interrupted_ ? State::interrupted : State::failed;
    }
    std::vector<Open> open;
    for (size_t k = 0; k < results.records.size(); ++k) {
        const CaseRecord& record = results.records[k];
        switch (record.status) {
            case Status::unsupported:
                ++counts_.unsupported;
                continue;
            case Status::error:
                if (is_empty(record)) {
                    ++counts_.empty;
                } else {
                    ++counts_.unjudged;
                    if (unjudged_.size() < kMostUnjudged) {
                        unjudged_.emplace_back(chunk.made[k].text, record.reason);
                    }
                }
                continue;
            default:
                break;
        }
        ++counts_.drawn;
        if (!symptom_of(record)) {
            continue;
        }
        ++counts_.failed;
        if (std::optional<Symptom> symptom =
                unexplained(record, essentials_of(chunk.made[k].text))) {
            open.push_back({std::move(*symptom), chunk.made[k].text, chunk.made[k].number});
        }
    }
    counts_.next_case = chunk.next_case;
    counts_.poses = chunk.poses;
    counts_.pairs = chunk.pairs;
    const Clock::time_point reducing = Clock::now();
    reduce_open(std::move(open));
    counts_.reducing_seconds += seconds_since(reducing);
    on_progress_(counts_, entries_.size());
    if (is_interrupted_ || !failure_.empty()) {
        return is_interrupted_ ? State::interrupted : State::failed;
    }
    return is_over() ? State::done : State::goes_on;
}

// The gravest symptom that no entry explains; the entry that explains the gravest of all counts the
// case.
std::optional<Symptom> Hunt::unexplained(const CaseRecord& record,
                                         const std::set<std::string>& of_the_case) {
    bool is_counted = false;
    for (const Symptom& symptom : symptoms_of(record)) {
        const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
            return explains(e, symptom, of_the_case);
        });
        if (entry == entries_.end()) {
            return symptom;
        }
        if (!is_counted) {
            ++entry->count;
            is_counted = true;
        }
    }
    return std::nullopt;
}

void Hunt::reduce_open(std::vector<Open> open) {
    // The shortest first: nearest to what it will be.
    std::stable_sort(open.begin(), open.end(),
                     [](const Open& a, const Open& b) { return a.text.size() < b.text.size(); });
    std::map<Symptom, size_t> reduced;
    size_t all = 0;
    for (const Open& one : open) {
        if (is_over() || is_interrupted_ || !failure_.empty() || all >= kReductionsOfChunk) {
            return;
        }
        const std::set<std::string> words = essentials_of(one.text);
        const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
            return explains(e, one.symptom, words);
        });
        if (entry != entries_.end()) {
            ++entry->count;
            continue;
        }
        if (reduced[one.symptom]++ >= kReductionsOfSymptom) {
            continue;
        }
        ++all;
        if (std::optional<Entry> fresh = reduce_one(one)) {
            const auto same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
                return e.symptom == fresh->symptom && e.essentials == fresh->essentials;
            });
            if (same != entries_.end()) {
                ++same->count;
                same->also.insert(fresh->also.begin(), fresh->also.end());
            } else {
                entries_.push_back(std::move(*fresh));
            }
        }
    }
}

std::optional<Entry> Hunt::reduce_one(const Open& open) {
    ++counts_.reductions;
    std::optional<Entry> entry = reduce_case(
        open.text, open.symptom,
        [this](const std::vector<cases::Case>& cases) {
            counts_.reduction_cases += cases.size();
            return is_interrupted_ || !failure_.empty() ? std::vector<CaseRecord>(cases.size())
                                                        : draw(cases).records;
        },
        options_.most_rounds);
    if (!entry) {
        ++counts_.unrepeated;
        return std::nullopt;
    }
    entry->first_case = open.number;
    return entry;
}

std::optional<Entry> reduce_case(const std::string& text, const Symptom& symptom, const Draw& draw,
                                 size_t most_rounds) {
    const auto document = cases::read_toml(text, "reduced");
    const std::optional<cases::Case> original = load(text, "original");
    if (!document || !original) {
        return std::nullopt;
    }
    const bool is_sound = can_fail_everywhere(*original);
    std::optional<CaseRecord> last;  // of the smallest text that shows it
    std::string last_text;
    const Shows shown = [&](const std::vector<std::string>& texts) {
        std::vector<bool> out(texts.size(), false);
        std::vector<cases::Case> cases;
        std::vector<size_t> of;
        for (size_t k = 0; k < texts.size(); ++k) {
            if (std::optional<cases::Case> c = load(texts[k], std::to_string(k))) {
                cases.push_back(std::move(*c));
                of.push_back(k);
            }
        }
        if (cases.empty()) {
            return out;
        }
        const std::vector<CaseRecord> records = draw(cases);
        for (size_t k = 0; k < of.size(); ++k) {
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
    entry.essentials = essentials(reduced.document);
    entry.text = to_text(described(reduced.document, symptom));
    if (const auto c = load(entry.text, "reduced"); c && !can_fail_everywhere(*c)) {
        entry.text =
            "# At profile vulkan no sample must be covered: a suite wants one triangle more.\n" +
            entry.text;
    }
    entry.needs = reduced.needs;
    entry.is_minimal = reduced.is_minimal;
    entry.count = 1;
    entry.also.insert({symptom.kind, symptom.rule});
    for (const Symptom& other : last ? symptoms_of(*last) : std::vector<Symptom>()) {
        entry.also.insert({other.kind, other.rule});
    }
    return entry;
}

}  // namespace fuzz
