// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The renderings that a batch of cases is drawn in: mostly one a case, with the depth that the
// device has beside a stencil; several where a case is drawn in parts (parts.hpp).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vk_harness/parts.hpp"

namespace vk_harness {

// One of those that a batch is drawn in.
struct Rendering {
    const cases::Case* test = nullptr;
    bool reads_hits = true;  // check_case()
};

class Renderings {
  public:
    // `filed`, the batch, and `store`, where its planes go, must live as long.
    Renderings(const Capabilities& capabilities, std::span<const cases::Case> filed,
               const PlaneStore& store);

    std::span<const Rendering> all() const { return all_; }
    // Where the planes of a rendering go.
    PlaneStore slots() const;
    // The results of the cases, of those of all renderings.
    std::vector<Rendered> joined(std::vector<Rendered> drawn) const;

  private:
    std::span<const cases::Case> filed_;
    const PlaneStore* store_;
    std::vector<cases::Case>
        own_;  // with the depth that the device has; none if no case needs that
    std::span<const cases::Case> batch_;    // these, or `filed`
    std::vector<std::vector<Part>> parts_;  // of each case; none: drawn in one rendering
    std::vector<Rendering> all_;
    std::vector<std::optional<size_t>> slot_of_;  // of a rendering that is its case's only one
};

// Why the device cannot draw a case; nothing if it can.
std::optional<Rejection> check_renderings(const Capabilities& capabilities, const cases::Case& c);

// Memory for the planes that a capture of this target has, of case `slot` of the batch: the store's
// if it has some (Rendered::placed), else the capture's own.
capture::PlaneSpans placed_planes(Rendered& result, size_t slot, const PlaneStore& store);

}  // namespace vk_harness
