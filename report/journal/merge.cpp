// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "cases/base/printable.hpp"
#include "cases/model/device.hpp"

namespace report {

namespace {

std::string device_text(const Run& run) {
    const capture::DeviceInfo& d = run.device;
    return fmt::format("{} {} {}, {} subpixel bits", d.name, d.driver_name, d.driver_info,
                       d.subpixel_bits);
}

// What all parts have in common, and how a sentence calls it.
struct Common {
    const char* what;
    std::string (*text)(const Run&);
    bool names_edited_file = false;  // if that is what differs
};
const Common kCommon[] = {
    {"the device", device_text},
    {"the profile", [](const Run& r) { return std::string(cases::to_string(r.profile)); }},
    {"the suite (a hash of its files)", [](const Run& r) { return r.suite_hash; }},
    {"the version of edgecase", [](const Run& r) { return r.tool_version; }},
    {"the number of shards", [](const Run& r) { return std::to_string(r.shards); }},
    {"the selection before --shard (a hash of the ids)", [](const Run& r) { return r.selection; }},
    {"what case files outside the suite hold (a hash)", [](const Run& r) { return r.own_hash; },
     true},
    {"what the expectation files hold (a hash)", [](const Run& r) { return r.expectation_hash; }},
    {"what else decides (options)", [](const Run& r) { return r.settings; }},
};

// A file that both parts took cases from and that was not the same; empty if there is none.
std::string edited_file(const Run& a, const Run& b) {
    const std::map<std::string, std::string> files(a.sources.begin(), a.sources.end());
    for (const auto& [name, hash] : b.sources) {
        const auto found = files.find(name);
        if (found != files.end() && found->second != hash) {
            return name;
        }
    }
    return {};
}

}  // namespace

cases::Expected<Run> merge_runs(std::vector<Part> parts) {
    if (parts.empty()) {
        return cases::failure("there is no run to merge; name the folders of runs");
    }
    const Part& first = parts.front();
    for (const Part& part : parts) {
        for (const Common& common : kCommon) {
            const std::string a = common.text(first.run);
            const std::string b = common.text(part.run);
            if (const std::string file = edited_file(first.run, part.run);
                a != b && common.names_edited_file && !file.empty()) {
                return cases::failure(
                    "the case file '{}' is not the same in all parts; only parts of one run can be "
                    "merged, use 'edgecase compare' for different ones",
                    cases::printable(file));
            }
            if (a != b) {
                return cases::failure(
                    "{} is '{}' in {} and '{}' in {}; only parts of one run "
                    "can be merged, use 'edgecase compare' for different ones",
                    common.what, cases::printable(a), first.name, cases::printable(b), part.name);
            }
        }
    }
    std::map<std::string, const Part*> owner;
    for (const Part& part : parts) {
        for (const CaseRecord& record : part.run.cases) {
            const auto [at, fresh] = owner.emplace(record.id, &part);
            if (!fresh && record.id != cases::kLimitsCase) {  // which each shard judges
                return cases::failure(
                    "the case '{}' is in {} and in {}; give each job its own --shard",
                    cases::printable(record.id), at->second->name, part.name);
            }
        }
    }
    Run run = first.run;
    run.diagnoses.clear();  // they speak of a part
    std::set<uint32_t> shards = {run.shard};
    for (size_t k = 1; k < parts.size(); ++k) {
        Run& part = parts[k].run;
        shards.insert(part.shard);
        run.started = std::min(run.started, part.started);
        run.ended = run.ended.empty() || part.ended.empty() ? "" : std::max(run.ended, part.ended);
        run.seconds += part.seconds;
        run.interrupted = run.interrupted || part.interrupted;
        run.missing_shards.insert(run.missing_shards.end(), part.missing_shards.begin(),
                                  part.missing_shards.end());  // of a part that is a merged run
        run.jobs += part.jobs;
        std::ranges::move(part.cases, std::back_inserter(run.cases));
        std::ranges::move(part.sources, std::back_inserter(run.sources));
    }
    std::ranges::sort(run.sources);
    run.sources.erase(std::unique(run.sources.begin(), run.sources.end()), run.sources.end());
    const auto twice = std::ranges::adjacent_find(
        run.sources, [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != run.sources.end()) {
        return cases::failure(
            "the case file '{}' is not the same in all parts; only parts of one run can be merged, "
            "use 'edgecase compare' for different ones",
            cases::printable(twice->first));
    }
    for (uint32_t shard = 1; shard <= run.shards; ++shard) {
        if (!shards.contains(shard)) {
            run.missing_shards.push_back(shard);
        }
    }
    run.shard = run.shards = 1;
    std::ranges::sort(run.cases, [](const CaseRecord& a, const CaseRecord& b) {
        return std::pair(a.id, b.status) < std::pair(b.id, a.status);
    });
    const auto of_one_id = [](const CaseRecord& a, const CaseRecord& b) { return a.id == b.id; };
    run.cases.erase(std::unique(run.cases.begin(), run.cases.end(), of_one_id), run.cases.end());
    return run;
}

}  // namespace report
