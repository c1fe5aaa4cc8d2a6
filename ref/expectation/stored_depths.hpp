// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whose depth a sample may hold: the depth plane as an observer of paths (ref/path/path.hpp).
#pragma once

#include <span>
#include <vector>

#include "cases/model/sample.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace ref {

class StoredDepths {
  public:
    // Keeps references; `values` judges depth.
    StoredDepths(const Expectation& expectation, ValueReference& values)
        : expectation_(expectation), values_(values) {}

    // The triangles that may have stored the depth of a sample, and whether it may be the clear
    // value.
    std::span<const uint32_t> writers_of(const SampleExpectation& s) const {
        return is_kept(s) ? expectation_.depth_writers_of(s) : expectation_.writers_of(s);
    }
    static bool may_be_clear(const SampleExpectation& s) {
        return is_kept(s) ? s.depth_may_be_clear : s.hits.total_min == 0;
    }
    // Whether a triangle's fragment may have stored a depth.
    bool is_of(uint32_t triangle, cases::SampleId id, float depth);
    // Whether a sample may hold a depth; `is_clear`: it is the clear value.
    bool allows(const SampleExpectation& s, cases::SampleId id, float depth, bool is_clear);
    // Of a sample of which something is open: which of its fragments (`of`: of these alone; null:
    // of all) may have stored the depth.
    void observe(const SampleExpectation& s, cases::SampleId id, float depth, bool is_clear,
                 path::Observed& out, const std::vector<bool>* of = nullptr);

  private:
    // Else the last fragment that shows has stored its depth.
    static bool is_kept(const SampleExpectation& s) {
        return s.depth_count > 0 || s.depth_may_be_clear;
    }
    const Expectation& expectation_;
    ValueReference& values_;
};

}  // namespace ref
