// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/run_loop.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <utility>

#include "capture/checksum.hpp"
#include "cases/base/checksum.hpp"
#include "cases/base/parallel.hpp"
#include "cases/model/derive.hpp"

namespace run {

using capture::Rendered;
using report::CaseRecord;
using report::Status;

namespace {

constexpr int kProgressMs = 200;

std::vector<uint64_t> all_bytes(const std::vector<Task>& cases) {
    std::vector<uint64_t> bytes;
    for (const Task& c : cases) {
        bytes.push_back(capture::capture_bytes(c.data));
    }
    return bytes;
}

CaseRecord taken(std::map<size_t, CaseRecord>& from, size_t k) {
    CaseRecord record = std::move(from.at(k));
    from.erase(k);
    return record;
}

// Why a drawn case cannot be judged by what its worker sent; empty if it can.
std::string misfit(const cases::Case& c, const CaseResult& result) {
    if (result.view.target != c.target) {
        return "the worker sent an image of another size than the case's target";
    }
    return result.consistency.size() != cases::derivations(c).size()
               ? "the worker did not compare all of the case's derived renderings"
               : "";
}

// A hash of the picture and of what the worker itself has found.
uint64_t bits_of(const CaseResult& result) {
    return result.bits ^
           cases::checksum(static_cast<uint64_t>(FrameType::result), encode_findings(result));
}

// Of a duration in seconds.
double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

RunLoop::RunLoop(LoopConfig config, Plan plan, report::Journal* journal, SignalFd& signals,
                 OnRecord on_record, OnProgress on_progress)
    : config_(std::move(config)),
      plan_(std::move(plan)),
      cases_(*plan_),
      journal_(journal),
      signals_(signals),
      on_record_(std::move(on_record)),
      on_progress_(std::move(on_progress)),
      schedule_(all_bytes(cases_), config_.schedule),
      judging_(config_.judging),
      is_finished_(cases_.size(), false) {}

RunLoop::End RunLoop::run(std::vector<WorkerClient> workers, const capture::DeviceInfo& device) {
    take_up(std::move(workers), device);
    while (settled_ < cases_.size() && end_.failure.empty() && !is_stopped_) {
        for (Slot& slot : slots_) {
            feed(slot);
        }
        wait();
        if (signals_.has_come()) {
            end_.interrupted = true;
            break;
        }
        for (Slot& slot : slots_) {
            advance(slot);
        }
        judging_.collect();
        is_stopped_ = !on_progress_(settled_, unconfirmed_.size()) || is_stopped_;
    }
    if (!config_.keeps_workers) {  // the system takes a while to free what a worker holds
        ending_ = cases::beside([slots = std::exchange(slots_, {})]() mutable { slots.clear(); });
    }
    end_early();
    return end_;
}

// Workers for the slots, and the cases for the schedule, but for those that are not to be drawn.
void RunLoop::take_up(std::vector<WorkerClient> workers, const capture::DeviceInfo& device) {
    device_ = device;
    config_.worker.device.pinned = device.key;
    if (config_.gpu_budget) {
        schedule_.set_batch_bytes(0);  // until it is known how long they take, one case each
    }
    slots_.resize(std::max(size_t{1}, config_.schedule.lanes));
    for (size_t k = 0; k < std::min(workers.size(), slots_.size()); ++k) {
        slots_[k].client.emplace(std::move(workers[k]));
    }
    for (size_t k = 0; k < cases_.size(); ++k) {
        const Task& c = cases_[k];
        if (!c.error.empty()) {
            settle(k, fresh_record(k, Status::error, c.error));
        } else if (c.expected && skips(*c.expected)) {
            settle(k, fresh_record(k, Status::skip, c.expected->note));
        } else if (c.alone) {
            schedule_.add_alone(k);
        } else {
            schedule_.add(k);
        }
    }
}

// Until a worker, a judgement or a signal has something to say, or a time limit is over.
void RunLoop::wait() const {
    std::vector<pollfd> fds{{signals_.fd(), POLLIN, 0}, {judging_.fd(), POLLIN, 0}};
    Clock::time_point next = Clock::now() + std::chrono::milliseconds(kProgressMs);
    for (const Slot& slot : slots_) {
        if (slot.client) {
            slot.client->add_poll(fds);
            next = std::min(next, slot.client->deadline().value_or(next));
        }
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now());
    ::poll(fds.data(), fds.size(), static_cast<int>(std::max<int64_t>(left.count(), 0)));
}

// Settles what a run that ends early has left open.
void RunLoop::end_early() {
    for (auto& [k, record] : std::exchange(held_, {})) {
        finish(k, std::move(record));
    }
    for (size_t k = 0; is_stopped_ && k < cases_.size(); ++k) {
        if (!is_finished_[k]) {
            finish(k, fresh_record(k, Status::skip, "the run ended before this case was judged"));
        }
    }
}

std::vector<WorkerClient> RunLoop::take_workers() {
    std::vector<WorkerClient> workers;
    for (Slot& slot : slots_) {
        if (slot.client && slot.client->state() == WorkerClient::State::idle) {
            workers.push_back(std::move(*slot.client));
            slot.client.reset();
        }
    }
    return workers;
}

void RunLoop::fail(const std::string& why) {
    if (end_.failure.empty()) {
        end_.failure = why;
    }
}

void RunLoop::check(const cases::Expected<void>& written) {
    if (!written) {
        fail(written.error().message);
    }
}

void RunLoop::start_worker(Slot& slot) {
    slot.client.reset();
    cases::Expected<WorkerClient> client =
        WorkerClient::start(config_.command, config_.worker, config_.timeout);
    if (client) {
        slot.client.emplace(std::move(*client));
        return;
    }
    const auto other = std::ranges::find_if(
        slots_, [&slot](const Slot& s) { return &s != &slot && s.client.has_value(); });
    if (other == slots_.end()) {  // a limit that others may use up for a while
        on_start_failure(slot, client.error().message);
        return;
    }
    slot.is_left_out = true;  // fewer workers draw all of it, too
    schedule_.hand_over(static_cast<size_t>(&slot - slots_.data()),
                        static_cast<size_t>(other - slots_.begin()),
                        *std::exchange(slot.batch, std::nullopt));
}

void RunLoop::feed(Slot& slot) {
    if (slot.is_left_out) {
        return;
    }
    if (!slot.batch && !judging_.is_full()) {
        slot.batch = schedule_.next(static_cast<size_t>(&slot - slots_.data()));
        slot.sent = false;
    }
    if (!slot.batch || slot.sent) {
        return;
    }
    if (!slot.client || (slot.batch->fresh && !slot.client->is_fresh())) {
        if (Clock::now() < start_pauses_.next()) {
            return;
        }
        start_worker(slot);
    }
    if (!slot.client || slot.client->state() != WorkerClient::State::idle ||
        !slot.client->has_room()) {
        return;
    }
    std::vector<const cases::Case*> batch;
    uint64_t bytes = 0;
    for (const size_t k : slot.batch->cases) {
        if (journal_ != nullptr) {
            check(journal_->write_begin(cases_[k].data.id, schedule_.attempts(k)));
        }
        batch.push_back(&cases_[k].data);
        bytes += capture::capture_bytes(cases_[k].data);
    }
    slot.answered.assign(batch.size(), false);
    slot.failure.clear();
    slot.since = Clock::now();
    slot.sent = true;
    slot.client->render(slot.batch->attempt, batch, bytes);
}

void RunLoop::advance(Slot& slot) {
    if (!slot.client) {
        return;
    }
    for (WorkerEvent& event : slot.client->advance()) {
        if (!slot.client) {
            return;  // an earlier event has ended it
        }
        if (auto* device = std::get_if<capture::DeviceInfo>(&event); device != nullptr) {
            on_device(slot, *device);
        } else if (auto* failure = std::get_if<capture::Failure>(&event); failure != nullptr) {
            on_start_failure(slot, failure->message);
            return;
        } else if (auto* result = std::get_if<CaseResult>(&event); result != nullptr) {
            on_result(slot, *result);
        } else if (std::get_if<BatchDone>(&event) != nullptr) {
            on_batch_done(slot);
        } else if (auto* death = std::get_if<Death>(&event); death != nullptr) {
            on_death(slot, *death);
            return;
        }
    }
}

void RunLoop::on_device(Slot& slot, const capture::DeviceInfo& device) {
    if (device.name != device_.name || device.key != device_.key ||
        device.driver_version != device_.driver_version) {
        fail("a later worker found another device ('" + device.name + "' instead of '" +
             device_.name + "')");
        slot.client->kill();
    }
}

void RunLoop::on_start_failure(Slot& slot, const std::string& why) {
    slot.client.reset();
    start_pauses_.failed();
    if (start_pauses_.is_over()) {
        fail("workers cannot be started any more: " + why);
    }
}

CaseRecord RunLoop::fresh_record(size_t k, Status status, const std::string& reason) const {
    CaseRecord record = cases_[k].planned;
    record.status = status;
    record.reason = reason;
    return record;
}

// Of a case that no picture came of.
CaseRecord RunLoop::undrawn_record(const Slot& slot, size_t k, const Rendered& rendered) const {
    const bool is_unsupported = rendered.status == Rendered::Status::unsupported;
    const bool is_lost = rendered.status == Rendered::Status::device_lost;
    CaseRecord record = fresh_record(k,
                                     is_unsupported ? Status::unsupported
                                     : is_lost      ? Status::device_lost
                                                    : Status::error,
                                     rendered.reason);
    record.error_kind = rendered.status == Rendered::Status::not_built
                            ? report::ErrorKind::not_built
                            : report::ErrorKind::other;
    record.drawn.messages = rendered.messages;
    if (!is_unsupported) {
        record.death.output = slot.client->output_since_batch();
    }
    return record;
}

// Of a case that was drawn again with other bits.
CaseRecord RunLoop::flake_record(size_t k) {
    CaseRecord record = taken(judged_, k);
    record.reason = fmt::format("rendering {} has other bits than the first, which counted as {}",
                                schedule_.attempts(k), report::to_string(record.status));
    record.status = Status::flake;
    return record;
}

bool RunLoop::is_unexpected(size_t k, const CaseRecord& record) const {
    const auto& expected = cases_[k].expected;
    return !report::is_expected(expected ? counts_as(*expected, record) : record.status);
}

void RunLoop::on_result(Slot& slot, CaseResult& result) {
    start_pauses_.succeeded();  // not before: who greets and dies is not well
    const size_t k = slot.batch->cases[result.index];
    const Rendered& rendered = result.rendered;
    const bool is_drawn = rendered.status == Rendered::Status::drawn;
    if (!is_drawn && rendered.status != Rendered::Status::unsupported && !slot.batch->fresh) {
        if (slot.failure.empty()) {
            slot.failure = rendered.reason;
        }
        return;  // stays without a result; on_batch_done renders it alone
    }
    slot.answered[result.index] = true;
    seconds_[k] += seconds_since(slot.since) / static_cast<double>(slot.answered.size());
    if (!is_drawn) {
        settle(k, undrawn_record(slot, k, rendered));
        return;
    }
    if (const std::string why = misfit(cases_[k].data, result); !why.empty()) {
        settle(k, fresh_record(k, Status::error, why));
        return;
    }
    switch (schedule_.drawn(k, bits_of(result))) {
        case Schedule::Drawn::judge:
            judge(k, result);
            break;
        case Schedule::Drawn::same:
            if (schedule_.confirmed(k)) {
                settle(k, taken(judged_, k));
            }
            break;
        case Schedule::Drawn::differs:
            settle(k, flake_record(k));
            break;
    }
}

void RunLoop::judge(size_t k, CaseResult& result) {
    const bool is_told = this->is_told(k);
    judging_.submit(
        {plan_, &cases_[k].data}, std::move(result), fresh_record(k, Status::not_run),
        [this, k, is_told](CaseRecord record) { on_judged(k, is_told, std::move(record)); },
        is_told ? std::nullopt : std::optional(KeepPictures::brief));
}

void RunLoop::on_judged(size_t k, bool is_told, CaseRecord record) {
    record.drawn.is_brief = !is_told && record.status == Status::fail;
    if (config_.judged) {
        config_.judged(cases_[k].data, record);
    }
    const bool unexpected = record.status != Status::pass && is_unexpected(k, record);
    failed_ += unexpected && record.status == Status::fail ? 1U : 0U;
    const auto as = !is_told                        ? Schedule::Judged::good
                    : unexpected                    ? Schedule::Judged::unexpected_failure
                    : record.status == Status::fail ? Schedule::Judged::known_failure
                                                    : Schedule::Judged::good;
    if (schedule_.judged(k, as)) {
        settle(k, std::move(record));
    } else {
        judged_[k] = std::move(record);
        if (unexpected) {
            unconfirmed_.insert(k);
        }
    }
}

// The slowest of the last batches decides: a measurement fades as faster ones follow.
void RunLoop::keep_gpu_budget(const Slot& slot) {
    if (!config_.gpu_budget || !slot.batch) {
        return;
    }
    uint64_t bytes = 1;
    for (const size_t k : slot.batch->cases) {
        bytes += capture::capture_bytes(cases_[k].data);
    }
    constexpr double kFading = 0.9;
    seconds_per_byte_ = std::max(seconds_since(slot.since) / static_cast<double>(bytes),
                                 seconds_per_byte_ * kFading);
    const double budget = std::chrono::duration<double>(*config_.gpu_budget).count();
    const auto most = static_cast<double>(config_.schedule.batch_bytes);
    schedule_.set_batch_bytes(static_cast<uint64_t>(std::min(most, budget / seconds_per_byte_)));
}

void RunLoop::on_batch_done(Slot& slot) {
    keep_gpu_budget(slot);
    const std::vector<size_t> without_result = slot.without_result();
    if (!without_result.empty()) {
        schedule_.died(*slot.batch, without_result,
                       slot.failure + ", while this case was drawn with others");
        slot.client.reset();  // what a driver does after that is worth nothing
    }
    slot.batch.reset();
}

std::vector<size_t> RunLoop::Slot::without_result() const {
    std::vector<size_t> cases;
    for (size_t k = 0; batch && k < answered.size(); ++k) {
        if (!answered[k]) {
            cases.push_back(batch->cases[k]);
        }
    }
    return cases;
}

void RunLoop::on_death(Slot& slot, const Death& death) {
    if (!slot.batch || !slot.sent) {
        on_start_failure(slot, describe(death));
        return;
    }
    const std::vector<size_t> without_result = slot.without_result();
    const Batch batch = *std::exchange(slot.batch, std::nullopt);
    slot.client.reset();
    const std::string signal = death.exit.signalled && !death.timed_out && !death.malformed
                                   ? signal_name(death.exit.code)
                                   : "";
    if (without_result.empty() ||
        !schedule_.died(batch, without_result, describe(death), signal, death.step)) {
        return;
    }
    for (const size_t k : without_result) {
        seconds_[k] += seconds_since(slot.since);
        CaseRecord record =
            fresh_record(k, death.timed_out ? Status::timeout : Status::crash, describe(death));
        record.death.step = death.step;
        record.death.signal = signal;
        record.death.output = death.output;
        judged_.erase(k);
        settle(k, std::move(record));
    }
}

void RunLoop::settle(size_t k, CaseRecord record) {
    record.drawn.attempts = schedule_.attempts(k);
    record.drawn.seconds = seconds_[k];
    schedule_.settled(k, record.status);
    if (!schedule_.is_held(k)) {
        finish(k, std::move(record));
        return;
    }
    held_[k] = std::move(record);
    for (const Schedule::Released& released : schedule_.release()) {
        CaseRecord ready = taken(held_, released.k);
        if (!released.unrepeated_death.empty()) {
            charge(ready, released);
        }
        finish(released.k, std::move(ready));
    }
}

// The worker died over these cases, and none of them repeated it alone: the first one is charged,
// and the others are told, because any of them may be the culprit.
void RunLoop::charge(CaseRecord& record, const Schedule::Released& death) const {
    record.status = Status::flake;
    record.death.signal = death.signal;
    record.death.step = death.step;
    record.reason = death.unrepeated_death + "; no case of its batch repeated that alone";
    for (const size_t k : death.suspects) {
        record.death.suspects.push_back(cases_[k].data.id);
    }
    if (record.death.suspects.size() > 1) {
        record.reason +=
            "; it may be any of " + fmt::format("{}", fmt::join(record.death.suspects, ", "));
    }
}

void RunLoop::finish(size_t k, CaseRecord record) {
    if (const auto& expected = cases_[k].expected; expected) {
        apply(*expected, record);
    }
    if (config_.requires_support) {
        require_support(record);
    }
    if (config_.complete) {
        config_.complete(cases_[k].data, record);
    }
    if (journal_ != nullptr) {
        check(journal_->write_end(record));
    }
    ++settled_;
    is_finished_[k] = true;
    unconfirmed_.erase(k);
    is_stopped_ = !on_record_(record) || is_stopped_;
}

}  // namespace run
