// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of a reduction: each makes a case file simpler in one way.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fuzz/document/document.hpp"

namespace fuzz {

struct Edit {
    std::string what;  // "without draw 1", "with 1 sample", "draw 0: without scissor"
    // It takes something away that a plain case has not: if the failure needs it, that is worth
    // telling.
    bool is_feature = false;
    // False if it changes nothing, or does not apply.
    std::function<bool(Document&)> apply;
};

// All steps for a document, those first that make it easiest for a person. A result need not be a
// case: the loader says so.
std::vector<Edit> edits(const Document& document);

}  // namespace fuzz
