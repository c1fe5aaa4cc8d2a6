// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/color_memory.hpp"

#include <cmath>

namespace ref::color {

Color color_of(const Source& source) {
    Color out;
    for (size_t k = 0; k < 4; ++k) {
        out[k] = std::isinf(source.low[k])
                     ? Component::anything()
                     : Interval{mpq_class(source.low[k]), mpq_class(source.high[k])};
    }
    return out;
}

std::optional<uint32_t> ColorMemory::name_of(uint32_t draw, bool masked, const Source& source) {
    const Fragment fragment{draw, masked, source};
    if (const auto found = names_.find(fragment); found != names_.end()) {
        return found->second;
    }
    if (names_.size() >= capacity_) {
        return std::nullopt;
    }
    return names_.emplace(fragment, static_cast<uint32_t>(names_.size())).first->second;
}

}  // namespace ref::color
