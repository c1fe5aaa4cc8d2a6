// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fast way of most samples: where nothing is open there is one path, and no search.
#pragma once

#include <optional>

#include "ref/path/path.hpp"

namespace ref::path {

// The one path of a question of which nothing is open, as resolve() has it; nothing if something
// is.
std::optional<Resolution> resolve_certain(const Question& question);

}  // namespace ref::path
