// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/source.hpp"

#include <utility>

#include "fuzz/generate/generator.hpp"

namespace fuzz {

void GeneratedSource::enter(uint64_t group) {
    // A pose depends on those before it.
    for (uint64_t made = poses_.count(); made <= group; ++made) {
        pose_ = poses_.next([&](const Pose& candidate) { return is_case(seed_, candidate, made); });
    }
}

Source::Made GeneratedSource::make(uint64_t number) const {
    Made made;
    made.text = case_text(seed_, pose_, number / group_size(), number);
    made.data = load_one(made.text, std::to_string(number));
    if (!made.data) {
        made.text.clear();
        made.refused = 1;
    }
    return made;
}

static std::optional<cases::Case> only(cases::ExpectedAll<std::vector<cases::Case>> loaded) {
    return loaded && loaded->size() == 1 ? std::optional(std::move(loaded->front())) : std::nullopt;
}

std::optional<cases::Case> load_one(const std::string& text, const std::string& id) {
    return only(cases::load_text(text, "fuzz", id));
}

std::optional<cases::Case> load_one(const cases::TomlValue& document, const std::string& id) {
    return only(cases::load_tree(document, id));
}

}  // namespace fuzz
