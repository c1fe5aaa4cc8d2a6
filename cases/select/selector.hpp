// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which cases a command works on: globs on ids ("coverage/**", "*" stays inside one path part and
// never crosses ':', "**" crosses '/'; an id without its matrix part means all its leaves),
// "@rule:PATTERN", a path to a case file or folder, "-" for ids on standard input, "!" in front
// excludes.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

// True if the glob matches the whole id, or the id's part before ':' (all leaves). Behind '@' a
// glob of ways (cases/model/way.hpp) stands in both or in neither.
bool glob_matches(std::string_view pattern, std::string_view id);

// Indices into `all` that the selectors choose, in suite order; no selector chooses all.
// Only-exclusions start from all. A selector that matches nothing is an error that names the
// nearest id or rule. `input` is read for "-". `named` are cases that are chosen besides, whatever
// their ids look like, but for what an exclusion takes out again.
Expected<std::vector<size_t>> select(const std::vector<Case>& all,
                                     const std::vector<std::string>& selectors, std::istream& input,
                                     const std::vector<size_t>& named = {});

// The candidate with the smallest edit distance to `word`, or "" if none is near. Used by every
// "did you mean" in the program.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

// "; did you mean 'NAME'?" with the nearest candidate, or `otherwise` if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         const std::string& otherwise = {});

// "did you mean 'depth.bias'?", with that quote, if a rule is near; else the rules of the
// family that the word names; else where all are listed. Inside a family only what follows the
// point is compared, for "depth.test" is near to "depth.bias" by its family alone.
std::string rule_hint(std::string_view word, char quote);

}  // namespace cases
