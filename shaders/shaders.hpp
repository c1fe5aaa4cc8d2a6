// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The SPIR-V modules that the build compiled from the GLSL beside this file.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace shaders {

inline constexpr uint32_t kMaxAttributes = 4;

// Interpolation of one attribute, numbered as cases::Interpolation.
enum class Mode : uint8_t { smooth, noperspective, flat };

// capture.vert for `attribute_count` (0..4) attributes.
std::span<const uint32_t> capture_vertex(uint32_t attribute_count);

// capture.frag for the first `attribute_count` modes, with or without gl_PrimitiveID (which needs
// the device feature geometryShader).
std::span<const uint32_t> capture_fragment(uint32_t attribute_count,
                                           const std::array<Mode, kMaxAttributes>& modes,
                                           bool primitive_id);

// copy_samples.comp for colour or depth attachments.
std::span<const uint32_t> copy_samples(bool depth);

}  // namespace shaders
