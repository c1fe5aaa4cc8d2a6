// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes a case that shows a finding as small as it can be while it still shows it. What shows it is
// asked of the caller, many candidates at once.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "fuzz/document/document.hpp"

namespace fuzz {

// A case that may show the finding still, and the text of its file.
struct Candidate {
    std::string text;
    cases::Case data;
};
// For each of some candidates: whether it shows the finding. As many answers.
using Shows = std::function<std::vector<bool>(const std::vector<Candidate>& candidates)>;

struct ReduceOptions {
    size_t batch = 64;          // texts that are asked about at once, at least 1
    size_t most_rounds = 2000;  // calls of Shows
    // True, from some time on, ends the reduction; the answers of a call that it ended do not
    // count.
    std::function<bool()> is_over = {};
};

struct Reduced {
    Document document;
    // What the finding needs: the neighbours of the document that do not show it, in words ("not
    // with 1 sample", "not without blend").
    std::vector<std::string> needs;
    std::vector<std::string> need_texts;  // what was asked about for each of them
    std::vector<std::string> steps;       // that were taken, in words, in this order
    size_t tried = 0;                     // texts that were asked about
    size_t rounds = 0;                    // calls of Shows
    bool is_minimal = false;              // nothing in simpler(document) shows the finding
};

// The document must show the finding itself, which is not asked. Is a function of its arguments and
// of the answers alone. No text is asked about twice.
Reduced reduce(Document document, const Shows& shows, const ReduceOptions& options = {});

}  // namespace fuzz
