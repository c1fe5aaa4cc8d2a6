// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The image that an attachment is a part of.
#pragma once

#include <compare>
#include <cstdint>

#include "vk_harness/device/device.hpp"

namespace vk_harness {

// As constructed: an image of the attachment's size and layers, and nothing more.
struct ImageWay {
    uint32_t more_columns = 0, more_rows = 0;  // to the right and below, in pixels of `level`
    bool ends_with_it = false;                 // those lie to the left and above instead
    bool is_input = false;                     // it may be an input attachment
    bool is_sampled = false;                   // it is read by a shader, and never copied
    uint32_t first_layer = 0;                  // of the image, in which the attachment begins
    uint32_t more_layers = 0;                  // behind the attachment's own
    uint32_t level = 0;                        // of the image; others lie before and behind it
    bool all_usages = false;
    bool is_dedicated = false;
    bool is_linear = false;         // tiled so, where the device offers it
    bool is_aliased = false;        // its memory is another image's, too
    bool has_spare_aspect = false;  // it is resolved into one aspect of two
    // The view shows all layers of the image, of which these are drawn to, a bit each (viewMask);
    // the attachment is the last of them. 0: without multiview.
    uint32_t views = 0;
    friend auto operator<=>(const ImageWay&, const ImageWay&) = default;

    // Where in the image's level it begins.
    VkOffset2D origin() const {
        return ends_with_it
                   ? VkOffset2D{static_cast<int32_t>(more_columns), static_cast<int32_t>(more_rows)}
                   : VkOffset2D{0, 0};
    }
    // Whether the image has texels that are not the attachment's.
    bool has_neighbours() const {
        return has_spare_aspect || more_columns + more_rows + first_layer + more_layers + level > 0;
    }
    uint32_t levels() const { return level > 0 ? level + 2 : 1; }
    // Size of level 0 in texels: an odd one, so that halves are rounded down.
    VkExtent2D extent(const VkExtent2D& attachment) const {
        const uint32_t odd = (1U << level) - 1;
        return {((attachment.width + more_columns) << level) + odd,
                ((attachment.height + more_rows) << level) + odd};
    }
};

}  // namespace vk_harness
