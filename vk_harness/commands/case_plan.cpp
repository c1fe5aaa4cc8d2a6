// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/case_plan.hpp"

#include <fmt/format.h>

#include "vk_harness/memory/barrier.hpp"

namespace vk_harness {

std::vector<std::pair<Guard*, std::string>> guards_of(const CasePlan& plan) {
    std::vector<std::pair<Guard*, std::string>> out;
    if (plan.blit != nullptr) {
        out.emplace_back(plan.blit->guard(), "color");
    }
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (!plan.attachments[k].is_beside_depth) {
            out.emplace_back(plan.images[k]->guard(), attachment_name(plan.attachments, k));
        }
    }
    return out;
}

namespace {

constexpr ImageUse kAnyUse = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                              VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                              VK_IMAGE_LAYOUT_UNDEFINED};
constexpr ImageUse kLeftAlone = {kAnyUse.stage, kAnyUse.access,
                                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
constexpr ImageUse kCopied = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

bool is_looked_around(Role role) {
    return role == Role::writer_and_hits || role == Role::hits || role >= Role::other_color;
}

}  // namespace

VkDeviceSize place_surroundings(CasePlan& plan, VkDeviceSize begin) {
    plan.surroundings.clear();
    const cases::Target& target = plan.test->target;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& a = plan.attachments[k];
        std::optional<Surroundings> around = Surroundings::of(
            *plan.images[k], {target.width, target.height}, a.aspect(), a.texel_bytes);
        if (around && is_looked_around(a.role)) {
            begin = around->place(begin);
            plan.surroundings.push_back({k, *around});
        }
    }
    return begin;
}

void fill_surroundings(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                       VkBuffer pattern) {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (!plan.attachments[k].is_beside_depth && plan.is_filled(k)) {
            const Image& image = *plan.images[k];
            barriers.push_back(image_barrier(
                image.get(),
                {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}, kAnyUse,
                kLeftAlone));
        }
    }
    record_barriers(device, commands, barriers);
    for (const PlacedSurroundings& s : plan.surroundings) {
        s.of.record_fill(device, commands, pattern);
    }
}

void copy_surroundings(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                       VkBuffer readback) {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (!plan.attachments[k].is_beside_depth && plan.is_filled(k)) {
            for (const VkImageSubresourceRange& range : ranges_beside(*plan.images[k])) {
                barriers.push_back(
                    image_barrier(plan.images[k]->get(), range, kLeftAlone, kCopied));
            }
        }
    }
    record_barriers(device, commands, barriers);
    for (const PlacedSurroundings& s : plan.surroundings) {
        s.of.record_copy(device, commands, readback);
    }
}

std::vector<capture::StrayWrite> changed_surroundings(const CasePlan& plan,
                                                      std::span<const std::byte> memory) {
    std::vector<capture::StrayWrite> out;
    for (const PlacedSurroundings& s : plan.surroundings) {
        if (const std::optional<Surroundings::Change> change = s.of.read(memory)) {
            capture::StrayWrite write;
            write.attachment = attachment_name(plan.attachments, s.attachment);
            write.expected = Surroundings::expected(plan.attachments[s.attachment].texel_bytes);
            write.got = change->got;
            write.words = change->changed;
            write.texel = fmt::format("({}, {}) of layer {}, level {}", change->x, change->y,
                                      change->layer, change->level);
            out.push_back(std::move(write));
        }
    }
    return out;
}

std::vector<capture::StrayWrite> stray_writes(const CasePlan& plan,
                                              std::span<const GuardDamage> damage,
                                              size_t renderings) {
    std::vector<capture::StrayWrite> out;
    for (const auto& [guard, name] : guards_of(plan)) {
        for (const GuardDamage& found : damage) {
            if (found.guard == guard) {
                out.push_back({name,
                               found.is_before,
                               found.distance,
                               kGuardWord,
                               found.got,
                               found.words,
                               static_cast<uint32_t>(renderings),
                               {}});
            }
        }
    }
    return out;
}

}  // namespace vk_harness
