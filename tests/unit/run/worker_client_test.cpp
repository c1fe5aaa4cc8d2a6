// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The parent's side of the protocol: every message, in every state, once, twice, cut and doubled.
#include "run/worker/worker_client.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include "cases/load/loader.hpp"

namespace run {
namespace {

namespace fs = std::filesystem;
using State = WorkerState;

// A worker of a few words: it says what stands in the file `first`, then what comes through a pipe,
// and stays or leaves.
class Worker {
  public:
    enum class End : uint8_t { stays, leaves, leaves_a_child, dribbles };

    Worker(std::string_view first, FrameType question, End end, int timeout_ms = 60000) {
        ::signal(SIGPIPE, SIG_IGN);  // what is said to the dead
        std::string name = (fs::temp_directory_path() / "edgecase-worker-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        std::ofstream(folder_ / "first", std::ios::binary) << first;
        EXPECT_EQ(::mkfifo((folder_ / "more").c_str(), 0600), 0);
        static const std::map<End, const char*> ends = {
            {End::stays, "exec sleep 1000"},
            {End::leaves, "exit 0"},
            {End::leaves_a_child, "sleep 1000 & exit 0"},
            {End::dribbles, "while :; do printf x >&4; sleep 0.02; done"}};
        const std::string text = "cat '" + (folder_ / "first").string() + "' >&4; cat '" +
                                 (folder_ / "more").string() + "' >&4; " + ends.at(end);
        auto started = WorkerClient::start({{"/bin/sh", "-c", text}, false}, {},
                                           std::chrono::milliseconds(timeout_ms), question);
        EXPECT_TRUE(started);
        client_.emplace(std::move(*started));
    }
    ~Worker() {
        client_.reset();
        fs::remove_all(folder_);
    }
    WorkerClient& client() { return *client_; }

    // It says more when it listens to the pipe, unless it has died before.
    void says(std::string_view more) {
        while (client_->state() != State::dead) {
            const Fd pipe(::open((folder_ / "more").c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
            if (pipe.is_open()) {
                ::fcntl(pipe.get(), F_SETFL, 0);
                write_all(pipe.get(), more);
                return;
            }
            look();
        }
    }
    // All events until so many have come, or the worker is dead.
    std::vector<WorkerEvent> events(size_t most) {
        while (come_.size() < most && client_->state() != State::dead) {
            look();
        }
        return std::exchange(come_, {});
    }

  private:
    void look() {
        std::vector<pollfd> fds;
        client_->add_poll(fds);
        ::poll(fds.data(), fds.size(), 10);
        for (WorkerEvent& event : client_->advance()) {
            come_.push_back(std::move(event));
        }
    }
    std::vector<WorkerEvent> come_;
    fs::path folder_;
    std::optional<WorkerClient> client_;
};

constexpr std::array kTypes = {FrameType::configure, FrameType::render,    FrameType::list_devices,
                               FrameType::hello,     FrameType::no_device, FrameType::devices,
                               FrameType::step,      FrameType::result,    FrameType::batch_done};

// A right message of the type, as far as a worker has any.
std::string message(FrameType type) {
    switch (type) {
        case FrameType::hello:
            return encode_frame(type, encode(capture::DeviceInfo{}));
        case FrameType::no_device:
            return encode_frame(type, encode(capture::Failure{}));
        case FrameType::devices:
            return encode_frame(type, encode(std::vector<capture::DeviceInfo>(2)));
        case FrameType::step:
            return encode_frame(type, "submit");
        case FrameType::result: {
            CaseResult result;
            result.rendered.status = capture::Rendered::Status::unsupported;
            result.rendered.reason = "it lacks it";
            return encode_frame(type, encode_result(result));
        }
        default:
            return encode_frame(type, {});
    }
}

// A state, and how a worker comes to it.
struct Way {
    State state;
    FrameType question = FrameType::hello;
    std::string first = {};
    bool has_batch = false;
};
const std::vector<Way>& ways() {
    static const std::vector<Way> all = {
        {State::asked_device},
        {State::asked_list, FrameType::list_devices},
        {State::answered, FrameType::hello, message(FrameType::no_device)},
        {State::answered, FrameType::list_devices, message(FrameType::devices)},
        {State::idle, FrameType::hello, message(FrameType::hello)},
        {State::busy, FrameType::hello, message(FrameType::hello), true}};
    return all;
}

// What the worker may say, as docs/design.md tells it, and the state after it. Written apart from
// the table that the parent reads.
std::optional<State> expected(State state, FrameType type) {
    using T = FrameType;
    static const std::map<State, std::map<T, State>> legal = {
        {State::asked_device,
         {{T::step, State::asked_device},
          {T::hello, State::idle},
          {T::no_device, State::answered}}},
        {State::asked_list,
         {{T::step, State::asked_list},
          {T::devices, State::answered},
          {T::no_device, State::answered}}},
        {State::busy, {{T::step, State::busy}, {T::result, State::busy}}}};  // batch_done: below
    const auto found = legal.find(state);
    if (found == legal.end() || !found->second.contains(type)) {
        return std::nullopt;
    }
    return found->second.at(type);
}

const cases::Case& some_case() {
    static const cases::Case c =
        cases::load_text(
            "format = 1\ndescription = \"One.\"\nrules = [\"cover.inside\"]\n"
            "[target]\nsize = [2, 2]\n[[draw]]\nvertices = [[0,0], [2,0], [0,2]]\n",
            "one", "one")
            ->front();
    return c;
}

class Reached : public Worker {
  public:
    Reached(const Way& way, End end, int timeout_ms = 60000)
        : Worker(way.first, way.question, end, timeout_ms) {
        // One whose time is short may be dead before it comes there, which the caller takes, too.
        const std::vector<WorkerEvent> early =
            way.first.empty() ? std::vector<WorkerEvent>() : events(1);
        is_dead_ = client().state() == State::dead;
        if (way.has_batch && !is_dead_) {
            client().render(1, {&some_case()}, 1000);
        }
        EXPECT_TRUE(client().state() == way.state || (is_dead_ && timeout_ms < 60000));
    }
    // Whether a death has come or comes.
    bool dies() {
        const std::vector<WorkerEvent> later = events(100);
        return is_dead_ || (!later.empty() && std::holds_alternative<Death>(later.back()));
    }

  private:
    bool is_dead_ = false;
};

bool is_death(const std::vector<WorkerEvent>& events) {
    return !events.empty() && std::holds_alternative<Death>(events.back());
}

size_t deaths(const std::vector<WorkerEvent>& events) {
    return static_cast<size_t>(std::ranges::count_if(
        events, [](const WorkerEvent& e) { return std::holds_alternative<Death>(e); }));
}

TEST(Protocol, EveryMessageInEveryStateIsLegalOrADeath) {
    for (const Way& way : ways()) {
        for (const FrameType type : kTypes) {
            SCOPED_TRACE(testing::Message() << "state " << static_cast<int>(way.state) << ", frame "
                                            << static_cast<int>(type));
            Reached worker(way, Worker::End::stays);
            worker.says(message(type));
            const std::optional<State> then = expected(way.state, type);
            if (!then) {
                const std::vector<WorkerEvent> events = worker.events(100);
                ASSERT_EQ(events.size(), 1U);
                ASSERT_TRUE(is_death(events));
                EXPECT_TRUE(std::get<Death>(events.back()).malformed);
                continue;
            }
            if (type ==
                FrameType::step) {  // which is no event: a second message tells that it came
                EXPECT_EQ(worker.client().state(), *then);
                continue;
            }
            const std::vector<WorkerEvent> events = worker.events(1);
            EXPECT_EQ(events.size(), 1U);
            EXPECT_FALSE(is_death(events));
            EXPECT_EQ(worker.client().state(), *then);
        }
    }
}

TEST(Protocol, EveryMessageTwiceIsADeathBehindTheFirst) {
    for (const Way& way : ways()) {
        for (const FrameType type : kTypes) {
            if (type == FrameType::step && expected(way.state, type)) {
                continue;  // of which there may be many
            }
            SCOPED_TRACE(testing::Message() << "state " << static_cast<int>(way.state) << ", frame "
                                            << static_cast<int>(type));
            Reached worker(way, Worker::End::stays);
            worker.says(message(type) + message(type));
            const std::vector<WorkerEvent> events = worker.events(100);
            EXPECT_EQ(events.size(), expected(way.state, type) ? 2U : 1U);
            EXPECT_EQ(deaths(events), 1U);
            EXPECT_TRUE(is_death(events));
            EXPECT_EQ(worker.client().state(), State::dead);
            EXPECT_TRUE(worker.client().advance().empty()) << "after its death";
        }
    }
}

// Whatever part of a message has come when the worker leaves, or when its time is up.
TEST(Protocol, EveryMessageThatIsCutIsADeath) {
    for (const Way& way : ways()) {
        for (const FrameType type : kTypes) {
            const std::string whole = message(type);
            const std::set<size_t> cuts = {1, 31, whole.size() - 1};
            for (const size_t cut : cuts) {
                SCOPED_TRACE(testing::Message()
                             << "state " << static_cast<int>(way.state) << ", frame "
                             << static_cast<int>(type) << " at " << cut);
                Reached leaves(way, Worker::End::leaves);
                leaves.says(std::string_view(whole).substr(0, cut));
                EXPECT_TRUE(is_death(leaves.events(100)));
            }
            Reached stays(way, Worker::End::stays, 50);
            stays.says(std::string_view(whole).substr(0, whole.size() / 2));
            EXPECT_TRUE(stays.dies());
        }
    }
}

// A header that announces twice what comes, or what no batch can hold.
TEST(Protocol, AFrameIsBoundedByWhatWasAsked) {
    for (const Way& way : ways()) {
        for (const FrameType type : kTypes) {
            SCOPED_TRACE(testing::Message() << "state " << static_cast<int>(way.state) << ", frame "
                                            << static_cast<int>(type));
            std::string header = message(type).substr(0, 32);
            const uint64_t length = uint64_t{60} << 30;
            std::memcpy(header.data() + 16, &length, sizeof length);
            Reached worker(way, Worker::End::stays);
            worker.says(header);
            const std::vector<WorkerEvent> events = worker.events(100);
            ASSERT_TRUE(is_death(events));
            EXPECT_TRUE(std::get<Death>(events.back()).malformed);
        }
    }
}

TEST(Protocol, ABatchIsDoneWhenAllItsResultsHaveCome) {
    Reached right(ways().back(), Worker::End::stays);
    right.says(message(FrameType::step) + message(FrameType::result) +
               message(FrameType::batch_done));
    std::vector<WorkerEvent> events = right.events(2);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_TRUE(std::holds_alternative<CaseResult>(events.front()));
    EXPECT_TRUE(std::holds_alternative<BatchDone>(events.back()));
    EXPECT_EQ(right.client().state(), State::idle);

    CaseResult second;
    second.index = 1;  // of a batch of one
    second.rendered.status = capture::Rendered::Status::unsupported;
    Reached beyond(ways().back(), Worker::End::stays);
    beyond.says(encode_frame(FrameType::result, encode_result(second)));
    EXPECT_TRUE(is_death(beyond.events(100)));
}

// Steps renew the time limit, so that their number is bounded.
TEST(Protocol, StepsWithoutEndAreADeath) {
    Reached worker(ways().back(), Worker::End::stays);
    std::string steps;
    for (uint64_t k = 0; k <= step_bound(1); ++k) {
        steps += message(FrameType::step);
    }
    worker.says(steps);
    EXPECT_TRUE(is_death(worker.events(100)));
}

// Else this one would live for years.
TEST(Protocol, BytesDoNotRenewTheTimeLimit) {
    Reached worker(ways().back(), Worker::End::dribbles, 200);
    std::string header = message(FrameType::result).substr(0, 32);
    const uint64_t length = 1 << 20;
    std::memcpy(header.data() + 16, &length, sizeof length);
    worker.says(header);
    EXPECT_TRUE(worker.dies());
}

// What it has started holds its pipes open for longer than any time limit of a run.
TEST(Protocol, TheDeathOfAWorkerIsSeenBesideItsChild) {
    for (const Way& way : ways()) {
        Reached worker(way, Worker::End::leaves_a_child, 100000);
        worker.says("");
        const std::vector<WorkerEvent> events = worker.events(100);
        ASSERT_TRUE(is_death(events));
        EXPECT_FALSE(std::get<Death>(events.back()).timed_out);
    }
}

TEST(Protocol, TheAnswerOfAWorkerThatDiesBehindItIsItsDeath) {
    SignalFd signals;
    Worker worker(message(FrameType::hello) + message(FrameType::hello), FrameType::hello,
                  Worker::End::stays);
    const std::optional<WorkerEvent> answer = wait_for_answer(worker.client(), signals);
    ASSERT_TRUE(answer);
    EXPECT_TRUE(std::holds_alternative<Death>(*answer));
}

}  // namespace
}  // namespace run
