// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/worker_client.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <memory>
#include <utility>

#include "capture/checksum.hpp"
#include "cases/base/limits.hpp"

namespace run {

namespace {

constexpr int kGraceMs = 500;  // a worker whose pipe has closed is dying already
constexpr size_t kChunk = size_t{1} << 20;
// A pipe between processes carries this much even on a busy machine.
constexpr uint64_t kBytesOfMillisecond = uint64_t{16} << 10;

}  // namespace

std::string describe(const Death& death) {
    std::string how = "the worker left with exit status " + std::to_string(death.exit.code) +
                      " and without a result";
    if (death.timed_out) {
        how = "the worker gave no sign of life within the time limit";
    } else if (death.malformed) {
        how = "the worker sent a result that is malformed";
    } else if (death.exit.signalled) {
        how = "the worker was killed by " + signal_name(death.exit.code);
    }
    how += death.step.empty() ? " before it was ready" : " during '" + death.step + "'";
    const std::string limits = cases::tight_limits();
    return limits.empty() ? how : how + "; " + limits;
}

cases::Expected<WorkerClient> WorkerClient::start(const Command& command,
                                                  const WorkerOptions& options,
                                                  std::chrono::milliseconds timeout,
                                                  FrameType question) {
    std::shared_ptr<SharedMemory> memory =
        question == FrameType::hello ? SharedMemory::create() : nullptr;
    cases::Expected<ChildProcess> child = spawn(command, memory ? memory->fd() : -1);
    if (!child) {
        return tl::unexpected(child.error());
    }
    WorkerClient client(std::move(*child), std::move(memory), timeout);
    client.pending_ = encode_frame(FrameType::configure, encode(options));
    client.pending_ += encode_frame(question, {});
    client.state_ = question == FrameType::hello ? State::asked_device : State::asked_list;
    client.write_pending();
    return client;
}

WorkerClient::~WorkerClient() {
    if (child_.request.is_open()) {  // not moved from
        kill();
    }
}

void WorkerClient::kill() {
    if (state_ != State::dead && child_.request.is_open()) {
        if (SignalFd::has_come() &&
            !child_.keeps_terminal) {  // it takes the system a while to free what it holds
            kill_all_children();
        } else {
            kill_and_reap(child_, 0);
        }
    }
    state_ = State::dead;
}

void WorkerClient::render(uint32_t attempt, const std::vector<const cases::Case*>& batch,
                          uint64_t bytes) {
    region_ = memory_ ? memory_->take(bytes + batch.size() * 64) : nullptr;
    Room room;
    if (region_) {  // no more than needed: the worker unlocks and locks page by page
        constexpr uint64_t kPage = 4096;
        const uint64_t padded = bytes + batch.size() * 64;  // places are aligned
        room = {region_->offset,
                std::min<uint64_t>((padded + kPage - 1) / kPage * kPage, region_->bytes.size())};
    }
    pending_ += encode_frame(FrameType::render, encode_request(attempt, room, batch));
    state_ = State::busy;
    steps_ = 0;
    has_result_.assign(batch.size(), false);
    most_planes_ = 0;
    for (const cases::Case* c : batch) {
        most_planes_ = std::max(most_planes_, capture::capture_bytes(*c));
    }
    deadline_ = Clock::now() + timeout_;
    read_output();
    output_.clear();
    step_ = "start of the batch";
    ++batches_;
    write_pending();
}

void WorkerClient::add_poll(std::vector<pollfd>& fds) const {
    if (state_ == State::dead) {
        return;
    }
    fds.push_back({child_.result.get(), POLLIN, 0});
    if (child_.output.is_open()) {
        fds.push_back({child_.output.get(), POLLIN, 0});
    }
    if (!pending_.empty()) {
        fds.push_back({child_.request.get(), POLLOUT, 0});
    }
}

void WorkerClient::write_pending() {
    while (written_ < pending_.size()) {
        const ssize_t n =
            ::write(child_.request.get(), pending_.data() + written_, pending_.size() - written_);
        if (n < 0) {
            if (errno == EINTR) {
                continue;
            }
            if (errno != EAGAIN) {
                pending_.clear();  // the worker is gone; the result pipe tells
                written_ = 0;
            }
            return;
        }
        written_ += static_cast<size_t>(n);
    }
    pending_.clear();
    written_ = 0;
}

void WorkerClient::read_output() {
    constexpr size_t kOutputChunk = size_t{1} << 16;
    const auto chunk = std::make_unique_for_overwrite<char[]>(kOutputChunk);
    // A worker that prints without end must not keep this process from looking at the clock.
    constexpr size_t kMostChunks = 16;
    for (size_t chunks = 0; chunks < kMostChunks && child_.output.is_open(); ++chunks) {
        const ssize_t n = ::read(child_.output.get(), chunk.get(), kOutputChunk);
        if (n > 0) {
            output_.add({chunk.get(), static_cast<size_t>(n)});
        } else if (n < 0 && errno == EINTR) {
            continue;
        } else {
            if (n == 0) {
                child_.output.reset();
            }
            return;
        }
    }
}

WorkerClient::Read WorkerClient::read_result() {
    const auto chunk = std::make_unique_for_overwrite<char[]>(kChunk);
    // A worker that sends without end must not keep this process from looking at what has come.
    constexpr size_t kMostChunks = 16;
    for (size_t chunks = 0; chunks < kMostChunks; ++chunks) {
        const ssize_t n = ::read(child_.result.get(), chunk.get(), kChunk);
        if (n > 0) {
            reader_.feed({chunk.get(), static_cast<size_t>(n)});
        } else if (n == 0 || errno != EINTR) {
            return n < 0 && errno == EAGAIN ? Read::all : Read::end;
        }
    }
    return Read::some;
}

// How much may come of a frame, by what was asked.
std::optional<uint64_t> WorkerClient::bound_of(FrameType type) const {
    if (!after(state_, type) ||
        (type == FrameType::step && steps_ >= step_bound(has_result_.size()))) {
        return std::nullopt;
    }
    return payload_bound(type) + (type == FrameType::result ? most_planes_ : 0);
}

std::optional<Clock::time_point> WorkerClient::deadline() const {
    if (!is_expected_to_speak(state_)) {
        return std::nullopt;
    }
    return deadline_ + std::chrono::milliseconds(reader_.announced() / kBytesOfMillisecond);
}

bool WorkerClient::find_planes(CaseResult& result) const {
    if (result.rendered.status != capture::Rendered::Status::drawn) {
        return !result.is_shared;
    }
    capture::Capture& c = result.rendered.capture;
    if (!result.is_shared) {
        auto capture = std::make_shared<const capture::Capture>(std::move(c));
        c = capture::Capture();
        result.view = *capture;
        result.keep = std::move(capture);
        result.bits = capture::capture_bits(result.view);
        return true;
    }
    if (region_ == nullptr || result.offset < region_->offset || result.offset % 16 != 0 ||
        c.target.width > cases::kMaxTargetSize || c.target.height > cases::kMaxTargetSize ||
        c.target.samples > 64 || c.target.layers > cases::kMaxLayers) {
        return false;
    }
    const uint64_t at = result.offset - region_->offset;
    const uint64_t bytes = capture::plane_bytes(c.target, c.attribute_count);
    if (bytes > region_->bytes.size() || at > region_->bytes.size() - bytes) {
        return false;
    }
    result.view = capture::view_planes(c.target, c.has_primitive, c.attribute_count,
                                       region_->bytes.data() + at);
    result.view.counted = c.counted;
    result.keep = region_;
    return capture::capture_bits(result.view) == result.bits;
}

bool WorkerClient::handle(const Frame& frame, std::vector<WorkerEvent>& events) {
    const auto add = [&](auto answer) {
        if (answer) {
            events.emplace_back(std::move(*answer));
        }
        return answer.has_value();
    };
    deadline_ = Clock::now() + timeout_;
    const State then = *after(state_, frame.type);  // bound_of() lets no other pass
    bool is_valid = true;
    switch (frame.type) {
        case FrameType::step:
            ++steps_;
            step_ = frame.payload;
            break;
        case FrameType::hello:
            is_valid = add(decode<capture::DeviceInfo>(frame.payload));
            break;
        case FrameType::no_device:
            read_output();  // what a driver or a layer printed before may say why
            is_valid = add(decode<capture::Failure>(frame.payload));
            break;
        case FrameType::devices:
            is_valid = add(decode<std::vector<capture::DeviceInfo>>(frame.payload));
            break;
        case FrameType::result: {
            std::optional<CaseResult> result = decode_result(frame.payload);
            is_valid = result && result->index < has_result_.size() &&
                       !has_result_[result->index] && find_planes(*result);
            if (is_valid) {
                has_result_[result->index] = true;
                add(std::move(result));
            }
            break;
        }
        case FrameType::batch_done:
            is_valid = std::ranges::all_of(has_result_, std::identity());
            if (is_valid) {
                region_ = nullptr;
                events.emplace_back(BatchDone{});
            }
            break;
        default:
            is_valid = false;
    }
    state_ = then;
    return is_valid;
}

Death WorkerClient::die(bool timed_out, bool malformed, int grace_ms) {
    Death death;
    death.timed_out = timed_out;
    death.malformed = malformed;
    death.exit = kill_and_reap(child_, grace_ms);
    read_output();
    death.step = step_;
    death.output = output_.text();
    state_ = State::dead;
    return death;
}

std::vector<WorkerEvent> WorkerClient::advance() {
    std::vector<WorkerEvent> events;
    if (state_ == State::dead) {
        return events;
    }
    write_pending();
    read_output();
    // Whoever it has started may hold the pipe open for ever, so its own end counts. What it sent
    // before is in the pipe by then.
    const bool is_at_end = has_ended(child_);
    const Read read = read_result();
    bool is_valid = true;
    while (is_valid) {
        const std::optional<Frame> frame =
            reader_.next([this](FrameType type) { return bound_of(type); });
        if (!frame) {
            break;
        }
        is_valid = handle(*frame, events);
    }
    // Where nothing may come, the first byte is one too many.
    const bool is_out_of_turn = reader_.has_rest() && !is_expected_to_speak(state_);
    if (!is_valid || reader_.is_malformed() || is_out_of_turn) {
        events.emplace_back(die(false, true, 0));
    } else if (read == Read::end || (is_at_end && read == Read::all)) {
        Death death = die(false, false, kGraceMs);
        death.malformed = reader_.has_rest() && !death.exit.signalled;
        events.emplace_back(std::move(death));
    } else if (const auto end = deadline(); end && Clock::now() >= *end) {
        events.emplace_back(die(true, false, 0));
    }
    return events;
}

std::vector<WorkerEvent> wait_for_events(WorkerClient& client, SignalFd& signals) {
    constexpr int kPollMs = 200;
    for (;;) {
        std::vector<pollfd> fds{{signals.fd(), POLLIN, 0}};
        client.add_poll(fds);
        ::poll(fds.data(), fds.size(), kPollMs);
        if (signals.has_come()) {
            client.kill();
            return {};
        }
        if (std::vector<WorkerEvent> events = client.advance(); !events.empty()) {
            return events;
        }
    }
}

std::optional<WorkerEvent> wait_for_answer(WorkerClient& client, SignalFd& signals) {
    std::vector<WorkerEvent> events = wait_for_events(client, signals);
    if (events.empty()) {
        return std::nullopt;
    }
    const bool is_dead = std::holds_alternative<Death>(events.back());
    return std::move(is_dead ? events.back() : events.front());
}

}  // namespace run
