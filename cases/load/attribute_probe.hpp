// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys of [[draw.attribute]] that say where a value is taken and what is made of it: auxiliary,
// source, probe, offset, sample, texture.
#pragma once

#include <vector>

#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

// What every device has of offsets (Vulkan, "Required Limits": minInterpolationOffset -0.5,
// maxInterpolationOffset 0.5 - 1 ULP, at 4 bits), and the largest side of a texture.
inline constexpr float kMinProbeOffset = -0.5F, kMaxProbeOffset = 0.4375F;
inline constexpr int64_t kMaxTextureSide = 4096;

// Reads `source`, and sets its components if they do not come from vertices; false on a mistake.
// gl_SamplePosition is one in a target with locations of its own: its value is undefined there
// (Vulkan, "Built-In Variables", SamplePosition; VK_EXT_sample_locations).
bool read_source(LeafContext& context, const TomlValue& table, const Target& target,
                 Attribute& attribute);

// Reads the other keys; interpolation, source and values have been read before. `samples` is the
// target's number of samples. Returns false after a mistake.
bool read_probe(LeafContext& context, const TomlValue& table, uint32_t samples,
                Attribute& attribute);

// What attributes of one draw must have in common: one texture, and one place where a barycentric
// built-in is evaluated. `where`: of each attribute.
void check_shared_inputs(LeafContext& context, const std::vector<Attribute>& attributes,
                         const std::vector<SourceLocation>& where);

}  // namespace cases
