// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"

namespace ref {

// The boxes of a draw's vertices, computed when first asked for.
class VertexBoxes {
  public:
    VertexBoxes(const cases::Case& c, const Limits& limits, cases::Profile profile);
    const std::optional<Box>& of(uint32_t draw, uint32_t vertex);
    // The box of a vertex in the view volume; null if the vertex is not in it, has no box or is not
    // representable.
    const Box* inside_view(uint32_t draw, uint32_t vertex);

  private:
    enum class View : uint8_t { unknown, inside, outside };
    struct Entry {
        bool is_known = false;
        View view = View::unknown;  // and representable
        std::optional<Box> box;
    };
    const cases::Case& case_;
    Limits limits_;
    cases::Profile profile_;
    std::vector<std::vector<Entry>> entries_;
};

}  // namespace ref
