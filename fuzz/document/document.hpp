// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case file as a tree that can be changed.
#pragma once

#include <algorithm>
#include <string_view>

#include "cases/toml/toml_text.hpp"
#include "cases/toml/toml_tree.hpp"

namespace fuzz {

using Document = cases::TomlValue;
using Kind = Document::Kind;

using cases::tree::boolean;
using cases::tree::find;
using cases::tree::list;
using cases::tree::number;
using cases::tree::numbers;
using cases::tree::set;
using cases::tree::table;
using cases::tree::text;

// Whether there was such an entry.
bool erase(Document& table, std::string_view key);
// Removes an element of a list, and with its last one the key; false if there is none.
bool erase_at(Document* table, std::string_view key, size_t element);
// Removes the colour target with all that needs one; false if there is none.
bool erase_color(Document& document);
// Calls change(draw) for each draw.
template <class Change>
void for_each_draw(Document& document, Change&& change) {
    if (Document* draws = find(document, "draw")) {
        std::ranges::for_each(draws->array, change);
    }
}

// Whether two trees say the same: kinds, values (floats by their bits, all NaNs alike) and
// keys, in any order. Where they stand in files does not matter.
bool is_same(const Document& a, const Document& b);

}  // namespace fuzz
