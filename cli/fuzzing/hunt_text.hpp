// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a hunt says on standard output.
#pragma once

#include <filesystem>

#include "fuzz/ledger.hpp"

namespace cli {

// A cause: what is wrong, the file of its smallest case, and what that needs.
void tell_cause(const fuzz::Entry& entry, const std::filesystem::path& folder);

// How many cases were judged, how fast, and by how many causes they failed. `starts`: the cases
// that the hunt started from, 0 if it made its own.
void tell_counts(const fuzz::Ledger& ledger, size_t starts);

}  // namespace cli
