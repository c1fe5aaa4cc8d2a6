// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of what attachments are a part of, of how pipelines and renderings are made and submitted,
// and of stages before rasterization: only a picture through that door shows them.
#include <algorithm>
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

bool write_no_green(PipelineCopy& p) {
    bool altered = false;
    for (VkPipelineColorBlendAttachmentState& blend : p.blends) {
        altered = change(blend.colorWriteMask,
                         blend.colorWriteMask & ~VkColorComponentFlags{VK_COLOR_COMPONENT_G_BIT}) ||
                  altered;
    }
    return altered;
}

// Of the colours for whose images this holds.
bool clear_to_zero(Rendering& r, bool (*holds)(const ImageFacts&)) {
    bool altered = false;
    for (size_t k = 0; k < r.colors.size(); ++k) {
        if (holds(r.images[k])) {
            r.colors[k].clearValue = {};
            altered = true;
        }
    }
    return altered;
}

bool lose_last_triangle(DrawCall& d, VkShaderStageFlags stage) {
    return (d.stages & stage) != 0 && change(d.count, d.count - std::min(d.count, 3U));
}

constexpr std::array kTargetDoorFaults = {
    Fault{"door-half-positions-flat",
          "Of a position in binary16 the first two numbers are read, and the others are 0 and 1.",
          {.pipeline =
               [](PipelineCopy& p) {
                   bool altered = false;
                   for (VkVertexInputAttributeDescription& input : p.inputs) {
                       if (input.format == VK_FORMAT_R16G16B16A16_SFLOAT) {
                           altered = change(input.format, VK_FORMAT_R16G16_SFLOAT);
                       }
                   }
                   return altered;
               }}},
    Fault{"door-library-writes-no-green",
          "A pipeline library does not write the second component.",
          {.pipeline = [](PipelineCopy& p) { return p.is_library() && write_no_green(p); }}},
    Fault{"door-derived-writes-as-base",
          "A derivative writes what the pipeline writes that it is derived from.",
          {.pipeline =
               [](PipelineCopy& p) {
                   bool altered = false;
                   for (VkPipelineColorBlendAttachmentState& blend : p.blends) {
                       altered = (p.is_derived() && change(blend.colorWriteMask, 0)) || altered;
                   }
                   return altered;
               }}},
    Fault{"door-cached-writes-no-green",
          "A pipeline out of a cache's data does not write the second component.",
          {.pipeline = [](PipelineCopy& p) { return p.has_cached_data && write_no_green(p); }}},
    Fault{"door-pass-clears-to-zero",
          "A render pass object clears every attachment to 0.",
          {.pass_clears =
               [](std::vector<VkClearValue>& clears) {
                   std::fill(clears.begin(), clears.end(), VkClearValue{});
                   return !clears.empty();
               }}},
    Fault{"door-second-subpass-lost",
          "Nothing is drawn in a second subpass.",
          {.draw = [](DrawCall& d) { return d.subpass > 0 && change(d.times, 0); }}},
    Fault{"door-submission-without-fence-lost",
          "Commands that are submitted without a fence are not executed.",
          {.drop_submission = [](bool has_fence) { return !has_fence; }}},
    Fault{"door-larger-image-copied-from-one",
          "Of an image that is larger than what is copied, the copy begins a column later.",
          {.image_copy =
               [](ImageCopy& c) {
                   const auto end =
                       static_cast<uint32_t>(c.region.imageOffset.x) + c.region.imageExtent.width;
                   return c.region.imageSubresource.mipLevel == 0 && end < c.image.extent.width &&
                          change(c.region.imageOffset.x, c.region.imageOffset.x + 1);
               }}},
    Fault{"door-area-elsewhere-clears-to-zero",
          "A rendering whose area does not begin at the origin clears its colours to 0.",
          {.rendering =
               [](Rendering& r) {
                   return r.info.renderArea.offset.x != 0 &&
                          clear_to_zero(r, [](const ImageFacts&) { return true; });
               }}},
    Fault{"door-input-second-of-first",
          "The second input attachment reads what the first one holds.",
          {.input_views =
               [](std::span<VkImageView> views) {
                   return views.size() > 1 && change(views[1], views[0]);
               }}},
    Fault{"door-unused-input-writes-no-green",
          "A pipeline that describes an input at location 15 does not write the second component.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return std::ranges::any_of(p.inputs,
                                              [](const auto& i) { return i.location == 15; }) &&
                          write_no_green(p);
               }}},
    Fault{
        "door-mesh-last-group-lost",
        "The last group of a mesh shader makes no triangle.",
        {.mesh_groups = [](uint32_t& groups) { return groups > 0 && change(groups, groups - 1); }}},
    Fault{"door-view-of-first-layer",
          "Every view begins with layer 0.",
          {.view =
               [](VkImageViewCreateInfo& v) {
                   return change(v.subresourceRange.baseArrayLayer, 0);
               }}},
    Fault{
        "door-view-of-first-level",
        "Every view begins with mip level 0.",
        {.view =
             [](VkImageViewCreateInfo& v) { return change(v.subresourceRange.baseMipLevel, 0); }}},
    Fault{"door-area-one-wider",
          "A render area that ends before its images does so a column further right.",
          {.rendering =
               [](Rendering& r) {
                   uint32_t& width = r.info.renderArea.extent.width;
                   const uint32_t end = static_cast<uint32_t>(r.info.renderArea.offset.x) + width;
                   return !r.images.empty() && r.images.front().levels == 1 &&
                          end < r.images.front().extent.width && change(width, width + 1);
               }}},
    Fault{"door-levels-resolved-into-nothing",
          "No colour is resolved into an image of several mip levels.",
          {.rendering =
               [](Rendering& r) {
                   return resolve_nothing(r,
                                          [](const ImageFacts& image) { return image.levels > 1; });
               }}},
    Fault{"door-storage-image-clears-to-zero",
          "Colours that may be stored to are cleared to 0.",
          {.rendering =
               [](Rendering& r) {
                   return clear_to_zero(r, [](const ImageFacts& image) {
                       return (image.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
                   });
               }}},
    Fault{"door-dedicated-image-clears-to-zero",
          "Colours in memory of their own are cleared to 0.",
          {.rendering =
               [](Rendering& r) {
                   return clear_to_zero(r,
                                        [](const ImageFacts& image) { return image.is_dedicated; });
               }}},
    Fault{"door-linear-image-clears-to-zero",
          "Colours of linear tiling are cleared to 0.",
          {.rendering =
               [](Rendering& r) {
                   return clear_to_zero(r, [](const ImageFacts& image) {
                       return image.tiling == VK_IMAGE_TILING_LINEAR;
                   });
               }}},
    Fault{"door-aliased-image-clears-to-zero",
          "Colours whose memory is another image's, too, are cleared to 0.",
          {.rendering =
               [](Rendering& r) {
                   return clear_to_zero(r,
                                        [](const ImageFacts& image) { return image.is_aliased; });
               }}},
    Fault{"door-multiview-first-view",
          "Of several views the first is drawn instead of the second.",
          {.rendering =
               [](Rendering& r) { return r.info.viewMask != 0 && change(r.info.viewMask, 1); }}},
    Fault{"door-multiview-one-view",
          "Of several views that are drawn together only the first is drawn.",
          {.rendering =
               [](Rendering& r) {
                   const uint32_t views = r.info.viewMask;
                   return change(r.info.viewMask, views & (~views + 1U));
               }}},
    Fault{"door-feedback-writes-nothing",
          "Transform feedback writes nothing.",
          {.drop_feedback = [] { return true; }}},
    Fault{
        "door-geometry-last-triangle-lost",
        "A geometry shader never gets a draw's last three vertices.",
        {.draw = [](DrawCall& d) { return lose_last_triangle(d, VK_SHADER_STAGE_GEOMETRY_BIT); }}},
    Fault{"door-tessellation-last-patch-lost",
          "A draw's last patch is not tessellated.",
          {.draw =
               [](DrawCall& d) {
                   return lose_last_triangle(d, VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT);
               }}},
};

}  // namespace

std::span<const Fault> target_door_faults() {
    return kTargetDoorFaults;
}

}  // namespace breaking
