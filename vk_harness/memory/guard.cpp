// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/guard.hpp"

#include <algorithm>
#include <optional>

#include "capture/capture.hpp"
#include "vk_harness/memory/barrier.hpp"

namespace vk_harness {

namespace {

constexpr size_t kGuardWords = kGuardBytes / sizeof(uint32_t);

// All are powers of two.
VkDeviceSize round_up(VkDeviceSize offset, VkDeviceSize alignment) {
    return (offset + alignment - 1) & ~(alignment - 1);
}

// What is wrong with one side, `words` in the order of memory.
std::optional<GuardDamage> compare_side(std::span<const uint32_t> words, bool is_before) {
    const auto is_changed = [](uint32_t word) { return word != kGuardWord; };
    const auto changed = static_cast<uint64_t>(std::ranges::count_if(words, is_changed));
    if (changed == 0) {
        return std::nullopt;
    }
    const auto first = std::ranges::find_if(words, is_changed) - words.begin();
    const auto last = words.rend() - std::find_if(words.rbegin(), words.rend(), is_changed) - 1;
    const auto nearest = static_cast<size_t>(is_before ? last : first);
    GuardDamage damage;
    damage.is_before = is_before;
    damage.distance = (is_before ? words.size() - nearest : nearest) * uint64_t{sizeof(uint32_t)};
    damage.got = words[nearest];
    damage.words = changed;
    return damage;
}

}  // namespace

GuardPlaces place_guards(const VkMemoryRequirements& image, const VkMemoryRequirements& buffer,
                         VkDeviceSize granularity) {
    const VkDeviceSize buffer_step = std::max(buffer.alignment, granularity);
    GuardPlaces places;
    places.image = round_up(buffer.size, std::max({image.alignment, granularity}));
    places.before = (places.image - buffer.size) & ~(buffer.alignment - 1);
    places.after = round_up(places.image + image.size, buffer_step);
    places.size = places.after + buffer.size;
    return places;
}

Guard::Guard(const Device& device) {
    for (Handle<VkBuffer>* side : {&before_, &after_}) {
        *side = make_buffer(device, kGuardBytes,
                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    }
    // Those of the other buffer, made with the same parameters, are the same.
    device.vk().vkGetBufferMemoryRequirements(device.get(), before(), &needs_);
}

void Guard::bind(const Device& device, VkDeviceMemory memory, const GuardPlaces& places,
                 VkDeviceSize image_size) {
    gap_before_ = places.image - (places.before + kGuardBytes);
    gap_after_ = places.after - (places.image + image_size);
    for (const auto& [buffer, offset] :
         {std::pair(before(), places.before), std::pair(after(), places.after)}) {
        check(Stage::memory, device.vk().vkBindBufferMemory(device.get(), buffer, memory, offset),
              "vkBindBufferMemory");
    }
}

void GuardCheck::add(Guard* guard) {
    if (guard != nullptr && std::ranges::find(guards_, guard) == guards_.end()) {
        guards_.push_back(guard);
    }
}

VkDeviceSize GuardCheck::place(VkDeviceSize begin) {
    begin_ = begin;
    return begin + guards_.size() * 2 * kGuardBytes;
}

void GuardCheck::record_fills(VkCommandBuffer commands) const {
    const VolkDeviceTable& vk = device_->vk();
    bool any = false;
    for (const Guard* guard : guards_) {
        if (!guard->is_filled) {
            vk.vkCmdFillBuffer(commands, guard->before(), 0, kGuardBytes, kGuardWord);
            vk.vkCmdFillBuffer(commands, guard->after(), 0, kGuardBytes, kGuardWord);
            any = true;
        }
    }
    if (!any) {
        return;
    }
    // Before anything is drawn: what a draw writes there is not to be filled again.
    memory_barrier(*device_, commands,
                   {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT});
}

void GuardCheck::record_copies(VkCommandBuffer commands, VkBuffer readback) const {
    VkBufferCopy region{};
    region.dstOffset = begin_;
    region.size = kGuardBytes;
    for (const Guard* guard : guards_) {
        for (const VkBuffer side : {guard->before(), guard->after()}) {
            device_->vk().vkCmdCopyBuffer(commands, side, readback, 1, &region);
            region.dstOffset += kGuardBytes;
        }
    }
}

std::vector<GuardDamage> GuardCheck::read(std::span<const std::byte> memory) const {
    std::vector<GuardDamage> found;
    const auto* words = reinterpret_cast<const uint32_t*>(memory.data() + begin_);
    for (Guard* guard : guards_) {
        guard->is_filled = true;
        for (const bool is_before : {true, false}) {
            const std::span<const uint32_t> side(words, kGuardWords);
            words += kGuardWords;
            if (std::ranges::all_of(side, [](uint32_t word) { return word == capture::kPoison; })) {
                fail(Stage::readback,
                     "the memory beside an attachment was not copied from the device: it still "
                     "holds the read-back memory's fill pattern");
            }
            if (std::optional<GuardDamage> damage = compare_side(side, is_before)) {
                damage->guard = guard;
                damage->distance += guard->gap(is_before);
                guard->is_filled = false;
                found.push_back(*damage);
            }
        }
    }
    return found;
}

}  // namespace vk_harness
