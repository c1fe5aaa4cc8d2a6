// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The device's stencil, which counts front faces up and back faces down, and what it makes of a
// pixel's samples at the end of rendering.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

class StencilAttachment {
  public:
    // The device must outlive this object.
    StencilAttachment(const cases::Target& target, const Device& device);
    // A fragment of a sample; `passes`: the depth test.
    void test(size_t index, const cases::Draw& draw, bool front, bool passes);
    const std::vector<uint32_t>& values() const { return values_; }

  private:
    const Device& device_;
    uint32_t samples_;
    std::vector<uint32_t> values_;  // empty if the target has no stencil
};

// Fills the resolved planes from the capture's samples.
void resolve(capture::Capture& capture, const Device& device);

}  // namespace software
