// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertices as a file writes them, exact, and their conversion to clip space.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/toml/binary32.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

enum class Space : uint8_t { pixels, ndc, clip };

inline constexpr size_t kMaxVertices = size_t{1} << 20U;  // of all draws
inline constexpr size_t kMaxIndices = size_t{1} << 22U;   // of all draws

// x, y, z, w in the draw's space. pixels: x and y in framebuffer pixels, z in the viewport's 0..1
// before the depth range; ndc: after the division by w; clip: before it.
struct ExactVertex {
    std::array<Number, 4> xyzw;
    const mpq_class& x() const { return xyzw[0].value; }
    const mpq_class& y() const { return xyzw[1].value; }
    const mpq_class& z() const { return xyzw[2].value; }
    const mpq_class& w() const { return xyzw[3].value; }
};
// The vertex (x, y) with z = 1/2 and w = 1.
ExactVertex exact_vertex(mpq_class x, mpq_class y);

// The array `vertices` of a draw. Numbers in ndc and clip space must be binary32.
std::optional<std::vector<ExactVertex>> read_vertices(LeafContext& context, const TomlValue& value,
                                                      Space space);

// False if a component is NaN or infinite (space clip only).
bool is_finite(const ExactVertex& vertex);

// Framebuffer position in pixels by the viewport; nothing if w is 0 or a component is not finite.
struct PixelPosition {
    mpq_class x, y;
};
std::optional<PixelPosition> pixel_position(const ExactVertex& vertex, Space space,
                                            const Viewport& viewport);

// What reaches the device. In pixels x_c = ((x_f - o_x) / (p_x / 2)) * w, z_c = z * w with w
// rounded first; in ndc x_c = x * w. Each is rounded once to nearest. A conversion that rounds adds
// a sentence that starts with `name` to `notes`; a result too large for binary32 is an error, told
// at the vertex in `list`, the array that the vertices come from, if there is one, else at `where`.
std::optional<std::vector<glm::vec4>> to_clip(LeafContext& context,
                                              const std::vector<ExactVertex>& vertices, Space space,
                                              const Viewport& viewport, const SourceLocation& where,
                                              const std::string& name,
                                              std::vector<std::string>& notes,
                                              const TomlValue* list = nullptr);

}  // namespace cases
