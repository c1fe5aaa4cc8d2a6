// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of one case: what is drawn and what is claimed of it. Everything that draws or judges
// starts from this structure; how it is written in a file is the loader's business (loader.hpp).
//
// Conventions: framebuffer origin top left, x right, y down; pixel (i,j) is [i,i+1) x [j,j+1). A
// vertex's truth is its clip-space quadruple of binary32 numbers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/error.hpp"

namespace cases {

enum class Topology : uint8_t { triangle_list, triangle_strip, triangle_fan };
enum class CullMode : uint8_t { none, front, back, front_and_back };
enum class FrontFace : uint8_t { counter_clockwise, clockwise };
enum class Interpolation : uint8_t { smooth, noperspective, flat };

inline constexpr uint32_t kMaxAttributes = 4;
inline constexpr uint32_t kMaxTargetSize = 16384;       // pixels a side
inline constexpr uint32_t kRestartIndex = 0xffffffffU;  // primitive restart, 32-bit indices
inline constexpr float kMaxAttributeMagnitude =
    0x1p126F;  // larger ones could look like the clear value

// As VkViewport: pixels; height may be negative; depths in [0,1].
struct Viewport {
    float x = 0, y = 0, width = 0, height = 0;
    float min_depth = 0, max_depth = 1;
    friend bool operator==(const Viewport&, const Viewport&) = default;
};

// As VkRect2D: half-open, pixels.
struct Rect {
    int32_t x = 0, y = 0;
    uint32_t width = 0, height = 0;
    friend bool operator==(const Rect&, const Rect&) = default;
};

// A fragment-shader input. values[v] belongs to vertex v; components beyond `components` are 0.
struct Attribute {
    std::string name;
    Interpolation interpolation = Interpolation::smooth;
    uint32_t components = 1;  // 1..4
    std::vector<glm::vec4> values;
};

// One draw command and the state it needs.
struct Draw {
    Topology topology = Topology::triangle_list;
    std::vector<glm::vec4> positions;  // clip space, binary32, bits as they reach the device
    std::optional<std::vector<uint32_t>> indices;
    bool primitive_restart = false;     // only with indices
    std::vector<Attribute> attributes;  // at most kMaxAttributes
    Viewport viewport;
    Rect scissor;  // the whole target unless the file says otherwise
    CullMode cull = CullMode::none;
    FrontFace front_face = FrontFace::counter_clockwise;
    SourceLocation where;
};

struct Target {
    uint32_t width = 0, height = 0;  // pixels
    uint32_t samples = 1;
    friend bool operator==(const Target&, const Target&) = default;
};

// A picture drawn by hand that the REFERENCE must agree with, checked before any device is asked.
// rows[j][i] is pixel (i,j): '.' no hit, '1'..'9' that many hits, '?' the reference must say that
// more than one number of hits is allowed. Judged at profile direct3d with 8 subpixel bits.
struct ExpectedHits {
    std::vector<std::string> rows;
    SourceLocation where;
};

struct Case {
    std::string id;  // path below the suite without .toml, plus ":key=value,..." for a matrix leaf
    SourceLocation where;
    std::string description;         // what is claimed
    std::string catches;             // which fault would break it; may be empty
    std::vector<std::string> rules;  // rule ids, rule.hpp
    std::vector<std::string> links;  // reports from the field
    std::vector<std::pair<std::string, std::string>> parameters;  // matrix leaf, in file order
    Target target;
    std::vector<Draw> draws;
    std::optional<ExpectedHits> expected_hits;
    std::vector<std::string> notes;  // conversions that rounded, one sentence each
};

}  // namespace cases
