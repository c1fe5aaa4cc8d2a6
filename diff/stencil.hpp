// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencil of a case whose draws test it (ref/path/path.hpp), sample by sample.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/attribution.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/on_demand.hpp"
#include "ref/expectation/scene.hpp"

namespace diff {

class StencilComparison {
  public:
    // Keeps references. The case needs a stencil test (ref::stencil::is_needed).
    StencilComparison(const cases::Case& c, const ref::Expectation& expectation,
                      const capture::CaptureView& capture, Attribution& attribution)
        : case_(c), expectation_(expectation), capture_(capture), attribution_(attribution) {}

    // What is wrong with the stencil of a sample. Of one that is open it must be one that goes with
    // the hits that it shows, if their faces are known.
    std::optional<Finding> judge(size_t index, cases::SampleId id, const ref::path::SeenHits& seen);

  private:
    // What a device may leave that is wrong about something.
    struct Other {
        Other(cases::Case changed, const ref::Limits& limits, cases::Profile profile)
            : c(std::move(changed)), scene(c, limits, profile, false), expectation(scene) {}
        cases::Case c;
        ref::Scene scene;
        ref::OnDemand expectation;
    };

    // The rule that a device must be wrong about to leave this value at a sample: of the changes
    // that ref/exercise tells wrong devices by, the first that explains it.
    ref::ReasonKind reason_of(size_t index, uint32_t value, cases::Profile level);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    Attribution& attribution_;
    // What other devices leave, by the number of the change and the profile; where it changes
    // nothing, nothing.
    std::map<std::pair<size_t, cases::Profile>, std::unique_ptr<Other>> others_;
};

}  // namespace diff
