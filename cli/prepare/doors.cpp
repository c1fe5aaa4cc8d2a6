// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/doors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <tuple>

#include "capture/checksum.hpp"
#include "cases/model/door.hpp"
#include "cases/model/selector.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

std::vector<std::string> all_words() {
    std::vector<std::string> words = {"all", "default", "none"};
    for (const cases::DoorRow& row : cases::all_doors()) {
        words.emplace_back(row.word);
    }
    return words;
}

OrStop<std::vector<cases::Door>> named_doors(const std::string& words) {
    std::vector<cases::Door> doors;
    std::istringstream in(words);
    for (std::string word; std::getline(in, word, ',');) {
        const std::optional<cases::Door> door = cases::find_door(word);
        if (!door) {
            const std::string nearest = cases::nearest_name(word, all_words());
            return tl::unexpected(stop_with(
                report::kExitUsage,
                fmt::format("--doors: there is no door '{}'{}; 'edgecase doors' lists them", word,
                            nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest))));
        }
        if (std::find(doors.begin(), doors.end(), *door) == doors.end()) {
            doors.push_back(*door);
        }
    }
    return doors;
}

std::string family_of(const cases::Case& c) {
    return c.id.substr(0, std::min(c.id.find('/'), c.id.find(':')));
}

// More than the usual needs of a device, so that it may not draw the case at all.
bool is_demanding(const cases::Case& c) {
    return c.target.samples > 4 || !c.target.sample_locations.empty() || c.target.layers > 1;
}

void cover(std::span<cases::Case* const> selected) {
    std::map<std::string, std::vector<cases::Case*>> families;
    for (cases::Case* c : selected) {
        families[family_of(*c)].push_back(c);
    }
    for (auto& [family, members] : families) {
        std::vector<uint64_t> bytes;
        for (const cases::Case* c : members) {
            bytes.push_back(capture::capture_bytes(*c));
        }
        for (const cases::DoorRow& row : cases::all_doors()) {
            std::optional<size_t> best;
            const auto rank = [&](size_t k) {
                return std::tuple(is_demanding(*members[k]), bytes[k], members[k]->doors.size(), k);
            };
            for (size_t k = 0; k < members.size(); ++k) {
                if (cases::can_take(row.door, *members[k]) && (!best || rank(k) < rank(*best))) {
                    best = k;
                }
            }
            if (best) {
                members[*best]->doors.push_back(row.door);
            }
        }
    }
}

}  // namespace

OrStop<LeftOutDoors> choose_doors(const std::string& words,
                                  std::span<cases::Case* const> selected) {
    LeftOutDoors left_out;
    if (words.empty() || words == "none") {
        return left_out;
    }
    if (words == "default") {
        cover(selected);
        return left_out;
    }
    std::vector<cases::Door> doors;
    if (words == "all") {
        for (const cases::DoorRow& row : cases::all_doors()) {
            doors.push_back(row.door);
        }
    } else {
        OrStop<std::vector<cases::Door>> named = named_doors(words);
        if (!named) {
            return tl::unexpected(named.error());
        }
        doors = std::move(*named);
    }
    for (const cases::Door door : doors) {
        size_t taking = 0;
        for (cases::Case* c : selected) {
            if (cases::can_take(door, *c)) {
                c->doors.push_back(door);
                ++taking;
            } else {
                left_out[c->id].emplace_back(cases::row_of(door).word);
            }
        }
        if (taking == 0 && words != "all") {
            return tl::unexpected(stop_with(
                report::kExitNothingSelected,
                fmt::format("no selected case can go through the door '{}', which takes {}; select "
                            "others, or leave it out",
                            cases::row_of(door).word, cases::row_of(door).takes)));
        }
    }
    return left_out;
}

std::string doors_words(const std::string& words, const std::vector<std::string>& doors) {
    return words == "all" ? words : fmt::format("{}", fmt::join(doors, ","));
}

}  // namespace cli
