// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Planes beside the instruments: what colour and depth are resolved into, and a stencil.
#pragma once

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

// Throws what the device lacks for them, or which question about them failed.
void check_resolve_and_stencil(const Capabilities& c, const cases::Target& t);

VkResolveModeFlagBits resolve_mode(cases::Resolve mode);

// Has the attachment `from` resolved into `view` at the end of rendering.
void resolve_into(VkImageView view, VkImageLayout layout, cases::Resolve mode,
                  VkRenderingAttachmentInfo& from);

}  // namespace vk_harness
