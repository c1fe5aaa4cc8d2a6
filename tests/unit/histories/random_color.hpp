// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "histories.hpp"
#include "scene.hpp"

namespace histories {

// The colour targets of a scene, and whether anything else is attached.
void give_targets(Scene& scene, Random& random);
// What a draw does to them, of numbers that their formats hold.
void give_colors(const Scene& scene, Draw& draw, Random& random);
// Other numbers than the clear ones, whatever is stored.
void give_control_colors(const Scene& scene, Draw& draw);

}  // namespace histories
