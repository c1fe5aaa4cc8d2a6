// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What of a draw's state a device cannot do.
#pragma once

#include "vk_harness/device/capabilities.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

// Throws why the device cannot draw by that state, if it cannot.
void check_draw(const Capabilities& c, const cases::Draw& draw);
// The same of the size of its fragments, which hangs on the target's samples.
void check_fragment_size(const FragmentSizeSupport& device, const cases::Draw& draw,
                         const cases::Target& target);

}  // namespace vk_harness
