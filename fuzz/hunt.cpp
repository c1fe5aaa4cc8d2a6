// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hunt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "cases/base/parallel.hpp"
#include "cases/model/triangle.hpp"
#include "fuzz/same_cause.hpp"

namespace fuzz {

using report::CaseRecord;
using report::Status;
using Clock = HuntOptions::Clock;

namespace {

constexpr uint64_t kNumbersOfChunk = 1024;
// So many failing cases with one symptom are reduced after each chunk: the others wait for a case
// that shows the same, which a cause that is not rare soon has.
constexpr size_t kReductionsOfSymptom = 2;
constexpr size_t kReductionsOfChunk = 6;
// With so many open cases no other is drawn before all are reduced: each keeps its text.
constexpr size_t kMostOpen = 4096;
constexpr size_t kMostUnrepeated = 20;
constexpr size_t kMostUnjudged = 20;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Whether judging a case may take minutes, for which all others of its chunk would wait.
bool is_dear(const cases::Case& c) {
    constexpr uint64_t kMostPairs = uint64_t{1} << 23U;  // of a sample and a triangle
    return uint64_t{c.target.width} * c.target.rows() * c.target.samples *
               cases::assemble(c).size() >
           kMostPairs;
}

// Whether the end came before the case's result did.
bool is_left(const CaseRecord& record) {
    return record.status == Status::not_run || record.status == Status::skip;
}

}  // namespace

std::string text_of_case(Source& source, uint64_t number) {
    source.enter(number / source.group_size());
    return source.make(number).text;
}

Hunt::Hunt(HuntOptions options, run::DrawAndJudge draw, std::vector<Entry> known,
           const std::vector<Waiting>& waiting, OnProgress on_progress)
    : options_(std::move(options)),
      draw_(std::move(draw)),
      on_progress_(std::move(on_progress)),
      source_(options_.source()),
      entries_(std::move(known)),
      is_behind_(!waiting.empty()) {
    counts_.next_case = options_.first_case;
    take_up(waiting);
}

// What an earlier hunt has not done. Groups are entered in their order.
void Hunt::take_up(const std::vector<Waiting>& waiting) {
    std::map<uint64_t, std::optional<Waiting>> by_number;
    for (const uint64_t number : options_.left) {
        by_number[number];
    }
    for (const Waiting& one : waiting) {
        by_number[one.number] = one;
    }
    Chunk left;
    const uint64_t size = source_->group_size();
    std::optional<uint64_t> group;
    for (auto& [number, one] : by_number) {
        if (group != number / size) {
            group = number / size;
            source_->enter(*group);
        }
        Source::Made made = source_->make(number);
        if (one && made.data && is_through_broken_door(*made.data)) {
            ++counts_.through_broken_doors;  // the door is known since
        } else if (one) {
            Facts facts = facts_of(made.text);
            open_.push_back({std::move(*one), std::move(made.text), std::move(facts), {}});
        } else if (made.data && !is_dear(*made.data)) {
            left.made.push_back({std::move(made.text), number});
            left.cases.push_back(std::move(*made.data));
        }
    }
    if (!left.made.empty()) {
        left.next_case = options_.first_case;
        left.poses = (options_.first_case + size - 1) / size;
        left.pairs = source_->pairs();
        again_ = std::move(left);
    }
}

std::vector<uint64_t> Hunt::left() const {
    std::vector<uint64_t> all = left_;
    if (again_) {
        for (const Made& made : again_->made) {
            all.push_back(made.number);
        }
    }
    return all;
}

std::vector<Waiting> Hunt::waiting() const {
    std::vector<Waiting> all;
    for (const Open& open : open_) {
        all.push_back(open.waiting);
    }
    return all;
}

std::vector<Entry> Hunt::not_reduced() const {
    std::map<Symptom, Entry> smallest;
    for (const Open& open : open_) {
        const Symptom& symptom = open.waiting.symptoms.front();
        Entry& entry = smallest[symptom];
        ++entry.count;
        if (entry.count == 1 || open.text.size() < entry.text.size()) {
            entry.symptom = symptom;
            entry.essentials = open.facts.essentials;
            entry.text = open.text;
            entry.facts = open.facts;
            entry.first_case = open.waiting.number;
            entry.is_reduced = false;
            entry.also.clear();
            for (const Symptom& other : open.waiting.symptoms) {
                entry.also.insert({other.kind, other.rule});
            }
        }
    }
    std::vector<Entry> all;
    for (auto& [symptom, entry] : smallest) {
        all.push_back(std::move(entry));
    }
    return all;
}

bool Hunt::is_over() const {
    return options_.deadline && options_.now() >= *options_.deadline;
}

Hunt::Chunk Hunt::make_chunk() {
    Chunk chunk;
    const uint64_t end = options_.most_cases == 0 ? UINT64_MAX : options_.most_cases;
    const uint64_t size = source_->group_size();
    uint64_t numbers = 0;
    while (numbers < kNumbersOfChunk && next_case_ < end) {
        const uint64_t group = next_case_ / size;
        const uint64_t begin = next_case_;
        next_case_ = begin + size;
        // Each shard gets bare poses and others, whatever the number of shards is.
        if ((group / 3 + group % 3) % options_.shards != options_.shard - 1 ||
            next_case_ <= options_.first_case) {
            continue;
        }
        source_->enter(group);
        numbers += size;
        for (uint64_t k = std::max(begin, options_.first_case); k < std::min(next_case_, end);
             ++k) {
            if (options_.is_interrupted()) {
                return chunk;  // which nobody draws
            }
            Source::Made made = source_->make(k);
            chunk.refused += made.refused;
            if (made.data && !is_dear(*made.data)) {
                chunk.made.push_back({std::move(made.text), k});
                chunk.cases.push_back(std::move(*made.data));
            } else {
                ++chunk.missing;
            }
        }
    }
    chunk.next_case = std::min(next_case_, end);
    chunk.poses = next_case_ / size;
    chunk.pairs = source_->pairs();
    return chunk;
}

run::Session::Results Hunt::draw(std::vector<cases::Case> cases) {
    const size_t all = cases.size();
    const bool is_of_chunk = doing_.empty();
    run::Session::Results results = draw_(std::move(cases), [&](size_t done) {
        if (is_of_chunk) {
            doing_ = fmt::format("drawing, {} of {}", done, all);
        }
        tell_progress();
        return !is_over();
    });
    is_interrupted_ = is_interrupted_ || results.interrupted;
    if (failure_.empty()) {
        failure_ = results.failure;
    }
    return results;
}

Hunt::State Hunt::step() {
    is_behind_ = !open_.empty() && (is_behind_ || open_.size() >= kMostOpen);
    if (!is_behind_ && again_) {
        draw_chunk(*std::exchange(again_, std::nullopt));
    } else if (!is_behind_) {
        if (!ahead_.valid()) {
            ahead_ = cases::beside([this] { return make_chunk(); });
        }
        Chunk chunk = ahead_.get();
        if (options_.is_interrupted()) {
            is_interrupted_ = true;
            return State::interrupted;
        }
        if (chunk.made.empty() && options_.most_cases != 0 &&
            chunk.next_case >= options_.most_cases) {
            if (open_.empty()) {
                return State::done;
            }
            is_behind_ = true;
        } else {
            ahead_ = cases::beside([this] { return make_chunk(); });
            draw_chunk(std::move(chunk));
        }
    }
    if (!is_interrupted_ && failure_.empty()) {
        const Clock::time_point begin = Clock::now();
        reduce_open();
        counts_.reducing_seconds += seconds_since(begin);
        tell_progress();
    }
    if (is_interrupted_ || !failure_.empty()) {
        return is_interrupted_ ? State::interrupted : State::failed;
    }
    return is_over() ? State::done : State::goes_on;
}

void Hunt::keep_unjudged(const std::string& text, const std::string& reason) {
    ++counts_.unjudged;
    if (unjudged_.size() < kMostUnjudged) {
        unjudged_.emplace_back(text, reason);
    }
}

// What goes through a door that is known to draw something else shows that, and nothing new.
bool Hunt::is_through_broken_door(const cases::Case& c) const {
    return std::ranges::any_of(c.relations, [&](const cases::Relation& relation) {
        return relation.kind == cases::RelationKind::door &&
               options_.broken_doors.contains(relation.door);
    });
}

void Hunt::leave_out_broken_doors(Chunk& chunk) {
    for (size_t k = chunk.cases.size(); k-- > 0;) {
        if (is_through_broken_door(chunk.cases[k])) {
            chunk.cases.erase(chunk.cases.begin() + static_cast<std::ptrdiff_t>(k));
            chunk.made.erase(chunk.made.begin() + static_cast<std::ptrdiff_t>(k));
            ++counts_.through_broken_doors;
        }
    }
}

void Hunt::draw_chunk(Chunk chunk) {
    const Clock::time_point begin = Clock::now();
    leave_out_broken_doors(chunk);
    std::vector<size_t> triangles;
    for (const cases::Case& c : chunk.cases) {
        triangles.push_back(cases::assemble(c).size());
    }
    doing_.clear();  // which draw() fills in
    const run::Session::Results results = draw(std::move(chunk.cases));
    counts_.drawing_seconds += seconds_since(begin);
    if (!failure_.empty()) {
        return;
    }
    for (size_t k = 0; k < results.records.size(); ++k) {
        const CaseRecord& record = results.records[k];
        if (is_left(record)) {
            left_.push_back(chunk.made[k].number);
            continue;
        }
        if (!record.drawn.messages.empty()) {
            // Every case is to be valid Vulkan: nothing that a driver does with another counts.
            keep_unjudged(chunk.made[k].text,
                          "the validation layer says: " + record.drawn.messages.front());
            continue;
        }
        switch (record.status) {
            case Status::unsupported:
                ++counts_.unsupported;
                continue;
            case Status::error:
                // What is nobody's failure is counted alone.
                switch (record.error_kind) {
                    case report::ErrorKind::shows_nothing:
                        ++counts_.empty;
                        break;
                    case report::ErrorKind::not_built:
                        ++counts_.unsupported;
                        break;
                    case report::ErrorKind::other:
                        keep_unjudged(chunk.made[k].text, record.reason);
                        break;
                }
                continue;
            default:
                break;
        }
        ++counts_.drawn;
        counts_.triangles += triangles[k];
        std::vector<Symptom> symptoms = symptoms_of(record);
        if (!symptoms.empty()) {
            ++counts_.failed;
            Made& made = chunk.made[k];
            Facts facts = facts_of(made.text);
            open_.push_back(
                {{made.number, std::move(symptoms)}, std::move(made.text), std::move(facts), {}});
        }
    }
    counts_.next_case = chunk.next_case;
    counts_.poses = chunk.poses;
    counts_.pairs = chunk.pairs;
    counts_.refused += chunk.refused;
    counts_.missing += chunk.missing;
}

// Takes from an open case the symptoms that an entry explains.
void Hunt::explain(Open& open) const {
    std::erase_if(open.waiting.symptoms, [&](const Symptom& symptom) {
        const auto entry = std::ranges::find_if(
            entries_, [&](const Entry& e) { return explains(e, symptom, open.facts); });
        if (entry == entries_.end()) {
            return false;
        }
        open.entry = open.entry.value_or(static_cast<size_t>(entry - entries_.begin()));
        return true;
    });
}

// Counts a case of which nothing is open any more, for the entry that explains its gravest symptom.
void Hunt::count(const Open& open) {
    if (open.is_unrepeated) {
        ++counts_.unrepeated;
        if (unrepeated_.size() < kMostUnrepeated) {
            unrepeated_.push_back(open.text);
        }
    } else {
        ++entries_[*open.entry].count;
    }
}

void Hunt::reduce_open() {
    // The shortest first: nearest to what it will be.
    std::ranges::stable_sort(
        open_, [](const Open& a, const Open& b) { return a.text.size() < b.text.size(); });
    std::map<Symptom, size_t> reduced;
    size_t all = 0;
    for (Open& open : open_) {
        explain(open);
        while (!open.waiting.symptoms.empty() && has_known_left() && !is_at_end(is_over()) &&
               all < kReductionsOfChunk) {
            ++all;
            meet_known();
            explain(open);
        }
        if (open.waiting.symptoms.empty() || is_over() || is_interrupted_ || !failure_.empty() ||
            all >= kReductionsOfChunk ||
            reduced[open.waiting.symptoms.front()] >= kReductionsOfSymptom) {
            continue;
        }
        ++all;
        ++reduced[open.waiting.symptoms.front()];
        reduce_one(open);
        explain(open);
    }
    std::erase_if(open_, [&](Open& open) {
        // Entries that came after its turn may explain it, too.
        explain(open);
        if (open.waiting.symptoms.empty()) {
            count(open);
        }
        return open.waiting.symptoms.empty();
    });
}

bool Hunt::is_at_end(bool is_cut) {
    is_interrupted_ = is_interrupted_ || options_.is_interrupted();
    return is_cut || is_interrupted_ || !failure_.empty();
}

run::Session::Results Hunt::draw_candidates(std::vector<cases::Case> cases, bool& is_cut) {
    is_cut = is_cut || is_over();
    if (is_at_end(is_cut)) {
        return {std::vector<CaseRecord>(cases.size()), false, ""};
    }
    counts_.reduction_cases += cases.size();
    run::Session::Results results = draw(std::move(cases));
    is_cut = std::ranges::any_of(results.records, is_left);
    return results;
}

bool Hunt::has_known_left() const {
    return options_.known_failures != nullptr && !options_.known_failures->is_empty();
}

void Hunt::meet_known() {
    ++counts_.reductions;
    bool is_cut = false;
    std::optional<Entry> known = options_.known_failures->next(
        entries_,
        [&](std::vector<cases::Case> cases, const auto&) {
            return draw_candidates(std::move(cases), is_cut);
        },
        [&] { return is_at_end(is_cut); },
        [this](const std::string& what) {
            doing_ = what;
            tell_progress();
        });
    if (known) {
        entries_.push_back(std::move(*known));
    }
}

// Makes an entry of an open case's gravest symptom, or finds that it is that of another one.
void Hunt::reduce_one(Open& open) {
    const Symptom symptom = open.waiting.symptoms.front();
    ++counts_.reductions;
    doing_ = fmt::format("reducing case {}", open.waiting.number);
    bool is_cut = false;  // by the end of the time: it waits for another hunt
    std::optional<Entry> fresh = reduce_case(
        open.text, symptom,
        [&](std::vector<cases::Case> cases, const auto&) {
            return draw_candidates(std::move(cases), is_cut);
        },
        options_.most_rounds, [&] { return is_at_end(is_cut); });
    if (is_at_end(is_cut)) {
        return;
    }
    open.waiting.symptoms.erase(open.waiting.symptoms.begin());
    if (!fresh) {
        open.is_unrepeated = true;
        return;
    }
    fresh->first_case = open.waiting.number;
    fresh->count = 0;  // the case counts when nothing of it is open
    const auto same =
        std::ranges::find_if(entries_, [&](const Entry& e) { return is_same_cause(e, *fresh); });
    open.entry = open.entry.value_or(static_cast<size_t>(same - entries_.begin()));
    if (same != entries_.end()) {
        merge(*same, std::move(*fresh));
    } else {
        entries_.push_back(std::move(*fresh));
    }
}

}  // namespace fuzz
