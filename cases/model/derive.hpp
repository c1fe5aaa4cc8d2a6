// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Derives the other renderings that the relations of a case speak of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

// One rendering that must agree with the case bit for bit, except where its variation says
// otherwise.
struct Derivation {
    std::string name;  // as a report shows it: "scissor-tiles 7x3"
    std::string_view rule;
    RelationKind kind = RelationKind::same_twice;
    Variation variation;
};

// The renderings of all relations of a case, in their order; same-twice and write-masks have two.
std::vector<Derivation> derivations(const Case& c);

// Whether a case claims rules of doors and no others: without its doors it shows nothing.
bool claims_doors_alone(const Case& c);

// What is drawn for one of them: the case with the variation, without relations.
Case derive(const Case& c, const Derivation& derivation);

// Whether a device draws the target with another depth: binary32 beside a stencil, in a file that
// names no format. Vulkan asks of D24S8 and D32S8 for one alone ("Required Format Support").
bool takes_depth_beside_stencil(const Target& target, DepthFormat beside_stencil);

// What stands for a clear among the draws: a triangle over the target that passes every test, with
// the depth, the stencil and the colour that the clear writes, and leaves alone what it does not.
Draw clear_draw(const Target& target, Clear clear, uint32_t layer);

// The largest number of attributes among the draws.
uint32_t attributes_of(const Case& c);

// Whether the third and the fourth number of an attribute are +0 at every vertex, whatever the
// probe: their values, derivatives and sums are 0 then, of either sign (SignedZeroInfNanPreserve is
// not asked for). Renderers may leave them out.
bool has_two_numbers(const Attribute& a);

// What a draw writes to the colour target of a location (below Target::color_count()).
const ColorOutput& output_at(const Target& target, const Draw& draw, uint32_t location);
// The blend constants, which a device has once for all targets: those of an output that blends.
glm::vec4 blend_constants(const Draw& draw);
// The attributes that are drawn without instruments, each once: those that are colours, in the
// order of the locations, or at which a texture is read, then the one whose sign discards.
std::vector<uint32_t> drawn_attributes(const Target& target, const Draw& draw);

// The word of a relation in a case file.
std::string_view to_string(RelationKind kind);

// Counts the tiles of a scissor-tiles relation; every draw has as many.
uint64_t tile_count(const Target& target, const Relation& relation);

}  // namespace cases
