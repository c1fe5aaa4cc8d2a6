// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/base/datasheet.hpp"

#include <algorithm>

namespace probe {

const Property* Datasheet::find(std::string_view id) const {
    const auto it = std::ranges::find_if(properties, [&](const auto& p) { return p.id == id; });
    return it == properties.end() ? nullptr : &*it;
}

std::string_view Datasheet::answer(std::string_view id) const {
    const Property* found = find(id);
    return found == nullptr ? kCannotTell : std::string_view(found->answer);
}

}  // namespace probe
