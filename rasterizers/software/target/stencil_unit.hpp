// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The device's stencil: the test of each sample, and what is written then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

class StencilAttachment {
  public:
    // Both must outlive this object.
    StencilAttachment(const cases::Case& c, const Device& device);
    // Tests and updates a sample for a fragment of a draw; `passes`: the depth test would. False if
    // the fragment fails the stencil test.
    bool test(size_t index, uint32_t draw, bool front, bool passes);
    void clear(size_t index, uint32_t value) { values_[index] = value; }
    const std::vector<uint32_t>& values() const { return values_; }

  private:
    cases::StencilFace face_of(uint32_t draw, bool front) const;
    bool compare(const cases::StencilFace& face, uint32_t stored) const;
    uint32_t apply(cases::StencilOp op, const cases::StencilFace& face, uint32_t stored) const;
    uint32_t masked(cases::StencilOp op, const cases::StencilFace& face, uint32_t stored) const;

    const cases::Case& case_;
    const Device& device_;
    uint32_t samples_;
    std::vector<uint32_t> values_;  // empty if the target has no stencil
    std::vector<uint32_t> before_;  // at the beginning of the draw at hand
    uint32_t draw_ = ~0U;
};

}  // namespace software
