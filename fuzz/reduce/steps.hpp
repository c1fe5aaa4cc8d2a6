// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of the reducer: ways to make a document simpler, in the order of what makes it easiest
// for a person first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/document/document.hpp"

namespace fuzz {

// Kinds of steps, the most valuable first.
enum class Stage : uint8_t {
    draws,      // fewer draws
    triangles,  // fewer triangles, and vertices that are in none
    topology,   // lists without indices
    features,   // one sample, one layer, no colour, no relations
    inputs,     // fewer attributes, clip and cull distances
    keys,       // keys left out, and what is told inside of them
    sources,    // attributes from plain values, the same at each vertex, of fewer components
    space,      // vertices in pixels, without z and w
    target,     // a smaller target
    positions,  // rounder positions
    values,     // rounder numbers anywhere else
};

inline constexpr std::array<Stage, 11> kStages = {
    Stage::draws,   Stage::triangles, Stage::topology, Stage::features,  Stage::inputs, Stage::keys,
    Stage::sources, Stage::space,     Stage::target,   Stage::positions, Stage::values};

// When a step goes before others that are put together with it, all made for the same document:
// what moves numbers of draws, vertices and attributes comes last.
enum class Phase : uint8_t { in_place, removal, reshape, draws, target };

struct Step {
    Stage stage = Stage::draws;
    Phase phase = Phase::in_place;
    std::string words = {};  // "draw 0 without scissor"
    std::string need = {};   // "not without scissor in draw 0", or nothing
    // What a removal removes: elements [begin, end) of list `of` in that draw.
    size_t draw = 0, begin = 0, end = 0;
    std::string_view of = {};
    // Changes the document; false if it has no such part (any more).
    std::function<bool(Document&)> apply;
};

// All steps of a stage that a document may take. Some may lead to what does not load or is not
// simpler.
std::vector<Step> steps_of(const Document& document, Stage stage);

// --- the stages; each appends its steps ---
void add_draw_steps(const Document& document, std::vector<Step>& steps);
void add_triangle_steps(const Document& document, std::vector<Step>& steps);
void add_topology_steps(const Document& document, std::vector<Step>& steps);
void add_feature_steps(const Document& document, std::vector<Step>& steps);
void add_input_steps(const Document& document, std::vector<Step>& steps);
void add_key_steps(const Document& document, std::vector<Step>& steps);
void add_source_steps(const Document& document, std::vector<Step>& steps);
void add_space_steps(const Document& document, std::vector<Step>& steps);
void add_target_steps(const Document& document, std::vector<Step>& steps);
void add_position_steps(const Document& document, std::vector<Step>& steps);
void add_value_steps(const Document& document, std::vector<Step>& steps);

// --- what the parts share ---
size_t draw_count(const Document& document);
// The table of that draw, or nullptr.
Document* draw_at(Document& document, size_t draw);
// The words and the need of a step in a draw; a draw that is alone is not named.
void name_in_draw(const Document& document, size_t draw, const std::string& what, Step& step);
// Appends a step of a draw.
Step& add_in_draw(const Document& document, size_t draw, const std::string& what,
                  std::function<bool(Document&)> apply, std::vector<Step>& steps);

// Halves, quarters, ... and single ones of `count` things as [begin, end), the largest first; not
// all of them at once.
struct Range {
    size_t begin = 0, end = 0;
};
std::vector<Range> parts_of(size_t count);

}  // namespace fuzz
