// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case file as a tree that can be changed and written down again.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cases/toml/toml_reader.hpp"

namespace fuzz {

using Document = cases::TomlValue;
using Kind = Document::Kind;

// --- making values ---
// An integer if the number is whole, below 2^53 in magnitude and not -0; a float otherwise. A NaN
// with a sign is the word "-nan": TOML's floats lose it.
Document number(double value);
Document text(std::string value);
Document boolean(bool value);
Document list(std::vector<Document> elements);
Document numbers(const std::vector<double>& values);
Document table();

// --- changing tables ---
// The entry of that key, or nullptr; of a value that is no table, too.
Document* find(Document& table, std::string_view key);
// Replaces the entry of that key where it stands, or adds one at the end.
Document& set(Document& table, std::string_view key, Document value);
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

// The document as a readable case file. Reading it gives the same tree. Keys stand in the order of
// their rows (cases/key/key.hpp), vertices after the state of a draw. Floats have the fewest digits
// that read back as the same binary64.
std::string to_text(const Document& document);

}  // namespace fuzz
