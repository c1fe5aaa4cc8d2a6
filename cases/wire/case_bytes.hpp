// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case as bytes, for the pipe between the parent process and its workers (same machine, same
// program, so no versioning beyond a magic number).
#pragma once

#include <span>
#include <string>

#include "cases/model/case.hpp"

namespace cases {

// What a renderer needs of a case: all fields but those marked kNotOnWire, float bits as they are.
std::string to_bytes(const Case& c);
Expected<Case> from_bytes(std::span<const char> bytes);

}  // namespace cases
