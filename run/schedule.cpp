// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/schedule.hpp"

#include <algorithm>
#include <utility>

namespace run {

using report::Status;

Schedule::Schedule(std::vector<uint64_t> bytes, const Options& options)
    : bytes_(std::move(bytes)),
      options_(options),
      states_(bytes_.size()),
      lanes_(std::max(options.lanes, size_t{1})) {
    for (State& state : states_) {
        state.needed = options_.repeat;
    }
}

std::optional<Batch> Schedule::take(std::deque<size_t>& queue, size_t count, bool fresh) {
    Batch batch;
    batch.fresh = fresh;
    uint64_t total = 0;
    while (!queue.empty() && batch.cases.size() < count) {
        const size_t k = queue.front();
        const uint32_t attempt = states_[k].attempts + 1;
        total += bytes_[k];
        if (!batch.cases.empty() && (total > options_.batch_bytes || attempt != batch.attempt)) {
            break;
        }
        batch.attempt = attempt;
        batch.cases.push_back(k);
        ++states_[k].attempts;
        queue.pop_front();
    }
    return batch.cases.empty() ? std::nullopt : std::optional(std::move(batch));
}

// A share of less than two batches is not worth splitting, one of less than eight not the start of
// another worker: starting a driver takes as long as drawing some hundred small cases.
void Schedule::refill(Lane& lane) {
    const auto is_shorter = [](const Lane& a, const Lane& b) {
        return a.cases.size() < b.cases.size();
    };
    std::deque<size_t>& longest = std::max_element(lanes_.begin(), lanes_.end(), is_shorter)->cases;
    if (longest.size() < (lane.has_worker ? 2 : 8) * options_.batch) {
        return;
    }
    const auto half = longest.begin() + static_cast<ptrdiff_t>(longest.size() / 2);
    lane.cases.assign(half, longest.end());
    longest.erase(half, longest.end());
}

bool Schedule::has_waiting() const {
    return !again_.empty() || !retry_.empty() || !fresh_.empty() ||
           std::any_of(lanes_.begin(), lanes_.end(),
                       [](const Lane& lane) { return !lane.cases.empty(); });
}

// Of the cases that have been drawn before.
std::optional<Batch> Schedule::take_again() {
    if (!again_.empty()) {
        return take(again_, options_.batch, false);
    }
    if (!retry_.empty()) {
        return take(retry_, 1, false);
    }
    return take(fresh_, 1, true);
}

std::optional<Batch> Schedule::next(size_t lane) {
    Lane& own = lanes_.at(lane);
    if (options_.suspects_first) {
        if (std::optional<Batch> batch = take_again(); batch) {
            return batch;
        }
    }
    if (own.cases.empty()) {
        refill(own);
    }
    if (!own.cases.empty()) {
        own.has_worker = true;
        return take(own.cases, options_.batch, false);
    }
    return take_again();
}

void Schedule::hand_over(size_t from, size_t to, const Batch& batch) {
    std::deque<size_t>& own = lanes_.at(from).cases;
    for (const size_t k : batch.cases) {
        --states_[k].attempts;
        (batch.fresh               ? fresh_
         : batch.attempt == 1      ? own
         : batch.cases.size() == 1 ? retry_
                                   : again_)
            .push_back(k);
    }
    std::deque<size_t>& other = lanes_.at(to).cases;
    other.insert(other.end(), own.begin(), own.end());
    own.clear();
}

Schedule::Drawn Schedule::drawn(size_t k, uint64_t bits) {
    State& state = states_[k];
    ++state.drawn;
    if (!state.bits) {
        state.bits = bits;
        return Drawn::judge;
    }
    return *state.bits == bits ? Drawn::same : Drawn::differs;
}

bool Schedule::judged(size_t k, Judged as) {
    State& state = states_[k];
    if (as != Judged::good) {
        state.needed = std::max(state.needed, 1 + options_.retries);
    }
    if (state.drawn >= state.needed) {
        return true;
    }
    (as == Judged::unexpected_failure ? retry_ : again_).push_back(k);
    return false;
}

bool Schedule::confirmed(size_t k) {
    if (states_[k].drawn >= states_[k].needed) {
        return true;
    }
    again_.push_back(k);
    return false;
}

bool Schedule::died(const Batch& batch, const std::vector<size_t>& without_result,
                    const std::string& reason, const std::string& signal, const std::string& step) {
    if (batch.fresh) {
        return true;
    }
    Group group;
    group.reason = reason;
    group.signal = signal;
    group.step = step;
    group.suspects = batch.cases;
    for (const size_t k : without_result) {
        if (states_[k].group < 0) {
            states_[k].group = static_cast<int>(groups_.size());
            group.open.push_back(k);
        }
        fresh_.push_back(k);
    }
    if (!group.open.empty()) {
        group.charged = group.open.front();
        groups_.push_back(std::move(group));
    }
    return false;
}

bool Schedule::is_held(size_t k) const {
    const int group = states_[k].group;
    return group >= 0 && !groups_[static_cast<size_t>(group)].released;
}

void Schedule::settled(size_t k, Status status) {
    if (states_[k].group < 0) {
        return;
    }
    Group& group = groups_[static_cast<size_t>(states_[k].group)];
    const auto at = std::find(group.open.begin(), group.open.end(), k);
    if (at != group.open.end()) {
        group.open.erase(at);
        group.held.push_back(k);
    }
    if (status == Status::crash || status == Status::timeout || status == Status::device_lost ||
        status == Status::error) {
        group.repeated = true;
    }
}

std::vector<Schedule::Released> Schedule::release() {
    std::vector<Released> released;
    for (Group& group : groups_) {
        if (group.released || !group.open.empty()) {
            continue;
        }
        group.released = true;
        for (const size_t k : group.held) {
            const bool charged = !group.repeated && k == group.charged;
            released.push_back(
                charged ? Released{k, group.reason, group.signal, group.step, group.suspects}
                        : Released{k, {}, {}, {}, {}});
        }
    }
    return released;
}

}  // namespace run
