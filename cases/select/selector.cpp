// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/select/selector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "cases/model/rule.hpp"
#include "cases/model/way.hpp"

namespace cases {

namespace {

// Characters; the longest path that systems take. Matching takes this many times the ids' length.
constexpr size_t kMaxSelector = 4096;

// Matches in time that is linear in the text for each character of the pattern, "*" and "**"
// included; the pattern's other characters stand for themselves. "**" followed by "/" also matches
// nothing ("a/**/b" matches "a/b").
bool match(std::string_view pattern, std::string_view text) {
    // Most patterns differ from most ids before their first star.
    const size_t plain = std::min(pattern.find('*'), pattern.size());
    if (!text.starts_with(pattern.substr(0, plain))) {
        return false;
    }
    pattern.remove_prefix(plain);
    text.remove_prefix(plain);
    // reachable[i]: the pattern so far can match the first i characters.
    std::vector<bool> reachable(text.size() + 1, false);
    reachable[0] = true;
    for (size_t p = 0; p < pattern.size();) {
        std::vector<bool> next(text.size() + 1, false);
        const bool deep = pattern.substr(p, 2) == "**";
        const bool deep_slash = pattern.substr(p, 3) == "**/";
        const bool star = pattern[p] == '*';
        bool is_inside = false;  // the star, which began at some earlier character
        for (size_t i = 0; i <= text.size(); ++i) {
            if (star) {
                next[i] = reachable[i] || (is_inside && (!deep_slash || text[i - 1] == '/'));
                const bool is_wall = !deep && i < text.size() && (text[i] == '/' || text[i] == ':');
                is_inside = (is_inside || reachable[i]) && !is_wall;
            } else if (i < text.size() && reachable[i] && pattern[p] == text[i]) {
                next[i + 1] = true;
            }
        }
        reachable = std::move(next);
        p += deep_slash ? 3 : deep ? 2 : 1;
    }
    return reachable[text.size()];
}

size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> before(b.size() + 1);
    std::vector<size_t> row(b.size() + 1);
    std::vector<size_t> next(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        next[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            next[j] = std::min(
                {row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                next[j] = std::min(next[j], before[j - 2] + 1);  // two letters exchanged
            }
        }
        std::swap(before, row);
        std::swap(row, next);
    }
    return row[b.size()];
}

std::string with_hint(std::string message, const std::string& nearest) {
    return nearest.empty() ? message : message + "; did you mean " + nearest + "?";
}

// The family that is near to the first part of a word, or begins with it; else empty.
std::string family_like(const std::string& part, const std::vector<std::string>& folders) {
    const auto like = std::ranges::find_if(
        folders, [&](const std::string& f) { return part.size() > 2 && f.starts_with(part); });
    const std::string nearest = nearest_name(part, folders);
    const std::string family = nearest.empty() && like != folders.end() ? *like : nearest;
    return family == part ? "" : family;
}

std::string part_before_leaf(const std::string& id) {
    return id.substr(0, id.find(':'));
}

struct Matcher {
    const std::vector<Case>& all;

    Expected<std::vector<bool>> by_rule(const std::string& pattern) const {
        std::vector<bool> chosen(all.size(), false);
        std::vector<std::string> names;
        for (const Rule& rule : all_rules()) {
            names.emplace_back(rule.id);
        }
        if (std::ranges::none_of(names, [&](const std::string& n) { return match(pattern, n); })) {
            return failure(with_hint("no rule is called " + pattern, nearest_name(pattern, names)));
        }
        for (size_t i = 0; i < all.size(); ++i) {
            const std::vector<std::string>& rules = all[i].claim.rules;
            chosen[i] =
                std::ranges::any_of(rules, [&](const std::string& r) { return match(pattern, r); });
        }
        if (std::ranges::none_of(chosen, [](bool b) { return b; })) {
            return failure("no case checks the rule " + pattern);
        }
        return chosen;
    }

    // A path to a case file or folder; nothing if no case came from there.
    std::vector<bool> by_path(const std::string& word) const {
        namespace fs = std::filesystem;
        std::vector<bool> chosen(all.size(), false);
        std::error_code ignored;
        const fs::path path = fs::weakly_canonical(word, ignored);
        if (ignored || !fs::exists(path, ignored)) {
            return chosen;
        }
        for (size_t i = 0; i < all.size(); ++i) {
            const fs::path file = fs::weakly_canonical(all[i].claim.where.file, ignored);
            const auto [rest, in_file] = std::ranges::mismatch(path, file);
            chosen[i] = rest == path.end();
        }
        return chosen;
    }

    Expected<std::vector<bool>> one(const std::string& word) const {
        if (word.rfind("@rule:", 0) == 0) {
            return by_rule(word.substr(6));
        }
        if (word.rfind('@', 0) == 0) {
            return failure("the selector " + word +
                           " is unknown; write @rule:PATTERN or a case id");
        }
        std::vector<bool> chosen(all.size(), false);
        for (size_t i = 0; i < all.size(); ++i) {
            chosen[i] = glob_matches(word, all[i].id);
        }
        if (std::ranges::none_of(chosen, [](bool b) { return b; })) {
            chosen = by_path(word);
        }
        if (std::ranges::none_of(chosen, [](bool b) { return b; })) {
            return failure(nothing_matches(word));
        }
        return chosen;
    }

    // "coverage/size has 2 leaves, the first is coverage/size:k=1,o=64"; empty if there is no such
    // case.
    std::string leaves_of(const std::string& file) const {
        size_t count = 0;
        std::string first;
        for (const Case& c : all) {
            if (c.id == file) {
                return file + " has no leaves";
            }
            if (c.id.starts_with(file + ":")) {
                first = count == 0 ? c.id : first;
                ++count;
            }
        }
        return count == 0 ? ""
                          : fmt::format("{} has {} {}, the first is {}", file, count,
                                        count == 1 ? "leaf" : "leaves", first);
    }

    // Why no case matches, and what may have been meant: a family, a case, a file.
    std::string nothing_matches(const std::string& word) const {
        if (word.ends_with(".toml")) {
            return "there is no case file " + word;
        }
        std::string bare = word;
        for (const std::string_view ending : {"/**", "/*", "/"}) {
            bare = bare.ends_with(ending) ? bare.substr(0, bare.size() - ending.size()) : bare;
        }
        std::vector<std::string> ids, folders;
        for (const Case& c : all) {
            ids.push_back(word.find(':') == std::string::npos ? part_before_leaf(c.id) : c.id);
            for (size_t at = c.id.find('/'); at != std::string::npos; at = c.id.find('/', at + 1)) {
                folders.push_back(c.id.substr(0, at));
            }
        }
        const bool is_folder = std::ranges::find(folders, bare) != folders.end();
        std::error_code ignored;
        if (!is_folder && std::filesystem::is_directory(word, ignored)) {
            return word + " is a folder without case files (*.toml)";
        }
        if (!is_folder && std::filesystem::is_regular_file(word, ignored)) {
            return word + " is no case file (*.toml)";
        }
        // The parameters of a leaf with some left out mean the first leaf that has them.
        const auto whole = std::ranges::find_if(ids, [&](const std::string& id) {
            return id.starts_with(word) && id[word.size()] == ',';
        });
        const std::string id = is_folder            ? ""
                               : whole != ids.end() ? *whole
                                                    : nearest_name(word, ids);
        std::string folder = is_folder ? bare : id.empty() ? nearest_name(bare, folders) : "";
        if (id.empty() && folder.empty()) {
            folder = family_like(bare.substr(0, bare.find('/')), folders);
        }
        if (id.empty() && folder.empty() && word.find(':') != std::string::npos) {
            if (const std::string leaves = leaves_of(part_before_leaf(word)); !leaves.empty()) {
                return "no case matches " + word + "; " + leaves;
            }
        }
        return with_hint("no case matches " + word, folder.empty() ? id : folder + "/**");
    }
};

std::string trimmed(const std::string& line) {
    const size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') {
        return "";
    }
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

bool glob_matches(std::string_view pattern, std::string_view id) {
    const auto [base, way] = split_way(id);
    const auto [of_base, of_way] = split_way(pattern);
    if (way.empty() != of_way.empty()) {
        return false;  // a case does not stand for what is drawn of it by ways
    }
    if (!way.empty()) {
        return match(of_way, way) && glob_matches(of_base, base);
    }
    return pattern == id || match(pattern, id) || match(pattern, id.substr(0, id.find(':')));
}

Expected<std::vector<size_t>> select(const std::vector<Case>& all,
                                     const std::vector<std::string>& selectors, std::istream& input,
                                     const std::vector<size_t>& named) {
    std::vector<std::string> words;
    for (const std::string& selector : selectors) {
        if (selector != "-") {
            words.push_back(selector);
            continue;
        }
        const size_t before = words.size();
        for (std::string line; std::getline(input, line);) {
            if (std::string word = trimmed(line); !word.empty()) {
                words.push_back(std::move(word));
            }
        }
        if (words.size() == before) {
            return failure("standard input names no case; write one selector a line");
        }
    }
    const bool only_exclusions =
        named.empty() &&
        std::ranges::all_of(words, [](const std::string& w) { return w.rfind('!', 0) == 0; });
    std::vector<bool> chosen(all.size(), only_exclusions);
    for (const size_t k : named) {
        chosen[k] = true;
    }
    std::vector<bool> excluded(all.size(), false);
    const Matcher matcher{all};
    for (const std::string& word : words) {
        const bool exclude = word.rfind('!', 0) == 0;
        const std::string rest = exclude ? word.substr(1) : word;
        if (rest.empty()) {
            return failure("a selector is empty; write a case id or a pattern");
        }
        if (rest.size() > kMaxSelector) {
            return failure(
                fmt::format("a selector has {} characters, the most are {}; write "
                            "several selectors",
                            rest.size(), kMaxSelector));
        }
        const Expected<std::vector<bool>> matched = matcher.one(rest);
        if (!matched) {
            return tl::unexpected(matched.error());
        }
        for (size_t i = 0; i < all.size(); ++i) {
            if ((*matched)[i]) {
                (exclude ? excluded : chosen)[i] = true;
            }
        }
    }
    std::vector<size_t> result;
    for (size_t i = 0; i < all.size(); ++i) {
        if (chosen[i] && !excluded[i]) {
            result.push_back(i);
        }
    }
    return result;
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
    // Near: at most a third of the longer word's letters differ.
    std::string best;
    size_t best_distance = SIZE_MAX;
    for (const std::string& candidate : candidates) {
        const size_t longest = std::max(word.size(), candidate.size());
        // The distance is at least the difference of the lengths.
        const size_t least = longest - std::min(word.size(), candidate.size());
        if (least >= best_distance || least * 3 > longest + 1) {
            continue;
        }
        const size_t distance = edit_distance(word, candidate);
        if (distance < best_distance && distance * 3 <= longest + 1) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         const std::string& otherwise) {
    const std::string nearest = nearest_name(word, candidates);
    return nearest.empty() ? otherwise : "; did you mean '" + nearest + "'?";
}

std::string rule_hint(std::string_view word, char quote) {
    const std::string_view family = word.substr(0, word.find('.') + 1);  // "depth."
    std::vector<std::string> all, endings;
    std::string list;
    for (const Rule& rule : all_rules()) {
        all.emplace_back(rule.id);
        if (!family.empty() && rule.id.starts_with(family)) {
            endings.emplace_back(rule.id.substr(family.size()));
            list += (list.empty() ? "" : ", ") + all.back();
        }
    }
    std::string nearest = nearest_name(word, all);
    if (!endings.empty()) {
        const std::string ending = nearest_name(word.substr(family.size()), endings);
        nearest = ending.empty() ? "" : std::string(family) + ending;
    }
    if (!nearest.empty()) {
        return fmt::format("did you mean {}{}{}?", quote, nearest, quote);
    }
    return list.empty() ? "docs/rules.md lists all" : "there are " + list;
}

}  // namespace cases
