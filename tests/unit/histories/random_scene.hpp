// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "histories.hpp"
#include "scene.hpp"

namespace histories {

// A scene of one to four draws with any state of the format, and one more that draws the last
// column whatever the others do, so that a picture of nothing is never right.
Scene random_scene(Random& random);

}  // namespace histories
