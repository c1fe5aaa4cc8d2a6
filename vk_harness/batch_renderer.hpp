// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Plans a batch, records it, submits it once, reads it back.
#pragma once

#include "vk_harness/commands/lod_texture.hpp"
#include "vk_harness/commands/submission.hpp"
#include "vk_harness/depth_codes.hpp"
#include "vk_harness/device/rejection.hpp"
#include "vk_harness/renderings.hpp"

namespace vk_harness {

class BatchRenderer {
  public:
    // Throws Failure.
    explicit BatchRenderer(const Options& options);
    BatchRenderer(const BatchRenderer&) = delete;
    BatchRenderer& operator=(const BatchRenderer&) = delete;
    ~BatchRenderer();

    // As Renderer::render; of bare drawing nothing is read back.
    std::vector<Rendered> render(std::span<const cases::Case> batch, bool read_back,
                                 const Step& step, const PlaneStore& store = {});

    Device& device() { return device_; }
    const Device& device() const { return device_; }

  private:
    // As render(), of renderings: results in their order.
    std::vector<Rendered> draw(std::span<const Rendering> batch, bool read_back, const Step& step,
                               const PlaneStore& store);
    // Draws what was planned, and says in the results if that fails.
    void run_chunk(std::vector<CasePlan>& plans, bool read_back, std::vector<Rendered>& results,
                   const Step& step, const PlaneStore& store);
    // Draws the plans in one submission. A case that is_large() and alone is read back by rows.
    // Returns what was written beside attachments, if they are read back.
    std::vector<GuardDamage> draw_chunk(std::span<CasePlan> plans, bool read_back,
                                        std::vector<Rendered>& results, const Step& step,
                                        const PlaneStore& store);
    // Finds out which of the plans, drawn in one submission, did the damage: each is drawn alone.
    void blame(std::span<CasePlan> plans, std::span<const GuardDamage> damage,
               std::vector<Rendered>& results, const Step& step);

    // The buffer with the vertices of all plans.
    Buffer& write_vertices_of(std::span<CasePlan> plans);
    // The poisoned buffer in which all samples have their places, but those that are read by rows.
    Buffer& make_readback(std::span<CasePlan> plans, bool by_rows, GuardCheck& guards);
    // The commands of one case, with secondary command buffers if its door asks for them;
    // `commands` is then the buffer to go on with. `readback`: where samples go, if they do.
    void record(VkCommandBuffer& commands, CasePlan& plan, VkBuffer vertices,
                const Buffer* readback, bool by_rows);
    VkDeviceSize alignment() const;  // of everything in the read-back buffer
    // Where the planes of a case go that has been drawn: to the store's memory, if it has room.
    capture::PlaneSpans place_planes(const CasePlan& plan, Rendered& result,
                                     const PlaneStore& store) const;
    // Depth of D24 whose single samples a shader has read, of `memory` as it was read back; of a
    // device whose codes cannot be told the case is unsupported.
    void read_depth_codes(const CasePlan& plan, std::span<const std::byte> memory,
                          const capture::PlaneSpans& planes, Rendered& result);

    Instance instance_;
    Device device_;
    PipelineCache pipelines_;
    TargetCache targets_;
    LodTextures textures_;
    Submission submission_;
    std::optional<Submission> asking_;  // of depth_codes_, once it is needed
    DepthCodes depth_codes_;
    std::string lost_;  // why the device is lost, once it is
};

}  // namespace vk_harness
