// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case has that a plain one has not: one thing of it, and all.
#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

namespace fuzz {

enum class Trait : uint8_t {
    key,       // of its file
    far,       // a rectangle of its file that reaches beyond 15 bits
    relation,  // a claim of it
    several_draws,
    several_colors,
    several_samples,
    several_triangles,
    behind_the_eye,  // a vertex
    unequal_w,
    sloping_depth,
    // A triangle that may lose its area on a device's grid: the one trait that speaks of numbers.
    // What such a triangle shows, and in how many ways, hangs on each of them.
    thin_triangle,
};

struct Essential {
    Trait trait = Trait::key;
    std::string name =
        {};  // of a key and of what is far: "draw.color.blend"; of a relation its own
    std::string word = {};  // of a key: "triangle-fan", "true"; empty where it does not matter
    // Whether it is a key of the file whose name begins so.
    bool begins(std::string_view with) const;
    friend auto operator<=>(const Essential&, const Essential&) = default;
};
using Essentials = std::set<Essential>;

// "several draws", "relation doors", "draw.topology=triangle-fan", "draw.scissor beyond 32767".
std::string to_text(const Essential& essential);
// The essential of such a text. Any other text is the name of a key.
Essential parse_essential(std::string_view text);
// All texts, in alphabetical order, and the essentials of such texts.
std::set<std::string> to_texts(const Essentials& essentials);
Essentials parse_essentials(const std::set<std::string>& texts);

}  // namespace fuzz
