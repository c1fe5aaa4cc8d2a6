// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes a failing case as small as it can be while it shows what it shows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fuzz/document/document.hpp"

namespace fuzz {

// For each text, a case that loads, whether it still shows it.
using Shows = std::function<std::vector<bool>(const std::vector<std::string>& texts)>;

struct ReduceOptions {
    size_t batch = 64;        // texts asked about at once, at most
    size_t most_rounds = 80;  // a round ends with a smaller case, or is the last one
};

struct Reduced {
    Document document;
    // What the case needs, as its nearest neighbours that do not show it: "not with 1 sample".
    std::vector<std::string> needs;
    size_t rounds = 0, tried = 0;
    bool is_minimal = false;  // no step of edits() makes it smaller and still shows it
};

// `document` is a case of one leaf that shows it. The same document and answers give the same
// result. Each round takes the most valuable step that still shows it, and on top of it as many of
// the others as go with it. Every step makes the case smaller in an order without an infinite
// descent: draws, triangles, keys, samples of the target, length of the text, its digits.
Reduced reduce(Document document, const Shows& shows, const ReduceOptions& options = {});

}  // namespace fuzz
