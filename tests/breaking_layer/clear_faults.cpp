// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a driver may do to vkCmdClearAttachments among the draws, and to the load and store
// operations of each aspect. The program clears by another command only where a door says so.
#include <algorithm>
#include <array>
#include <utility>

#include "fault.hpp"

namespace breaking {

namespace {

template <class Change>
bool each_rect(Clears& c, const Change& change) {
    bool altered = false;
    for (VkClearRect& rect : c.rects) {
        altered = change(rect) || altered;
    }
    return altered;
}

// Leaves one aspect of depth and stencil out of what is cleared.
bool drop_aspect(Clears& c, VkImageAspectFlags aspect) {
    constexpr VkImageAspectFlags kBoth = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    bool altered = false;
    for (VkClearAttachment& clear : c.attachments) {
        altered =
            (clear.aspectMask == kBoth && change(clear.aspectMask, kBoth & ~aspect)) || altered;
    }
    return altered;
}

bool as(VkRenderingAttachmentInfo& one, VkAttachmentLoadOp load) {
    return change(one.loadOp, load);
}

bool has_both(const Rendering& r) {
    return r.depth && r.stencil && r.depth->imageView == r.stencil->imageView;
}

constexpr std::array kClearFaults = {
    Fault{"clear-ignored",
          "clear-ignored"_fault,
          {.clear_attachments = [](Clears& c) { return std::exchange(c.rects, {}).size() > 0; }}},
    Fault{"clear-right",
          "Rectangles of vkCmdClearAttachments lie a column too far right, or lose their last.",
          {.clear_attachments =
               [](Clears& c) {
                   return each_rect(c, [](VkClearRect& r) {
                       const bool is_wide = r.rect.extent.width > 1;
                       r.rect.offset.x += is_wide ? 1 : 0;
                       r.rect.extent.width -= is_wide ? 1 : 0;
                       return is_wide;
                   });
               }}},
    Fault{"clear-row-lost",
          "Rectangles of vkCmdClearAttachments lose their last row.",
          {.clear_attachments =
               [](Clears& c) {
                   return each_rect(c, [](VkClearRect& r) {
                       return r.rect.extent.height > 1 &&
                              change(r.rect.extent.height, r.rect.extent.height - 1);
                   });
               }}},
    Fault{"clear-first-rect-only",
          "clear-first-rect-only"_fault,
          {.clear_attachments =
               [](Clears& c) { return c.rects.size() > 1 && (c.rects.resize(1), true); }}},
    Fault{"clear-first-layer-only",
          "clear-first-layer-only"_fault,
          {.clear_attachments =
               [](Clears& c) {
                   return each_rect(c, [](VkClearRect& r) { return change(r.layerCount, 1); });
               }}},
    Fault{"clear-layer-zero",
          "clear-layer-zero"_fault,
          {.clear_attachments =
               [](Clears& c) {
                   return each_rect(c, [](VkClearRect& r) { return change(r.baseArrayLayer, 0); });
               }}},
    Fault{
        "clear-depth-beside-stencil-lost",
        "clear-depth-beside-stencil-lost"_fault,
        {.clear_attachments = [](Clears& c) { return drop_aspect(c, VK_IMAGE_ASPECT_DEPTH_BIT); }}},
    Fault{"clear-stencil-lost",
          "The stencil is not cleared where depth is.",
          {.clear_attachments =
               [](Clears& c) { return drop_aspect(c, VK_IMAGE_ASPECT_STENCIL_BIT); }}},
    Fault{"clear-color-red-blue",
          "Clears of a colour among the draws exchange red and blue.",
          {.clear_attachments =
               [](Clears& c) {
                   bool altered = false;
                   for (VkClearAttachment& clear : c.attachments) {
                       auto& bits = clear.clearValue.color.uint32;
                       if (clear.aspectMask == VK_IMAGE_ASPECT_COLOR_BIT) {
                           altered = bits[0] != bits[2] || altered;
                           std::swap(bits[0], bits[2]);
                       }
                   }
                   return altered;
               }}},
    Fault{"load-color-clears",
          "Colours that a pass loads are cleared.",
          {.rendering =
               [](Rendering& r) {
                   bool altered = false;
                   for (VkRenderingAttachmentInfo& color : r.colors) {
                       altered = (color.loadOp == VK_ATTACHMENT_LOAD_OP_LOAD &&
                                  as(color, VK_ATTACHMENT_LOAD_OP_CLEAR)) ||
                                 altered;
                   }
                   return altered;
               }}},
    Fault{"load-none-clears",
          "Attachments whose load operation is NONE are cleared.",
          {.rendering =
               [](Rendering& r) {
                   bool altered = false;
                   const auto clear = [&](VkRenderingAttachmentInfo& one) {
                       altered = (one.loadOp == VK_ATTACHMENT_LOAD_OP_NONE_EXT &&
                                  as(one, VK_ATTACHMENT_LOAD_OP_CLEAR)) ||
                                 altered;
                   };
                   std::ranges::for_each(r.colors, clear);
                   if (r.depth) {
                       clear(*r.depth);
                   }
                   if (r.stencil) {
                       clear(*r.stencil);
                   }
                   return altered;
               }}},
    Fault{
        "load-stencil-as-depth",
        "load-stencil-as-depth"_fault,
        {.rendering = [](Rendering& r) { return has_both(r) && as(*r.stencil, r.depth->loadOp); }}},
    Fault{
        "load-depth-as-stencil",
        "load-depth-as-stencil"_fault,
        {.rendering = [](Rendering& r) { return has_both(r) && as(*r.depth, r.stencil->loadOp); }}},
};

}  // namespace

std::span<const Fault> clear_faults() {
    return kClearFaults;
}

}  // namespace breaking
