// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The oracle of paths: each by itself, from the first fragment to the last, with the stencil test
// and its operations bit by bit.
#pragma once

#include <vector>

#include "ref/path/path.hpp"

namespace ref::path::exact {

Resolution resolve(const Question& question);

// Every path of a question; none where there are too many steps on them.
std::vector<History> histories(const Question& question);

// Whether a path is one that satisfies what was observed.
bool satisfies(const History& history, const Observed& observed);

}  // namespace ref::path::exact
