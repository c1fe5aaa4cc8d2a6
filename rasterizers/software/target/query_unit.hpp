// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The device's occlusion queries, one a draw.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// What has become of a covered sample of a fragment.
enum class Ending : uint8_t {
    masked,          // by the sample mask, or by that of the shader
    discarded,       // by the shader, before the tests
    out_of_bounds,   // the depth bounds test failed
    stencil_failed,  // the tests after it were not reached
    depth_failed,
    hidden,  // discarded after it passed all tests
    shown,
};

class QueryUnit {
  public:
    // Both must outlive this object.
    QueryUnit(const cases::Case& c, const Device& device);
    // `is_first`: no sample of the same fragment was covered before.
    void count(uint32_t draw, Ending ending, bool is_first);
    // As capture::Planes::counted.
    std::vector<uint64_t> results() const;

  private:
    const cases::Case& case_;
    const Device& device_;
    std::vector<uint64_t> counts_;  // empty if no draw has a query
};

}  // namespace software
