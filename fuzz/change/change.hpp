// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One change of a case, drawn by dice. Whether the result is a case is for the loader to say.
#pragma once

#include <string>
#include <string_view>

#include "cases/key/key.hpp"
#include "fuzz/document/document.hpp"
#include "fuzz/generate/dice.hpp"

namespace fuzz {

// What was changed, in words for people. Empty: nothing, as the document has no such part. `other`
// is another case, of which draws and triangles are borrowed; it may be nullptr.
using Words = std::string;

// What costs a driver a pipeline or an attachment: keys of the target and of draws, attributes,
// distances, relations, draws.
Words change_state(Document& document, Dice& dice, const Document* other);
// What does not: vertices and indices, viewports, scissors, numbers of any key.
Words change_geometry(Document& document, Dice& dice, const Document* other);

// --- parts of changes of a state: depth bounds, gl_FragDepth, logical operations and alpha,
// queries, stencil states, and what a blit has instead of draws ---
Words change_bounds(Document& document, Document& draw, Dice& dice);
Words change_frag_depth(Document& document, Document& draw, Dice& dice);
Words change_query(Document& document, Document& draw, Dice& dice);
Words change_codes(Document& document, Document& draw, Dice& dice);
Words change_fragment_size(Document& document, Document& draw, Dice& dice);
Words change_stencil(Document& document, Dice& dice);
Words change_blit(Document& document, Dice& dice);

// --- what the parts share ---
// A draw of the document, or nullptr; its words are "draw 2 ", or nothing if it is the only one.
Document* any_draw(Document& document, Dice& dice, Words& words);
// Changes any draw of the document; nothing if it has none.
Words change_draw(Document& document, Dice& dice,
                  Words (*change)(Document& document, Document& draw, Dice& dice));
// The colour of the target or of a draw, unless it is a list of several.
Document* color_table(Document& table);
inline std::string_view any_of(cases::Words words, Dice& dice) {
    return words[dice.below(words.size())];
}
// Gives a key any of the values that its row has to try; "key = value", or nothing without a row.
Words set_any(Document& table, const cases::KeyTable& keys, std::string_view name, Dice& dice);
// Another number, near to a value or simpler.
double other_number(double value, Dice& dice);
// Replaces a number by another one; false if it is none. `is_binary32`: it has to be one.
bool change_number(Document& value, Dice& dice, bool is_binary32);
// Calls visit(array) for each array of the draw that has one entry a vertex, but for the vertices.
template <class Visit>
void for_each_values(Document& draw, Visit&& visit) {
    for (const char* key : {"attribute", "clip_distance", "cull_distance"}) {
        if (Document* list = find(draw, key)) {
            for (Document& entry : list->array) {
                if (Document* values = find(entry, "values")) {
                    visit(*values);
                }
            }
        }
    }
}
// Appends the vertices of one draw to those of another; false if they do not go together.
bool append_vertices(Document& draw, const Document& from);

}  // namespace fuzz
