// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/run_loop.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "capture/checksum.hpp"
#include "cases/base/checksum.hpp"
#include "cases/base/heap.hpp"
#include "cases/base/parallel.hpp"
#include "cases/model/derive.hpp"
#include "report/text/sentences.hpp"

namespace run {

using capture::Rendered;
using report::CaseRecord;
using report::Status;

namespace {

constexpr uint64_t kMaxJudgingBytes = uint64_t{128} << 20;
constexpr int kProgressMs = 200;
constexpr uint32_t kRepeatsOfDeath = 10;  // of a batch whose worker died once

std::vector<uint64_t> all_bytes(const std::vector<PlannedCase>& cases) {
    std::vector<uint64_t> bytes;
    for (const PlannedCase& c : cases) {
        bytes.push_back(capture::capture_bytes(c.data));
    }
    return bytes;
}

CaseRecord taken(std::map<size_t, CaseRecord>& from, size_t k) {
    CaseRecord record = std::move(from.at(k));
    from.erase(k);
    return record;
}

// A rerun line that draws the case so many times at least.
std::string repeating(std::string rerun, uint32_t already, uint32_t times) {
    if (already >= times) {
        return rerun;
    }
    const std::string old = " --repeat " + std::to_string(already);
    const size_t at = already > 1 ? rerun.rfind(old) : std::string::npos;
    if (at != std::string::npos) {
        rerun.erase(at, old.size());
    }
    return rerun + " --repeat " + std::to_string(times);
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
      pool_(cases::cores()),
      is_finished_(cases_.size(), false) {
    if (!config_.judge) {
        config_.judge = [limits = config_.limits, profile = config_.profile,
                         pictures = config_.pictures](auto& record, const auto&... drawn) {
            judge(record, drawn..., limits, profile, pictures);
        };
    }
}

RunLoop::End RunLoop::run(std::vector<WorkerClient> workers, const capture::DeviceInfo& device) {
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
        const PlannedCase& c = cases_[k];
        if (!c.error.empty() || (c.expected && skips(*c.expected))) {
            settle(k, c.error.empty() ? fresh_record(k, Status::skip, c.expected->note)
                                      : fresh_record(k, Status::error, c.error));
        } else if (c.alone) {
            schedule_.add_alone(k);
        } else {
            schedule_.add(k);
        }
    }
    while (settled_ < cases_.size() && end_.failure.empty() && !is_stopped_) {
        for (Slot& slot : slots_) {
            feed(slot);
        }
        std::vector<pollfd> fds{{signals_.fd(), POLLIN, 0}, {pool_.fd(), POLLIN, 0}};
        for (const Slot& slot : slots_) {
            if (slot.client) {
                slot.client->add_poll(fds);
            }
        }
        ::poll(fds.data(), fds.size(), poll_timeout());
        if (signals_.has_come()) {
            end_.interrupted = true;
            break;
        }
        for (Slot& slot : slots_) {
            advance(slot);
        }
        pool_.collect();
        is_stopped_ = !on_progress_(settled_, unconfirmed_.size()) || is_stopped_;
    }
    if (!config_.keeps_workers) {  // the system takes a while to free what a worker holds
        ending_ = cases::beside([slots = std::exchange(slots_, {})]() mutable { slots.clear(); });
    }
    for (auto& [k, record] : std::exchange(held_, {})) {  // only if the run ends early
        finish(k, std::move(record));
    }
    for (size_t k = 0; is_stopped_ && k < cases_.size(); ++k) {
        if (!is_finished_[k]) {
            finish(k, fresh_record(k, Status::skip, "the run ended before this case was judged"));
        }
    }
    return end_;
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

int RunLoop::poll_timeout() const {
    Clock::time_point next = Clock::now() + std::chrono::milliseconds(kProgressMs);
    for (const Slot& slot : slots_) {
        if (const auto end = slot.client ? slot.client->deadline() : std::nullopt; end) {
            next = std::min(next, *end);
        }
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now());
    return static_cast<int>(std::max<int64_t>(left.count(), 0));
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
    const bool judging_too_much = judging_bytes_ > kMaxJudgingBytes;
    if (!slot.batch && !judging_too_much) {
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
    CaseRecord record = make_record(cases_[k].data);
    record.status = status;
    record.reason = reason;
    record.rerun = cases_[k].rerun;
    record.left_out_doors = cases_[k].left_out_doors;
    return record;
}

bool RunLoop::is_unexpected(size_t k, const CaseRecord& record) const {
    const auto& expected = cases_[k].expected;
    return !report::is_expected(expected ? counts_as(*expected, record) : record.status);
}

void RunLoop::on_result(Slot& slot, CaseResult& result) {
    start_pauses_.succeeded();  // not before: who greets and dies is not well
    const size_t k = slot.batch->cases[result.index];
    Rendered& rendered = result.rendered;
    const bool drawn = rendered.status == Rendered::Status::drawn;
    const bool unsupported = rendered.status == Rendered::Status::unsupported;
    if (!drawn && !unsupported && !slot.batch->fresh) {
        if (slot.failure.empty()) {
            slot.failure = rendered.reason;
        }
        return;  // stays without a result; on_batch_done renders it alone
    }
    slot.answered[result.index] = true;
    seconds_[k] += seconds_since(slot.since) / static_cast<double>(slot.answered.size());
    if (!drawn) {
        const bool lost = rendered.status == Rendered::Status::device_lost;
        CaseRecord record = fresh_record(k,
                                         unsupported ? Status::unsupported
                                         : lost      ? Status::device_lost
                                                     : Status::error,
                                         rendered.reason);
        record.drawn.messages = rendered.messages;
        if (!unsupported) {
            record.death.output = slot.client->output_since_batch();
        }
        settle(k, std::move(record));
        return;
    }
    if (result.view.target != cases_[k].data.target) {
        settle(k, fresh_record(k, Status::error,
                               "the worker sent an image of another size than the case's target"));
        return;
    }
    if (result.consistency.size() != cases::derivations(cases_[k].data).size()) {
        settle(k, fresh_record(k, Status::error,
                               "the worker did not compare all of the case's derived renderings"));
        return;
    }
    const uint64_t bits = result.bits ^ cases::checksum(static_cast<uint64_t>(FrameType::result),
                                                        encode_findings(result));
    switch (schedule_.drawn(k, bits)) {
        case Schedule::Drawn::judge: {
            auto record = std::make_shared<CaseRecord>(fresh_record(k, Status::not_run));
            record->drawn.messages = rendered.messages;
            record->drawn.bits = cases::hex(result.bits);
            const uint64_t bytes = capture::capture_bytes(cases_[k].data);
            judging_bytes_ += bytes;
            // It may outlive the loop (abandon_judgements), so all that it uses is its own.
            pool_.submit(
                [plan = plan_, k, view = result.view, consistency = std::move(result.consistency),
                 strays = std::move(rendered.stray_writes), record, judge = config_.judge] {
                    judge(*record, (*plan)[k].data, view, {consistency, strays});
                    cases::give_back_memory();
                },
                [this, k, bytes, record, keep = result.keep] {
                    judging_bytes_ -= bytes;
                    on_judged(k, std::move(*record));
                });
            break;
        }
        case Schedule::Drawn::same:
            if (schedule_.confirmed(k)) {
                settle(k, taken(judged_, k));
            }
            break;
        case Schedule::Drawn::differs: {
            CaseRecord record = taken(judged_, k);
            record.reason = "rendering " + std::to_string(schedule_.attempts(k)) +
                            " has other bits than the first, which counted as " +
                            std::string(report::to_string(record.status));
            record.status = Status::flake;
            record.rerun = repeating(record.rerun, config_.schedule.repeat, schedule_.attempts(k));
            settle(k, std::move(record));
            break;
        }
    }
}

void RunLoop::on_judged(size_t k, CaseRecord record) {
    const bool unexpected = record.status != Status::pass && is_unexpected(k, record);
    const auto as = unexpected                      ? Schedule::Judged::unexpected_failure
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
    record.rerun = repeating(record.rerun, config_.schedule.repeat, kRepeatsOfDeath);
    for (const size_t k : death.suspects) {
        record.death.suspects.push_back(cases_[k].data.id);
        if (k != death.k && !cases_[k].selector.empty()) {
            record.rerun += " " + cases_[k].selector;
        }
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
    if (!record.outcome.findings.empty()) {
        record.commands.explain =
            cases_[k].explain +
            report::sample_options(report::leading_finding(record), cases_[k].data.target);
    }
    const bool died = record.status == Status::crash || record.status == Status::timeout ||
                      record.status == Status::device_lost;
    const bool is_plain = std::ranges::all_of(record.outcome.groups,
                                              [](const auto& group) { return group.door.empty(); });
    const bool is_judged =
        !died && record.status != Status::flake && !record.outcome.findings.empty();
    if (is_judged && is_plain && record.rerun == cases_[k].rerun &&
        !cases_[k].plain_rerun.empty()) {
        record.rerun = cases_[k].plain_rerun;
    }
    if (died || !record.outcome.findings.empty()) {
        // The program draws the plain picture: what only doors show it would not.
        const bool is_of_doors =
            !died && std::ranges::all_of(record.outcome.groups,
                                         [](const auto& group) { return !group.door.empty(); });
        record.commands.reproducer = is_of_doors ? "" : cases_[k].reproducer;
        record.commands.no_reproducer = is_of_doors ? report::kDoorsAlone : cases_[k].no_reproducer;
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
