// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a value stands in a document: the keys and numbers that lead to it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "fuzz/document/document.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

struct Path {
    std::vector<std::variant<std::string, size_t>> parts;

    Path operator+(const std::string& key) const;
    Path operator+(size_t element) const;
};

// The value there, or nullptr.
Document* at(Document& document, const Path& path);

// The path for people, without `draw` and its number: "attribute 0 probe", "scissor[2]", "x of
// vertex 3"; empty for a draw and for the file.
std::string words_of(const Path& path);

// The words and the need of a step at that path. "{}" in `what` stands for the words of the path
// and a blank behind them; a draw is named too if there are several.
void name_at(const Document& document, const Path& path, const std::string& what, Step& step);

}  // namespace fuzz
