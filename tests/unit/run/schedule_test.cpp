// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace run {
namespace {

using report::Status;
using Ids = std::vector<size_t>;

Schedule make(size_t count, const Schedule::Options& options = {}) {
    Schedule schedule(std::vector<uint64_t>(count, 1), options);
    for (size_t k = 0; k < count; ++k) {
        schedule.add(k);
    }
    return schedule;
}

TEST(Schedule, BatchesAreBoundedByCountAndBytes) {
    Schedule::Options options;
    options.batch = 3;
    options.batch_bytes = 100;
    Schedule schedule({10, 60, 60, 1000, 1, 1, 1, 1}, options);
    for (size_t k = 0; k < 8; ++k) {
        schedule.add(k);
    }
    EXPECT_EQ(schedule.next()->cases, (Ids{0, 1}));
    EXPECT_EQ(schedule.next()->cases, (Ids{2}));
    EXPECT_EQ(schedule.next()->cases, (Ids{3}));  // too large for any batch, but drawn all the same
    EXPECT_EQ(schedule.next()->cases, (Ids{4, 5, 6}));
    EXPECT_EQ(schedule.next()->cases, (Ids{7}));
    EXPECT_FALSE(schedule.next());
}

TEST(Schedule, BatchesBecomeAsSmallAsTheyAreToldToBe) {
    Schedule::Options options;
    options.lanes = 1;
    Schedule schedule({10, 10, 10, 10}, options);
    for (size_t k = 0; k < 4; ++k) {
        schedule.add(k);
    }
    schedule.set_batch_bytes(0);
    EXPECT_EQ(schedule.next(0)->cases, std::vector<size_t>{0});
    schedule.set_batch_bytes(20);
    EXPECT_EQ(schedule.next(0)->cases, (std::vector<size_t>{1, 2}));
}

TEST(Schedule, WorkersTakeNeighboursAndHalfOfTheLongestLane) {
    Schedule::Options options;
    options.batch = 2;
    options.lanes = 3;
    Schedule schedule = make(20, options);
    EXPECT_EQ(schedule.next(0)->cases, (Ids{0, 1}));
    EXPECT_EQ(schedule.next(1)->cases, (Ids{11, 12}));  // 18 were left: 2..10 and 11..19
    EXPECT_FALSE(schedule.next(2)) << "9 cases are too few for the start of a worker";
    EXPECT_EQ(schedule.next(0)->cases, (Ids{2, 3}));
    for (const Ids& expected : {Ids{13, 14}, Ids{15, 16}, Ids{17, 18}, Ids{19}}) {
        EXPECT_EQ(schedule.next(1)->cases, expected);
    }
    EXPECT_EQ(schedule.next(1)->cases, (Ids{7, 8})) << "7 cases were left to lane 0: 4..6, 7..10";
    EXPECT_EQ(schedule.next(0)->cases, (Ids{4, 5}));
    EXPECT_EQ(schedule.next(0)->cases, (Ids{6}));
    EXPECT_FALSE(schedule.next(0)) << "2 cases are not worth splitting";
    EXPECT_TRUE(schedule.has_waiting());
    EXPECT_EQ(schedule.next(1)->cases, (Ids{9, 10}));
    EXPECT_FALSE(schedule.has_waiting());
}

TEST(Schedule, OnlyTheCulpritOfADeathIsCharged) {
    Schedule schedule = make(3);
    const Batch batch = *schedule.next();
    EXPECT_FALSE(schedule.died(batch, batch.cases, "death"));
    for (size_t k = 0; k < 3; ++k) {
        const Batch alone = *schedule.next();
        EXPECT_TRUE(alone.fresh);
        EXPECT_EQ(alone.cases, (Ids{k}));
        EXPECT_EQ(alone.attempt, 2U);
        schedule.settled(k, k == 1 ? Status::crash : Status::pass);
        EXPECT_EQ(schedule.is_held(k), true);
        const auto released = schedule.release();
        ASSERT_EQ(released.size(), k == 2 ? 3U : 0U);
        for (const Schedule::Released& r : released) {
            EXPECT_EQ(r.unrepeated_death, "");
        }
    }
}

TEST(Schedule, ADeathThatNoCaseRepeatsIsNotLost) {
    Schedule schedule = make(2);
    const Batch batch = *schedule.next();
    schedule.died(batch, {1}, "death", "SIGSEGV", "submit");
    schedule.settled(1, Status::pass);
    const auto released = schedule.release();
    ASSERT_EQ(released.size(), 1U);
    EXPECT_EQ(released[0].k, 1U);
    EXPECT_EQ(released[0].unrepeated_death, "death");
    EXPECT_EQ(released[0].signal, "SIGSEGV");
    EXPECT_EQ(released[0].step, "submit");
    EXPECT_EQ(released[0].suspects, (std::vector<size_t>{0, 1}));  // it may be the doing of either
    EXPECT_FALSE(schedule.is_held(0));
}

TEST(Schedule, ADeathInAFreshWorkerIsCharged) {
    Schedule schedule = make(0);
    Schedule alone({1}, {});
    alone.add_alone(0);
    const Batch batch = *alone.next();
    EXPECT_TRUE(batch.fresh);
    EXPECT_TRUE(alone.died(batch, batch.cases, "death"));
    EXPECT_FALSE(schedule.has_waiting());
}

TEST(Schedule, AFailureIsDrawnAgainAloneAndAPassIsNot) {
    Schedule schedule = make(2);
    schedule.next();
    EXPECT_EQ(schedule.drawn(0, 7), Schedule::Drawn::judge);
    EXPECT_EQ(schedule.drawn(1, 7), Schedule::Drawn::judge);
    EXPECT_TRUE(schedule.judged(0, Schedule::Judged::good));
    EXPECT_FALSE(schedule.judged(1, Schedule::Judged::unexpected_failure));
    EXPECT_EQ(schedule.next()->cases, (Ids{1}));
    EXPECT_EQ(schedule.drawn(1, 7), Schedule::Drawn::same);
    EXPECT_TRUE(schedule.confirmed(1));
}

TEST(Schedule, KnownFailuresAreDrawnAgainTogether) {
    Schedule schedule = make(3);
    schedule.next();
    for (size_t k = 0; k < 3; ++k) {
        schedule.drawn(k, 7);
    }
    EXPECT_FALSE(schedule.judged(0, Schedule::Judged::known_failure));
    EXPECT_FALSE(schedule.judged(1, Schedule::Judged::known_failure));
    EXPECT_TRUE(schedule.judged(2, Schedule::Judged::good));
    EXPECT_EQ(schedule.next()->cases, (Ids{0, 1}));
    EXPECT_EQ(schedule.drawn(0, 7), Schedule::Drawn::same);
    EXPECT_TRUE(schedule.confirmed(0));
    EXPECT_EQ(schedule.drawn(1, 8), Schedule::Drawn::differs);
    Schedule::Options options;
    options.retries = 0;
    Schedule once = make(1, options);
    once.next();
    once.drawn(0, 7);
    EXPECT_TRUE(once.judged(0, Schedule::Judged::known_failure));
}

TEST(Schedule, SuspectsComeFirstOnDemand) {
    for (const bool first : {false, true}) {
        Schedule::Options options;
        options.batch = 1;
        options.suspects_first = first;
        Schedule schedule = make(4, options);
        EXPECT_EQ(schedule.next()->cases, (Ids{0}));
        schedule.drawn(0, 1);
        EXPECT_FALSE(schedule.judged(0, Schedule::Judged::unexpected_failure));
        EXPECT_EQ(schedule.next()->cases, first ? (Ids{0}) : (Ids{1}));
        const Batch batch = *schedule.next();
        EXPECT_EQ(batch.cases, first ? (Ids{1}) : (Ids{2}));
        EXPECT_FALSE(schedule.died(batch, batch.cases, "died"));
        const Batch next = *schedule.next();
        EXPECT_EQ(next.cases, first ? (Ids{1}) : (Ids{3}));
        EXPECT_EQ(next.fresh, first);
    }
}

TEST(Schedule, OtherBitsDiffer) {
    Schedule schedule = make(1);
    schedule.next();
    schedule.drawn(0, 7);
    schedule.judged(0, Schedule::Judged::unexpected_failure);
    schedule.next();
    EXPECT_EQ(schedule.drawn(0, 8), Schedule::Drawn::differs);
}

TEST(Schedule, RepeatCountsRenderings) {
    Schedule::Options options;
    options.repeat = 3;
    Schedule schedule = make(1, options);
    EXPECT_EQ(schedule.next()->attempt, 1U);
    schedule.drawn(0, 7);
    EXPECT_FALSE(schedule.judged(0, Schedule::Judged::good));
    EXPECT_EQ(schedule.next()->attempt, 2U);
    EXPECT_EQ(schedule.drawn(0, 7), Schedule::Drawn::same);
    EXPECT_FALSE(schedule.confirmed(0));
    EXPECT_EQ(schedule.next()->attempt, 3U);
    EXPECT_EQ(schedule.drawn(0, 7), Schedule::Drawn::same);
    EXPECT_TRUE(schedule.confirmed(0));
    EXPECT_FALSE(schedule.has_waiting());
}

// A worker that cannot be had: all cases of its lane are drawn by the other, and count as attempts
// once.
TEST(Schedule, ALaneIsHandedOver) {
    Schedule::Options options;
    options.batch = 2;
    options.lanes = 2;
    Schedule schedule = make(40, options);
    std::vector<bool> is_drawn(40, false);
    const auto draw = [&](const Batch& batch) {
        for (const size_t k : batch.cases) {
            EXPECT_FALSE(is_drawn[k]);
            is_drawn[k] = true;
            EXPECT_EQ(schedule.attempts(k), 1U);
            EXPECT_EQ(schedule.drawn(k, 0), Schedule::Drawn::judge);
            EXPECT_TRUE(schedule.judged(k, Schedule::Judged::good));
        }
    };
    draw(*schedule.next(0));
    schedule.hand_over(1, 0, *schedule.next(1));
    while (const std::optional<Batch> batch = schedule.next(0)) {
        draw(*batch);
    }
    EXPECT_EQ(std::count(is_drawn.begin(), is_drawn.end(), true), 40);
}

}  // namespace
}  // namespace run
