// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of a case file: load_*.cpp read them. A mistake goes to the context, and what is
// returned then means nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// Mistakes end up in the context; the target then has no width.
Target load_target(LeafContext& context, const TomlValue& table);

// Reads `fragment_size` of a draw; and what it must be beside the rest of the draw, once that is
// known.
void read_fragment_size(LeafContext& context, const TomlValue& table, Draw& draw);
void check_fragment_size(LeafContext& context, const TomlValue& table, const Draw& draw,
                         const Target& target);

// In the note of a list whose last vertices are too few for a triangle.
inline constexpr char kLeftOver[] = "make no triangle";

// One [[draw]] table. `index` of the draw, from 0, stands in notes. Mistakes go to the context; the
// result is then meaningless.
Draw load_draw(LeafContext& context, const TomlValue& table, const Target& target, size_t index,
               std::vector<std::string>& notes);
// A [[draw]] with the key `clear`; `value` is its table.
Draw load_clear(LeafContext& context, const TomlValue& table, const TomlValue& value,
                const Target& target);

// The table [blit] of a case whose target has been read: a colour target alone.
std::optional<Blit> load_blit(LeafContext& context, const TomlValue& table, const Target& target);

// What load and store operations ask of the draws of a case that has been read; `table` is
// [target].
void check_kept(LeafContext& context, const TomlValue& table, const Case& c);

// Reads the relations of a case whose target and draws have been read.
std::vector<Relation> load_relations(LeafContext& context, const TomlValue& value, const Case& c);

}  // namespace cases
