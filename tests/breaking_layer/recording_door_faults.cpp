// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// State and recordings that go astray in one way and arrive in all others: only a picture through
// that door shows it.
#include <algorithm>
#include <array>
#include <limits>

#include "fault.hpp"

namespace breaking {

namespace {

template <size_t size>
constexpr bool is_one_of(std::string_view word, const std::array<std::string_view, size>& words) {
    return std::ranges::find(words, word) != words.end();
}

constexpr std::array<std::string_view, 2> kPlaces = {"viewport", "scissor"};

bool load_as_clear(VkRenderingAttachmentInfo& attachment) {
    return attachment.loadOp == VK_ATTACHMENT_LOAD_OP_LOAD &&
           change(attachment.loadOp, VK_ATTACHMENT_LOAD_OP_CLEAR);
}

constexpr VkRenderingFlags kParts = VK_RENDERING_SUSPENDING_BIT | VK_RENDERING_RESUMING_BIT;

constexpr std::array kRecordingDoorFaults = {
    Fault{"door-bind-resets-topology",
          "Binding a pipeline sets the dynamic topology to that of the pipeline.",
          {.bind =
               [](Reset& r) {
                   r.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
                   return true;
               }}},
    Fault{"door-bind-resets-cull-mode",
          "Binding a pipeline sets the dynamic cull mode to that of the pipeline.",
          {.bind =
               [](Reset& r) {
                   r.cull_mode = VK_CULL_MODE_NONE;
                   return true;
               }}},
    Fault{"door-bind-resets-scissor",
          "Binding a pipeline opens the scissor.",
          {.bind =
               [](Reset& r) {
                   constexpr uint32_t kWhole = std::numeric_limits<int32_t>::max();
                   r.scissor = VkRect2D{{0, 0}, {kWhole, kWhole}};
                   return true;
               }}},
    Fault{
        "door-second-viewport-lost",
        "Of two viewports or scissors that are set after a pipeline the first one counts.",
        {.drop_state = [](StateCall& c) { return c.is_set_again && is_one_of(c.state, kPlaces); }}},
    Fault{"door-second-topology-lost",
          "Of two topologies that are set after a pipeline the first one counts.",
          {.drop_state = [](StateCall& c) { return c.is_set_again && c.state == "topology"; }}},
    Fault{"door-second-discard-lost",
          "Of two rasterizer discards that are set after a pipeline the first one counts.",
          {.drop_state =
               [](StateCall& c) { return c.is_set_again && c.state == "rasterizer discard"; }}},
    Fault{"door-static-cull-mode-lost",
          "The cull mode of a pipeline is ignored.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return change(p.rasterization.cullMode, VkCullModeFlags{VK_CULL_MODE_NONE});
               }}},
    Fault{"door-static-front-face-lost",
          "Counter-clockwise is front for every pipeline that says itself which way is.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return change(p.rasterization.frontFace, VK_FRONT_FACE_COUNTER_CLOCKWISE);
               }}},
    Fault{"door-static-bias-lost",
          "The depth bias of a pipeline is ignored.",
          {.pipeline =
               [](PipelineCopy& p) { return change(p.rasterization.depthBiasEnable, VK_FALSE); }}},
    Fault{"door-static-compare-less",
          "The comparison of depth that a pipeline names is LESS.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return p.is_static() && p.depth.depthTestEnable == VK_TRUE &&
                          change(p.depth.depthCompareOp, VK_COMPARE_OP_LESS);
               }}},
    Fault{"door-static-viewport-stays",
          "Viewports and scissors of a pipeline stay in force when they are set later.",
          {.drop_state =
               [](StateCall& c) { return c.follows_static && is_one_of(c.state, kPlaces); }}},
    Fault{"door-static-cull-mode-stays",
          "The cull mode of a pipeline stays in force when it is set later.",
          {.drop_state = [](StateCall& c) { return c.follows_static && c.state == "cull mode"; }}},
    Fault{"door-dynamic-blend-of-first",
          "Dynamic blending is that of the first attachment for all of them.",
          {.blend_enables =
               [](std::span<VkBool32> enables) {
                   bool altered = false;
                   for (VkBool32& enable : enables) {
                       altered = change(enable, enables.front()) || altered;
                   }
                   return altered;
               }}},
    Fault{"door-dynamic-write-mask-no-green",
          "Dynamic write masks leave out the second component.",
          {.write_masks =
               [](std::span<VkColorComponentFlags> masks) {
                   bool altered = false;
                   for (VkColorComponentFlags& mask : masks) {
                       altered =
                           change(mask, mask & ~VkColorComponentFlags{VK_COLOR_COMPONENT_G_BIT}) ||
                           altered;
                   }
                   return altered;
               }}},
    Fault{"door-dynamic-sample-mask-empty",
          "A dynamic sample mask takes away every sample.",
          {.sample_mask = [](VkSampleMask& mask) { return change(mask, VkSampleMask{0}); }}},
    Fault{"door-dynamic-alpha-to-coverage-off",
          "Dynamic alpha to coverage is off.",
          {.alpha_to_coverage = [](VkBool32& enable) { return change(enable, VK_FALSE); }}},
    Fault{"door-dynamic-depth-clamp-off",
          "Dynamic clamping of depth is off.",
          {.depth_clamp = [](VkBool32& enable) { return change(enable, VK_FALSE); }}},
    Fault{"door-dynamic-provoking-vertex-first",
          "The dynamic provoking vertex is the first.",
          {.provoking_mode =
               [](VkProvokingVertexModeEXT& mode) {
                   return change(mode, VK_PROVOKING_VERTEX_MODE_FIRST_VERTEX_EXT);
               }}},
    Fault{"door-stencil-test-of-nothing-fails",
          "Where a stencil test is on and has no stencil, nothing is written.",
          {.pipeline =
               [](PipelineCopy& p) {
                   bool altered = false;
                   for (VkPipelineColorBlendAttachmentState& blend : p.blends) {
                       altered = (p.lacks_stencil && p.depth.stencilTestEnable == VK_TRUE &&
                                  p.depth.front.compareOp == VK_COMPARE_OP_NEVER &&
                                  change(blend.colorWriteMask, 0)) ||
                                 altered;
                   }
                   return altered;
               }}},
    Fault{"door-restart-without-indices-ends",
          "Nothing is drawn where restart is on and a draw has no indices.",
          {.draw = [](DrawCall& d) { return !d.indexed && d.has_restart && change(d.times, 0); }}},
    Fault{"door-unoptimized-writes-no-green",
          "Pipelines that are not optimized do not write the second component.",
          {.pipeline =
               [](PipelineCopy& p) {
                   bool altered = false;
                   for (VkPipelineColorBlendAttachmentState& blend : p.blends) {
                       altered = (p.is_unoptimized() &&
                                  change(blend.colorWriteMask,
                                         blend.colorWriteMask &
                                             ~VkColorComponentFlags{VK_COLOR_COMPONENT_G_BIT})) ||
                                 altered;
                   }
                   return altered;
               }}},
    Fault{"door-objects-last-triangle-lost",
          "A draw without a pipeline loses its last three vertices.",
          {.draw =
               [](DrawCall& d) {
                   return d.stages == 0 && change(d.count, d.count - std::min(d.count, 3U));
               }}},
    Fault{"door-secondary-last-triangle-lost",
          "In a secondary command buffer lists lose their last triangle.",
          {.draw =
               [](DrawCall& d) {
                   return d.in_secondary && d.topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST &&
                          change(d.count, d.count - std::min(d.count, 3U));
               }}},
    Fault{
        "door-secondary-first-draw-only",
        "In a secondary command buffer only the first draw is drawn.",
        {.draw = [](DrawCall& d) { return d.in_secondary && d.number > 0 && change(d.times, 0); }}},
    Fault{"door-stencil-reference-in-secondary",
          "A stencil reference that is set in a secondary command buffer has its bit 4 turned.",
          {.stencil_reference =
               [](StencilValue& s) { return s.in_secondary && change(s.value, s.value ^ 16U); }}},
    Fault{"door-secondaries-resolve-nothing",
          "A rendering by secondary command buffers resolves no colour.",
          {.rendering =
               [](Rendering& r) {
                   return (r.info.flags & VK_RENDERING_CONTENTS_SECONDARY_COMMAND_BUFFERS_BIT) !=
                              0 &&
                          resolve_nothing(r, [](const ImageFacts&) { return true; });
               }}},
    Fault{"door-secondaries-first-only",
          "Of several secondary command buffers only the first is executed.",
          {.secondaries =
               [](std::vector<VkCommandBuffer>& c) {
                   const bool altered = c.size() > 1;
                   c.resize(std::min<size_t>(c.size(), 1));
                   return altered;
               }}},
    Fault{"door-secondaries-reversed",
          "Several secondary command buffers are executed in reverse.",
          {.secondaries =
               [](std::vector<VkCommandBuffer>& c) {
                   std::ranges::reverse(c);
                   return c.size() > 1;
               }}},
    Fault{"door-secondary-again-lost",
          "A secondary command buffer is executed once, and never again.",
          {.drop_again = [] { return true; }}},
    Fault{"door-load-clears-color",
          "Colours that are loaded are cleared.",
          {.rendering =
               [](Rendering& r) {
                   bool altered = false;
                   for (VkRenderingAttachmentInfo& color : r.colors) {
                       altered = load_as_clear(color) || altered;
                   }
                   return altered;
               }}},
    Fault{"door-load-clears-depth",
          "Depth that is loaded is cleared.",
          {.rendering = [](Rendering& r) { return r.depth && load_as_clear(*r.depth); }}},
    Fault{"door-resume-clears",
          "A rendering that is resumed begins anew, with its clears.",
          {.rendering = [](Rendering& r) { return change(r.info.flags, r.info.flags & ~kParts); }}},
    Fault{"door-clear-first-attachment-only",
          "vkCmdClearAttachments clears the first of its attachments to the values of all, and the "
          "others to 0.",
          {.clear_attachments =
               [](Clears& c) {
                   for (size_t k = 1; k < c.attachments.size(); ++k) {
                       c.attachments[k].clearValue = {};
                   }
                   return c.attachments.size() > 1;
               }}},
    Fault{"door-clearing-draw-leaves-depth",
          "A draw without inputs that passes every depth test writes no depth.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return !p.has_inputs() && p.depth.depthCompareOp == VK_COMPARE_OP_ALWAYS &&
                          change(p.depth.depthWriteEnable, VK_FALSE);
               }}},
    Fault{"door-clear-depth-of-one",
          "vkCmdClearAttachments clears depth to 1, whatever it is told.",
          {.clear_attachments =
               [](Clears& c) {
                   bool altered = false;
                   for (VkClearAttachment& clear : c.attachments) {
                       if (clear.aspectMask == VK_IMAGE_ASPECT_DEPTH_BIT) {
                           altered = change(clear.clearValue.depthStencil.depth, 1) || altered;
                       }
                   }
                   return altered;
               }}},
};

}  // namespace

std::span<const Fault> recording_door_faults() {
    return kRecordingDoorFaults;
}

}  // namespace breaking
