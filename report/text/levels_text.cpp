// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/levels_text.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "cases/base/counted.hpp"
#include "report/text/causes.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

// What cases do that break a level, of one and of several: breaking a stricter one is less.
constexpr std::array<std::pair<std::string_view, std::string_view>, std::size(cases::kProfiles)>
    kLevelDeeds = {
        {{"is wrong", "are wrong"}, {"is suspicious", "are suspicious"}, {"differs", "differ"}}};

}  // namespace

std::string level_text(const Levels& levels, const LevelCount& row) {
    if (!row.is_judged || levels.judged == 0) {
        return "not judged";
    }
    const bool is_first = row.level == cases::kProfiles[0];
    const size_t news = row.unexpected.size(), known = row.expected.size();
    const auto& [one, several] = kLevelDeeds.at(static_cast<size_t>(row.level));
    const std::string all = cases::counted(levels.judged, "case");
    if (news == 0 && known == 0) {
        return is_first ? "nothing wrong in " + all : "nothing";
    }
    if (news == 0) {
        return fmt::format("nothing new{}, {} {} as expected", is_first ? " in " + all : "",
                           is_first ? std::to_string(known) : cases::counted(known, "case"),
                           known == 1 ? one : several);
    }
    return fmt::format("{} {} ({}){}",
                       is_first ? fmt::format("{} of {}", news, all) : cases::counted(news, "case"),
                       news == 1 ? one : several, families_text(row.unexpected),
                       known == 0 ? "" : fmt::format(", {} more as expected", known));
}

std::string unjudged_text(const Levels& levels) {
    return levels.unjudged == 0 ? "" : cases::counted(levels.unjudged, "case");
}

std::string levels_line(const Run& run) {
    const Levels found = levels(run);
    std::string text;
    for (const LevelCount& row : found.rows) {
        text += fmt::format("{}{}: {}", text.empty() ? "" : " - ", cases::to_string(row.level),
                            level_text(found, row));
    }
    const std::string unjudged = unjudged_text(found);
    return unjudged.empty() ? text : text + " - without a level: " + unjudged;
}

}  // namespace report
