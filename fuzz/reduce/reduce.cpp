// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/reduce.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "cases/base/checksum.hpp"
#include "cases/base/parallel.hpp"
#include "cases/load/loader.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

namespace {

// What stands for a text in the list of answers, which would be large with whole texts: two
// checksums, so 128 bits.
using Key = std::array<uint64_t, 2>;
Key key_of(const std::string& text) {
    return {cases::checksum(1, text), cases::checksum(2, text)};
}

// The case of a document, if it is one of no leaves or some: the first of them.
std::optional<cases::Case> load(const Document& document) {
    auto loaded = cases::load_tree(document, "case");
    return loaded && !loaded->empty() ? std::optional(std::move(loaded->front())) : std::nullopt;
}

// What a step makes of a document, if it is simpler.
std::optional<Document> applied(const Step& step, const Document& document, const Measure& before) {
    Document after = document;
    if (!step.apply(after) || !(measure(after) < before)) {
        return std::nullopt;
    }
    return after;
}

// A step and the case that it leads to. The document is made again when it is wanted:
// those of large cases are many times as large as their texts.
struct Stepped {
    const Step* step = nullptr;
    std::string text;
    std::optional<cases::Case> data;
};

// Those of some steps, in their order, whose texts are wanted and that are cases.
template <class IsWanted>
std::vector<Stepped> stepped(const Document& document, std::span<const Step> steps,
                             const IsWanted& is_wanted) {
    const Measure before = measure(document);
    std::vector<Stepped> all(steps.size());
    cases::for_each_index(all.size(), [&](size_t k) {
        if (const std::optional<Document> after = applied(steps[k], document, before)) {
            Stepped& one = all[k];
            one.step = &steps[k];
            one.text = to_text(*after);
            one.data = is_wanted(one.text) ? load(*after) : std::nullopt;
        }
    });
    std::erase_if(all, [](const Stepped& one) { return !one.data; });
    return all;
}

// Whether two steps of one document remove some same thing.
bool overlap(const Step& a, const Step& b) {
    return a.of == b.of && !a.of.empty() && a.draw == b.draw && a.begin < b.end && b.begin < a.end;
}

// The document after several steps that were all made for it: what moves numbers of others comes
// last, and from the back. Steps that take part of what another one took are left out.
struct Together {
    Document document;
    std::vector<std::string> steps;  // in words
};
Together applied_together(const Document& document, const std::vector<const Step*>& steps) {
    std::vector<const Step*> chosen;
    for (const Step* step : steps) {
        if (std::ranges::none_of(chosen, [&](const Step* s) { return overlap(*s, *step); })) {
            chosen.push_back(step);
        }
    }
    std::ranges::stable_sort(chosen, [](const Step* a, const Step* b) {
        return std::pair(a->phase, b->begin) < std::pair(b->phase, a->begin);
    });
    Together out{document, {}};
    for (const Step* step : chosen) {
        if (std::optional<Document> after = applied(*step, out.document, measure(out.document))) {
            out.document = std::move(*after);
            out.steps.push_back(step->words);
        }
    }
    return out;
}

std::span<const Stage> on_from(Stage stage) {
    return std::span(kStages).subspan(static_cast<size_t>(stage));
}

std::span<const Stage> only(Stage stage) {
    return on_from(stage).first(1);
}

bool has_large_target(const Document& document) {
    constexpr uint64_t kLarge = 4096;  // samples
    const Measure m = measure(document);
    constexpr size_t kSamplesAt = 3, kLayersAt = 4, kPixelsAt = 5;
    return m[kPixelsAt] * std::max<uint64_t>(m[kSamplesAt], 1) *
               std::max<uint64_t>(m[kLayersAt], 1) >
           kLarge;
}

class Reducer {
  public:
    Reducer(const Shows& shows, const ReduceOptions& options) : shows_(shows), options_(options) {
        options_.batch = std::max<size_t>(options_.batch, 1);
    }

    Reduced reduce(Document document) {
        out_.document = std::move(document);
        answers_.emplace(key_of(to_text(out_.document)), true);
        // Every question about a large target is dear.
        while (!is_spent() && has_large_target(out_.document) && take_some(only(Stage::target))) {
        }
        // After a success the search goes on where it was; what was refused before is tried again
        // in the end, when everything else has been.
        Stage from = kStages.front();
        while (!is_spent()) {
            if (const std::optional<Stage> found = take_some(on_from(from))) {
                from = *found;
            } else if (from == kStages.front() && !is_spent()) {
                out_.is_minimal = true;
                break;
            } else {
                from = kStages.front();
            }
        }
        tell_needs();
        return std::move(out_);
    }

  private:
    bool is_over() const { return options_.is_over && options_.is_over(); }
    bool is_spent() const { return out_.rounds >= options_.most_rounds || is_over(); }

    // Whether it has been asked about, and does not show the finding.
    bool is_refused(const std::string& text) const {
        const auto answer = answers_.find(key_of(text));
        return answer != answers_.end() && !answer->second;
    }

    // Asks about all of the texts that have no answer yet, in one call.
    void ask(std::vector<Candidate> candidates) {
        std::vector<Key> keys;
        std::erase_if(candidates, [&](const Candidate& c) {
            const Key key = key_of(c.text);
            const bool is_open = answers_.emplace(key, false).second;
            if (is_open) {
                keys.push_back(key);
            }
            return !is_open;
        });
        if (keys.empty()) {
            return;
        }
        ++out_.rounds;
        out_.tried += keys.size();
        const std::vector<bool> answers = shows_(candidates);
        if (answers.size() != keys.size()) {
            throw std::logic_error("the reducer needs one answer a text");
        }
        const bool is_cut = is_over();
        for (size_t k = 0; k < keys.size(); ++k) {
            if (is_cut) {
                answers_.erase(keys[k]);
            } else {
                answers_[keys[k]] = answers[k];
            }
        }
    }

    // Goes through the steps of some stages until some show the finding, and takes as
    // many of these as do so together. The stage where to go on, or nothing if no step showed it.
    std::optional<Stage> take_some(std::span<const Stage> stages) {
        // Each question about many triangles is dear: half of them are gone before the rest is
        // asked about.
        constexpr size_t kTrianglesAt = 1, kManyTriangles = 4, kFewQuestions = 8;
        const bool is_dear = measure(out_.document)[kTrianglesAt] > kManyTriangles;
        const size_t most = is_dear ? std::min(kFewQuestions, options_.batch) : options_.batch;
        std::deque<std::vector<Step>> kept;  // candidates point to them
        std::vector<Stepped> batch;
        for (const Stage stage : stages) {
            const std::span<const Step> steps = kept.emplace_back(steps_of(out_.document, stage));
            for (size_t at = 0; at < steps.size() && !is_spent(); at += most) {
                const size_t count = std::min(most, steps.size() - at);
                for (Stepped& c : stepped(out_.document, steps.subspan(at, count),
                                          [&](const auto& text) { return !is_refused(text); })) {
                    if (batch.size() == most) {
                        if (const std::optional<Stage> found = settle(batch)) {
                            return found;
                        }
                        batch.clear();
                    }
                    batch.push_back(std::move(c));
                }
            }
        }
        return settle(batch);
    }

    std::optional<Stage> settle(std::vector<Stepped>& batch) {
        if (batch.empty() || is_spent()) {
            return std::nullopt;
        }
        std::vector<Candidate> asked;
        for (Stepped& c : batch) {
            asked.push_back({c.text, std::move(*c.data)});
        }
        ask(std::move(asked));
        std::vector<Stepped*> good;
        for (Stepped& c : batch) {
            if (const auto answer = answers_.find(key_of(c.text));
                answer != answers_.end() && answer->second) {
                good.push_back(&c);
            }
        }
        if (good.empty()) {
            return std::nullopt;
        }
        const Stage found = batch.front().step->stage;
        take(good);
        return found;
    }

    // All of the candidates that show it at once, or the first half, quarter, ... of them: the most
    // that do so still. The first alone is known to.
    void take(const std::vector<Stepped*>& good) {
        std::vector<Together> chain;
        std::vector<std::string> texts;
        std::vector<Candidate> asked;
        for (size_t count = good.size(); count > 1 && texts.size() < options_.batch; count /= 2) {
            std::vector<const Step*> steps;
            for (size_t k = 0; k < count; ++k) {
                steps.push_back(good[k]->step);
            }
            Together together = applied_together(out_.document, steps);
            if (std::optional<cases::Case> data = load(together.document)) {
                texts.push_back(to_text(together.document));
                asked.push_back({texts.back(), std::move(*data)});
                chain.push_back(std::move(together));
            }
        }
        if (!is_spent()) {
            ask(std::move(asked));
        }
        const Measure before = measure(out_.document);
        Together next = applied_together(out_.document, {good.front()->step});
        for (size_t k = 0; k < chain.size(); ++k) {
            const auto answer = answers_.find(key_of(texts[k]));
            if (answer != answers_.end() && answer->second &&
                measure(chain[k].document) < measure(next.document)) {
                next = std::move(chain[k]);
                break;
            }
        }
        if (!(measure(next.document) < before)) {
            throw std::logic_error("a step of the reducer did not make the case simpler");
        }
        out_.document = std::move(next.document);
        out_.steps.insert(out_.steps.end(), next.steps.begin(), next.steps.end());
    }

    // Of all steps that were refused, those with words for it: one for each text.
    void tell_needs() {
        std::unordered_set<std::string> told;
        for (const Stage stage : kStages) {
            std::vector<Step> steps = steps_of(out_.document, stage);
            std::erase_if(steps, [](const Step& step) { return step.need.empty(); });
            for (Stepped& c : stepped(out_.document, steps,
                                      [&](const auto& text) { return is_refused(text); })) {
                if (told.insert(c.text).second) {
                    out_.needs.push_back(c.step->need);
                    out_.need_texts.push_back(std::move(c.text));
                }
            }
        }
    }

    const Shows& shows_;
    ReduceOptions options_;
    std::map<Key, bool> answers_;
    Reduced out_;
};

}  // namespace

Reduced reduce(Document document, const Shows& shows, const ReduceOptions& options) {
    return Reducer(shows, options).reduce(std::move(document));
}

}  // namespace fuzz
