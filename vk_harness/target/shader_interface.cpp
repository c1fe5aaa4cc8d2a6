// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/shader_interface.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"

namespace vk_harness {

uint32_t input_count(const cases::Case& c) {
    if (c.target.has_instruments) {
        return cases::attributes_of(c);
    }
    return std::any_of(c.draws.begin(), c.draws.end(),
                       [](const cases::Draw& draw) { return draw.color.attribute >= 0; })
               ? 1
               : 0;
}

const cases::Attribute* input_attribute(const cases::Case& c, const cases::Draw& draw,
                                        uint32_t input) {
    const int64_t index = c.target.has_instruments ? int64_t{input} : draw.color.attribute;
    return index >= 0 && index < std::ssize(draw.attributes)
               ? &draw.attributes[static_cast<size_t>(index)]
               : nullptr;
}

uint32_t viewport_count(const cases::Case& c) {
    uint32_t count = 1;
    for (const cases::Draw& draw : c.draws) {
        count = std::max(count, draw.viewport_index + 1);
    }
    return count;
}

bool names_layers(const cases::Case& c) {
    return std::any_of(c.draws.begin(), c.draws.end(),
                       [](const cases::Draw& draw) { return draw.layer > 0; });
}

}  // namespace vk_harness
