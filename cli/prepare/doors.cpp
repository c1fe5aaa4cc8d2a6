// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/doors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>

#include "capture/checksum.hpp"
#include "cases/model/door.hpp"
#include "cases/select/selector.hpp"
#include "cli/renderers/renderers.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

constexpr std::string_view kSets[] = {"all", "default", "none"};

bool is_set(std::string_view word) {
    return std::find(std::begin(kSets), std::end(kSets), word) != std::end(kSets);
}

// What --doors asks for: a set, or doors by their names, and those of a set that are left out.
struct Wish {
    std::string set = "none";
    std::vector<cases::Door> named, without;
    bool has(cases::Door door) const { return std::ranges::find(without, door) == without.end(); }
};

[[noreturn]] void refuse(const std::string& sentence) {
    throw stop_with(report::kExitUsage, "--doors: " + sentence);
}

cases::Door named_door(const std::string& word, bool is_first) {
    if (const std::optional<cases::Door> door = cases::find_door(word)) {
        return *door;
    }
    if (is_set(word)) {
        refuse(fmt::format(
            "'{}' stands first or not at all, and behind it only '-NAME', a door to leave out",
            word));
    }
    std::vector<std::string> known = cases::door_words();
    if (is_first) {
        known.insert(known.begin(), std::begin(kSets), std::end(kSets));
    }
    const std::string nearest = cases::nearest_name(word, known);
    refuse(fmt::format("there is no door '{}'{}; 'edgecase doors' lists them", word,
                       nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
}

// "all,-index-8", "default", "index-8,secondary".
Wish wish_of(const std::string& words) {
    Wish wish;
    std::istringstream in(words);
    bool is_first = true;
    for (std::string word; std::getline(in, word, ','); is_first = false) {
        if (is_first && is_set(word)) {
            wish.set = word;
            continue;
        }
        const bool is_left_out = word.starts_with('-');
        const cases::Door door = named_door(word.substr(is_left_out ? 1 : 0), is_first);
        const bool is_of_set = wish.set != "none";
        if (is_left_out && !is_of_set) {
            refuse(
                fmt::format("'{}' leaves a door out of a set, so 'all' or 'default' stands "
                            "first: all,{}",
                            word, word));
        }
        if (!is_left_out && words.starts_with("none,")) {
            refuse("'none' stands alone");
        }
        if (!is_left_out && is_of_set) {
            refuse(fmt::format("behind '{}' stand only doors to leave out; did you mean '-{}'?",
                               wish.set, word));
        }
        std::vector<cases::Door>& list = is_left_out ? wish.without : wish.named;
        if (std::ranges::find(list, door) == list.end()) {
            list.push_back(door);
        }
    }
    return wish;
}

std::string family_of(const cases::Case& c) {
    return c.id.substr(0, std::min(c.id.find('/'), c.id.find(':')));
}

// More than the usual needs of a device, so that it may not draw the case at all.
bool is_demanding(const cases::Case& c) {
    return c.target.samples > 4 || !c.target.sample_locations.empty() || c.target.layers > 1;
}

// Bytes that drawing the case moves, more or less, to tell which of several cases is cheapest to
// draw: those of its capture, and 64 for each vertex. Its position has 16 bytes (four binary32),
// which are read and written by the vertex shader, and then by clipping.
uint64_t drawing_cost(const cases::Case& c) {
    constexpr uint64_t kBytesOfVertex = 64;
    uint64_t vertices = 0;
    for (const cases::Draw& draw : c.draws) {
        vertices += draw.instances * draw.element_count();
    }
    return capture::capture_bytes(c) + kBytesOfVertex * vertices;
}

void cover(std::span<cases::Case* const> selected, const Wish& wish) {
    std::map<std::string, std::vector<cases::Case*>> families;
    for (cases::Case* c : selected) {
        families[family_of(*c)].push_back(c);
    }
    for (const auto& entry : families) {
        const std::vector<cases::Case*>& members = entry.second;
        std::vector<uint64_t> costs;
        for (const cases::Case* c : members) {
            costs.push_back(drawing_cost(*c));
        }
        for (const cases::DoorRow& row : cases::all_doors()) {
            std::optional<size_t> best;
            const auto rank = [&](size_t k) {
                return std::tuple(is_demanding(*members[k]), costs[k], members[k]->doors.size(), k);
            };
            for (size_t k = 0; k < members.size(); ++k) {
                if (wish.has(row.door) && cases::can_take(row.door, *members[k]) &&
                    (!best || rank(k) < rank(*best))) {
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

LeftOutDoors choose_doors(const std::string& words, std::span<cases::Case* const> selected) {
    LeftOutDoors left_out;
    const Wish wish = wish_of(words);
    if (wish.set == "default") {
        cover(selected, wish);
        return left_out;
    }
    std::vector<cases::Door> doors = wish.named;
    if (wish.set == "all") {
        for (const cases::DoorRow& row : cases::all_doors()) {
            if (wish.has(row.door)) {
                doors.push_back(row.door);
            }
        }
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
        if (taking == 0 && wish.set != "all") {
            throw stop_with(
                report::kExitNothingSelected,
                fmt::format("no selected case can go through the door '{}', which takes {}; select "
                            "others, or leave it out",
                            cases::row_of(door).word, cases::row_of(door).takes));
        }
    }
    return left_out;
}

bool takes_default(const RunOptions& options) {
    const SuiteOptions& suite = options.suite;
    const char* other = std::getenv("EDGECASE_SUITE");
    const bool is_own = suite.suite.empty() && (other == nullptr || *other == '\0');
    return is_own && suite.selectors.empty() && !options.quick && options.failed_in.empty() &&
           renderer_of(options.device).needs != nullptr;
}

std::string doors_of(const RunOptions& options) {
    return options.doors.empty() ? takes_default(options) ? "default" : "none" : options.doors;
}

bool asks_for_set(const std::string& words) {
    const std::string first = words.substr(0, words.find(','));
    return first == "all" || first == "default";
}

std::string doors_words(const std::string& words, const std::vector<std::string>& doors) {
    const bool are_all = words == "all" || words.starts_with("all,");
    return are_all && !doors.empty() ? words : fmt::format("{}", fmt::join(doors, ","));
}

}  // namespace cli
