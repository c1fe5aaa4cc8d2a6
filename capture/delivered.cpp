// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/delivered.hpp"

#include <algorithm>

namespace capture {

bool Delivered::is_empty() const {
    return detail == HitDetail::none && draws.empty() && frag_coord.empty() && depth.empty() &&
           color.empty() && stencil.empty() &&
           std::ranges::all_of(attributes, [](const auto& plane) { return plane.empty(); });
}

}  // namespace capture
