// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// In a worker: a batch with the derived renderings of its cases, which are compared on the spot.
// Only what was found travels; the parent demands one result for each derivation.
#pragma once

#include <functional>
#include <vector>

#include "capture/renderer.hpp"
#include "diff/consistency.hpp"
#include "ref/position/limits.hpp"

namespace run {

// A case's own rendering, and what its derived ones differ in, one result a derivation.
struct RenderedCase {
    capture::Rendered rendered;
    std::vector<diff::Consistency> consistency;
};

// Draws the cases and all renderings derived from them: those that come later in a submission of
// their own, the others beside the cases. A case one of whose derived renderings was not drawn
// has that one's status and reason. `store` places the cases' own planes. `damage`, if any, may
// change a derived capture of the case with that number before it is compared.
std::vector<RenderedCase> render_with_derived(
    capture::Renderer& renderer, const std::vector<cases::Case>& batch, const capture::Step& step,
    const capture::PlaneStore& store,
    const std::function<void(size_t, capture::Rendered&)>& damage = {});

// What the reference has to know of a device.
ref::Limits limits_of(const capture::DeviceInfo& device);

}  // namespace run
