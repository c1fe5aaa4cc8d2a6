// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a case as a case file (docs/cases.md), the way back from load_text.
#pragma once

#include <cstddef>
#include <string>

#include "cases/model/case.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// A file of more is for programs: of all draws, as is kMaxWrittenIndices, which is six a vertex,
// since a closed mesh has two triangles a vertex.
inline constexpr size_t kMaxWrittenVertices = 4096;
inline constexpr size_t kMaxWrittenIndices = 6 * kMaxWrittenVertices;

// The document of a file without a matrix that loads to this case: to the same bytes (wire/), words
// for readers and expected hits. What a file says of itself (id, place, matrix leaf, notes) is not
// in it, nor are generators, expressions and transformations, of which the model holds the results.
// Keys at their default are left out. The vertices of a draw are written in pixels if that gives
// the same clip-space bits, otherwise in clip space. The document is loaded again and compared
// before it is returned. A case that is too large or that no file can say is an error.
Expected<TomlValue> to_tree(const Case& c);
// The same as text.
Expected<std::string> to_toml(const Case& c);

}  // namespace cases
