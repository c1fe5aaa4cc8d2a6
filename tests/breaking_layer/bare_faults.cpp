// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Errors of pipelines as applications have them: each has a condition that no pipeline with the
// attachments that tell of fragments fulfils, and what is wrong there. Only ways (cases/model/way)
// and the cases of cases/suite/bare show them.
#include <algorithm>
#include <array>

#include "fault.hpp"
#include "memory_map.hpp"

namespace breaking {

namespace bare {

namespace {

// Conditions: what a pipeline is made of.

using Facts = PipelineFacts;
using Blend = VkPipelineColorBlendAttachmentState;

bool has_one_color(const Facts& p) {
    return p.colors.size() == 1 && p.colors.front() == VK_FORMAT_R8G8B8A8_UNORM;
}

bool has_depth_or_stencil(const Facts& p) {
    return p.depth != VK_FORMAT_UNDEFINED || p.stencil != VK_FORMAT_UNDEFINED;
}

// One colour of 8 bits, and nothing else.
bool is_bare(const Facts& p) {
    return has_one_color(p) && !has_depth_or_stencil(p) && p.fragment.has_value();
}

bool reads_constants(const Facts& p) {
    constexpr uint32_t kComponents = 4;
    return is_bare(p) && p.constants == kComponents && !p.fragment->reads_pushed &&
           !p.fragment->reads_uniforms && !p.fragment->reads_storage && !p.fragment->reads_textures;
}
bool reads_uniforms(const Facts& p) {
    return is_bare(p) && p.fragment->reads_uniforms;
}
bool reads_storage(const Facts& p) {
    return is_bare(p) && p.fragment->reads_storage;
}
bool reads_texture(const Facts& p) {
    return is_bare(p) && p.fragment->reads_textures && !p.fragment->reads_pushed;
}

bool is_opaque(const Facts& p) {
    return p.has_plain_output && p.blends.size() == 1 && p.blends.front().blendEnable == VK_FALSE &&
           p.blends.front().colorWriteMask != 0;
}
bool is_pushed(const Facts& p) {
    return is_bare(p) && is_opaque(p) && p.fragment->reads_pushed && !p.fragment->has_flat &&
           !p.fragment->has_smooth;
}
bool is_flat(const Facts& p) {
    return is_bare(p) && is_opaque(p) && p.fragment->has_flat;
}
bool is_smooth(const Facts& p) {
    return is_bare(p) && is_opaque(p) && p.fragment->has_smooth && !p.fragment->has_flat &&
           p.fragment->reads_pushed;
}
bool blends_by_alpha(const Facts& p) {
    return is_bare(p) && p.blends.size() == 1 && p.blends.front().blendEnable == VK_TRUE &&
           p.blends.front().srcColorBlendFactor == VK_BLEND_FACTOR_SRC_ALPHA &&
           p.blends.front().dstColorBlendFactor == VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
}

bool multiplies(const Facts& p) {
    return p.has_matrix;
}

bool has_no_fragments(const Facts& p) {
    return (p.stages & VK_SHADER_STAGE_FRAGMENT_BIT) == 0 && p.depth != VK_FORMAT_UNDEFINED;
}
bool is_stencil_alone(const Facts& p) {
    return p.colors.empty() && p.depth == VK_FORMAT_UNDEFINED && p.stencil != VK_FORMAT_UNDEFINED;
}
bool is_depth_alone(const Facts& p) {
    return p.colors.empty() && p.depth != VK_FORMAT_UNDEFINED && p.stencil == VK_FORMAT_UNDEFINED;
}
bool has_color_and_depth(const Facts& p) {
    return has_one_color(p) && p.depth != VK_FORMAT_UNDEFINED && is_opaque(p);
}
bool has_color_and_stencil(const Facts& p) {
    return has_one_color(p) && p.stencil != VK_FORMAT_UNDEFINED && is_opaque(p);
}

// Conditions: what is set as well.

template <bool (*of)(const Facts&)>
bool with(const DrawCall& d) {
    return of(d.pipeline);
}
bool has_dynamic_offset(const DrawCall& d) {
    return reads_uniforms(d.pipeline) && d.has_offsets;
}
bool has_uniform(const DrawCall& d) {
    return reads_uniforms(d.pipeline) && !d.has_offsets;
}
// The first half of a depth prepass.
bool writes_depth_alone(const DrawCall& d) {
    const Facts& p = d.pipeline;
    return has_one_color(p) && p.depth != VK_FORMAT_UNDEFINED && p.blends.size() == 1 &&
           p.blends.front().colorWriteMask == 0 && d.state.depth_write == VK_TRUE &&
           d.state.depth_compare == VK_COMPARE_OP_LESS_OR_EQUAL;
}
// The second half of a depth prepass.
bool tests_equal(const DrawCall& d) {
    return has_color_and_depth(d.pipeline) && d.state.depth_compare == VK_COMPARE_OP_EQUAL &&
           d.state.depth_write == VK_FALSE;
}
bool tests_depth(const DrawCall& d) {
    return has_color_and_depth(d.pipeline) && d.pipeline.samples == VK_SAMPLE_COUNT_1_BIT &&
           d.state.depth_compare != VK_COMPARE_OP_ALWAYS &&
           d.state.depth_compare != VK_COMPARE_OP_EQUAL && d.state.depth_write == VK_TRUE;
}
template <bool (*of)(const Facts&)>
bool culling(const DrawCall& d) {
    return of(d.pipeline) && d.state.cull_mode != VK_CULL_MODE_NONE;
}
template <bool (*of)(const Facts&), VkPrimitiveTopology topology>
bool of_topology(const DrawCall& d) {
    return of(d.pipeline) && d.state.topology == topology;
}
constexpr VkPrimitiveTopology kList = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
constexpr VkPrimitiveTopology kStrip = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
constexpr VkPrimitiveTopology kFan = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN;

// Effects on a draw.

bool lose_draw(DrawCall& d) {
    return change(d.times, 0);
}
bool draw_twice(DrawCall& d) {
    return change(d.times, 2);
}
bool lose_last_triangle(DrawCall& d) {
    const uint32_t vertices = d.state.topology == kList ? 3 : 1;
    return d.count >= 3 && change(d.count, d.count - vertices);
}
bool lose_first_triangle(DrawCall& d) {
    if (d.state.topology != kList || d.count < 3) {
        return false;
    }
    d.first += 3;
    d.count -= 3;
    return true;
}
bool begin_late(DrawCall& d) {
    d.count -= d.indexed ? 0 : 1;
    return !d.indexed && change(d.first, d.first + 1);
}
bool cull_nothing_again(DrawCall& d) {
    return d.may_repeat && change(d.state.cull_mode, VK_CULL_MODE_NONE);
}
template <VkPrimitiveTopology to>
bool take_as(DrawCall& d) {
    return change(d.state.topology, to);
}
bool cull_nothing(DrawCall& d) {
    return change(d.state.cull_mode, VK_CULL_MODE_NONE);
}
bool cull_back(DrawCall& d) {
    return d.state.cull_mode == VK_CULL_MODE_NONE &&
           change(d.state.cull_mode, VK_CULL_MODE_BACK_BIT);
}
bool swap_culling(DrawCall& d) {
    constexpr VkCullModeFlags kBoth = VK_CULL_MODE_FRONT_AND_BACK;
    return d.state.cull_mode != VK_CULL_MODE_NONE && d.state.cull_mode != kBoth &&
           change(d.state.cull_mode, d.state.cull_mode ^ kBoth);
}
bool swap_front(DrawCall& d) {
    return change(d.state.front_face, d.state.front_face == VK_FRONT_FACE_CLOCKWISE
                                          ? VK_FRONT_FACE_COUNTER_CLOCKWISE
                                          : VK_FRONT_FACE_CLOCKWISE);
}

bool change_viewports(DrawCall& d, bool (*how)(VkViewport&)) {
    bool altered = false;
    for (VkViewport& viewport : d.state.viewports) {
        altered = how(viewport) || altered;
    }
    return altered;
}
bool move_half_right(DrawCall& d) {
    return change_viewports(d, [](VkViewport& v) { return change(v.x, v.x + 0.5F); });
}
bool forget_depth_range(DrawCall& d) {
    return change_viewports(d, [](VkViewport& v) {
        const bool altered = change(v.minDepth, 0);
        return change(v.maxDepth, 1) || altered;
    });
}
bool change_scissors(DrawCall& d, bool (*how)(VkRect2D&)) {
    bool altered = false;
    for (VkRect2D& scissor : d.state.scissors) {
        altered = how(scissor) || altered;
    }
    return altered;
}
bool lower_scissor(DrawCall& d) {
    return change_scissors(d, [](VkRect2D& s) {
        return s.extent.height > 0 && change(s.extent.height, s.extent.height - 1);
    });
}
template <VkCompareOp from, VkCompareOp to>
bool compare(DrawCall& d) {
    return d.state.depth_compare == from && change(d.state.depth_compare, to);
}
bool write_no_depth(DrawCall& d) {
    return change(d.state.depth_write, VK_FALSE);
}
bool forget_bias(DrawCall& d) {
    return change(d.state.has_bias, VK_FALSE);
}
bool operate_as_front(DrawCall& d) {
    const StencilOpSet& front = d.state.stencil[0];
    StencilOpSet& back = d.state.stencil[1];
    const bool altered = front.pass != back.pass || front.fail != back.fail ||
                         front.depth_fail != back.depth_fail || front.compare != back.compare;
    back = front;
    return altered;
}
bool refer_to_zero(DrawCall& d) {
    const bool altered = change(d.state.stencil_reference[0], 0);
    return change(d.state.stencil_reference[1], 0) || altered;
}

// Effects on a pipeline.

bool cover_all_samples(PipelineCopy& p) {
    const bool altered = (p.mask & 0xffU) != 0xffU && p.multisample.pSampleMask != nullptr;
    p.mask = ~VkSampleMask{0};
    return altered;
}
bool clamp_no_depth(PipelineCopy& p) {
    return change(p.rasterization.depthClampEnable, VK_FALSE);
}
bool zero_constants(PipelineCopy& p) {
    std::fill(p.constants.begin(), p.constants.end(), 0U);
    return true;
}
bool turn_constants(PipelineCopy& p) {
    std::rotate(p.constants.begin(), p.constants.begin() + 1, p.constants.end());
    return true;
}

// Where a condition holds, an effect.
template <bool (*when)(const DrawCall&), bool (*does)(DrawCall&)>
bool draw(DrawCall& d) {
    return when(d) && does(d);
}
template <bool (*when)(const Facts&), bool (*does)(PipelineCopy&)>
bool pipeline(PipelineCopy& p) {
    return when(p.facts) && does(p);
}

// Colours that a shader reads have four floats.
template <VkDescriptorType type, VkDeviceSize later>
bool read_later(VkDescriptorBufferInfo& info, VkDescriptorType of) {
    return of == type && info.range == 4 * sizeof(float) &&
           change(info.offset, info.offset + later);
}
template <VkDescriptorType type>
bool lose_offset(VkDescriptorBufferInfo& info, VkDescriptorType of) {
    return of == type && info.range == 4 * sizeof(float) && change(info.offset, 0);
}
template <VkDeviceSize less>
bool lose_dynamic_offset(std::span<uint32_t> offsets) {
    bool altered = false;
    for (uint32_t& offset : offsets) {
        const auto by = static_cast<uint32_t>(std::min<VkDeviceSize>(less, offset));
        altered = change(offset, offset - by) || altered;
    }
    return altered;
}

// An image that is uploaded to, or rendered to, and then sampled, and nothing else.
template <VkImageUsageFlags filled>
bool is_texture(const ImageFacts& image) {
    return image.usage == (VK_IMAGE_USAGE_SAMPLED_BIT | filled) && image.extent.width == 4;
}
bool lose_upload_offset(ImageCopy& c) {
    return is_texture<VK_IMAGE_USAGE_TRANSFER_DST_BIT>(c.image) && change(c.region.bufferOffset, 0);
}
bool upload_late(ImageCopy& c) {
    constexpr VkDeviceSize kTwoRows = 32;
    return is_texture<VK_IMAGE_USAGE_TRANSFER_DST_BIT>(c.image) &&
           change(c.region.bufferOffset, c.region.bufferOffset + kTwoRows);
}
bool is_rendered_texture(const Rendering& r) {
    return r.images.size() == 1 &&
           is_texture<VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT>(r.images.front());
}
bool turn_texture_clear(Rendering& r) {
    if (!is_rendered_texture(r)) {
        return false;
    }
    VkClearColorValue& clear = r.colors.front().clearValue.color;
    std::swap(clear.uint32[0], clear.uint32[2]);
    return clear.uint32[0] != clear.uint32[2];
}
bool zero_texture_clear(Rendering& r) {
    if (!is_rendered_texture(r)) {
        return false;
    }
    r.colors.front().clearValue.color = {};
    return true;
}
bool clear_depth_to_zero(Rendering& r) {
    return r.colors.empty() && r.depth && !r.stencil &&
           change(r.depth->clearValue.depthStencil.depth, 0);
}

// Texels that tell where they lie.
constexpr uint32_t kTexels = 64;
bool upload_a_row_early(ImageCopy& c) {
    constexpr VkDeviceSize kRow = 4 * kTexels;
    return c.image.extent.width == kTexels &&
           c.image.usage == (VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT) &&
           change(c.region.bufferOffset, c.region.bufferOffset - kRow);
}

// An attachment without transfer usage.
template <VkImageUsageFlags attachment>
bool is_sampled_alone(const ImageFacts& image) {
    return image.usage == (attachment | VK_IMAGE_USAGE_SAMPLED_BIT) &&
           image.samples == VK_SAMPLE_COUNT_1_BIT;
}
bool clear_green(Rendering& r) {
    return r.images.size() == 1 && !is_rendered_texture(r) &&
           is_sampled_alone<VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT>(r.images.front()) &&
           change(r.colors.front().clearValue.color.float32[1], 1);
}
bool clear_sampled_depth(Rendering& r) {
    return r.depth &&
           is_sampled_alone<VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT>(
               facts_of(r.depth->imageView)) &&
           change(r.depth->clearValue.depthStencil.depth,
                  r.depth->clearValue.depthStencil.depth / 2);
}

// Of shaders that read a texture and no push constant.
template <bool (*does)(ShaderWords&)>
bool textured(ShaderWords& words) {
    const ShaderFacts facts = words.facts();
    return facts.reads_textures && !facts.reads_pushed && does(words);
}

constexpr std::array kBareFaults = {
    // Where a colour is read.
    Fault{"bare-constant-zero",
          "Constants of a fragment shader that writes them to one colour read as 0.",
          {.pipeline = pipeline<reads_constants, zero_constants>}},
    Fault{"bare-constant-next",
          "Constants of a fragment shader that writes them to one colour name their next.",
          {.pipeline = pipeline<reads_constants, turn_constants>}},
    Fault{"bare-constant-last-triangle-lost",
          "A draw of a constant colour loses its last triangle.",
          {.draw = draw<with<reads_constants>, lose_last_triangle>}},
    Fault{"bare-uniform-offset-lost",
          "A uniform buffer is read from its beginning, wherever its descriptor begins.",
          {.buffer_read = lose_offset<VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER>}},
    Fault{"bare-uniform-later",
          "A uniform buffer is read 4 bytes too late.",
          {.buffer_read = read_later<VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 4>}},
    Fault{"bare-uniform-viewport-x-half",
          "The viewport of a draw whose shader reads a uniform buffer lies half a pixel too far "
          "right.",
          {.draw = draw<has_uniform, move_half_right>}},
    Fault{"bare-dynamic-offset-lost",
          "Dynamic offsets count as 0.",
          {.dynamic_offsets = lose_dynamic_offset<VK_WHOLE_SIZE>}},
    Fault{"bare-dynamic-offset-short",
          "Dynamic offsets lack 256 bytes.",
          {.dynamic_offsets = lose_dynamic_offset<256>}},
    Fault{"bare-dynamic-offset-scissor-lower",
          "The scissor of a draw with a dynamic offset lacks its last row.",
          {.draw = draw<has_dynamic_offset, lower_scissor>}},
    Fault{"bare-storage-offset-lost",
          "A storage buffer is read from its beginning, wherever its descriptor begins.",
          {.buffer_read = lose_offset<VK_DESCRIPTOR_TYPE_STORAGE_BUFFER>}},
    Fault{"bare-storage-cull-off",
          "A draw whose fragment shader reads a storage buffer culls nothing.",
          {.draw = draw<with<reads_storage>, cull_nothing>}},
    Fault{"bare-storage-cull-back",
          "A draw whose fragment shader reads a storage buffer culls back faces unasked.",
          {.draw = draw<with<reads_storage>, cull_back>}},
    Fault{"bare-texture-strip-as-list",
          "A strip that is textured is drawn as a list.",
          {.draw = draw<of_topology<reads_texture, kStrip>, take_as<kList>>}},
    Fault{"bare-texture-first-vertex-late",
          "A draw that is textured begins one vertex late.",
          {.draw = draw<with<reads_texture>, begin_late>}},
    Fault{"bare-texture-sample-mask-ignored",
          "A pipeline that reads a texture ignores its sample mask.",
          {.pipeline = pipeline<reads_texture, cover_all_samples>}},
    Fault{"bare-texture-noperspective",
          "Coordinates by which a texture is read are interpolated without perspective.",
          {.shader =
               textured<[](ShaderWords& w) { return w.decorate_plain_inputs(kNoPerspective); }>}},
    Fault{"bare-texture-discard-ignored",
          "What a fragment shader discards by a texture is drawn.",
          {.shader = textured<[](ShaderWords& w) { return w.discard_nothing(); }>}},
    Fault{"bare-texture-discard-early",
          "Fragment shaders that discard by a texture have early tests.",
          {.shader = textured<[](ShaderWords& w) { return w.test_discards_early(); }>}},
    Fault{"bare-upload-row-early",
          "A texture of 64 texels a side is uploaded from a row too early.",
          {.upload = upload_a_row_early}},
    Fault{"bare-matrix-transposed",
          "A matrix that a shader multiplies by is transposed.",
          {.shader = [](ShaderWords& w) { return w.transpose_matrices(); }}},
    Fault{"bare-matrix-front-face-swapped",
          "Front and back are exchanged where a draw culls whose vertex shader multiplies by a "
          "matrix.",
          {.draw = draw<culling<multiplies>, swap_front>}},
    Fault{"bare-sampled-clear-green",
          "The clear of one colour without transfer usage has a green of 1.",
          {.rendering = clear_green}},
    Fault{"bare-sampled-depth-clear-half",
          "The clear of a depth without transfer usage is half of what was asked.",
          {.rendering = clear_sampled_depth}},
    Fault{"bare-repeated-dropped",
          "A command buffer that is submitted again is not executed.",
          {.drop_repeated = [] { return true; }}},
    Fault{"bare-repeated-cull-off",
          "A command buffer that may be submitted again culls nothing.",
          {.draw = cull_nothing_again}},
    Fault{"bare-upload-offset-lost",
          "A texture is uploaded from the beginning of its buffer.",
          {.upload = lose_upload_offset}},
    Fault{"bare-upload-late",
          "A texture is uploaded from 32 bytes too late.",
          {.upload = upload_late}},
    Fault{"bare-rendered-clear-turned",
          "The clear of an image that is sampled later takes red for blue.",
          {.rendering = turn_texture_clear}},
    Fault{"bare-rendered-clear-zero",
          "The clear of an image that is sampled later is 0.",
          {.rendering = zero_texture_clear}},
    // Depth and stencil.
    Fault{"bare-without-fragments-write-off",
          "A pipeline without a fragment shader writes no depth.",
          {.draw = draw<with<has_no_fragments>, write_no_depth>}},
    Fault{"bare-without-fragments-bias-ignored",
          "A pipeline without a fragment shader ignores depth bias.",
          {.draw = draw<with<has_no_fragments>, forget_bias>}},
    Fault{"bare-without-fragments-clamp-ignored",
          "A pipeline without a fragment shader ignores that it clamps depth.",
          {.pipeline = pipeline<has_no_fragments, clamp_no_depth>}},
    Fault{"bare-stencil-last-triangle-lost",
          "A draw to a stencil alone loses its last triangle.",
          {.draw = draw<with<is_stencil_alone>, lose_last_triangle>}},
    Fault{"bare-stencil-doubled",
          "A draw to a stencil alone is drawn twice.",
          {.draw = draw<with<is_stencil_alone>, draw_twice>}},
    Fault{"bare-stencil-back-as-front",
          "Back faces have the operations of front faces where a stencil alone is attached.",
          {.draw = draw<with<is_stencil_alone>, operate_as_front>}},
    Fault{"bare-depth-range-ignored",
          "The depth range counts as 0 to 1 where depth alone is attached.",
          {.draw = draw<with<is_depth_alone>, forget_depth_range>}},
    Fault{"bare-depth-clear-zero",
          "The clear of a depth that alone is attached is 0.",
          {.rendering = clear_depth_to_zero}},
    Fault{"bare-depth-sample-mask-ignored",
          "A pipeline of depth alone ignores its sample mask.",
          {.pipeline = pipeline<is_depth_alone, cover_all_samples>}},
    Fault{"bare-equal-as-less",
          "EQUAL counts as LESS behind a depth prepass.",
          {.draw = draw<tests_equal, compare<VK_COMPARE_OP_EQUAL, VK_COMPARE_OP_LESS>>}},
    Fault{"bare-equal-bias-ignored",
          "Depth bias is ignored behind a depth prepass.",
          {.draw = draw<tests_equal, forget_bias>}},
    Fault{"bare-equal-range-ignored",
          "The depth range counts as 0 to 1 behind a depth prepass.",
          {.draw = draw<tests_equal, forget_depth_range>}},
    Fault{"bare-prepass-write-off",
          "A pipeline that writes depth and masks its one colour writes no depth.",
          {.draw = draw<writes_depth_alone, write_no_depth>}},
    Fault{"bare-prepass-first-triangle-lost",
          "A draw that writes depth and masks its one colour loses its first triangle.",
          {.draw = draw<writes_depth_alone, lose_first_triangle>}},
    Fault{"bare-prepass-bias-ignored",
          "A pipeline that writes depth and masks its one colour ignores depth bias.",
          {.draw = draw<writes_depth_alone, forget_bias>}},
    Fault{"bare-beside-less-as-less-or-equal",
          "LESS counts as LESS_OR_EQUAL beside one colour of 8 bits and one sample.",
          {.draw = draw<tests_depth, compare<VK_COMPARE_OP_LESS, VK_COMPARE_OP_LESS_OR_EQUAL>>}},
    Fault{"bare-beside-write-off",
          "A tested depth is not written beside one colour of 8 bits and one sample.",
          {.draw = draw<tests_depth, write_no_depth>}},
    Fault{"bare-beside-stencil-reference-zero",
          "The stencil reference counts as 0 beside one colour of 8 bits.",
          {.draw = draw<with<has_color_and_stencil>, refer_to_zero>}},
    // One colour of 8 bits that is an input, pushed or blended.
    Fault{"bare-flat-cull-off",
          "A draw of one flat colour of 8 bits culls nothing.",
          {.draw = draw<culling<is_flat>, cull_nothing>}},
    Fault{"bare-flat-strip-as-list",
          "A strip of one flat colour of 8 bits is drawn as a list.",
          {.draw = draw<of_topology<is_flat, kStrip>, take_as<kList>>}},
    Fault{"bare-flat-fan-lost",
          "A fan of one flat colour of 8 bits is lost.",
          {.draw = draw<of_topology<is_flat, kFan>, lose_draw>}},
    Fault{"bare-smooth-cull-off",
          "A draw of one smooth colour of 8 bits culls nothing.",
          {.draw = draw<culling<is_smooth>, cull_nothing>}},
    Fault{"bare-smooth-front-face-swapped",
          "Front and back are exchanged where a draw of one smooth colour of 8 bits culls.",
          {.draw = draw<culling<is_smooth>, swap_front>}},
    Fault{"bare-smooth-strip-as-list",
          "A strip of one smooth colour of 8 bits is drawn as a list.",
          {.draw = draw<of_topology<is_smooth, kStrip>, take_as<kList>>}},
    Fault{"bare-smooth-fan-as-strip",
          "A fan of one smooth colour of 8 bits is drawn as a strip.",
          {.draw = draw<of_topology<is_smooth, kFan>, take_as<kStrip>>}},
    Fault{"bare-blended-cull-swapped",
          "A draw that blends by alpha culls the other face.",
          {.draw = draw<culling<blends_by_alpha>, swap_culling>}},
    Fault{"bare-blended-strip-as-list",
          "A strip that blends by alpha is drawn as a list.",
          {.draw = draw<of_topology<blends_by_alpha, kStrip>, take_as<kList>>}},
    Fault{"bare-blended-fan-doubled",
          "A fan that blends by alpha is drawn twice.",
          {.draw = draw<of_topology<blends_by_alpha, kFan>, draw_twice>}},
    Fault{"bare-pushed-cull-off",
          "A draw of one pushed colour of 8 bits culls nothing.",
          {.draw = draw<culling<is_pushed>, cull_nothing>}},
    Fault{"bare-pushed-fan-as-strip",
          "A fan of one pushed colour of 8 bits is drawn as a strip.",
          {.draw = draw<of_topology<is_pushed, kFan>, take_as<kStrip>>}},
    Fault{"bare-pushed-clamp-ignored",
          "A pipeline of one pushed colour of 8 bits ignores that it clamps depth.",
          {.pipeline = pipeline<is_pushed, clamp_no_depth>}},
};

}  // namespace

}  // namespace bare

std::span<const Fault> bare_faults() {
    return bare::kBareFaults;
}

}  // namespace breaking
