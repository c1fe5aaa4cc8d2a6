// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/partly.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "cases/base/parallel.hpp"
#include "diagnosis/choice.hpp"
#include "diagnosis/work.hpp"

namespace diagnosis {

namespace {

// The error's picture of a case under a condition; nothing where they have no part in it.
std::optional<capture::Capture> restricted(const Condition& condition, const Subject& subject,
                                           const std::optional<capture::Capture>& drawn) {
    std::optional<capture::Capture> out = drawn;
    if (out && !restrict_to(condition, *subject.data, subject.right, *out)) {
        out.reset();
    }
    return out;
}

// Whether the error is what is wrong in a failed case though the condition holds nowhere in it.
bool contradicts(const Subject& failed, const std::optional<capture::Capture>& drawn,
                 const std::optional<capture::Capture>& with_condition) {
    return with_condition && answer_of(failed, with_condition).says == Says::nothing &&
           answer_of(failed, drawn).match.covers();
}

// So many cases are drawn at once; then the tallies that they refute are left out.
constexpr size_t kAtOnce = 8;
// And so many of what passed before what failed.
constexpr size_t kFirst = 64;

// A condition that is left, and is told to be needed by a case that passed.
struct Tried {
    Tally tally;
    bool is_needed = false;
};

void leave_out_what_passed(const Hypothesis& hypothesis, std::span<const Subject* const> passed,
                           std::vector<Tried>& all, uint64_t& work) {
    for (size_t first = 0; first < passed.size() && !all.empty(); first += kAtOnce) {
        const auto some = passed.subspan(first, std::min(kAtOnce, passed.size() - first));
        for (const Subject* subject : some) {
            work += work_of_picture(*subject->data) * (1 + all.size());
        }
        std::vector<std::vector<uint8_t>> against(some.size(), std::vector<uint8_t>(all.size()));
        std::vector<uint8_t> needs(some.size());
        cases::for_each_index(some.size(), [&](size_t k) {
            const std::optional<capture::Capture> drawn = draw(hypothesis, *some[k]->data);
            needs[k] = drawn && is_against(*some[k], *drawn) ? 1 : 0;
            for (size_t t = 0; needs[k] != 0 && t < all.size(); ++t) {
                const auto picture = restricted(*all[t].tally.only, *some[k], drawn);
                against[k][t] = picture && is_against(*some[k], *picture) ? 1 : 0;
            }
        });
        for (size_t t = 0; t < all.size(); ++t) {
            for (size_t k = 0; k < some.size(); ++k) {
                all[t].tally.passed_against += against[k][t];
                all[t].is_needed = all[t].is_needed || needs[k] != 0;
            }
        }
        std::erase_if(all, [](const Tried& tried) { return tried.tally.passed_against > 0; });
    }
}

void leave_out_what_fails_otherwise(const Hypothesis& hypothesis, std::span<const Subject> subjects,
                                    size_t seed, std::vector<Tried>& all, uint64_t& work) {
    for (size_t first = 0; first < subjects.size() && !all.empty(); first += kAtOnce) {
        const size_t count = std::min(kAtOnce, subjects.size() - first);
        for (const Subject& subject : subjects.subspan(first, count)) {
            work += work_of_picture(*subject.data) * (1 + all.size());
        }
        std::vector<std::vector<uint8_t>> against(count, std::vector<uint8_t>(all.size()));
        cases::for_each_index(count, [&](size_t k) {
            const size_t s = first + k;
            if (s == seed) {
                return;
            }
            const std::optional<capture::Capture> drawn = draw(hypothesis, *subjects[s].data);
            for (size_t t = 0; t < all.size(); ++t) {
                Tally& tally = all[t].tally;
                const auto picture = restricted(*tally.only, subjects[s], drawn);
                tally.answers[s] = answer_of(subjects[s], picture);
                against[k][t] = tally.answers[s].says == Says::otherwise ||
                                        contradicts(subjects[s], drawn, picture)
                                    ? 1
                                    : 0;
            }
        });
        std::vector<Tried> left;
        for (size_t t = 0; t < all.size(); ++t) {
            if (std::ranges::none_of(against, [t](const auto& of) { return of[t] != 0; })) {
                left.push_back(std::move(all[t]));
            }
        }
        all = std::move(left);
    }
}

// Leaves of one file are nearly one case.
constexpr size_t kFewestLeaves = 4;
bool is_founded(std::span<const Subject> subjects, const Tally& tally) {
    std::set<std::string> files;
    for (size_t s = 0; s < subjects.size(); ++s) {
        if (tally.answers[s].says == Says::explains) {
            files.insert(file_of(*subjects[s].record));
        }
    }
    return files.size() >= 2 || tally.count(Says::explains) >= kFewestLeaves;
}

// Whether something is right within a case that the tally explains, and would be wrong without the
// condition.
bool is_needed_in_a_case(const Hypothesis& hypothesis, std::span<const Subject> subjects,
                         const Tally& tally) {
    for (size_t s = 0; s < subjects.size(); ++s) {
        if (tally.answers[s].says == Says::explains &&
            answer_of(subjects[s], draw(hypothesis, *subjects[s].data)).says != Says::explains) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<Tally> partial_tallies(const Hypothesis& hypothesis, size_t number,
                                   std::span<const Subject> subjects, size_t seed,
                                   std::span<const Subject* const> passed, uint64_t& work) {
    std::vector<Tried> all;
    work += work_of_picture(*subjects[seed].data);
    const std::optional<capture::Capture> at_seed = draw(hypothesis, *subjects[seed].data);
    if (!at_seed) {
        return {};
    }
    for (Condition& condition : conditions_at(subjects[seed], *at_seed)) {
        work += work_of_picture(*subjects[seed].data);
        const Answer answer =
            answer_of(subjects[seed], restricted(condition, subjects[seed], at_seed));
        if (answer.says == Says::explains) {
            all.push_back({{number, std::move(condition), {}, 0, passed.size()}});
            all.back().tally.answers.resize(subjects.size());
            all.back().tally.answers[seed] = answer;
        }
    }
    const std::span<const Subject* const> first = passed.first(std::min(kFirst, passed.size()));
    leave_out_what_passed(hypothesis, first, all, work);
    leave_out_what_fails_otherwise(hypothesis, subjects, seed, all, work);
    std::erase_if(all, [&](const Tried& tried) { return !is_founded(subjects, tried.tally); });
    leave_out_what_passed(hypothesis, passed.subspan(first.size()), all, work);
    std::set<Condition::Kind> kinds;
    std::vector<Tally> out;
    for (Tried& tried : all) {
        if ((tried.is_needed || is_needed_in_a_case(hypothesis, subjects, tried.tally)) &&
            kinds.insert(tried.tally.only->kind).second) {
            out.push_back(std::move(tried.tally));
        }
    }
    return out;
}

bool is_contradicted(const Hypothesis& hypothesis, const Condition& condition,
                     std::span<const Subject> failed) {
    std::vector<uint8_t> against(failed.size());
    cases::for_each_index(failed.size(), [&](size_t k) {
        const std::optional<capture::Capture> drawn = draw(hypothesis, *failed[k].data);
        against[k] = contradicts(failed[k], drawn, restricted(condition, failed[k], drawn)) ? 1 : 0;
    });
    return std::ranges::any_of(against, [](uint8_t is_against) { return is_against != 0; });
}

}  // namespace diagnosis
