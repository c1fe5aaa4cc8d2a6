// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/shader_interface.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"

namespace vk_harness {

uint32_t input_count(const cases::Case& c) {
    if (c.target.has_instruments) {
        return cases::attributes_of(c);
    }
    size_t count = 0;
    for (const cases::Draw& draw : c.draws) {
        count = std::max(count, cases::drawn_attributes(c.target, draw).size());
    }
    return static_cast<uint32_t>(count);
}

const cases::Attribute* input_attribute(const cases::Case& c, const cases::Draw& draw,
                                        uint32_t input) {
    size_t index = input;
    if (!c.target.has_instruments) {
        const std::vector<uint32_t> drawn = cases::drawn_attributes(c.target, draw);
        index = input < drawn.size() ? drawn[input] : draw.attributes.size();
    }
    return index < draw.attributes.size() ? &draw.attributes[index] : nullptr;
}

namespace {

// Without instruments, where only some attributes are inputs.
uint32_t input_of(const cases::Case& c, const cases::Draw& draw, uint32_t attribute) {
    const std::vector<uint32_t> drawn = cases::drawn_attributes(c.target, draw);
    return static_cast<uint32_t>(std::ranges::find(drawn, attribute) - drawn.begin());
}

}  // namespace

int32_t input_of_color(const cases::Case& c, const cases::Draw& draw, uint32_t location) {
    const int32_t attribute = cases::output_at(c.target, draw, location).attribute;
    if (c.target.has_instruments || attribute < 0) {
        return attribute;
    }
    return static_cast<int32_t>(input_of(c, draw, static_cast<uint32_t>(attribute)));
}

uint32_t input_of_discard(const cases::Case& c, const cases::Draw& draw) {
    return c.target.has_instruments || !cases::discards_by_value(draw)
               ? draw.discard_attribute
               : input_of(c, draw, draw.discard_attribute);
}

uint32_t viewport_count(const cases::Case& c) {
    uint32_t count = 1;
    for (const cases::Draw& draw : c.draws) {
        count = std::max(count, draw.viewport_index + 1);
    }
    return count;
}

bool names_layers(const cases::Case& c) {
    return std::ranges::any_of(
        c.draws, [](const cases::Draw& draw) { return !draw.clear && draw.layer > 0; });
}

}  // namespace vk_harness
