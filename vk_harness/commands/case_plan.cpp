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
    const bool is_d24 = target.depth_format == cases::DepthFormat::d24_unorm;
    const auto add = [&](size_t k, VkExtent2D size, VkImageAspectFlags aspect, uint32_t bytes) {
        if (std::optional<Surroundings> around =
                Surroundings::of(*plan.images[k], size, aspect, bytes, is_d24)) {
            begin = around->place(begin);
            plan.surroundings.push_back({k, *around});
        }
    };
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& a = plan.attachments[k];
        if (plan.images[k]->alias() != VK_NULL_HANDLE) {
            continue;  // spoil_aliases() leaves no contents
        }
        if (is_looked_around(a.role)) {
            add(k, {target.width, target.height}, a.aspect(), a.texel_bytes);
        }
        // Of a resolve by VK_RESOLVE_MODE_NONE nothing comes. A render pass object has no such
        // image whose contents it neither loads nor spoils.
        if (a.is_resolved() && a.is_depth_stencil() && target.has_depth && plan.pass == nullptr &&
            plan.images[k]->whole().has_spare_aspect) {
            a.is_depth() ? add(k, {}, VK_IMAGE_ASPECT_STENCIL_BIT, 1)
                         : add(k, {}, VK_IMAGE_ASPECT_DEPTH_BIT, row_of(target.depth_format).bytes);
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
            if (s.of.aspect() != plan.attachments[s.attachment].aspect()) {
                write.attachment += ", the other aspect";
            }
            write.expected = s.of.expected();
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
