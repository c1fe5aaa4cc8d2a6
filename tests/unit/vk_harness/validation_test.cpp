// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The harness must use Vulkan rightly, or a finding might be its own fault: nothing that it does
// may make the Khronos validation layer speak.
#include <gmock/gmock.h>

#include <utility>

#include "hand_case.hpp"
#include "vk_harness/device/device.hpp"

namespace vk_harness::testing {
namespace {

Options with_validation() {
    Options options;
    options.validation = true;
    return options;
}

cases::Attribute constant(cases::Interpolation interpolation, size_t vertices) {
    cases::Attribute attribute;
    attribute.name = "constant";
    attribute.interpolation = interpolation;
    attribute.values.assign(vertices, glm::vec4(0.5F));
    return attribute;
}

// Every topology, culling and facing mode, number of attributes, sample count, and several draws.
std::vector<cases::Case> all_states() {
    using cases::Interpolation;
    std::vector<cases::Case> batch;
    for (const uint32_t samples : {1U, 4U}) {
        for (uint32_t attributes = 0; attributes <= cases::kMaxAttributes; ++attributes) {
            cases::Case c = make_case({32, 16, samples}, half_square());
            for (uint32_t k = 0; k < attributes; ++k) {
                c.draws[0].attributes.push_back(constant(static_cast<Interpolation>(k % 3), 3));
            }
            cases::Draw strip = c.draws[0];
            strip.topology = cases::Topology::triangle_strip;
            strip.indices = {{0, 1, 2, cases::kRestartIndex, 2, 1, 0}};
            strip.primitive_restart = true;
            strip.cull = cases::CullMode::back;
            strip.viewport = {0, 16, 32, -16, 1, 0};
            cases::Draw fan = c.draws[0];
            fan.topology = cases::Topology::triangle_fan;
            fan.front_face = cases::FrontFace::clockwise;
            fan.scissor = {3, 2, 100, 0};
            fan.attributes.clear();
            c.draws.push_back(strip);
            c.draws.push_back(fan);
            batch.push_back(c);
            c.draws[0].multisample = {5U, {}, 0.0F};
            c.draws[1].multisample.min_sample_shading = 1.0F;
            batch.push_back(c);
        }
    }
    // Layers, chosen by gl_Layer and not.
    for (const uint32_t samples : {1U, 4U}) {
        cases::Case c = make_case({32, 16, samples, 3}, half_square());
        batch.push_back(c);
        c.draws[0].layer = 2;
        c.draws.push_back(c.draws[0]);
        c.draws[1].layer = 1;
        c.draws[1].viewport_index = 1;
        batch.push_back(c);
        c.target.has_stencil = true;
        batch.push_back(c);
    }
    batch.push_back(make_case({8, 8, 1}, {}));
    return batch;
}

TEST(Validation, NothingToSayAboutAnyDoor) {
    auto renderer = make_renderer(with_validation());
    ASSERT_TRUE(renderer) << renderer.error().message;
    std::vector<cases::Case> batch;
    for (const cases::DoorRow& row : cases::all_doors()) {
        cases::Case c = make_case({32, 16, 1}, half_square());
        c.draws[0].attributes.push_back(constant(cases::Interpolation::smooth, 3));
        c.draws.push_back(c.draws[0]);
        c.draws[1].topology = cases::Topology::triangle_strip;
        c.draws[1].indices = {{0, 1, 2}};
        if (row.door == cases::Door::transform_feedback) {
            c.draws.pop_back();  // no strips
        }
        c.variation.door = row.door;
        batch.push_back(c);
    }
    for (const Rendered& rendered : (*renderer)->render(batch)) {
        EXPECT_THAT(rendered.messages, ::testing::IsEmpty());
        EXPECT_NE(rendered.status, Rendered::Status::error) << rendered.reason;
    }
}

TEST(Validation, NothingToSayAboutAnyState) {
    auto renderer = make_renderer(with_validation());
    ASSERT_TRUE(renderer) << renderer.error().message;
    const std::vector<cases::Case> batch = all_states();
    // Twice: the second time with cached pipelines, attachments and buffers.
    for (int round = 0; round < 2; ++round) {
        for (const Rendered& rendered : (*renderer)->render(batch)) {
            EXPECT_EQ(rendered.status, Rendered::Status::drawn) << rendered.reason;
            EXPECT_THAT(rendered.messages, ::testing::IsEmpty());
        }
        for (const Rendered& rendered : render_bare(**renderer, batch)) {
            EXPECT_EQ(rendered.status, Rendered::Status::drawn) << rendered.reason;
        }
    }
    // Messages of render_bare would come with the next case.
    const std::vector<cases::Case> last = {make_case({8, 8, 1}, half_square())};
    EXPECT_THAT((*renderer)->render(last).front().messages, ::testing::IsEmpty());
}

// Every probe, auxiliary qualifier and built-in, with one sample and with four; cases that the
// device does not support say so.
TEST(Validation, NothingToSayAboutProbesAndSources) {
    auto renderer = make_renderer(with_validation());
    ASSERT_TRUE(renderer) << renderer.error().message;
    std::vector<cases::Case> batch;
    const auto add = [&](uint32_t samples, const cases::Attribute& attribute) {
        cases::Case c = make_case({16, 16, samples}, half_square());
        c.draws[0].attributes = {attribute};
        batch.push_back(std::move(c));
    };
    for (const uint32_t samples : {1U, 4U}) {
        for (uint8_t probe = 0; probe <= static_cast<uint8_t>(cases::Probe::lod); ++probe) {
            cases::Attribute a = constant(cases::Interpolation::smooth, 3);
            a.probe = static_cast<cases::Probe>(probe);
            a.components = 2;
            a.texture_size = {64, 16};
            add(samples, a);
        }
        for (const auto auxiliary : {cases::Auxiliary::centroid, cases::Auxiliary::sample}) {
            cases::Attribute a = constant(cases::Interpolation::noperspective, 3);
            a.auxiliary = auxiliary;
            add(samples, a);
        }
        for (const auto source : {cases::Source::barycentric, cases::Source::sample_mask_in,
                                  cases::Source::sample_id, cases::Source::sample_position}) {
            cases::Attribute a;
            a.name = "built-in";
            a.source = source;
            add(samples, a);
        }
    }
    size_t drawn = 0;
    for (const Rendered& rendered : (*renderer)->render(batch)) {
        EXPECT_TRUE(rendered.status == Rendered::Status::drawn ||
                    rendered.status == Rendered::Status::unsupported)
            << rendered.reason;
        EXPECT_THAT(rendered.messages, ::testing::IsEmpty());
        drawn += rendered.status == Rendered::Status::drawn ? 1U : 0U;
    }
    EXPECT_GT(drawn, 10U);
}

TEST(Validation, MisuseIsHeard) {
    const Instance instance = Instance::create(with_validation());
    const Device device = Device::create(choose_device(instance, {}));
    EXPECT_THAT(instance.messages().take(), ::testing::IsEmpty());
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = 0;  // must be greater than 0
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    if (device.vk().vkCreateBuffer(device.get(), &info, nullptr, &buffer) == VK_SUCCESS) {
        device.vk().vkDestroyBuffer(device.get(), buffer, nullptr);
    }
    EXPECT_THAT(instance.messages().take(),
                ::testing::Contains(::testing::HasSubstr("VUID-VkBufferCreateInfo-size-00912")));
}

}  // namespace
}  // namespace vk_harness::testing
