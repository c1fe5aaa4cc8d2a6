// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The parent's end of one worker: never blocks, turns what arrives into events.
#pragma once

#include <poll.h>

#include <chrono>
#include <string>
#include <variant>
#include <vector>

#include "run/process/frame.hpp"
#include "run/process/process.hpp"
#include "run/process/shared_memory.hpp"
#include "run/process/signal_fd.hpp"
#include "run/worker/message.hpp"
#include "run/worker/protocol.hpp"

namespace run {

using Clock = std::chrono::steady_clock;

// How a worker ended.
struct Death {
    bool timed_out = false;
    bool malformed = false;  // sent what is no frame, says nothing valid or was not its turn
    ExitStatus exit;
    std::string step;    // the last stage that it announced
    std::string output;  // what it printed since the batch began, head and tail, any bytes
};
// One sentence: "the worker was killed by SIGSEGV during 'submit'".
std::string describe(const Death& death);

struct BatchDone {};
using WorkerEvent = std::variant<capture::DeviceInfo, capture::Failure,
                                 std::vector<capture::DeviceInfo>, CaseResult, BatchDone, Death>;

class WorkerClient {
  public:
    using State = WorkerState;

    // Starts the command; the answer is a DeviceInfo, Failure or Death event, or, to the question
    // list_devices, the list of devices. `timeout` is the longest time between two frames that are
    // expected, to which comes what the transfer of a large one takes.
    static cases::Expected<WorkerClient> start(const Command& command, const WorkerOptions& options,
                                               std::chrono::milliseconds timeout,
                                               FrameType question = FrameType::hello);
    ~WorkerClient();
    WorkerClient(WorkerClient&&) noexcept = default;
    WorkerClient& operator=(WorkerClient&&) = delete;

    State state() const { return state_; }
    bool is_fresh() const { return batches_ == 0; }
    pid_t pid() const { return child_.pid; }
    std::string output_since_batch() const { return output_.text(); }

    // True if a batch handed over now finds room for its captures.
    bool has_room() const { return memory_ == nullptr || memory_->has_free(); }
    // Hands a batch over whose captures take `bytes` bytes; the worker must be idle.
    void render(uint32_t attempt, const std::vector<const cases::Case*>& batch, uint64_t bytes);

    // For poll(2): appends what this worker waits for.
    void add_poll(std::vector<pollfd>& fds) const;
    // Reads and writes what is possible now, and kills the worker if its time is up. Of a batch
    // each case has one result, and BatchDone follows all of them. Nothing follows a Death.
    std::vector<WorkerEvent> advance();
    // When its time is up; nothing while nothing is expected of it.
    std::optional<Clock::time_point> deadline() const;

    // Ends the worker at once.
    void kill();

  private:
    WorkerClient(ChildProcess child, std::shared_ptr<SharedMemory> memory,
                 std::chrono::milliseconds timeout)
        : child_(std::move(child)),
          memory_(std::move(memory)),
          timeout_(timeout),
          deadline_(Clock::now() + timeout) {}
    void write_pending();
    void read_output();
    enum class Read { all, some, end };  // `some`: there may be more; `end`: of the pipe
    Read read_result();
    std::optional<uint64_t> bound_of(FrameType type) const;
    bool handle(const Frame& frame, std::vector<WorkerEvent>& events);
    bool find_planes(CaseResult& result) const;  // false if they are not what was written
    Death die(bool timed_out, bool malformed, int grace_ms);

    ChildProcess child_;
    std::shared_ptr<SharedMemory> memory_;
    std::shared_ptr<const Region> region_;  // of the batch in hand
    State state_ = State::asked_device;
    uint64_t steps_ = 0;            // since the last request
    uint64_t most_planes_ = 0;      // bytes of the largest capture of the batch
    std::vector<bool> has_result_;  // [k] of the batch
    std::chrono::milliseconds timeout_;
    Clock::time_point deadline_;
    std::string pending_;  // request bytes, of which the first written_ are written
    size_t written_ = 0;
    FrameReader reader_;
    HeadAndTail output_;
    std::string step_;
    uint32_t batches_ = 0;
};

// Waits for the next events of a worker. None if a signal came, which ends it.
std::vector<WorkerEvent> wait_for_events(WorkerClient& client, SignalFd& signals);
// Waits until a starting worker has said what it is: a Death if it died right behind that. Nothing
// if a signal came.
std::optional<WorkerEvent> wait_for_answer(WorkerClient& client, SignalFd& signals);

}  // namespace run
