// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What one fragment carries, and from what a device may have set it up.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <string>

#include "cases/model/case.hpp"

namespace ref {

// What the device drew at one sample.
struct FragmentValues {
    glm::vec4 frag_coord{};
    float depth = 0;
    std::array<glm::vec4, cases::kMaxAttributes> attributes{};
};

// What the device may have set its planes up from.
enum class BasisKind : uint8_t { unsnapped, snapped, clipped_piece };

// Which number of a fragment: a component of an attribute or of FragCoord, or the depth.
struct QuantityId {
    enum class Of : uint8_t { attribute, frag_coord, depth };
    Of of = Of::depth;
    uint8_t attribute = 0;  // index into Draw::attributes
    uint8_t component = 0;  // 0..3: x, y, z, w

    static QuantityId of_attribute(size_t attribute, size_t component) {
        return {Of::attribute, static_cast<uint8_t>(attribute), static_cast<uint8_t>(component)};
    }
    static QuantityId of_frag_coord(size_t component) {
        return {Of::frag_coord, 0, static_cast<uint8_t>(component)};
    }
    bool is_attribute() const { return of == Of::attribute; }
    bool is_depth() const { return of == Of::depth; }
    friend bool operator==(const QuantityId&, const QuantityId&) = default;
};
// As reports show it: "attribute 1.x", "frag_coord.w", "depth".
std::string to_text(const QuantityId& id);

// The number that a fragment has for it.
float& number_of(FragmentValues& values, const QuantityId& id);
float number_of(const FragmentValues& values, const QuantityId& id);

}  // namespace ref
