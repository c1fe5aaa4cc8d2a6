// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "histories.hpp"
#include "planes.hpp"
#include "scene.hpp"

namespace histories {

// A right picture with one sample that no history shows in these planes, or with a wrong count.
struct WrongPicture {
    std::vector<Shown> picture;
    Planes planes;
    size_t index = 0;
    std::vector<uint64_t> counted;                      // by queries
    std::string how;                                    // it was made
    cases::Profile loosest = cases::Profile::direct3d;  // at which it is wrong
};

// `picture` is right at every profile. Nothing if what was tried is all allowed.
std::optional<WrongPicture> wrong_picture(const Scene& scene, const std::vector<Seen>& picture,
                                          Random& random);

}  // namespace histories
