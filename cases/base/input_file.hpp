// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that a stranger may have made: whole, ordinary, and inside the folder that was named.
#pragma once

#include <filesystem>
#include <string>

#include "cases/base/error.hpp"

namespace cases {

// Whether a file that the user names may be a pipe, too ('<(zcat sheet.json.gz)').
enum class Pipes { refused, read };

// All bytes of a file, links followed. A pipe without a writer is empty, so nothing waits for ever.
// The error is the reason alone: it cannot be opened or read, is no ordinary file, or is larger
// than 256 MiB.
Expected<std::string> read_file(const std::filesystem::path& file, Pipes pipes = Pipes::refused);

// Where `file`, which stands below `folder`, truly is: links may lead to it, but not out of the
// folder (which may be a link itself). The error is the reason alone.
Expected<std::filesystem::path> place_inside(const std::filesystem::path& folder,
                                             const std::filesystem::path& file);

// read_file() of place_inside().
Expected<std::string> read_inside(const std::filesystem::path& folder,
                                  const std::filesystem::path& file);

}  // namespace cases
