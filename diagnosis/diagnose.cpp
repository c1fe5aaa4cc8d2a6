// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnose.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cases/base/parallel.hpp"
#include "cases/model/sample.hpp"
#include "diagnosis/choice.hpp"
#include "diagnosis/fit.hpp"
#include "diagnosis/hypothesis.hpp"
#include "diagnosis/match.hpp"
#include "diagnosis/partly.hpp"
#include "diagnosis/tally.hpp"
#include "diagnosis/work.hpp"
#include "rasterizers/strength/recorded.hpp"
#include "rasterizers/strength/strength.hpp"

namespace diagnosis {

namespace {

using report::CaseRecord;
using report::Diagnosis;

constexpr uint64_t kMaxSeedCost = 1U << 14U;  // of all seeds: some seconds of one core

class Diagnoser {
  public:
    Diagnoser(const report::Run& run, const CaseOf& case_of, const Bound& bound)
        : bound_(bound),
          limits_(ref::limits_of(run.device.subpixel_bits, run.device.sample_locations,
                                 run.device.depth_beside_stencil)),
          profile_(run.profile) {
        // A known failure that fails otherwise, too, shows two errors at once: such cases are
        // looked at where there are no others.
        const bool has_news = std::ranges::any_of(run.cases, [](const auto& r) {
            return r.status == report::Status::fail && !r.known.expected;
        });
        const auto counts = [has_news](const CaseRecord& record) {
            return record.status == report::Status::fail && !(has_news && record.known.expected);
        };
        all_failed_ = static_cast<uint64_t>(std::ranges::count_if(run.cases, counts));
        const auto is_failed = [&](const cases::Case& c, const CaseRecord& record) {
            return counts(record) && can_match(c, record);
        };
        // One that breaks each rule, then some of each family and rule.
        more_failed_ = by_turn(run, case_of, is_failed, first_rule, kMaxOfRules);
        const std::vector<Choice> of_families =
            by_turn(run, case_of, is_failed, family_and_rule, run.cases.size());
        const size_t of_rules = more_failed_.size();
        failed_ = of_families.size();
        std::ranges::copy_if(
            of_families, std::back_inserter(more_failed_), [&](const Choice& choice) {
                const auto end = more_failed_.begin() + static_cast<std::ptrdiff_t>(of_rules);
                return std::find_if(more_failed_.begin(), end, [&](const Choice& c) {
                           return c.record == choice.record;
                       }) == end;
            });
        more_failed_.resize(std::min(failed_, kMaxSubjects + kMaxMore));
        size_t tried = std::min(more_failed_.size(), bound.subjects);
        std::set<std::string> families;
        for (size_t k = 0; k < tried; ++k) {
            const Choice& choice = more_failed_[k];
            // Most of what may be drawn is left for the errors.
            if (!subjects_.empty() && work_ > bound_.most / 4) {
                tried = k;
                break;
            }
            work_ += work_of_subject(*choice.data);
            if (auto subject = make_subject(*choice.data, *choice.record, limits_, profile_)) {
                subjects_.push_back(std::move(*subject));
                families.insert(family_of(*choice.record));
            }
        }
        more_failed_.erase(more_failed_.begin(),
                           more_failed_.begin() + static_cast<std::ptrdiff_t>(tried));
        if (subjects_.empty()) {
            return;
        }
        choose_passed(run, case_of, families);
        for (const CaseRecord& record : run.cases) {
            if (record.status == report::Status::pass) {
                passed_records_.emplace(record.id, &record);
            }
        }
        case_of_ = &case_of;
    }

    std::vector<Diagnosis> run() {
        std::vector<Diagnosis> out;
        known_ = hypotheses();
        answers_.assign(known_.size(), std::vector<std::optional<Answer>>(subjects_.size()));
        std::vector<bool> is_explained(subjects_.size());
        size_t seeds = 0, part_seeds = 0;
        uint64_t cost = 0;
        for (size_t s = 0; s < subjects_.size() && seeds < kMaxSeeds; ++s) {
            const uint64_t more = cost_of(*subjects_[s].data);
            if (is_explained[s] || cost + more > kMaxSeedCost) {
                continue;
            }
            ++seeds;
            cost += more;
            if (bound_.progress) {
                bound_.progress(seeds, std::min(kMaxSeeds, subjects_.size()));
            }
            std::vector<Tally> best = best_for(s);
            if (best.empty() && part_seeds < kMaxPartSeeds) {
                ++part_seeds;
                best = best_part_for(s);
            }
            if (is_spent()) {
                break;  // the best of what was drawn need not be the best
            }
            if (best.empty()) {
                continue;
            }
            for (size_t k = 0; k < subjects_.size(); ++k) {
                is_explained[k] = is_explained[k] || best.front().answers[k].says == Says::explains;
            }
            out.push_back(told(best));
        }
        std::ranges::stable_sort(
            out, [](const Diagnosis& a, const Diagnosis& b) { return a.cases > b.cases; });
        return out;
    }

  private:
    // Some of every family; then, since they are the most likely to contradict what is told, those
    // of the families that fail.
    void choose_passed(const report::Run& run, const CaseOf& case_of,
                       const std::set<std::string>& families) {
        std::set<const CaseRecord*> chosen;
        const auto is_new = [&](const cases::Case&, const CaseRecord& record) {
            return record.status == report::Status::pass && !chosen.contains(&record);
        };
        passed_ = by_turn(run, case_of, is_new, family_and_rule, kMaxSubjects);
        for (const Choice& choice : passed_) {
            chosen.insert(choice.record);
        }
        const std::vector<Choice> nearby = by_turn(
            run, case_of,
            [&](const cases::Case& c, const CaseRecord& record) {
                return is_new(c, record) && families.contains(family_of(record));
            },
            file_of, kMaxNearby);
        passed_.insert(passed_.end(), nearby.begin(), nearby.end());
    }

    // Those with a size that some values fit come first.
    std::vector<Hypothesis> hypotheses() {
        std::vector<Hypothesis> out;
        if (subjects_.empty()) {
            return out;
        }
        const auto add = [&out](const Hypothesis& h) {
            if (std::ranges::find(out, h.name, &Hypothesis::name) == out.end()) {
                out.push_back(h);
            }
        };
        size_t fits = 0;
        for (size_t k = 0; k < subjects_.size() && fits < kMaxFits; ++k) {
            const std::vector<Hypothesis> fitted =
                fitted_hypotheses(subjects_[k], limits_.subpixel_bits);
            fits += fitted.empty() ? 0U : 1U;
            std::ranges::for_each(fitted, add);
        }
        std::ranges::for_each(usual_shifts(limits_.subpixel_bits), add);
        fitted_ = out.size();
        const std::vector<Hypothesis> known = known_hypotheses(limits_.subpixel_bits);
        out.insert(out.end(), known.begin(), known.end());
        return out;
    }

    bool is_spent() const { return work_ > bound_.most; }

    // Adds what asking subject `s` costs, if that was not asked.
    void spend_for(size_t h, size_t s) {
        work_ += answers_[h][s] ? 0 : work_of_picture(*subjects_[s].data);
    }

    // What a hypothesis says of a subject; each is asked once.
    const Answer& ask(size_t h, size_t subject) {
        std::optional<Answer>& answer = answers_[h][subject];
        if (!answer) {
            answer = answer_of(subjects_[subject], draw(known_[h], *subjects_[subject].data));
        }
        return *answer;
    }

    // The same, without a difference between what says nothing and what fails otherwise where that
    // is cheaper.
    Answer ask_in_short(size_t h, size_t subject) {
        std::optional<Answer>& answer = answers_[h][subject];
        if (answer) {
            return *answer;
        }
        const std::optional<capture::Capture> drawn = draw(known_[h], *subjects_[subject].data);
        if (!drawn || !may_match(subjects_[subject], *drawn)) {
            return {};
        }
        answer = answer_of(subjects_[subject], drawn);
        return *answer;
    }

    // The plausible hypotheses that explain subject `seed` and most others, all that are alike.
    std::vector<Tally> best_for(size_t seed) {
        at_seed_.assign(known_.size(), {});
        for (size_t h = 0; h < known_.size(); ++h) {
            spend_for(h, seed);
        }
        cases::for_each_index(known_.size(),
                              [&](size_t h) { at_seed_[h] = ask_in_short(h, seed); });
        std::vector<Tally> plausible;
        for (size_t h = 0; h < known_.size(); ++h) {
            if (at_seed_[h].says != Says::explains) {
                continue;
            }
            for (size_t k = 0; k < subjects_.size(); ++k) {
                spend_for(h, k);
            }
            if (is_spent()) {
                return {};
            }
            Tally tally{h, {}, std::vector<Answer>(subjects_.size()), 0, 0};
            cases::for_each_index(subjects_.size(),
                                  [&](size_t k) { tally.answers[k] = ask(h, k); });
            if (tally.is_plausible()) {
                plausible.push_back(std::move(tally));
            }
        }
        std::ranges::stable_sort(
            plausible, [](const Tally& a, const Tally& b) { return a.score() > b.score(); });
        // Those that are worse than one that stands cannot be told.
        std::vector<Tally> best;
        for (Tally& tally : plausible) {
            if (!best.empty() && !best.front().is_alike(tally)) {
                continue;
            }
            try_passed(tally);
            if (tally.stands(failed_)) {
                best.push_back(std::move(tally));
            }
        }
        const auto least = std::ranges::min_element(best, {}, &Tally::passed_against);
        if (least != best.end()) {
            std::erase_if(best, [most = least->passed_against](const Tally& tally) {
                return tally.passed_against > most;
            });
        }
        leave_out_what_is_fitted(best);
        if (best.size() > kMaxNamed) {
            best.clear();
        }
        return best;
    }

    // What draws every case as a fitted size does says the same, with less.
    void leave_out_what_is_fitted(std::vector<Tally>& best) const {
        if (best.empty() || best.front().hypothesis >= fitted_) {
            return;
        }
        const Hypothesis& fitted = known_[best.front().hypothesis];
        const auto is_same = [&](const Tally& tally) {
            for (size_t k = 0; k < subjects_.size(); ++k) {
                if (tally.answers[k].says == Says::explains) {
                    const auto a = draw(fitted, *subjects_[k].data);
                    const auto b = draw(known_[tally.hypothesis], *subjects_[k].data);
                    if (!a || !b || !software::same_bits(*a, *b)) {
                        return false;
                    }
                }
            }
            return true;
        };
        best.erase(std::remove_if(best.begin() + 1, best.end(), is_same), best.end());
    }

    // Those that, under a condition, explain subject `seed` and most others, all that are alike;
    // after best_for().
    std::vector<Tally> best_part_for(size_t seed) {
        std::vector<size_t> candidates;
        for (size_t h = 0; h < known_.size(); ++h) {
            if (at_seed_[h].says != Says::nothing && at_seed_[h].match.covers()) {
                candidates.push_back(h);
            }
        }
        std::vector<Tally> best;
        if (candidates.size() > kMaxPartCandidates) {
            return best;  // the seed tells too little
        }
        for (const size_t h : candidates) {
            std::vector<const Subject*> passed;
            for (const cases::Case* c : passed_cases(h)) {
                if (const std::optional<Subject>& subject = passed_subject(*c)) {
                    passed.push_back(&*subject);
                }
            }
            if (is_spent()) {
                return {};
            }
            for (Tally& tally : partial_tallies(known_[h], h, subjects_, seed, passed, work_)) {
                for (const Subject& subject : more_failed()) {
                    work_ += work_of_picture(*subject.data);
                }
                if (is_contradicted(known_[h], *tally.only, more_failed())) {
                    continue;
                }
                if (best.empty() || tally.score() > best.front().score()) {
                    best.clear();
                }
                if (best.empty() || best.front().is_alike(tally)) {
                    best.push_back(std::move(tally));
                }
            }
        }
        if (best.size() > kMaxNamed) {
            best.clear();
        }
        return best;
    }

    // Failed cases that are not tried one by one.
    const std::vector<Subject>& more_failed() {
        for (const Choice& choice : std::exchange(more_failed_, {})) {
            work_ += work_of_subject(*choice.data);
            if (auto subject = make_subject(*choice.data, *choice.record, limits_, profile_)) {
                more_subjects_.push_back(std::move(*subject));
            }
        }
        return more_subjects_;
    }

    // Small cases that passed; for a known fault, those that are known to catch it come first.
    std::vector<const cases::Case*> passed_cases(size_t hypothesis) const {
        const Hypothesis& h = known_[hypothesis];
        std::vector<const cases::Case*> list;
        for (const software::Kill& kill : software::built_in_kills()) {
            const bool is_asked = h.device.fault == kill.fault && kill.fault != cases::kNoFault &&
                                  passed_records_.contains(kill.leaf);
            const cases::Case* c = is_asked ? (*case_of_)(kill.leaf) : nullptr;
            if (c != nullptr && cost_of(*c) <= kMaxCost) {
                list.push_back(c);
            }
        }
        for (const Choice& choice : passed_) {
            list.push_back(choice.data);
        }
        return list;
    }

    // Cases that passed would have failed.
    void try_passed(Tally& tally) {
        for (const cases::Case* c : passed_cases(tally.hypothesis)) {
            if (!tally.stands(failed_) || is_spent()) {
                return;
            }
            ++tally.passed_tried;
            work_ += work_of_picture(*c);
            std::optional<capture::Capture> drawn = draw(known_[tally.hypothesis], *c);
            const std::optional<Subject>& subject = drawn ? passed_subject(*c) : nothing_;
            if (subject && subject->altered) {
                drawn = draw(known_[tally.hypothesis], *subject->data);
            }
            if (subject && is_against(*subject, *drawn)) {
                ++tally.passed_against;
            }
        }
    }

    const std::optional<Subject>& passed_subject(const cases::Case& c) {
        const auto [at, is_new] = passed_subjects_.try_emplace(&c);
        if (is_new) {
            work_ += work_of_subject(c);
            at->second = make_subject(c, *passed_records_.at(c.id), limits_, profile_);
        }
        return at->second;
    }

    Diagnosis told(const std::vector<Tally>& best) const {
        Diagnosis out;
        for (const Tally& tally : best) {
            const Hypothesis& h = known_[tally.hypothesis];
            out.what.push_back(tally.only ? h.what + ' ' + tally.only->what : h.what);
            out.names.push_back(tally.only ? h.name + '@' + tally.only->name : h.name);
        }
        const Tally& first = best.front();
        out.tried = subjects_.size();
        out.failed = all_failed_;
        out.cases = first.count(Says::explains);
        out.against = first.count(Says::otherwise);
        out.passed_against = first.passed_against;
        out.passed_tried = first.passed_tried;
        for (size_t k = 0; k < subjects_.size(); ++k) {
            if (first.answers[k].says == Says::explains) {
                const Match& m = first.answers[k].match;
                out.samples += m.wrong;
                out.same_samples += m.same;
                out.values += m.values;
                out.same_values += m.same_values;
                if (out.examples.size() < 3) {
                    out.examples.push_back(subjects_[k].record->id);
                }
                out.explained.push_back(subjects_[k].record->id);
            } else {
                out.unexplained.push_back(subjects_[k].record->id);
            }
        }
        return out;
    }

    Bound bound_;
    uint64_t all_failed_ = 0;
    Work work_ = 0;
    ref::Limits limits_;
    cases::Profile profile_;
    std::vector<Subject> subjects_;
    size_t failed_ = 0;                   // cases that could be subjects
    std::vector<Choice> more_failed_;     // until they are asked for
    std::vector<Subject> more_subjects_;  // then
    std::vector<Choice> passed_;
    std::map<std::string, const CaseRecord*> passed_records_;  // by id
    const CaseOf* case_of_ = nullptr;
    std::vector<Hypothesis> known_;
    size_t fitted_ = 0;  // so many of them, the first, have a size
    std::vector<std::vector<std::optional<Answer>>> answers_;  // [hypothesis][subject]
    std::vector<Answer> at_seed_;                              // [hypothesis], of the last seed
    std::map<const cases::Case*, std::optional<Subject>> passed_subjects_;
    const std::optional<Subject> nothing_;
};

}  // namespace

std::vector<Diagnosis> diagnose(const report::Run& run, const CaseOf& case_of, const Bound& bound) {
    return Diagnoser(run, case_of, bound).run();
}

}  // namespace diagnosis
