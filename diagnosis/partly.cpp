// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/partly.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "cases/base/parallel.hpp"

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

// So many cases are drawn at once; then the tallies that they refute are left out.
constexpr size_t kAtOnce = 8;

void leave_out_what_passed(const Hypothesis& hypothesis, std::span<const Subject* const> passed,
                           std::vector<Tally>& tallies) {
    for (size_t first = 0; first < passed.size() && !tallies.empty(); first += kAtOnce) {
        const auto some = passed.subspan(first, std::min(kAtOnce, passed.size() - first));
        std::vector<std::vector<uint8_t>> against(some.size(),
                                                  std::vector<uint8_t>(tallies.size()));
        cases::for_each_index(some.size(), [&](size_t k) {
            const std::optional<capture::Capture> drawn = draw(hypothesis, *some[k]->data);
            for (size_t t = 0; t < tallies.size(); ++t) {
                const auto picture = restricted(*tallies[t].only, *some[k], drawn);
                against[k][t] = picture && is_against(*some[k], *picture) ? 1 : 0;
            }
        });
        for (size_t t = 0; t < tallies.size(); ++t) {
            for (const std::vector<uint8_t>& of_case : against) {
                tallies[t].passed_against += of_case[t];
            }
        }
        std::erase_if(tallies, [](const Tally& tally) { return tally.passed_against > 0; });
    }
}

void leave_out_what_fails_otherwise(const Hypothesis& hypothesis, std::span<const Subject> subjects,
                                    size_t seed, std::vector<Tally>& tallies) {
    for (size_t first = 0; first < subjects.size() && !tallies.empty(); first += kAtOnce) {
        cases::for_each_index(std::min(kAtOnce, subjects.size() - first), [&](size_t k) {
            const size_t s = first + k;
            if (s == seed) {
                return;
            }
            const std::optional<capture::Capture> drawn = draw(hypothesis, *subjects[s].data);
            for (Tally& tally : tallies) {
                tally.answers[s] =
                    answer_of(subjects[s], restricted(*tally.only, subjects[s], drawn));
            }
        });
        std::erase_if(tallies, [](const Tally& tally) { return tally.count(Says::otherwise) > 0; });
    }
}

}  // namespace

std::vector<Tally> partial_tallies(const Hypothesis& hypothesis, size_t number,
                                   std::span<const Subject> subjects, size_t seed,
                                   std::span<const Subject* const> passed) {
    std::vector<Tally> tallies;
    const std::optional<capture::Capture> at_seed = draw(hypothesis, *subjects[seed].data);
    if (!at_seed) {
        return {};
    }
    for (Condition& condition : conditions_at(subjects[seed], *at_seed)) {
        const Answer answer =
            answer_of(subjects[seed], restricted(condition, subjects[seed], at_seed));
        if (answer.says == Says::explains) {
            tallies.push_back({number, std::move(condition), {}, 0, passed.size()});
            tallies.back().answers.resize(subjects.size());
            tallies.back().answers[seed] = answer;
        }
    }
    leave_out_what_passed(hypothesis, passed, tallies);
    leave_out_what_fails_otherwise(hypothesis, subjects, seed, tallies);
    std::set<Condition::Kind> kinds;
    std::erase_if(tallies, [&](const Tally& tally) {
        return tally.count(Says::explains) < 2 || !kinds.insert(tally.only->kind).second;
    });
    return tallies;
}

}  // namespace diagnosis
