// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is observed of a sample, asked of its paths together: the search against a list of all
// paths, each by itself.
#include "ref/path/path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "ref/path/exact.hpp"
#include "tests/unit/ref/random_questions.hpp"

namespace ref::test {
namespace {

using path::Answer;
using path::History;
using path::Observed;
using path::Question;

// Some of what a path leaves, as planes would show it; now and then what none leaves.
Observed observed_of(const History& path, size_t count, RandomQuestions& random) {
    Observed out;
    const auto front = static_cast<uint32_t>(std::ranges::count(path.is_front, true));
    const auto total = static_cast<uint32_t>(path.shown.size());
    switch (random.below(4)) {
        case 0:
            out.hits = {path::SeenHits::Detail::any, total > 0 ? 1U : 0U, 0};
            break;
        case 1:
            out.hits = {path::SeenHits::Detail::total, total + (random.one_in(6) ? 1U : 0U), 0};
            break;
        case 2:
            out.hits = {path::SeenHits::Detail::faces, front, total - front};
            break;
        default:
            break;
    }
    if (random.one_in(2)) {
        out.stencil = random.one_in(6) ? path.stencil ^ 1U : path.stencil;
    }
    const auto flags = [&](int right) {
        std::vector<bool> of(count, false);
        for (size_t m = 0; m < count; ++m) {
            of[m] = static_cast<int>(m) == right ? !random.one_in(8) : random.one_in(4);
        }
        return of;
    };
    if (random.one_in(2)) {
        out.last = flags(path.shown.empty() ? -1 : static_cast<int>(path.shown.back()));
        out.may_be_unhit = path.shown.empty();
    }
    if (random.one_in(2)) {
        out.stored = flags(path.stored);
        out.may_be_clear = path.stored == path::kClearDepth;
    }
    return out;
}

// What a colour shows of a path: the fragments that show, and clears.
std::vector<uint32_t> colored(const History& h, const Question& question) {
    std::vector<uint32_t> out = h.shown;
    std::ranges::copy_if(h.discarded, std::back_inserter(out),
                         [&](uint32_t m) { return question.fragments[m].is_clear; });
    std::ranges::sort(out);
    return out;
}

bool is_path(const History& found, const std::vector<History>& all) {
    return std::ranges::any_of(all, [&](const History& h) {
        return h.shown == found.shown && h.is_front == found.is_front && h.stored == found.stored &&
               h.stencil == found.stencil && h.discarded == found.discarded;
    });
}

// Checks one question; returns how many observations no path satisfies.
size_t check(const Question& question, const std::vector<History>& all, RandomQuestions& random) {
    size_t denied = 0;
    const size_t count = question.fragments.size();
    for (int n = 0; n < 6; ++n) {
        const Observed observed =
            observed_of(all[random.below(static_cast<uint32_t>(all.size()))], count, random);
        std::set<std::vector<uint32_t>> lists;
        for (const History& h : all) {
            if (path::exact::satisfies(h, observed)) {
                lists.insert(colored(h, question));
            }
        }
        EXPECT_EQ(path::has_path(question, observed), lists.empty() ? Answer::no : Answer::yes);
        const auto found = path::find_path(question, observed);
        EXPECT_EQ(found.has_value(), !lists.empty());
        if (found) {
            EXPECT_TRUE(path::exact::satisfies(*found, observed));
            EXPECT_TRUE(is_path(*found, all));
        }
        const path::Shown shown = path::shown_by(question, observed);
        EXPECT_TRUE(!shown.is_free || question.is_unknown);  // of 256 stencils each
        if (!shown.is_free) {
            EXPECT_EQ(std::set(shown.lists.begin(), shown.lists.end()), lists);
        }
        // Fragments of a kind look alike, and what is replaced is gone.
        path::Kinds kinds;
        for (uint32_t m = 0; m < count; ++m) {
            kinds.kind.push_back(m > 0 && random.one_in(2) ? kinds.kind.back() : m);
            kinds.replaces.push_back(random.one_in(3));
        }
        std::set<std::vector<uint32_t>> seen;
        for (const std::vector<uint32_t>& list : lists) {
            std::vector<uint32_t> of;
            for (const uint32_t m : list) {
                if (kinds.replaces[m]) {
                    of.clear();
                }
                of.push_back(kinds.kind[m]);
            }
            seen.insert(of);
        }
        const path::Shown of_kinds = path::shown_by(question, observed, &kinds);
        EXPECT_TRUE(!of_kinds.is_free || question.is_unknown);
        if (!of_kinds.is_free) {
            EXPECT_EQ(std::set(of_kinds.lists.begin(), of_kinds.lists.end()), seen);
            EXPECT_EQ(of_kinds.lists.size(), seen.size());
        }
        std::vector<bool> of(count);
        for (size_t m = 0; m < count; ++m) {
            of[m] = random.one_in(2);
        }
        for (const bool with_discarded : {false, true}) {
            std::set<uint32_t> numbers;
            for (const History& h : all) {
                const auto is_of = [&](uint32_t m) { return of[m]; };
                const auto passed = static_cast<uint32_t>(
                    std::ranges::count_if(h.shown, is_of) +
                    (with_discarded ? std::ranges::count_if(h.discarded, is_of) : 0));
                if (path::exact::satisfies(h, observed)) {
                    numbers.insert(passed);
                }
            }
            path::Observed counting = observed;
            counting.counting.emplace(of, with_discarded);
            const auto counted = path::counted_by(question, counting);
            EXPECT_EQ(counted.has_value(), !lists.empty());
            if (counted) {
                EXPECT_EQ(counted->least, *numbers.begin());
                EXPECT_EQ(counted->most, *numbers.rbegin());
            }
            for (uint32_t number = 0; number <= count; ++number) {
                counting.counting->number = number;
                EXPECT_EQ(path::has_path(question, counting) == path::Answer::yes,
                          numbers.contains(number));
            }
        }
        denied += lists.empty() ? 1U : 0U;
    }
    return denied;
}

size_t check_seeds(uint64_t first, uint64_t count) {
    size_t denied = 0;
    for (uint64_t seed = first; seed < first + count; ++seed) {
        RandomQuestions random(seed);
        std::vector<cases::StencilState> states;
        const Question question = random.question(states);
        const std::vector<History> all = path::exact::histories(question);
        if (!all.empty()) {
            denied += check(question, all, random);
        }
        if (testing::Test::HasFailure()) {
            ADD_FAILURE() << "seed " << seed;
            break;
        }
    }
    return denied;
}

TEST(Path, WhatIsObservedIsAskedTogether) {
    EXPECT_GT(check_seeds(1, 150), 100U);
}

TEST(ExhaustivePath, WhatIsObservedIsAskedTogether) {
    EXPECT_GT(check_seeds(1000, 4000), 3000U);
}

// Two fragments that may be discarded, the second of which leaves depth alone.
TEST(Path, PlanesAreNotRightOneByOne) {
    Question question;
    question.fragments = {{&path::kKeepStencil, false, true, false, true},
                          {&path::kKeepStencil, false, true, false, false}};
    const auto answer = [&](uint32_t hits, std::vector<bool> last, std::vector<bool> stored) {
        Observed observed;
        observed.hits = {path::SeenHits::Detail::total, hits, 0};
        observed.last = std::move(last);
        observed.may_be_unhit = false;
        observed.may_be_clear = std::ranges::find(stored, true) == stored.end();
        observed.stored = std::move(stored);
        return path::has_path(question, observed);
    };
    EXPECT_EQ(answer(2, {false, true}, {true, false}), Answer::yes);
    EXPECT_EQ(answer(1, {false, true}, {false, false}), Answer::yes);
    EXPECT_EQ(answer(1, {true, false}, {true, false}), Answer::yes);
    EXPECT_EQ(answer(1, {false, true}, {true, false}), Answer::no);
    EXPECT_EQ(answer(2, {false, true}, {false, false}), Answer::no);
    EXPECT_EQ(answer(1, {true, false}, {false, false}), Answer::no);
}

// Of many fragments of which one is there only the states that differ are followed.
TEST(Path, OneOfManyIsNoSearch) {
    Question question;
    question.sets = {{1, 1}};
    for (uint32_t m = 0; m < 2000; ++m) {
        path::Fragment fragment{&path::kKeepStencil, false, true, false, true};
        fragment.set = 0;
        question.fragments.push_back(fragment);
    }
    Observed observed;
    observed.hits = {path::SeenHits::Detail::total, 1, 0};
    observed.last.assign(2000, false);
    observed.last[700] = true;
    observed.may_be_unhit = false;
    EXPECT_EQ(path::has_path(question, observed), Answer::yes);
    observed.hits.front = 2;
    EXPECT_EQ(path::has_path(question, observed), Answer::no);
}

}  // namespace
}  // namespace ref::test
