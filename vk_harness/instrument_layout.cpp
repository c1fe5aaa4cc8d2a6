// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/instrument_layout.hpp"

#include <algorithm>
#include <bit>

#include "vk_harness/case_check.hpp"

namespace vk_harness {

namespace {

// Up to the last number that is not +0 at every vertex, whatever the probe: +0 everywhere has +0 as
// its value, its derivatives and their sums.
uint32_t components_of(const cases::Attribute& a) {
    switch (a.source) {
        case cases::Source::barycentric:
            return 3;
        case cases::Source::sample_position:
            return 2;
        case cases::Source::sample_mask_in:
        case cases::Source::sample_id:
            return 1;
        case cases::Source::vertex:
            break;
    }
    uint32_t last = a.probe == cases::Probe::lod ? 2 : 1;
    for (const glm::vec4& value : a.values) {
        for (uint32_t k = last; k < 4; ++k) {
            if (std::bit_cast<uint32_t>(value[static_cast<int>(k)]) != 0) {
                last = k + 1;
            }
        }
    }
    return last;
}

// A draw and a primitive of it are one number that binary32 holds (packed_id). No draw has more
// primitives than indices or vertices.
bool ids_fit(const cases::Case& test) {
    size_t most = 0;
    for (const cases::Draw& draw : test.draws) {
        most = std::max(most, draw.indices ? draw.indices->size() : draw.positions.size());
    }
    return (most + 2) * std::max(test.draws.size(), size_t{1}) < kMaxId;
}

}  // namespace

uint32_t InstrumentLayout::numbers(uint32_t attribute, uint32_t half) const {
    const uint32_t count = attribute < components.size() ? components.at(attribute) : 4U;
    return !pairs ? count : half == 0 ? std::min(count, 2U) : count <= 3 ? 1U : 2U;
}

VkFormat InstrumentLayout::attribute_format(uint32_t attribute, uint32_t half) const {
    const uint32_t count = numbers(attribute, half);
    return count == 1 ? kOneNumber : count == 2 ? kTwoNumbers : kColorFormat;
}

InstrumentLayout instrument_layout(const Capabilities& c, const cases::Case& test) {
    InstrumentLayout layout;
    if (!test.target.has_instruments || !ids_fit(test) ||
        (c.narrow_sample_counts & test.target.samples) == 0) {
        return layout;
    }
    uint32_t most = 0;
    const uint32_t attributes = std::min(attribute_count(test), cases::kMaxAttributes);
    for (uint32_t k = 0; k < attributes; ++k) {
        uint32_t count = 1;
        for (const cases::Draw& draw : test.draws) {
            if (k < draw.attributes.size()) {
                count = std::max(count, components_of(draw.attributes[k]));
            }
        }
        layout.components.at(k) = static_cast<uint8_t>(count);
        most = std::max(most, count);
    }
    const uint32_t all = kSplitAttachments + attributes + (test.target.color ? 1 : 0);
    const uint32_t limit = std::min(kMaxSplitAttachments, c.info.max_color_attachments);
    layout.split = all <= limit;
    layout.pairs = most > 2 && all + attributes <= limit;
    if (!layout.pairs) {
        std::replace(layout.components.begin(), layout.components.end(), uint8_t{3}, uint8_t{4});
    }
    return layout;
}

}  // namespace vk_harness
