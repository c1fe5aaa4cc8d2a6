// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tables of changes are made of; the tables stand in a file for each part of a case.
#pragma once

#include <functional>
#include <span>
#include <variant>

#include "cases/fault/fault.hpp"
#include "cases/model/case.hpp"

namespace cases::fault {

// A change of a case: of the whole, or one by one of its draws (clears are none), attributes,
// positions, depth biases, faces of the stencil, blendings, equations of these. Each says whether
// it changed anything.
template <class Part>
using ChangeOf = bool (*)(Part&);
struct Body {
    Fault fault;
    std::variant<ChangeOf<Case>, ChangeOf<Draw>, ChangeOf<Attribute>, ChangeOf<glm::vec4>,
                 ChangeOf<DepthBias>, ChangeOf<StencilFace>, ChangeOf<Blend>,
                 ChangeOf<BlendEquation>>
        change;
};

std::span<const Body> geometry_bodies();  // viewport, scissor, draws and their vertices, facing
std::span<const Body> input_bodies();     // inputs, samples, clip and cull distances
std::span<const Body> depth_bodies();     // depth and stencil
std::span<const Body> clear_bodies();     // clears among the draws
std::span<const Body> target_bodies();    // colour, blits

// Sets a field; true if it had another value.
template <class T, class U = T>
bool set(T& field, const U& value) {
    if (std::equal_to<>()(field, value)) {
        return false;
    }
    field = value;
    return true;
}
// Sets a field that has the value `from`.
template <class T>
bool replace(T& field, const T& from, const T& to) {
    return field == from && set(field, to);
}
template <class T>
bool exchange(T& field, const T& a, const T& b) {
    return replace(field, a, b) || replace(field, b, a);
}

// Changes the entries of a list one by one; true if one was changed.
template <class List, class ChangeOne>
bool any_of(List& list, const ChangeOne& change) {
    bool is_changed = false;
    for (auto& entry : list) {
        is_changed = change(entry) || is_changed;
    }
    return is_changed;
}

// The same of draws; clears are none.
template <class ChangeOne>
bool any_of(std::vector<Draw>& draws, const ChangeOne& change) {
    bool is_changed = false;
    for (Draw& draw : draws) {
        is_changed = (!draw.clear && change(draw)) || is_changed;
    }
    return is_changed;
}

}  // namespace cases::fault
