// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/ways.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

#include "cases/base/checksum.hpp"
#include "cases/model/way.hpp"
#include "cases/select/selector.hpp"
#include "cli/prepare/doors.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

using Way = const cases::WayRow*;

// The id of a case's file.
std::string file_part(const std::string& id) {
    return id.substr(0, id.find(':'));
}

std::vector<Way> ways_like(const std::string& glob) {
    std::vector<Way> found;
    for (const cases::WayRow& way : cases::all_ways()) {
        if (cases::glob_matches(glob, way.word)) {
            found.push_back(&way);
        }
    }
    if (found.empty()) {
        std::vector<std::string> words = cases::way_words();
        words.insert(words.end(), {"all", "default", "none"});
        throw stop_with(
            report::kExitUsage,
            fmt::format("--ways: there is no way '{}'{}", glob,
                        cases::did_you_mean(glob, words, "; 'edgecase doors' lists them")));
    }
    return found;
}

// Some ways of one file's cases.
void cover(const std::vector<cases::Case*>& leaves, std::vector<cases::Case>& out) {
    const std::span<const cases::WayRow> ways = cases::all_ways();
    const uint64_t hash = cases::stable_hash(file_part(leaves.front()->id), 0);
    // Without a factor in common with the number of ways: all come, in another order.
    size_t step = 7;
    while (std::gcd(step, ways.size()) > 1) {
        step += 2;
    }
    size_t made = 0;
    const auto add = [&](const cases::WayRow& way) {
        for (size_t n = 0; n < leaves.size(); ++n) {
            const size_t leaf =
                (hash / ways.size() + made * (leaves.size() / kWaysOfFile + 1) + n) % leaves.size();
            if (std::optional<cases::Case> c = cases::by_way(way, *leaves[leaf])) {
                out.push_back(std::move(*c));
                ++made;
                break;
            }
        }
    };
    // The one that takes the fewest cases comes first.
    const auto rare = std::ranges::find(ways, "bare-beside", &cases::WayRow::word);
    add(*rare);
    for (size_t k = 0; k < ways.size() && made < kWaysOfFile; ++k) {
        const size_t at = (hash + step * k) % ways.size();
        if (&ways[at] != &*rare) {
            add(ways[at]);
        }
    }
}

}  // namespace

std::vector<cases::Case> choose_ways(const std::string& words,
                                     std::span<cases::Case* const> selected) {
    std::vector<cases::Case> out;
    if (words == "none") {
        return out;
    }
    if (words == "default") {
        std::map<std::string, std::vector<cases::Case*>> files;
        for (cases::Case* c : selected) {
            files[file_part(c->id)].push_back(c);
        }
        for (const auto& [file, leaves] : files) {
            cover(leaves, out);
        }
        return out;
    }
    std::vector<Way> ways;
    std::istringstream in(words == "all" ? "*" : words);
    for (std::string glob; std::getline(in, glob, ',');) {
        for (const Way way : ways_like(glob)) {
            if (std::ranges::find(ways, way) == ways.end()) {
                ways.push_back(way);
            }
        }
    }
    for (const cases::Case* c : selected) {
        for (const Way way : ways) {
            if (std::optional<cases::Case> made = cases::by_way(*way, *c)) {
                out.push_back(std::move(*made));
            }
        }
    }
    if (out.empty() && words != "all") {
        throw stop_with(report::kExitNothingSelected,
                        fmt::format("no selected case is drawn by '{}', which takes {}; select "
                                    "others, or leave it out",
                                    words, ways.front()->takes));
    }
    return out;
}

std::string ways_of(const RunOptions& options) {
    return options.ways.empty() ? takes_default(options) ? "default" : "none" : options.ways;
}

void add_drawn(LoadedSuite& suite, const report::Run& run) {
    std::map<std::string, size_t> by_id;
    for (size_t k = 0; k < suite.cases.size(); ++k) {
        by_id.emplace(suite.cases[k].id, k);
    }
    for (const report::CaseRecord& record : run.cases) {
        const auto [base, word] = cases::split_way(record.id);
        const auto at = word.empty() ? by_id.end() : by_id.find(std::string(base));
        const auto way = std::ranges::find(cases::all_ways(), word, &cases::WayRow::word);
        if (at == by_id.end() || way == cases::all_ways().end()) {
            continue;
        }
        if (auto made = cases::by_way(*way, suite.cases[at->second])) {
            suite.add(std::move(*made), at->second);
        }
    }
}

}  // namespace cli
