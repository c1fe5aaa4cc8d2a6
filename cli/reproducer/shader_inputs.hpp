// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The shaders of a reproducer's draws, as the harness makes them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "shaders/shaders.hpp"

namespace cli {

// What the shaders of a draw are compiled for and fed with. All draws of a case have as many
// inputs, so that the colour target is the same attachment for all of them.
struct Inputs {
    std::vector<const cases::Attribute*> attributes;  // null: the draw has none there
    bool has_instruments = true;
    shaders::ColorKind color = shaders::ColorKind::none;

    // The fragment shader, its inputs interpolated as the attributes are; empty if the build made
    // none.
    std::vector<uint32_t> fragment_code(const cases::Draw& d) const;
    // The specialization constant of input k: what of it is written.
    uint32_t choice(size_t k) const;
};
Inputs inputs_of(const cases::Case& c, const cases::Draw& d);

// The vertex shader, which writes gl_Layer if any draw of the case names a layer; empty if the
// build made none.
std::span<const uint32_t> vertex_code(const cases::Case& c, const cases::Draw& d);

// Whether the build made a shader for each draw of the case and of the drawings that it is compared
// with.
bool has_shaders(const cases::Case& c);

}  // namespace cli
