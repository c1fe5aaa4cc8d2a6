// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/pipeline_cache.hpp"

#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/feedback_pipeline.hpp"
#include "vk_harness/pipeline/graphics_pipeline.hpp"

namespace vk_harness {

namespace {

// What a map has for the key, else what is made for it, which the map then keeps.
template <class Key, class Object, class Make>
const Object& get_or_make(std::map<Key, Object>& kept, const Key& key, const Make& make) {
    const auto found = kept.find(key);
    return found != kept.end() ? found->second : kept.emplace(key, make()).first->second;
}

}  // namespace

void PipelineCache::trim(size_t most) {
    if (pipelines_.size() + objects_.size() > most) {
        pipelines_.clear();
        libraries_.clear();
        objects_.clear();
    }
}

VkPipeline PipelineCache::get(const PipelineKey& key) {
    const auto make = [&] {
        const VkRenderPass pass = key.pass ? get_pass(*key.pass) : VK_NULL_HANDLE;
        const VkPipeline base =
            key.made == PipelineWay::derived ? get(base_key(key)) : VK_NULL_HANDLE;
        return make_graphics(base_, key, pass, base, libraries_);
    };
    return get_or_make(pipelines_, key, make).get();
}

VkRenderPass PipelineCache::get_pass(const PassKey& key) {
    return get_or_make(passes_, key, [&] { return make_render_pass(base_.device(), key); }).get();
}

ShaderPair PipelineCache::get_objects(const PipelineKey& key) {
    const auto& made = get_or_make(objects_, key, [&] { return make_objects(base_, key); });
    return {made[0].get(), made[1].get()};
}

VkPipeline PipelineCache::get_feedback(uint32_t attribute_count) {
    return get_or_make(feedbacks_, attribute_count,
                       [&] { return make_feedback(base_, attribute_count); })
        .get();
}

VkPipeline PipelineCache::get_clear(const ClearKey& key) {
    return get_or_make(clears_, key, [&] { return make_clear(base_, key); }).get();
}

VkPipeline PipelineCache::get_input(const InputKey& key) {
    return get_or_make(inputs_, key, [&] { return make_input(base_, key, get_pass(key.pass)); })
        .get();
}

VkPipeline PipelineCache::get_copy(const Attachment& attachment) {
    if (attachment.is_sampled) {
        return get_copy(attachment.is_depth() ? shaders::copy_codes_of_depth()
                                              : shaders::copy_codes_of_color());
    }
    return get_copy(shaders::copy_samples(attachment.is_depth(), attachment.sample_bytes / 4));
}

VkPipeline PipelineCache::get_code_copy() {
    return get_copy(shaders::copy_codes_of_depth());
}

VkPipeline PipelineCache::get_copy(std::span<const uint32_t> source) {
    const auto make = [&] {
        const Device& device = base_.device();
        VkComputePipelineCreateInfo info = Typed{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, base_.shader_module(source));
        info.layout = layouts().copy.get();
        VkPipeline pipeline = VK_NULL_HANDLE;
        check(Stage::pipeline,
              device.vk().vkCreateComputePipelines(device.get(), base_.cache(), 1, &info, nullptr,
                                                   &pipeline),
              "vkCreateComputePipelines");
        return Handle<VkPipeline>(device.get(), pipeline, device.vk().vkDestroyPipeline);
    };
    return get_or_make(copies_, source.data(), make).get();
}

}  // namespace vk_harness
