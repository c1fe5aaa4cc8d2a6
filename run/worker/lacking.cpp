// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/lacking.hpp"

#include <algorithm>
#include <map>
#include <variant>

#include "cases/model/derive.hpp"
#include "run/worker/worker_client.hpp"

namespace run {

namespace {

// The case without doors if it claims more than rules of doors, which a worker is not told: it is
// drawn without them, too.
cases::Case without_doors_beside_others(cases::Case c) {
    if (!cases::claims_doors_alone(c)) {
        std::erase_if(c.relations,
                      [](const cases::Relation& r) { return r.door != cases::Door::none; });
    }
    return c;
}

}  // namespace

cases::Expected<std::vector<std::string>> ask_what_is_lacking(
    const Command& command, WorkerOptions options, std::chrono::milliseconds timeout,
    const std::vector<const cases::Case*>& asked, SignalFd& signals) {
    options.only_asks = true;
    cases::Expected<WorkerClient> client = WorkerClient::start(command, options, timeout);
    if (!client) {
        return tl::unexpected(client.error());
    }
    std::vector<std::string> reasons(asked.size());  // by index
    std::vector<cases::Case> copies;
    copies.reserve(asked.size());
    std::vector<const cases::Case*> all;
    for (const cases::Case* c : asked) {
        const bool has_doors = std::ranges::any_of(
            c->relations, [](const cases::Relation& r) { return r.door != cases::Door::none; });
        all.push_back(has_doors ? &copies.emplace_back(without_doors_beside_others(*c)) : c);
    }
    for (;;) {
        const std::vector<WorkerEvent> events = wait_for_events(*client, signals);
        if (events.empty()) {
            return cases::failure("interrupted");
        }
        for (const WorkerEvent& event : events) {
            if (std::get_if<capture::DeviceInfo>(&event) != nullptr) {
                client->render(1, all, 0);
            } else if (const auto* failure = std::get_if<capture::Failure>(&event)) {
                return cases::failure("{}", failure->message);
            } else if (const auto* result = std::get_if<CaseResult>(&event);
                       result != nullptr && result->index < reasons.size()) {
                reasons[result->index] = result->rendered.reason;
            } else if (std::get_if<BatchDone>(&event) != nullptr) {
                return reasons;
            } else if (const auto* death = std::get_if<Death>(&event)) {
                return cases::failure("{}", describe(*death));
            }
        }
    }
}

SuiteShare share_of(const std::vector<std::string>& reasons) {
    SuiteShare share;
    share.cases = reasons.size();
    std::map<std::string, size_t> count;
    for (const std::string& reason : reasons) {
        if (reason.empty()) {
            ++share.drawn;
        } else {
            ++count[reason];
        }
    }
    share.lacking.assign(count.begin(), count.end());
    std::stable_sort(share.lacking.begin(), share.lacking.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return share;
}

}  // namespace run
