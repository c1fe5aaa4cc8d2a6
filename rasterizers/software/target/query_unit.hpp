// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The device's queries, one a draw: of occlusion and of pipeline statistics.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>
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

// The two by two pixels of a triangle that a fragment belongs to: quad numbers and primitive.
using Quad = std::tuple<int64_t, int64_t, uint32_t>;

class QueryUnit {
  public:
    // Both must outlive this object.
    QueryUnit(const cases::Case& c, const Device& device);
    // `is_first`: no sample of the same fragment was covered before.
    void count(uint32_t draw, Ending ending, bool is_first, const Quad& quad);
    // What clipping has left of a triangle, a polygon of so many corners.
    void count_clipped(uint32_t draw, size_t corners, bool was_cut);
    // Adds to the statistic of a draw, if it is this one.
    void add(uint32_t draw, cases::Query statistic, uint64_t more);
    // As capture::Planes::counted.
    std::vector<uint64_t> results() const;

  private:
    void count_fragment(uint32_t draw, Ending ending, bool is_first, const Quad& quad);
    const cases::Case& case_;
    const Device& device_;
    std::vector<uint64_t> counts_;   // empty if no draw has a query
    bool is_fragment_done_ = false;  // the fragment at hand has been counted
    uint32_t quads_draw_ = 0;        // of the draw at hand:
    std::set<Quad> quads_;           // those that have been counted
};

}  // namespace software
