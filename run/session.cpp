// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/session.hpp"

#include <map>
#include <memory>
#include <utility>

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
    const auto plan = std::make_shared<std::vector<Task>>(cases.size());
    std::map<std::string, size_t> index;
    for (size_t k = 0; k < cases.size(); ++k) {
        Task& task = (*plan)[k];
        task.planned = planned_case(cases[k]);
        task.data = std::move(cases[k]);
        results.records.emplace_back(task.planned);
        index.emplace(task.planned.id, k);
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
    // Shared with what is drawn yet when a signal ends the call.
    const auto drawn = std::make_shared<std::map<std::string, capture::Drawn>>();
    for (const cases::Case& c : cases) {
        drawn->emplace(c.id, capture::Drawn());
    }
    config_.judging.judge = [drawn](report::CaseRecord& record, const cases::Case& c,
                                    const capture::CaptureView& view, const auto&) {
        drawn->at(c.id).picture = capture::copy_of(view);
        record.status = report::Status::pass;
    };
    Results results = draw(std::move(cases));
    config_.judging.judge = {};
    Pictures out{{}, results.interrupted, std::move(results.failure)};
    for (const report::CaseRecord& record : results.records) {
        if (record.status == report::Status::pass) {
            out.pictures.push_back(std::move(drawn->at(record.id)));
        } else {
            out.pictures.push_back({{},
                                    record.reason.empty()
                                        ? "it ended as " + std::string(to_string(record.status))
                                        : record.reason});
        }
    }
    return out;
}

}  // namespace run
