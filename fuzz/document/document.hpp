// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case file as a tree that can be changed and written again.
#pragma once

#include <string>
#include <string_view>

#include "cases/toml/toml_reader.hpp"

namespace fuzz {

using Document = cases::TomlValue;

// A case file's text: what it is about first, then the target, then the draws. Reading it gives the
// same tree but for the order of keys, the places, and that whole floats are written as integers,
// which mean the same.
std::string to_text(const Document& document);

// The entry of a key, or nullptr.
Document* find(Document& table, std::string_view key);
// Removes a key; false if there is none.
bool erase(Document& table, std::string_view key);
// Sets a key, at the end if it is new.
void set(Document& table, std::string_view key, Document value);

Document number(double value);
Document array(std::vector<Document> elements);
// Of an integer or a float; 0 for anything else.
double number_of(const Document& value);

}  // namespace fuzz
