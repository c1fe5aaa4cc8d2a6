// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory before and after an image, in the image's own allocation, that nothing but a driver's
// error can write to: a buffer on either side, filled with a pattern and read back after drawing.
#pragma once

#include <span>
#include <vector>

#include "vk_harness/device/device.hpp"

namespace vk_harness {

// A row of 64 texels of the widest format: what is written beside an image begins at its border or,
// in targets as small as most of the suite, within a row of it. A submission reads back two guards
// of each of its images, some hundred in all.
inline constexpr VkDeviceSize kGuardBytes = 1024;
// This word is neither a clear value nor capture::kPoison.
inline constexpr uint32_t kGuardWord = 0xed9eca5eU;

// Byte offsets of both guards and of the image between them, and the bytes of it all.
struct GuardPlaces {
    VkDeviceSize before = 0, image = 0, after = 0, size = 0;
};
// As close to the image as alignments and bufferImageGranularity let them be.
GuardPlaces place_guards(const VkMemoryRequirements& image, const VkMemoryRequirements& buffer,
                         VkDeviceSize granularity);

// The two buffers of an image.
class Guard {
  public:
    explicit Guard(const Device& device);

    VkMemoryRequirements needs() const { return needs_; }  // of either
    // `image_size`: bytes of the image between them.
    void bind(const Device& device, VkDeviceMemory memory, const GuardPlaces& places,
              VkDeviceSize image_size);

    VkBuffer before() const { return before_.get(); }
    VkBuffer after() const { return after_.get(); }
    // Bytes between a guard and the image's memory: where alignments ask for them.
    VkDeviceSize gap(bool is_before) const { return is_before ? gap_before_ : gap_after_; }
    // Whether both hold the pattern, as far as anybody knows.
    bool is_filled = false;

  private:
    Handle<VkBuffer> before_, after_;
    VkMemoryRequirements needs_{};
    VkDeviceSize gap_before_ = 0, gap_after_ = 0;
};

// What a submission has left in the guards of an image, on one side.
struct GuardDamage {
    const Guard* guard = nullptr;
    bool is_before = false;
    uint64_t distance = 0;  // as capture::StrayWrite has it
    uint32_t got = 0;       // that word
    uint64_t words = 0;     // that changed
};

// The guards of one submission: filled where they are not, copied behind the last draw, compared.
class GuardCheck {
  public:
    explicit GuardCheck(const Device& device) : device_(&device) {}

    // Null and what was added before are left out.
    void add(Guard* guard);
    // They are copied to read-back memory from byte `begin` on; returns the end.
    VkDeviceSize place(VkDeviceSize begin);
    void record_fills(VkCommandBuffer commands) const;
    void record_copies(VkCommandBuffer commands, VkBuffer readback) const;
    // What was recorded has run. Guards that are damaged count as not filled.
    std::vector<GuardDamage> read(std::span<const std::byte> memory) const;

  private:
    const Device* device_;
    std::vector<Guard*> guards_;
    VkDeviceSize begin_ = 0;
};

}  // namespace vk_harness
