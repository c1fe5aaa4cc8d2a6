// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws of instances: what each of them reads, and the vertices that come of it. Number i of a draw
// is instance firstInstance + i, and reads element firstInstance + i / divisor, firstInstance if
// the divisor is 0 [Vulkan specification, "Vertex Input Address Calculation"]. Elements are
// numbered from firstInstance on here.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"

namespace cases {

// Whether a draw has several instances, or one with inputs of its own, or another than number 0.
bool is_instanced(const Draw& draw);

// The element that instance number `instance` reads, and how many all read; of an input without
// divisor a vertex is an element, and `vertices` those of one instance.
uint32_t element_of(uint32_t instance, uint32_t divisor);
size_t elements_of(const Draw& draw, std::optional<uint32_t> divisor, size_t vertices);

// From elements to what each vertex of each instance has, and back.
std::vector<glm::vec4> for_all_instances(const Draw& draw, std::span<const glm::vec4> elements,
                                         std::optional<uint32_t> divisor, size_t vertices);
std::vector<glm::vec4> elements_read(const Draw& draw, std::span<const glm::vec4> values,
                                     std::optional<uint32_t> divisor);

// The positions before the offsets, of one instance; the same to which an offset is added again.
std::vector<glm::vec4> base_positions(const Draw& draw);

// The sum of each number, as every device computes it: nothing if binary32 does not hold it, or if
// it or a summand is denormal, which a device may take for 0.
std::optional<glm::vec4> offset_by(const glm::vec4& position, const glm::vec4& offset);

}  // namespace cases
