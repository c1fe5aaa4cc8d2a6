// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which images the attachments of a case are a part of, by its door (cases/model/door.hpp).
#pragma once

#include <optional>
#include <string>

#include "cases/model/case.hpp"
#include "vk_harness/memory/image_way.hpp"

namespace vk_harness {

ImageWay image_way(const cases::Case& c);

// The same of what they are resolved into: another layer than theirs, or another level.
ImageWay resolved_way(const cases::Case& c);

// Why the device has no such images: one sentence; nothing if it has them.
std::optional<std::string> missing_images(const Capabilities& capabilities, const cases::Case& c);

// What of its attachments a case is drawn to.
VkRect2D render_area(const cases::Case& c);

// The views that the rendering of a case draws to, one bit a view; 0: there is no multiview.
uint32_t view_mask(const cases::Case& c);

}  // namespace vk_harness
