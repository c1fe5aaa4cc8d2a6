// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Devices that take a case for another one: some state is ignored, exchanged, lost or a little off.
// What the faults of the software device (rasterizers/software/choice) have already is left to
// them. The rows stand in one file for each part of a case.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "diagnosis/hypothesis.hpp"

namespace diagnosis::as_if {

using cases::Case;
using cases::Draw;

struct Row {
    std::string_view name, what;
    Change change;
    PictureChange after = nullptr;
};

std::span<const Row> geometry_rows();  // viewport, scissor, draws and their vertices, facing
std::span<const Row> input_rows();     // inputs, samples, clip and cull distances
std::span<const Row> depth_rows();
std::span<const Row> target_rows();  // colour, the whole picture, blits

// Changes draws one by one; true if one was changed.
inline bool each(Case& c, bool (*change)(Draw&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = change(d) || is_changed;
    }
    return is_changed;
}

// Sets a field; true if it had another value.
template <class T, class U = T>
bool set(T& field, const U& value) {
    if (std::equal_to<>()(field, value)) {
        return false;
    }
    field = value;
    return true;
}

template <class T>
bool exchange(T& field, const T& a, const T& b) {
    if (field == a) {
        field = b;
        return true;
    }
    return field == b && set(field, a);
}

inline bool always(Case&) {
    return true;
}

}  // namespace diagnosis::as_if
