// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Who looks on while a case is judged sample by sample: what it rests on, which an expectation does
// not keep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "cases/model/sample.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/narrowing.hpp"

namespace ref {

struct JudgedSample {
    size_t index = 0;  // index_of(target, id)
    cases::SampleId id;
    FixedPoint p;
    std::span<const Hit> hits;          // in drawing order
    const HitBounds& bounds;            // what they may come to
    std::span<const uint32_t> writers;  // triangles that may have written last
    const JudgeReasons& reasons;
};

class Onlooker {
  public:
    virtual ~Onlooker() = default;
    // Looks at the next sample; the set-ups are those of the profile that is judged. False if it
    // has seen enough.
    virtual bool look(const JudgedSample& sample, TriangleSetups& setups) = 0;
};

}  // namespace ref
