// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The delivered planes of a sample as observers of its paths (ref/path/path.hpp): a sample is right
// at a profile if one path satisfies all of them together.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/attribution.hpp"
#include "diff/delivery.hpp"
#include "diff/last_fragment.hpp"
#include "diff/verdict.hpp"
#include "ref/color/color.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

// What takes part of a sample's planes: those that were delivered and are not found wrong already.
struct SeenPlanes {
    ref::path::SeenHits hits;
    bool writer = false, values = false, depth = false, stencil = false;
};

class Observers {
  public:
    // All must outlive this object; `values` are those of the expectation's profile.
    Observers(const cases::Case& c, const ref::Expectation& expectation,
              const capture::CaptureView& capture, const Delivery& delivery,
              const LastFragment& last_fragment, Attribution& attribution,
              ref::ValueReference& values)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          delivery_(delivery),
          last_fragment_(last_fragment),
          attribution_(attribution),
          values_(values) {}

    // The number of hits that the delivered planes tell of, the most telling plane first.
    ref::path::SeenHits hits_at(size_t index);

    // What the planes but the colour tell a colour of a sample at a profile.
    ref::ColorWitness witness(cases::Profile profile, size_t index, cases::SampleId id,
                              const SeenPlanes& seen);
    // The same of one question of the sample's paths.
    ref::path::Observed observe(cases::Profile profile, size_t index, cases::SampleId id,
                                const SeenPlanes& seen);
    // The depth's part of it; `of`: only these fragments may have stored it (null: all may).
    void observe_depth(cases::Profile profile, size_t index, cases::SampleId id,
                       ref::path::Observed& out, const std::vector<bool>* of = nullptr);
    // The finding at a sample whose planes are right one by one, but satisfy no path together.
    // What contradicts the planes before it is no longer `seen`.
    std::optional<Finding> judge(size_t index, cases::SampleId id, SeenPlanes& seen);

    // "2 hits; writer: draw 0, triangle 1; depth 0.75": what is seen of a sample.
    std::string text_of(size_t index, const SeenPlanes& seen) const;

    // True while it asks values itself, whose texts nobody reads.
    bool is_asking() const { return is_asking_; }

  private:
    const ref::Expectation& at(cases::Profile profile, size_t index) {
        return attribution_.at(profile, index);
    }
    bool has_path(cases::Profile profile, size_t index, cases::SampleId id, const SeenPlanes& seen);
    // Whether the values of a fragment that were delivered are all clear.
    bool has_clear_values(size_t index) const;
    bool is_covered_by_values(size_t index);
    bool fits(cases::Profile profile, uint32_t t, size_t index, cases::SampleId id);
    ref::ValueReference& values_of(cases::Profile profile);
    Finding finding_of(size_t index, cases::SampleId id, const SeenPlanes& seen,
                       const std::string& why);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    const Delivery& delivery_;
    const LastFragment& last_fragment_;
    Attribution& attribution_;
    ref::ValueReference& values_;
    std::array<std::unique_ptr<ref::ValueReference>, 3> looser_;  // by profile
    bool is_asking_ = false;
};

}  // namespace diff
