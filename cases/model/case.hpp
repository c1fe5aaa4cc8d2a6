// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of one case: what is drawn (draw.hpp), to what (target.hpp), and what is claimed of it.
// Everything that draws or judges starts from this structure; how it is written in a file is the
// loader's business (loader.hpp).
//
// Conventions: framebuffer origin top left, x right, y down; pixel (i,j) is [i,i+1) x [j,j+1). A
// vertex's truth is its clip-space quadruple of binary32 numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/base/fields.hpp"
#include "cases/format/color_format.hpp"
#include "cases/model/draw.hpp"
#include "cases/model/relation.hpp"
#include "cases/model/target.hpp"

namespace cases {

// vkCmdBlitImage instead of draws. The destination is the colour target, Target::color, cleared
// first; the source is an image of its own, filled with a pattern (blit_source.hpp).
enum class BlitFilter : uint8_t { nearest, linear };
enum class BlitPattern : uint8_t {
    unique,  // every texel has other bits
    ramp,    // values grow to the right and downwards
};
// Two corners of a region in texels, in either order: x1 < x0 mirrors.
struct Corners {
    int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    static void fields(auto&& visit, auto&... c) {
        visit("x0", c.x0...);
        visit("y0", c.y0...);
        visit("x1", c.x1...);
        visit("y1", c.y1...);
    }
    friend bool operator==(const Corners&, const Corners&) = default;
};
struct Blit {
    ColorFormat source_format = ColorFormat::rgba8_unorm;
    uint32_t source_width = 0, source_height = 0;  // texels
    BlitPattern pattern = BlitPattern::unique;
    uint32_t seed = 1;
    BlitFilter filter = BlitFilter::nearest;
    Corners source, destination;  // each inside its image
    static void fields(auto&& visit, auto&... b) {
        visit("filter", b.filter...);
        visit("source_format", b.source_format...);
        visit("source_width", b.source_width...);
        visit("source_height", b.source_height...);
        visit("pattern", b.pattern...);
        visit("seed", b.seed...);
        visit("source_region", b.source...);
        visit("destination_region", b.destination...);
    }
    friend bool operator==(const Blit&, const Blit&) = default;
};

// A picture drawn by hand that the REFERENCE must agree with, checked before any device is asked.
// rows[j][i] is pixel (i,j): '.' no hit, '1'..'9' that many hits, '?' the reference must say that
// more than one number of hits is allowed. Judged at profile direct3d with 8 subpixel bits.
struct ExpectedHits {
    std::vector<std::string> rows;
    SourceLocation where;
    static void fields(auto&& visit, auto&... e) {
        visit("rows", e.rows...);
        visit("where", e.where...);
    }
};

// What a case file says of a case to its readers and to the reference. It alters no picture, so
// workers are not told of it.
struct Claim {
    SourceLocation where;
    std::string description;         // the claim, one sentence
    std::string catches;             // which fault would break it; may be empty
    std::vector<std::string> rules;  // rule ids, rule.hpp
    std::vector<std::string> links;  // reports from the field
    std::vector<std::pair<std::string, std::string>> parameters;  // matrix leaf, in file order
    std::optional<ExpectedHits> expected_hits;
    std::vector<std::string> notes;  // conversions that rounded, one sentence each
    static void fields(auto&& visit, auto&... c) {
        visit("where", c.where...);
        visit("description", c.description...);
        visit("catches", c.catches...);
        visit("rules", c.rules...);
        visit("links", c.links...);
        visit("parameters", c.parameters...);
        visit("expected_hits", c.expected_hits...);
        visit("notes", c.notes...);
    }
};

struct Case {
    std::string id;  // path below the suite without .toml, plus ":key=value,..." for a matrix leaf
    Claim claim;
    Target target;
    std::vector<Draw> draws;
    std::optional<Blit> blit = {};         // then there are no draws
    std::vector<Relation> relations = {};  // renderings that must have the same bits
    std::vector<Door> doors = {};          // the same, asked for by a run instead of the file
    Variation variation = {};  // of such a rendering, derive.hpp; neither in files nor on the wire
    static void fields(auto&& visit, auto&... c) {
        visit("id", c.id...);
        visit({"claim", kNotOnWire}, c.claim...);
        visit("target", c.target...);
        visit("draws", c.draws...);
        visit("blit", c.blit...);
        visit("relations", c.relations...);
        visit({"doors", kNotExported}, c.doors...);
        visit({"variation", kNotOnWire}, c.variation...);  // the worker makes it of relations
    }
};

}  // namespace cases
