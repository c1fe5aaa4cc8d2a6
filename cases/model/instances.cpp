// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/instances.hpp"

#include <algorithm>
#include <cmath>

namespace cases {

bool is_instanced(const Draw& draw) {
    return draw.instances > 1 || draw.first_instance > 0 || !draw.offsets.empty() ||
           std::ranges::any_of(draw.attributes,
                               [](const Attribute& a) { return a.divisor.has_value(); });
}

uint32_t element_of(uint32_t instance, uint32_t divisor) {
    return divisor == 0 ? 0 : instance / divisor;
}

size_t elements_of(const Draw& draw, std::optional<uint32_t> divisor, size_t vertices) {
    return divisor ? element_of(draw.instances - 1, *divisor) + size_t{1} : vertices;
}

std::vector<glm::vec4> for_all_instances(const Draw& draw, std::span<const glm::vec4> elements,
                                         std::optional<uint32_t> divisor, size_t vertices) {
    std::vector<glm::vec4> out;
    for (uint32_t i = 0; i < draw.instances; ++i) {
        for (size_t v = 0; v < vertices; ++v) {
            out.push_back(elements[divisor ? element_of(i, *divisor) : v]);
        }
    }
    return out;
}

std::vector<glm::vec4> elements_read(const Draw& draw, std::span<const glm::vec4> values,
                                     std::optional<uint32_t> divisor) {
    const size_t vertices = draw.vertex_count();
    if (values.empty() || !divisor) {
        return {values.begin(),
                values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), vertices))};
    }
    std::vector<glm::vec4> out(elements_of(draw, divisor, vertices));
    for (uint32_t i = 0; i < draw.instances; ++i) {
        out[element_of(i, *divisor)] = values[i * vertices];
    }
    return out;
}

std::vector<glm::vec4> base_positions(const Draw& draw) {
    std::vector<glm::vec4> out = elements_read(draw, draw.positions, std::nullopt);
    for (size_t v = 0; v < out.size() && !draw.offsets.empty(); ++v) {
        out[v] -= draw.offsets.front();
    }
    return out;
}

std::optional<glm::vec4> offset_by(const glm::vec4& position, const glm::vec4& offset) {
    glm::vec4 sum = position + offset;
    for (int k = 0; k < 4; ++k) {
        // A sum that was rounded differs from a summand by another number than the other one;
        // binary64 may round that, too, but not to the other one in both differences.
        const double p = position[k], o = offset[k], s = sum[k];
        const bool is_exact = s - p >= o && s - p <= o && s - o >= p && s - o <= p;
        for (const float number : {position[k], offset[k], sum[k]}) {
            if (!is_exact || !(std::isnormal(number) || std::fpclassify(number) == FP_ZERO)) {
                return std::nullopt;
            }
        }
    }
    return sum;
}

}  // namespace cases
