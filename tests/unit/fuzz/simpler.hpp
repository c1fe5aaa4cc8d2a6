// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that single steps of the reducer make of a document.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cases/load/loader.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

// A document that is one step simpler than another.
struct Simpler {
    Document document;
    std::string step;  // "without draw 1", "with 1 sample", "draw 0 without scissor"
    std::string need;  // Step::need
};

// What makes a case easiest for a person first. What does not load, stays the same text or is no
// simpler by measure.hpp is left out.
inline std::vector<Simpler> simpler(const Document& document) {
    std::vector<Simpler> out;
    std::set<std::string> seen = {to_text(document)};
    for (const Stage stage : kStages) {
        for (const Step& step : steps_of(document, stage)) {
            Document after = document;
            if (!step.apply(after) || !(measure(after) < measure(document))) {
                continue;
            }
            const auto loaded = cases::load_tree(after, "case");
            if (loaded && !loaded->empty() && seen.insert(to_text(after)).second) {
                out.push_back({std::move(after), step.words, step.need});
            }
        }
    }
    return out;
}

}  // namespace fuzz
