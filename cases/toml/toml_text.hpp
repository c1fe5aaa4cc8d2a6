// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The way back from read_toml: a document as a readable case file.
#pragma once

#include <string>

#include "cases/toml/toml_reader.hpp"

namespace cases {

// Reading it gives the same tree. Keys stand in the order of their rows (cases/key/key.hpp),
// vertices after the state of a draw. Floats have the fewest digits that read back as the same
// binary64.
std::string to_text(const TomlValue& document);

}  // namespace cases
