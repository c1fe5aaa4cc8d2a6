// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that are written whole or not at all: whatever the disk or a signal does, the name holds
// the old file or the new one.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "cases/base/error.hpp"

namespace cases {

// A text that is too long to be held at once is told piece after piece.
using Put = std::function<void(std::string_view piece)>;
using Tell = std::function<void(const Put& put)>;

// What becomes of a link that has the file's name. A file that the user names is written where its
// link leads; in a folder of ours the new file takes the link's place.
enum class Link { followed, replaced };

// Puts a new file in the place of `file`. With Link::followed it gets the owner and the permissions
// of the old one, and is written in place where no new file can take it: a device, a pipe, a folder
// that takes no file, an owner that cannot be kept. The error is the reason alone.
Expected<void> write_file(const std::filesystem::path& file, Link link, const Tell& tell);

// Tells the pieces to a descriptor; the error is the reason alone.
Expected<void> write_to(int fd, const Tell& tell);

// Makes the folders between `folder` and `file`, which stands below it. Error: one is a link or
// something else, so that the file would stand elsewhere, or cannot be made.
Expected<void> make_folders(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace cases
