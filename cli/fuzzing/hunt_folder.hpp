// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a hunt writes: its ledger, and a file for each cause.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/options/stop.hpp"
#include "fuzz/entry.hpp"

namespace cli {

// Makes the folder, and holds it against another hunt until the program ends. Errors (2): it cannot
// be made, or another hunt holds it.
void open_hunt_folder(const std::filesystem::path& path);

// Gives the entry a file name in this folder below that of the hunt, which no other of the entries
// and no file has.
void name_file(fuzz::Entry& entry, const std::string& below,
               const std::vector<fuzz::Entry>& entries, const std::filesystem::path& folder);

}  // namespace cli
