// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/doors_text.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string_view>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "cases/model/door.hpp"
#include "cases/model/way.hpp"

namespace report {

std::vector<DoorCount> door_counts(const Run& run) {
    std::map<std::string, DoorCount> by_word;
    for (const CaseRecord& record : run.cases) {
        for (const std::string& door : record.doors) {
            by_word[door];
        }
        for (const std::string& door : record.left_out_doors) {
            ++by_word[door].left_out;
        }
        for (const std::string& door : record.drawn.doors) {
            ++by_word[door].pictures;
        }
        for (const auto& [door, reason] : record.drawn.closed_doors) {
            DoorCount& count = by_word[door];
            ++count.closed;
            if (count.reason.empty()) {
                count.reason = reason;
            }
        }
    }
    for (const auto& [door, bug] : run.skipped_doors) {
        by_word[door].bug = bug;
    }
    std::vector<DoorCount> counts;
    for (const cases::DoorRow& row : cases::all_doors()) {
        if (const auto found = by_word.find(std::string(row.word)); found != by_word.end()) {
            counts.push_back(found->second);
            counts.back().door = row.word;
        }
    }
    return counts;
}

std::string doors_text(const Run& run, bool verbose) {
    const std::vector<DoorCount> counts = door_counts(run);
    if (counts.empty() || run.device.api_version.empty()) {
        return {};  // what is no driver has none
    }
    size_t pictures = 0, left_out = 0, open = 0, known = 0, unsupported = 0;
    for (const DoorCount& count : counts) {
        pictures += count.pictures;
        left_out += count.left_out;
        open += count.pictures > 0 ? 1 : 0;
        known += count.bug.empty() ? 0U : 1U;
        unsupported += count.bug.empty() && count.pictures == 0 && count.closed > 0 ? 1U : 0U;
    }
    std::string text =
        fmt::format("doors: {} through {} of {}", cases::counted(pictures, "picture"), open,
                    cases::counted(counts.size(), "door"));
    const auto add = [&text](size_t count, std::string_view what) {
        text += count > 0 ? fmt::format("; {} {}", count, what) : "";
    };
    add(left_out, "left out, since the case cannot take the door");
    if (!verbose) {
        add(known, known == 1 ? "is known to be broken" : "are known to be broken");
        add(unsupported, "the device lacks");
        return text + '\n';
    }
    text += '\n';
    for (const DoorCount& count : counts) {
        text += fmt::format("  {}: {}", count.door,
                            count.pictures == 0 ? "no picture was drawn"
                                                : cases::counted(count.pictures, "picture"));
        if (count.left_out > 0) {
            text += fmt::format(", {} left out", count.left_out);
        }
        if (!count.bug.empty()) {
            text += fmt::format("; left out where no case asks for it, known to be broken by {}",
                                cases::printable(count.bug));
        } else if (count.closed > 0) {
            text +=
                fmt::format(", {} unsupported: {}", count.closed, cases::printable(count.reason));
        } else if (count.pictures == 0) {
            text += "; no case that can take it was judged";
        }
        text += '\n';
    }
    return text;
}

std::string ways_text(const Run& run) {
    size_t pictures = 0;
    std::set<std::string_view> ways;
    for (const CaseRecord& c : run.cases) {
        const std::string_view way = cases::split_way(c.id).way;
        if (!way.empty() && c.status != Status::unsupported && c.status != Status::skip &&
            c.status != Status::not_run) {
            ++pictures;
            ways.insert(way);
        }
    }
    return ways.empty() ? std::string()
                        : fmt::format("ways: {} by {}\n", cases::counted(pictures, "picture"),
                                      cases::counted(ways.size(), "way"));
}

}  // namespace report
