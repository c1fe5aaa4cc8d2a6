// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The judged one of several colour targets, as the device has it. What a right device draws to the
// others is nothing to it; a wrong one mixes them up.
#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <optional>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// What the target is cleared to.
glm::vec4 clear_of(const cases::Target& target, const Device& device);
// How a draw blends and masks it; `output`: what the draw says of it.
cases::ColorOutput output_beside(const cases::Case& c, const cases::Draw& draw,
                                 cases::ColorOutput output, const Device& device);
// The output of the shader that reaches it.
const cases::ColorOutput& reaching(const cases::Target& target, const cases::Draw& draw,
                                   const Device& device);
// The colour on its way there.
glm::vec4 passed(const cases::Target& target, const glm::vec4& value, const Device& device);
// Where a fragment at sample `index` is written; nothing if it is lost.
std::optional<size_t> place_in(const cases::Target& target, size_t index, const Device& device);

}  // namespace software
