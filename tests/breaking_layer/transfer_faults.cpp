// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clears, the rendered area, memory beside attachments, copies and blits. N is the parameter of
// EDGECASE_BREAK.
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

bool loads(VkRenderingAttachmentInfo& attachment) {
    return attachment.loadOp == VK_ATTACHMENT_LOAD_OP_CLEAR &&
           change(attachment.loadOp, VK_ATTACHMENT_LOAD_OP_LOAD);
}

bool no_color_clear(Rendering& r) {
    bool altered = false;
    for (VkRenderingAttachmentInfo& color : r.colors) {
        altered = loads(color) || altered;
    }
    return altered;
}
bool no_depth_clear(Rendering& r) {
    return r.depth && loads(*r.depth);
}
// A clear to 0 that is lost would not be seen in memory that is new.
bool stencil_clear_one(Rendering& r) {
    return r.stencil && change(r.stencil->clearValue.depthStencil.stencil, 1);
}
bool first_clear_for_all(Rendering& r) {
    bool altered = false;
    for (VkRenderingAttachmentInfo& color : r.colors) {
        for (int k = 0; k < 4; ++k) {
            altered =
                change(color.clearValue.color.uint32[k], r.colors[0].clearValue.color.uint32[k]) ||
                altered;
        }
    }
    return altered;
}
bool depth_clear_one(Rendering& r) {
    return r.depth && change(r.depth->clearValue.depthStencil.depth, 1);
}
bool narrow_area(Rendering& r) {
    return r.info.renderArea.extent.width > 1 &&
           change(r.info.renderArea.extent.width, r.info.renderArea.extent.width - 1);
}
bool lower_area(Rendering& r) {
    return r.info.renderArea.extent.height > 1 &&
           change(r.info.renderArea.extent.height, r.info.renderArea.extent.height - 1);
}

// The region begins one texel further right; one column less, so that it stays inside the image.
bool copy_from_right(VkBufferImageCopy& region) {
    if (region.imageExtent.width < 2) {
        return false;
    }
    region.bufferRowLength =
        region.bufferRowLength != 0 ? region.bufferRowLength : region.imageExtent.width;
    ++region.imageOffset.x;
    --region.imageExtent.width;
    return true;
}
bool copy_from_below(VkBufferImageCopy& region) {
    return region.imageExtent.height > 1 &&
           change(region.imageExtent.height, region.imageExtent.height - 1) &&
           change(region.imageOffset.y, region.imageOffset.y + 1);
}
bool copy_fewer_rows(VkBufferImageCopy& region) {
    return region.imageExtent.height > 1 &&
           change(region.imageExtent.height, region.imageExtent.height - 1);
}

bool write_before(Neighbours& n) {
    if (n.before.buffer == VK_NULL_HANDLE || n.rendering % parameter() != 0) {
        return false;
    }
    n.written = {n.before.buffer, n.before.size - sizeof(uint32_t)};
    return true;
}
bool write_after(Neighbours& n) {
    if (n.after.buffer == VK_NULL_HANDLE || n.rendering % parameter() != 0) {
        return false;
    }
    n.written = {n.after.buffer, 0};
    return true;
}

bool swap_x(VkImageBlit& b, VkFilter& /*filter*/) {
    std::swap(b.srcOffsets[0].x, b.srcOffsets[1].x);
    return true;
}
bool swap_y(VkImageBlit& b, VkFilter& /*filter*/) {
    std::swap(b.dstOffsets[0].y, b.dstOffsets[1].y);
    return true;
}
bool never_mirrored(VkImageBlit& b, VkFilter& /*filter*/) {
    bool altered = false;
    for (VkOffset3D(*corners)[2] : {&b.srcOffsets, &b.dstOffsets}) {
        VkOffset3D& first = (*corners)[0];
        VkOffset3D& second = (*corners)[1];
        if (first.x > second.x) {
            std::swap(first.x, second.x);
            altered = true;
        }
        if (first.y > second.y) {
            std::swap(first.y, second.y);
            altered = true;
        }
    }
    return altered;
}
// One texel of the source's or the destination's right side is left out: what remains is scaled.
bool smaller_source(VkImageBlit& b, VkFilter& /*filter*/) {
    int32_t& right = b.srcOffsets[0].x < b.srcOffsets[1].x ? b.srcOffsets[1].x : b.srcOffsets[0].x;
    const bool wide =
        b.srcOffsets[1].x - b.srcOffsets[0].x > 1 || b.srcOffsets[0].x - b.srcOffsets[1].x > 1;
    return wide && change(right, right - 1);
}
bool smaller_destination(VkImageBlit& b, VkFilter& /*filter*/) {
    int32_t& bottom = b.dstOffsets[0].y < b.dstOffsets[1].y ? b.dstOffsets[1].y : b.dstOffsets[0].y;
    const bool high =
        b.dstOffsets[1].y - b.dstOffsets[0].y > 1 || b.dstOffsets[0].y - b.dstOffsets[1].y > 1;
    return high && change(bottom, bottom - 1);
}
// Both ends one texel to the left, where there is room.
bool move_source(VkImageBlit& b, VkFilter& /*filter*/) {
    return b.srcOffsets[0].x > 0 && b.srcOffsets[1].x > 0 &&
           change(b.srcOffsets[0].x, b.srcOffsets[0].x - 1) &&
           change(b.srcOffsets[1].x, b.srcOffsets[1].x - 1);
}
bool move_destination(VkImageBlit& b, VkFilter& /*filter*/) {
    return b.dstOffsets[0].x > 0 && b.dstOffsets[1].x > 0 &&
           change(b.dstOffsets[0].x, b.dstOffsets[0].x - 1) &&
           change(b.dstOffsets[1].x, b.dstOffsets[1].x - 1);
}
bool always_nearest(VkImageBlit& /*b*/, VkFilter& filter) {
    return change(filter, VK_FILTER_NEAREST);
}

constexpr std::array kTransferFaults = {
    Fault{"clear-color-lost", "Colour attachments are not cleared.", {.rendering = no_color_clear}},
    Fault{"clear-depth-lost", "Depth attachments are not cleared.", {.rendering = no_depth_clear}},
    Fault{"clear-stencil-one", "stencil-cleared-to-one"_fault, {.rendering = stencil_clear_one}},
    Fault{"clear-first-for-all",
          "All colour attachments are cleared to the first one's value.",
          {.rendering = first_clear_for_all}},
    Fault{"clear-depth-one", "depth-cleared-to-one"_fault, {.rendering = depth_clear_one}},
    Fault{"clear-image-lost",
          "vkCmdClearColorImage does nothing.",
          {.drop_clear_color = [] { return true; }}},
    Fault{"clear-image-red",
          "vkCmdClearColorImage clears red to zero.",
          {.clear_color = [](VkClearColorValue& c) { return change(c.uint32[0], 0); }}},
    Fault{"area-narrow",
          "The last column of the rendered area is left out.",
          {.rendering = narrow_area}},
    Fault{"area-low", "The last row of the rendered area is left out.", {.rendering = lower_area}},
    Fault{"read-back-right", "read-back-right"_fault, {.image_to_buffer = copy_from_right}},
    Fault{"read-back-below", "read-back-below"_fault, {.image_to_buffer = copy_from_below}},
    Fault{"read-back-short",
          "Copies to buffers leave out the last row.",
          {.image_to_buffer = copy_fewer_rows}},
    Fault{"write-before-attachment",
          "Every N-th rendering writes a word directly before each of its attachments.",
          {.stray_write = write_before}},
    Fault{"write-after-attachment",
          "Every N-th rendering writes a word directly behind each of its attachments.",
          {.stray_write = write_after}},
    Fault{"dispatch-short",
          "A dispatch leaves out its last column of groups.",
          {.dispatch = [](uint32_t& x) { return change(x, x - 1); }}},
    Fault{"upload-right",
          "Copies from buffers begin one column further right.",
          {.buffer_to_image = copy_from_right}},
    Fault{"blit-mirrored-x", "blit-mirrored-x"_fault, {.blit = swap_x}},
    Fault{"blit-mirrored-y", "blit-mirrored-y"_fault, {.blit = swap_y}},
    Fault{"blit-never-mirrored", "blit-mirror-ignored"_fault, {.blit = never_mirrored}},
    Fault{"blit-source-smaller", "blit-source-column-lost"_fault, {.blit = smaller_source}},
    Fault{"blit-destination-smaller",
          "blit-destination-row-lost"_fault,
          {.blit = smaller_destination}},
    Fault{"blit-source-moved", "Blits read one texel too far left.", {.blit = move_source}},
    Fault{"blit-destination-moved",
          "Blits write one texel too far left.",
          {.blit = move_destination}},
    Fault{"blit-nearest", "blit-filter-ignored"_fault, {.blit = always_nearest}},
};

}  // namespace

std::span<const Fault> transfer_faults() {
    return kTransferFaults;
}

}  // namespace breaking
