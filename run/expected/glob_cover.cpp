// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/glob_cover.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

#include "cases/select/selector.hpp"

namespace run {

namespace {

constexpr size_t kMaxKeys = 6;  // 2^6 patterns an id; matrices have rarely more keys

// The id before the values of its matrix; the whole id if it has none.
std::string base_of(const std::string& id) {
    return id.substr(0, id.find(':'));
}

// "fam/name:a=1,b=2" -> {"a=1", "b=2"}
std::vector<std::string> values_of(const std::string& id) {
    std::vector<std::string> values;
    const size_t colon = id.find(':');
    for (size_t begin = colon; begin < id.size();) {
        const size_t end = std::min(id.find(',', begin + 1), id.size());
        values.push_back(id.substr(begin + 1, end - begin - 1));
        begin = end;
    }
    return values;
}

// Patterns that match the id, with a star for each run of values that may be any.
std::vector<std::string> patterns_of(const std::string& id) {
    const std::vector<std::string> values = values_of(id);
    if (values.empty() || values.size() > kMaxKeys) {
        return {id};
    }
    std::vector<std::string> patterns;
    for (size_t stars = 0; stars < (size_t{1} << values.size()); ++stars) {
        std::string text;
        for (size_t k = 0; k < values.size(); ++k) {
            if ((stars >> k & 1) == 0) {
                text += (text.empty() ? "" : ",") + values[k];
            } else if (!text.ends_with('*')) {
                text += text.empty() ? "*" : ",*";
            }
        }
        patterns.push_back(base_of(id) + ":" + text);
    }
    return patterns;
}

}  // namespace

std::vector<std::string> cover_by_globs(const std::vector<std::string>& wanted,
                                        const std::vector<std::string>& all) {
    std::map<std::string, std::vector<std::string>> wanted_of, all_of;  // by what precedes ':'
    std::vector<std::string> bases;
    for (const std::string& id : wanted) {
        std::vector<std::string>& ids = wanted_of[base_of(id)];
        if (ids.empty()) {
            bases.push_back(base_of(id));
        }
        ids.push_back(id);
    }
    for (const std::string& id : all) {
        all_of[base_of(id)].push_back(id);
    }
    std::vector<std::string> globs;
    for (const std::string& base : bases) {
        const std::vector<std::string>& ids = wanted_of[base];
        std::set<std::string> left(ids.begin(), ids.end());
        std::map<std::string, std::vector<std::string>> candidates;
        for (const std::string& id : ids) {
            for (const std::string& pattern : patterns_of(id)) {
                candidates[pattern];
            }
        }
        for (auto at = candidates.begin(); at != candidates.end();) {
            std::copy_if(all_of[base].begin(), all_of[base].end(), std::back_inserter(at->second),
                         [&](const std::string& id) { return cases::glob_matches(at->first, id); });
            const bool fits = std::all_of(at->second.begin(), at->second.end(),
                                          [&](const std::string& id) { return left.contains(id); });
            at = fits ? std::next(at) : candidates.erase(at);
        }
        while (!left.empty()) {
            const std::string* best = nullptr;
            size_t most = 0;
            for (const auto& [pattern, matched] : candidates) {
                const auto count = static_cast<size_t>(
                    std::count_if(matched.begin(), matched.end(),
                                  [&](const std::string& id) { return left.contains(id); }));
                if (count > most || (count == most && best != nullptr && count > 0 &&
                                     pattern.size() < best->size())) {
                    best = &pattern;
                    most = count;
                }
            }
            if (best == nullptr || most == 1) {
                globs.insert(globs.end(), left.begin(), left.end());
                break;
            }
            globs.push_back(*best);
            for (const std::string& id : candidates.at(*best)) {
                left.erase(id);
            }
        }
    }
    return globs;
}

}  // namespace run
