// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Self-consistency: which other renderings of a case must agree with it bit for bit, whatever the
// device's freedom. [Vulkan, appendix Invariance: Rules 1, 2 and 4, Corollaries 1 and 2]
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cases/model/door.hpp"

namespace cases {

enum class RelationKind : uint8_t {
    same_twice,        // drawn again, in the same submission and in another
    scissor_tiles,     // every draw repeated under each scissor of a tiling of the target
    other_clears,      // attachments cleared to other values
    write_masks,       // one half of the attachments is not written, then the other half
    fewer_attributes,  // without the attributes, so with fewer colour attachments
    more_attributes,   // with copies of the attributes, so with more colour attachments
    door,              // through another way of the API
};
inline constexpr RelationKind kLastRelationKind = RelationKind::door;

struct Relation {
    RelationKind kind = RelationKind::same_twice;
    std::array<uint32_t, 2> tile{};  // scissor_tiles: width and height in pixels
    Door door = Door::none;          // door: which one
    static void fields(auto&& visit, auto&... r) {
        visit("kind", r.kind...);
        visit("tile", r.tile...);
        visit("door", r.door...);
    }
    friend bool operator==(const Relation&, const Relation&) = default;
};

// How a rendering differs from that of the case as it stands. Planes have their numbers of
// capture/capture.hpp; the colour target is neither masked nor cleared otherwise.
struct Variation {
    std::array<uint32_t, 2> tile{};  // not 0: every draw is repeated under each tile's scissor
    bool other_clears = false;       // of attachments
    bool other_depth_clear = false;  // of depth
    uint32_t masked = 0;             // bit k: plane k is not written
    bool masks_depth = false;        // depth is not written
    bool later = false;              // in a later submission than the case
    Door door = Door::none;
    std::vector<uint32_t> splits = {};  // split_of() every draw, if the door splits any
    static void fields(auto&& visit, auto&... v) {
        visit("tile", v.tile...);
        visit("other_clears", v.other_clears...);
        visit("other_depth_clear", v.other_depth_clear...);
        visit("masked", v.masked...);
        visit("masks_depth", v.masks_depth...);
        visit("later", v.later...);
        visit("door", v.door...);
        visit("splits", v.splits...);
    }
    friend bool operator==(const Variation&, const Variation&) = default;
};

}  // namespace cases
