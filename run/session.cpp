// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/session.hpp"

#include <map>
#include <memory>
#include <utility>

#include "capture/copy.hpp"

namespace run {

Session::Session(LoopConfig config, WorkerClient first, capture::DeviceInfo device,
                 SignalFd& signals)
    : config_(std::move(config)), device_(std::move(device)), signals_(signals) {
    config_.keeps_workers = true;
    workers_.push_back(std::move(first));
}

Session::Results Session::draw(std::vector<cases::Case> cases,
                               const std::function<bool(size_t)>& on_progress) {
    Results results;
    const auto plan = std::make_shared<std::vector<PlannedCase>>(cases.size());
    std::map<std::string, size_t> index;
    for (size_t k = 0; k < cases.size(); ++k) {
        results.records.push_back(make_record(cases[k]));
        index.emplace(cases[k].id, k);
        (*plan)[k].data = std::move(cases[k]);
    }
    bool goes_on = true;
    RunLoop loop(
        config_, plan, nullptr, signals_,
        [&](const report::CaseRecord& record) {
            results.records[index.at(record.id)] = record;
            return goes_on;
        },
        [&](size_t done, size_t) {
            goes_on = goes_on && (!on_progress || on_progress(done));
            return goes_on;
        });
    const RunLoop::End end = loop.run(std::move(workers_), device_);
    workers_ = loop.take_workers();
    if (end.interrupted || !goes_on) {
        loop.abandon_judgements();
    }
    results.interrupted = end.interrupted;
    results.failure = end.failure;
    return results;
}

Session::Pictures Session::pictures(std::vector<cases::Case> cases) {
    Pictures out;
    out.pictures.resize(cases.size());
    config_.take_drawn = [&out](size_t k, const capture::CaptureView& drawn) {
        out.pictures.at(k).capture = capture::copy_of(drawn);
    };
    const Results results = draw(std::move(cases));
    config_.take_drawn = {};
    for (size_t k = 0; k < out.pictures.size(); ++k) {
        const report::CaseRecord& record = results.records[k];
        if (!out.pictures[k].capture) {
            out.pictures[k].why_not = record.reason.empty()
                                          ? "it ended as " + std::string(to_string(record.status))
                                          : record.reason;
        }
    }
    out.interrupted = results.interrupted;
    out.failure = results.failure;
    return out;
}

}  // namespace run
