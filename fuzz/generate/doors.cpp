// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/doors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/door.hpp"

namespace fuzz {

std::string through_doors(std::string text, Dice dice) {
    const auto c = cases::load_text(text, "fuzz", "fuzz");
    if (!c || c->size() != 1) {
        return text;
    }
    std::vector<std::string> words;
    for (uint64_t k = 0; k < 2; ++k) {
        const std::span<const cases::DoorRow> rows = cases::all_doors();
        const cases::DoorRow& row = rows[dice.below(rows.size())];
        const std::string word = fmt::format("\"{}\"", row.word);
        if (cases::can_take(row.door, c->front()) &&
            std::find(words.begin(), words.end(), word) == words.end()) {
            words.push_back(word);
        }
    }
    if (!words.empty()) {
        text.insert(text.find("\n[target]"),
                    fmt::format("relations = [{{ doors = [{}] }}]\n", fmt::join(words, ", ")));
    }
    return text;
}

}  // namespace fuzz
