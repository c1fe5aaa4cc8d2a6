// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "histories.hpp"

namespace histories {

// What the queries of a picture's draws count; empty if there is none.
std::vector<uint64_t> counted_of(const Scene& scene, const std::vector<Seen>& picture);

// Another count of one draw, that no histories of the samples have which show the picture.
struct WrongCount {
    std::vector<uint64_t> counted;
    size_t draw = 0;
    cases::Profile loosest = cases::Profile::direct3d;
};
std::optional<WrongCount> wrong_count(const Scene& scene, const std::vector<Seen>& picture,
                                      Random& random);

}  // namespace histories
