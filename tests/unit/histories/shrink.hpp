// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "planes.hpp"
#include "scene.hpp"

namespace histories {

// A scene and what one sample of it shows.
struct Finding {
    Scene scene;
    Planes planes;
    Shown sample;
};

// The same with fewer draws, triangles, states and planes, as long as `is_still` says so of it.
Finding shrunk(Finding finding, const std::function<bool(const Finding&)>& is_still);

}  // namespace histories
