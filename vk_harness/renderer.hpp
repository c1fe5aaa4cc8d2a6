// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The body of Renderer: plans a batch, records it, submits it once, reads it back.
#pragma once

#include "vk_harness/commands/lod_texture.hpp"
#include "vk_harness/commands/record.hpp"
#include "vk_harness/depth_codes.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

// Commands and memory of one submission, reused by the next.
class Submission {
  public:
    static Result<Submission> create(const Device& device);

    // The vertex buffer of at least `size` bytes; the read-back buffer likewise.
    Result<Buffer*> vertices(VkDeviceSize size);
    Result<Buffer*> readback(VkDeviceSize size);
    // Frees buffers larger than `limit` bytes.
    void trim(VkDeviceSize limit);

    Result<VkCommandBuffer> begin();
    // Ends recording, submits, and begins another command buffer, which is executed after it.
    Result<VkCommandBuffer> next();
    // Secondary command buffers that are in no use since the last begin().
    Result<std::vector<VkCommandBuffer>> secondaries(size_t count);
    // Ends recording, submits, and waits until the device has finished.
    Result<void> run();

    // Descriptor sets for copying the samples of one case; they live until the next begin().
    Result<std::vector<VkDescriptorSet>> copy_sets(const PipelineCache& pipelines,
                                                   const CasePlan& plan);
    // The same for reading its input attachments, into the plan; it is placed in the read-back
    // buffer.
    Result<void> make_input_sets(const PipelineCache& pipelines, CasePlan& plan);

  private:
    explicit Submission(const Device& device) : device_(&device) {}
    Result<Buffer*> grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage,
                         HostAccess access);

    // Makes them `count` command buffers at least.
    Result<void> allocate(std::vector<VkCommandBuffer>& buffers, size_t count,
                          VkCommandBufferLevel level);
    // Begins a primary command buffer that is in no use since the last begin().
    Result<VkCommandBuffer> begin_next();
    Result<void> submit(VkFence fence);  // ends recording before

    const Device* device_;
    Handle<VkCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;             // that is recorded
    std::vector<VkCommandBuffer> primaries_, secondaries_;  // owned by the pool
    size_t used_primaries_ = 0, used_secondaries_ = 0;      // since the last begin()
    Handle<VkFence> fence_;
    std::vector<Handle<VkDescriptorPool>> descriptor_pools_;
    Buffer vertices_;
    Buffer readback_;
};

// Where a case's planes are guarded, and what the attachments are called.
std::vector<std::pair<Guard*, std::string>> guards_of(const CasePlan& plan);

// FragCoord of a case that is drawn elsewhere in its target, as it is at the origin: whole pixels
// are taken off again, exactly.
void move_back(const CasePlan& plan, const capture::PlaneSpans& planes);

// The locations that gl_SamplePosition told, pixel by pixel; empty if they differ among pixels or
// are not in sixteenths of a pixel.
cases::SampleLocations told_locations(std::span<const glm::vec4> positions, uint32_t samples);

// What a failed call makes of a case's result.
void reject(Rendered& result, const Failure& failure);

// Memory for the planes that a capture of this target has, of case `slot` of the batch: the store's
// if it has some (Rendered::placed), else the capture's own.
capture::PlaneSpans placed_planes(Rendered& result, size_t slot, const PlaneStore& store);

// One of those that a batch is drawn in.
struct Rendering {
    const cases::Case* test = nullptr;
    bool reads_hits = true;  // check_case()
};

class BatchRenderer {
  public:
    static Result<BatchRenderer> create(const Options& options);
    BatchRenderer(BatchRenderer&&) noexcept = default;
    ~BatchRenderer();

    // As Renderer::render, or render_bare if not `read_back`.
    std::vector<Rendered> render(std::span<const cases::Case> filed, bool read_back,
                                 const std::function<void(std::string_view)>& step,
                                 const PlaneStore& store = {});

    // Why the case cannot be drawn; nothing if it can.
    std::optional<Rejection> check(const cases::Case& c) const;

    // Where the device's samples are, if it does not promise the standard locations: into its
    // DeviceInfo, or why it could not be asked.
    void ask_sample_locations();

    const Device& device() const { return *device_; }

  private:
    // The cases with the depth that the device has beside a stencil, if it lacks D32S8; none if no
    // case needs that.
    std::vector<cases::Case> with_own_depth(std::span<const cases::Case> batch) const;
    // As render(), of renderings: results in their order.
    std::vector<Rendered> draw(std::span<const Rendering> batch, bool read_back,
                               const std::function<void(std::string_view)>& step,
                               const PlaneStore& store);
    BatchRenderer(Instance instance, std::unique_ptr<Device> device, PipelineCache pipelines,
                  Submission submission);
    VkDeviceSize alignment() const;  // of everything in the read-back buffer
    // Pipelines, attachments and places of one case; nothing if the result says why not.
    bool plan(CasePlan& plan, Rendered& result);
    void run_chunk(std::vector<CasePlan>& plans, bool read_back, std::vector<Rendered>& results,
                   const std::function<void(std::string_view)>& step, const PlaneStore& store);
    // `damage`: what was written beside attachments, if they are read back.
    Result<void> draw_chunk(std::span<CasePlan> plans, bool read_back,
                            std::vector<Rendered>& results,
                            const std::function<void(std::string_view)>& step,
                            const PlaneStore& store, std::vector<GuardDamage>& damage);
    // The render pass and framebuffer of a case that has_pass().
    Result<void> plan_pass(CasePlan& plan, const TargetLayout& layout);
    // What reads the input attachments of that pass.
    Result<void> plan_inputs(CasePlan& plan, const PassKey& pass);
    // The pipeline of a draw, or its shaders where there is none.
    Result<void> plan_shaders(DrawPlan& item, const PipelineKey& key, cases::Door door);
    // What clears the attachments of a case that is cleared by draws.
    Result<void> plan_clears(CasePlan& plan);
    // The commands of one case, with secondary command buffers if its door asks for them;
    // `commands` is then the buffer to go on with.
    Result<void> record(VkCommandBuffer& commands, CasePlan& plan, VkBuffer vertices,
                        bool read_back);
    // Where the planes of a case go that has been drawn: to the store's memory, if it has room.
    capture::PlaneSpans place_planes(const CasePlan& plan, Rendered& result,
                                     const PlaneStore& store) const;
    // Depth of D24 whose single samples a shader has read, of `memory` as it was read back; of a
    // device whose codes cannot be told the case is unsupported.
    Result<void> read_depth_codes(const CasePlan& plan, std::span<const std::byte> memory,
                                  const capture::PlaneSpans& planes, Rendered& result);
    // What the case's queries counted, into its capture.
    static Result<void> read_queries(const CasePlan& plan, Rendered& result);
    // Whether a case that is drawn alone is so large that draw_large() reads it back.
    static bool is_large(std::span<const CasePlan> plans);
    // As draw_chunk() with read-back, of one case, in little more memory than its capture takes:
    // attachments are read back one after another, by rows, and freed.
    Result<void> draw_large(CasePlan& plan, Rendered& result,
                            const std::function<void(std::string_view)>& step,
                            const PlaneStore& store, std::vector<GuardDamage>& damage);
    // Reads attachments back that are decoded together, from `first` up to `end`.
    Result<void> read_rows(const CasePlan& plan, size_t first, size_t end,
                           const capture::PlaneSpans& to);
    // Finds out which of the plans, drawn in one submission, did the damage: each is drawn alone.
    Result<void> blame(std::span<CasePlan> plans, std::span<const GuardDamage> damage,
                       std::vector<Rendered>& results,
                       const std::function<void(std::string_view)>& step);

    Instance instance_;
    std::unique_ptr<Device> device_;  // stable address: everything below points to it
    PipelineCache pipelines_;
    TargetCache targets_;
    LodTextures textures_;
    Submission submission_;
    std::optional<Submission> asking_;  // of depth_codes_, once it is needed
    DepthCodes depth_codes_;
    std::string lost_;  // why the device is lost, once it is
};

struct Renderer::Impl {
    BatchRenderer body;
};

}  // namespace vk_harness
