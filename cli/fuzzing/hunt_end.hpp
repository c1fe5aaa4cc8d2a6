// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How a hunt ends.
#pragma once

#include <filesystem>

#include "fuzz/hunt.hpp"
#include "fuzz/ledger.hpp"

namespace cli {

// Tells what was found and what is left, writes the cases that could not be judged or did not fail
// again, and returns the exit code. `starts`: as of tell_counts.
int end_hunt(fuzz::Hunt& hunter, fuzz::Hunt::State state, const fuzz::Ledger& ledger,
             const std::filesystem::path& folder, size_t starts);

}  // namespace cli
