// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/seen_results.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cases/model/way.hpp"
#include "diagnosis/choice.hpp"
#include "diagnosis/work.hpp"

namespace cli {

using report::CaseRecord;
using report::Status;

void SeenResults::add(const CaseRecord& record) {
    CaseRecord seen;
    seen.id = record.id;
    seen.status = record.status;
    const bool is_failure = record.status == Status::fail || record.status == Status::xfail;
    if (is_failure && (failures_ < kMostFailures || records_.contains(record.id))) {
        seen = record;
        seen.evidence = {};
        if (record.evidence.pictures.marks.size() <= diagnosis::kMaxCost) {
            seen.evidence.pictures = record.evidence.pictures;
        }
    }
    const bool is_new = records_.insert_or_assign(record.id, std::move(seen)).second;
    failures_ += is_new && is_failure ? 1U : 0U;
}

report::Run SeenResults::of(const report::RunHeader& header, const capture::DeviceInfo& device,
                            const std::set<std::string>* ids) const {
    report::Run run;
    static_cast<report::RunHeader&>(run) = header;
    run.device = device;
    for (const auto& [id, record] : records_) {
        if (ids == nullptr || ids->contains(id)) {
            run.cases.push_back(record);
        }
    }
    return run;
}

namespace {

// Plain cases have the smaller one: what is drawn alone, of one draw (`draws`) and one sample a
// pixel, in a picture that is large enough to show where something lies, with values that tell by
// how much.
auto plainness(const run::Task& task, size_t draws = 1) {
    constexpr uint64_t kLarge = 64;
    const cases::Case& c = task.data;
    const uint64_t cost = diagnosis::cost_of(c);
    const auto is_smooth = [](const cases::Attribute& a) {
        return a.interpolation != cases::Interpolation::flat;
    };
    const bool has_values =
        !c.draws.empty() && std::ranges::any_of(c.draws.front().attributes, is_smooth);
    return std::tuple(!c.doors.empty(), c.draws.size() != draws, c.target.samples > 1,
                      cost < kLarge, !has_values, cost, std::string_view(c.id));
}

bool may_be_looked_at(const run::Task& task) {
    return cases::split_way(task.data.id).way.empty() && !task.expected && task.error.empty() &&
           !task.data.blit && diagnosis::cost_of(task.data) <= diagnosis::kMaxCost;
}

}  // namespace

void choose_told(std::vector<run::Task>& plan) {
    std::map<std::string_view, run::Task*> plainest;  // by rule or way
    const auto note = [&plainest](std::string_view key, run::Task& task) {
        run::Task*& known = plainest[key];
        if (known == nullptr || plainness(task) < plainness(*known)) {
            known = &task;
        }
    };
    for (run::Task& task : plan) {
        if (const std::string_view way = cases::split_way(task.data.id).way; !way.empty()) {
            note(way, task);
            continue;
        }
        for (const std::string& rule : task.data.claim.rules) {
            note(rule, task);
        }
    }
    for (const auto& [key, task] : plainest) {
        task->is_told = true;
    }
}

FirstLook::FirstLook(std::vector<run::Task>& plan) {
    if (plan.size() < kLeastPlan) {
        return;
    }
    std::map<std::string, std::vector<size_t>> families;
    for (size_t k = 0; k < plan.size(); ++k) {
        if (may_be_looked_at(plan[k])) {
            families[diagnosis::family_of(plan[k].data.id)].push_back(k);
        }
    }
    // What one draw shows may be of each, of the first or of the last: every fourth family shows
    // two.
    size_t number = 0;
    for (auto& [family, list] : families) {
        const size_t draws = ++number % 4 == 0 ? 2 : 1;
        std::ranges::sort(list, {}, [&](size_t k) { return plainness(plan[k], draws); });
    }
    std::vector<size_t> chosen;
    for (size_t turn = 0; turn < kMost && chosen.size() < kMost; ++turn) {
        for (const auto& [family, list] : families) {
            if (turn < list.size() && chosen.size() < kMost) {
                chosen.push_back(list[turn]);
            }
        }
    }
    std::vector<run::Task> ordered;
    std::vector<bool> is_first(plan.size());
    for (const size_t k : chosen) {
        ids_.insert(plan[k].data.id);
        is_first[k] = true;
        ordered.push_back(std::move(plan[k]));
        ordered.back().is_told = true;
    }
    for (size_t k = 0; k < plan.size(); ++k) {
        if (!is_first[k]) {
            ordered.push_back(std::move(plan[k]));
        }
    }
    plan = std::move(ordered);
    open_ = ids_;
}

bool FirstLook::ends_with(const CaseRecord& record) {
    return open_.erase(record.id) > 0 && open_.empty();
}

}  // namespace cli
