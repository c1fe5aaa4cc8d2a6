// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hunt.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "run/judge.hpp"

namespace fuzz {
namespace {

using testing::IsEmpty;
using testing::SizeIs;
using Clock = HuntOptions::Clock;

constexpr uint64_t kChunk = 1024;

// A case for each number, all alike.
class PlainSource : public Source {
  public:
    uint64_t group_size() const override { return 16; }
    void enter(uint64_t) override {}
    Made make(uint64_t number) const override {
        Made made;
        made.text =
            "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\nsize = [4, 4]\n"
            "[[draw]]\nvertices = [[0, 0], [4, 0], [0, 4]]\n";
        made.data = load_one(made.text, std::to_string(number));
        return made;
    }
};

// A device whose time is counted in cases that it has drawn; the last of a call come first.
struct Device {
    std::multiset<uint64_t> drawn;
    size_t interrupted_at = SIZE_MAX;
    std::set<uint64_t> failing;
    std::map<uint64_t, report::ErrorKind> errors;

    Clock::time_point now() const { return Clock::time_point(std::chrono::seconds(drawn.size())); }
    run::Session::Results draw(std::vector<cases::Case> cases,
                               const std::function<bool(size_t)>& on_progress) {
        run::Session::Results results;
        bool goes_on = true;
        for (const cases::Case& c : cases) {
            results.records.push_back(run::planned_case(c));
        }
        for (size_t k = cases.size(); k-- > 0;) {
            results.interrupted = drawn.size() >= interrupted_at;
            report::CaseRecord& record = results.records[k];
            if (results.interrupted || !goes_on) {
                record.status =
                    results.interrupted ? report::Status::not_run : report::Status::skip;
                continue;
            }
            const uint64_t number = std::stoull(cases[k].id);
            drawn.insert(number);
            record.status = report::Status::pass;
            if (const auto error = errors.find(number); error != errors.end()) {
                record.status = report::Status::error;
                record.error_kind = error->second;
                record.reason = "in any words";
            }
            // Candidates of a reduction have small numbers, too.
            if (failing.contains(number)) {
                record.status = report::Status::fail;
                diff::FindingGroup group;
                group.rule = "cover.inside";
                group.level = cases::Profile::vulkan;
                group.count = 1;
                record.outcome.groups.push_back(group);
            }
            goes_on = on_progress(drawn.size());
        }
        return results;
    }
};

Hunt hunt_on(Device& device, HuntOptions options, const std::vector<Waiting>& waiting = {}) {
    if (!options.source) {
        options.source = [] { return std::make_unique<PlainSource>(); };
    }
    options.now = [&device] { return device.now(); };
    return Hunt(
        options,
        [&device](std::vector<cases::Case> cases, const auto& on_progress) {
            return device.draw(std::move(cases), on_progress);
        },
        {}, waiting, [](const auto&...) {});
}

// What a hunt has not judged when it ends, another one judges, and each case is judged once.
void expect_resumed(Hunt& ended, Device& device, size_t judged) {
    EXPECT_EQ(ended.counts().drawn, judged);
    EXPECT_EQ(ended.counts().next_case, kChunk);
    EXPECT_THAT(ended.left(), SizeIs(kChunk - judged));
    HuntOptions rest;
    rest.first_case = ended.counts().next_case;
    rest.left = ended.left();
    rest.most_cases = kChunk + 16;
    Hunt second = hunt_on(device, rest);
    EXPECT_EQ(second.left(), ended.left());
    Hunt::State state = Hunt::State::goes_on;
    while (state == Hunt::State::goes_on) {
        state = second.step();
    }
    EXPECT_EQ(state, Hunt::State::done);
    EXPECT_THAT(second.left(), IsEmpty());
    EXPECT_EQ(second.counts().drawn, kChunk + 16 - judged);
    ASSERT_THAT(device.drawn, SizeIs(kChunk + 16));
    uint64_t next = 0;
    for (const uint64_t number : device.drawn) {
        EXPECT_EQ(number, next++);
    }
}

// Every second number goes through a door.
class DoorSource : public PlainSource {
  public:
    Made make(uint64_t number) const override {
        Made made = PlainSource::make(number);
        if (number % 2 == 1) {
            made.text.replace(
                made.text.find("[target]"), 0,
                "relations = [{ doors = [\"interleaved\", \"indirect-after-count\"] }]\n");
            made.data = load_one(made.text, std::to_string(number));
        }
        return made;
    }
};

TEST(Hunt, LeavesOutDoorsThatTheDeviceBreaks) {
    for (const bool is_broken : {false, true}) {
        Device device;
        HuntOptions options;
        options.most_cases = kChunk;
        options.source = [] { return std::make_unique<DoorSource>(); };
        if (is_broken) {
            options.broken_doors = {cases::Door::indirect_after_count};
        }
        Hunt hunt = hunt_on(device, options);
        Hunt::State state = Hunt::State::goes_on;
        while (state == Hunt::State::goes_on) {
            state = hunt.step();
        }
        EXPECT_EQ(hunt.counts().drawn, is_broken ? kChunk / 2 : kChunk);
        EXPECT_EQ(hunt.counts().through_broken_doors, is_broken ? kChunk / 2 : 0);
        EXPECT_EQ(device.drawn.count(1), is_broken ? 0U : 1U);
        EXPECT_EQ(device.drawn.count(2), 1U);
        EXPECT_THAT(hunt.left(), IsEmpty());
    }
}

// An earlier hunt left two cases to be reduced: one goes through a door that is known since.
TEST(Hunt, WhatWaitsThroughABrokenDoorIsKnown) {
    for (const bool is_broken : {false, true}) {
        Device device;
        HuntOptions options;
        options.first_case = kChunk;
        options.most_cases = kChunk;
        options.source = [] { return std::make_unique<DoorSource>(); };
        if (is_broken) {
            options.broken_doors = {cases::Door::indirect_after_count};
        }
        const Symptom symptom{report::Status::fail,
                              diff::FindingKind::missing,
                              "cover.inside",
                              cases::Profile::vulkan,
                              {}};
        const Hunt hunt = hunt_on(device, options, {{1, {symptom}}, {2, {symptom}}});
        EXPECT_THAT(hunt.waiting(), SizeIs(is_broken ? 1 : 2));
        EXPECT_EQ(hunt.counts().through_broken_doors, is_broken ? 1U : 0U);
    }
}

TEST(Hunt, CountsErrorsByTheirKindWhateverTheySay) {
    Device device;
    device.errors = {{1, report::ErrorKind::shows_nothing},
                     {2, report::ErrorKind::shows_nothing},
                     {3, report::ErrorKind::not_built},
                     {4, report::ErrorKind::other}};
    HuntOptions options;
    options.most_cases = 16;
    Hunt hunt = hunt_on(device, options);
    while (hunt.step() == Hunt::State::goes_on) {
    }
    EXPECT_EQ(hunt.counts().empty, 2U);
    EXPECT_EQ(hunt.counts().unsupported, 1U);
    EXPECT_EQ(hunt.counts().unjudged, 1U);
    EXPECT_EQ(hunt.counts().drawn, 12U);
    ASSERT_THAT(hunt.unjudged(), SizeIs(1));
    EXPECT_EQ(hunt.unjudged()[0].second, "in any words");
}

TEST(Hunt, EndsWithinAChunkWhenItsTimeIsOver) {
    Device device;
    HuntOptions options;
    options.deadline = Clock::time_point(std::chrono::seconds(100));
    Hunt hunt = hunt_on(device, options);
    EXPECT_EQ(hunt.step(), Hunt::State::done);
    expect_resumed(hunt, device, 100);
}

TEST(Hunt, KeepsWhatWasJudgedBeforeASignal) {
    Device device;
    device.interrupted_at = 50;
    Hunt hunt = hunt_on(device, {});
    EXPECT_EQ(hunt.step(), Hunt::State::interrupted);
    device.interrupted_at = SIZE_MAX;
    expect_resumed(hunt, device, 50);
}

// Failures among what was judged are not lost, and a reduction ends in time, too.
TEST(Hunt, AReductionThatIsCutWaits) {
    Device device;
    device.failing = {0, 1000};
    HuntOptions options;
    options.deadline = Clock::time_point(std::chrono::seconds(100));
    Hunt first = hunt_on(device, options);
    EXPECT_EQ(first.step(), Hunt::State::done);
    EXPECT_EQ(first.counts().failed, 1U);
    ASSERT_THAT(first.waiting(), SizeIs(1));
    EXPECT_EQ(first.waiting()[0].number, 1000U);

    device = {};
    for (uint64_t number = 0; number < kChunk; ++number) {
        device.failing.insert(number);  // those of the reduction, too
    }
    options.first_case = first.counts().next_case;
    options.deadline = Clock::time_point(std::chrono::seconds(5));
    Hunt second = hunt_on(device, options, first.waiting());
    EXPECT_EQ(second.step(), Hunt::State::done);
    EXPECT_EQ(second.counts().reductions, 1U);
    EXPECT_THAT(device.drawn, SizeIs(5));
    EXPECT_THAT(second.entries(), IsEmpty());
    ASSERT_THAT(second.waiting(), SizeIs(1));
    EXPECT_EQ(second.waiting()[0].number, 1000U);
    EXPECT_EQ(second.counts().unrepeated, 0U);
}

// Two cases are so large that the others of their chunk would wait for minutes.
class LargeSource : public PlainSource {
  public:
    Made make(uint64_t number) const override {
        Made made = PlainSource::make(number);
        if (made.data && number < 2) {
            made.data->target.width = 4096;
            made.data->target.height = 4096;
        }
        return made;
    }
};

TEST(Hunt, WhatTakesMinutesToJudgeIsNotDrawn) {
    Device device;
    HuntOptions options;
    options.source = [] { return std::make_unique<LargeSource>(); };
    options.most_cases = 16;
    Hunt hunt = hunt_on(device, options);
    while (hunt.step() == Hunt::State::goes_on) {
    }
    EXPECT_EQ(hunt.counts().drawn, 14U);
    EXPECT_EQ(hunt.counts().missing, 2U);
}

// So many known causes; the last one explains what the device does wrong.
class KnownOnes : public KnownFailures {
  public:
    KnownOnes(Device& device, size_t count) : device_(device), count_(count) {}
    std::optional<Entry> next(const std::vector<Entry>& entries, const run::DrawAndJudge& draw,
                              const std::function<bool()>&, const Tell& tell) override {
        EXPECT_THAT(entries, SizeIs(asked));
        drawn_before = asked == 0 ? device_.drawn.size() : drawn_before;
        tell("reducing known one");
        const auto c = load_one(PlainSource().make(0).text, std::to_string(1'000'000 + asked));
        draw({*c}, {});
        ++asked;
        Entry entry;
        entry.is_known = true;
        entry.symptom.rule = "cover.inside";
        if (asked == count_) {
            entry.also.insert({entry.symptom.kind, entry.symptom.rule});
        } else {
            entry.essentials.insert({Trait::unequal_w});  // which no case of the hunt has
        }
        return entry;
    }
    bool is_empty() const override { return asked == count_; }
    size_t asked = 0, drawn_before = 0;

  private:
    Device& device_;
    size_t count_;
};

// A hunt's own cases come first, and known causes when one fails that no entry explains.
TEST(Hunt, KnownCausesAreAskedForWhenACaseFails) {
    for (const bool fails : {false, true}) {
        Device device;
        KnownOnes known(device, 9);
        HuntOptions options;
        options.known_failures = &known;
        options.most_cases = 3 * kChunk;
        if (fails) {
            device.failing = {5, kChunk + 5};
        }
        Hunt hunt = hunt_on(device, options);
        ASSERT_EQ(hunt.step(), Hunt::State::goes_on);
        EXPECT_EQ(known.drawn_before, fails ? kChunk : 0);
        // Some after each chunk: the hunt goes on drawing, and tells nothing that may be known.
        EXPECT_EQ(known.asked > 0 && known.asked < 9, fails);
        EXPECT_THAT(hunt.waiting(), SizeIs(fails ? 1 : 0));
        while (hunt.step() == Hunt::State::goes_on) {
        }
        EXPECT_EQ(known.asked, fails ? 9U : 0U);
        EXPECT_EQ(device.drawn.count(2 * kChunk), 1U);
        EXPECT_THAT(hunt.waiting(), IsEmpty());
        EXPECT_THAT(hunt.entries(), SizeIs(known.asked));
        for (const Entry& entry : hunt.entries()) {
            EXPECT_TRUE(entry.is_known);
        }
        if (fails) {
            EXPECT_EQ(hunt.entries().back().count, 2U);
        }
    }
}

// A hunt whose time is over has asked for no known cause in vain, and its failing case waits.
TEST(Hunt, NothingIsNewBeforeAllKnownCausesAreMet) {
    Device device;
    device.failing = {5};
    KnownOnes known(device, SIZE_MAX);
    HuntOptions options;
    options.known_failures = &known;
    options.deadline = Clock::time_point(std::chrono::seconds(kChunk + 20));
    Hunt hunt = hunt_on(device, options);
    while (hunt.step() == Hunt::State::goes_on) {
    }
    EXPECT_GT(known.asked, 3U);
    ASSERT_THAT(hunt.waiting(), SizeIs(1));
    EXPECT_EQ(hunt.waiting()[0].number, 5U);
    EXPECT_THAT(hunt.entries(), testing::Each(testing::Field(&Entry::is_known, true)));
}

}  // namespace
}  // namespace fuzz
