// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/renderer.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"
#include "vk_harness/case_check.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

namespace {

// Read-back memory of one submission, and attachments kept between submissions. Larger cases run
// alone.
constexpr VkDeviceSize kChunkBytes = VkDeviceSize{256} << 20;
constexpr VkDeviceSize kKeptBytes = VkDeviceSize{512} << 20;
// Pipelines and shader objects kept between submissions. The cases of a family follow each other,
// so that few are asked for again behind these: a run of the suite takes as long with 4,096. One of
// lavapipe takes some 600 KB, and a run through all doors makes tens of thousands.
constexpr size_t kKeptPipelines = 256;
// Pictures through doors in one submission. A worker gives a sign of life before a submission and
// after it, and none while it waits for the device; after 30 s without any (--timeout) it counts as
// hung. A case goes through up to some sixty doors, and there are cases that take a driver seconds
// each time (docs/findings/swiftshader-bad-numbers.md has one of 4.4 s): in one submission they
// would take minutes. Four pictures through doors and the plain one stay within the 30 s if each
// takes less than 6 s.
constexpr size_t kDoorsOfSubmission = 4;

// What is kept must not be why the next allocation fails, on a device of little memory.
VkDeviceSize kept_bytes(const Capabilities& c) {
    return std::min(kKeptBytes, c.total_memory / 8);
}

}  // namespace

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

void move_back(const CasePlan& plan, const capture::PlaneSpans& planes) {
    const VkOffset2D origin = plan.blit ? VkOffset2D{} : image_way(*plan.test).origin();
    if (origin.x == 0 && origin.y == 0) {
        return;
    }
    for (glm::vec4& coordinate : planes.frag_coord) {
        // A clear value and what was never copied stay as they are.
        if (coordinate.x > capture::kOtherClearValue) {
            coordinate.x -= static_cast<float>(origin.x);
            coordinate.y -= static_cast<float>(origin.y);
        }
    }
}

namespace {

// Of the damage, what lies beside the case's attachments.
std::vector<capture::StrayWrite> stray_writes(const CasePlan& plan,
                                              std::span<const GuardDamage> damage,
                                              size_t renderings) {
    std::vector<capture::StrayWrite> out;
    for (const auto& [guard, name] : guards_of(plan)) {
        for (const GuardDamage& found : damage) {
            if (found.guard == guard) {
                out.push_back({name, found.is_before, found.distance, kGuardWord, found.got,
                               found.words, static_cast<uint32_t>(renderings)});
            }
        }
    }
    return out;
}

// Whether a rendering gets a submission of its own. A driver would spoil other cases, too, and
// whose fault that is could not be told, if it never left a pipeline's rasterizer discard, blended
// all colours as the first behind a pipeline without any (docs/findings), or lost one of several
// submissions. The host's memory may be refused, and a query begins before any pipeline only in a
// command buffer that has had none.
bool is_drawn_alone(const Device& device, const cases::Case& c) {
    if (c.variation.door == cases::Door::submissions ||
        c.variation.door == cases::Door::memory_imported ||
        c.variation.door == cases::Door::transform_feedback ||
        c.variation.door == cases::Door::input_attachment ||
        c.variation.door == cases::Door::query_first) {
        return true;
    }
    const bool is_static =
        c.variation.door == cases::Door::state_static || !device.capabilities().core.dynamic_state;
    return is_static && std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& draw) {
               return draw.rasterizer_discard;
           });
}

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

BatchRenderer::BatchRenderer(Instance instance, std::unique_ptr<Device> device,
                             PipelineCache pipelines, Submission submission)
    : instance_(std::move(instance)),
      device_(std::move(device)),
      pipelines_(std::move(pipelines)),
      targets_(*device_),
      textures_(*device_),
      submission_(std::move(submission)),
      depth_codes_(*device_) {}

BatchRenderer::~BatchRenderer() {
    // Nothing may be freed while the device still works on it, as after a wait that failed.
    if (device_) {
        device_->vk().vkDeviceWaitIdle(device_->get());
    }
}

Result<void> BatchRenderer::record(VkCommandBuffer& commands, CasePlan& plan, VkBuffer vertices,
                                   bool read_back) {
    auto secondaries = submission_.secondaries(secondaries_of(plan));
    if (!secondaries) {
        return fail(secondaries.error());
    }
    plan.secondaries = std::move(*secondaries);
    return record_draws(*device_, pipelines_, commands, plan, vertices, read_back,
                        [this] { return submission_.next(); });
}

Result<void> BatchRenderer::read_queries(const CasePlan& plan, Rendered& result) {
    if (!plan.queries) {
        return {};
    }
    return put(result.capture.counted, plan.queries->read());
}

Result<void> BatchRenderer::read_depth_codes(const CasePlan& plan,
                                             std::span<const std::byte> memory,
                                             const capture::PlaneSpans& planes, Rendered& result) {
    const cases::Target& target = plan.test->target;
    const auto depth = std::ranges::find(plan.attachments, Role::depth, &Attachment::role);
    if (target.samples == 1 || target.depth_format != cases::DepthFormat::d24_unorm ||
        depth == plan.attachments.end()) {
        return {};
    }
    if (!asking_) {
        auto made = Submission::create(*device_);
        if (!made) {
            return fail(made.error());
        }
        asking_ = std::move(*made);
    }
    const auto k = static_cast<size_t>(depth - plan.attachments.begin());
    const std::span words(
        reinterpret_cast<const uint32_t*>(memory.data() + plan.readback.offset[k]),
        planes.depth.size());
    if (auto learned = depth_codes_.learn(*asking_, pipelines_, depth->format, words); !learned) {
        return learned;
    }
    if (auto untold = depth_codes_.decode(depth->format, words, planes.depth)) {
        result.status = Rendered::Status::unsupported;
        result.reason = *std::move(untold);
    }
    return {};
}

capture::PlaneSpans placed_planes(Rendered& result, size_t slot, const PlaneStore& store) {
    capture::Capture& capture = result.capture;
    if (store) {
        result.placed = store(slot, capture::plane_bytes(capture.target, capture.attribute_count));
    }
    if (!result.placed.empty()) {
        return capture::planes_at(capture.target, capture.attribute_count, result.placed.data());
    }
    capture::for_each_plane(
        [](const capture::Plane& plane, auto& entries) { entries.resize(plane.entries); }, capture,
        capture);
    return capture::PlaneSpans(capture);
}

capture::PlaneSpans BatchRenderer::place_planes(const CasePlan& plan, Rendered& result,
                                                const PlaneStore& store) const {
    const cases::Target& target = plan.test->target;
    capture::Capture& capture = result.capture;
    capture.target = target;
    capture.has_primitive = device_->capabilities().info.has_primitive_id;
    capture.has_half_hits = counts_in_halves(plan.attachments);
    capture.attribute_count = target.has_instruments ? cases::attributes_of(*plan.test) : 0;
    return placed_planes(result, plan.slot, store);
}

Result<void> BatchRenderer::draw_chunk(std::span<CasePlan> plans, bool read_back,
                                       std::vector<Rendered>& results,
                                       const std::function<void(std::string_view)>& step,
                                       const PlaneStore& store, std::vector<GuardDamage>& damage) {
    step("record");
    GuardCheck guards(*device_);
    VkDeviceSize vertex_bytes = 0;
    VkDeviceSize readback_bytes = 0;
    for (CasePlan& plan : plans) {
        vertex_bytes = place_vertices(plan, vertex_bytes);
        plan.readback =
            make_layout(plan.test->target, plan.attachments, readback_bytes, alignment());
        readback_bytes = plan.readback.end;
        for (const auto& [guard, name] : guards_of(plan)) {
            guards.add(guard);
        }
    }
    readback_bytes = guards.place(readback_bytes);
    auto vertices = submission_.vertices(vertex_bytes);
    if (!vertices) {
        return fail(vertices.error());
    }
    for (const CasePlan& plan : plans) {
        write_vertices(plan, (*vertices)->bytes());
        if (auto made = make_door_buffers(*device_, pipelines_, plan, (*vertices)->bytes());
            !made) {
            return made;
        }
    }
    if (auto flushed = (*vertices)->flush(); !flushed) {
        return flushed;
    }
    auto commands = submission_.begin();
    if (!commands) {
        return fail(commands.error());
    }

    textures_.record_transitions(*commands);

    Buffer* readback = nullptr;
    if (read_back) {
        auto buffer = submission_.readback(readback_bytes);
        if (!buffer) {
            return fail(buffer.error());
        }
        readback = *buffer;
        poison(readback->bytes().first(readback_bytes));
        if (auto flushed = readback->flush(); !flushed) {
            return flushed;
        }
        guards.record_fills(*commands);
    }
    for (CasePlan& plan : plans) {
        if (plan.blit != nullptr) {
            plan.blit->record(*device_, *commands, *plan.test, plan.attachments.front().clear.color,
                              read_back ? readback->get() : VK_NULL_HANDLE,
                              plan.readback.offset.front());
            append(results[plan.slot].messages, instance_.messages().take());
            continue;
        }
        if (read_back) {
            if (auto made = submission_.make_input_sets(pipelines_, plan); !made) {
                return made;
            }
        }
        if (auto recorded = record(*commands, plan, (*vertices)->get(), read_back); !recorded) {
            return recorded;
        }
        if (read_back) {
            std::vector<VkDescriptorSet> sets;
            std::vector<VkPipeline> copies;
            if (plan.test->target.samples > 1) {
                for (const Attachment& attachment : plan.attachments) {
                    auto copy = pipelines_.get_copy(attachment);
                    if (!copy) {
                        return fail(copy.error());
                    }
                    copies.push_back(*copy);
                }
                auto made = submission_.copy_sets(pipelines_, plan);
                if (!made) {
                    return fail(made.error());
                }
                sets = std::move(*made);
            }
            record_copies(*device_, copies, pipelines_.copy_layout(), *commands, plan,
                          readback->get(), sets);
        }
        append(results[plan.slot].messages, instance_.messages().take());
    }

    if (read_back) {
        guards.record_copies(*commands, readback->get());
    }

    step("submit");
    if (auto done = submission_.run(); !done) {
        return done;
    }
    for (const CasePlan& plan : plans) {
        results[plan.slot].status = Rendered::Status::drawn;
    }
    if (read_back) {
        step("readback");
        if (auto visible = readback->invalidate(); !visible) {
            return visible;
        }
        auto found = guards.read(readback->bytes());
        if (!found) {
            return fail(found.error());
        }
        damage = std::move(*found);
        for (const CasePlan& plan : plans) {
            const capture::PlaneSpans planes = place_planes(plan, results[plan.slot], store);
            read_planes(plan.attachments, plan.readback, readback->bytes(), planes);
            move_back(plan, planes);
            Rendered& result = results[plan.slot];
            if (auto read = read_depth_codes(plan, readback->bytes(), planes, result); !read) {
                return read;
            }
            if (auto read = read_queries(plan, result); !read) {
                return read;
            }
        }
    }
    return {};
}

Result<void> BatchRenderer::blame(std::span<CasePlan> plans, std::span<const GuardDamage> damage,
                                  std::vector<Rendered>& results,
                                  const std::function<void(std::string_view)>& step) {
    bool is_found = false;
    for (size_t k = 0; plans.size() > 1 && k < plans.size(); ++k) {
        std::vector<Rendered> again(results.size());
        std::vector<GuardDamage> alone;
        if (auto done = draw_chunk(plans.subspan(k, 1), true, again, step, {}, alone); !done) {
            return done;
        }
        results[plans[k].slot].stray_writes = stray_writes(plans[k], alone, 1);
        is_found = is_found || !alone.empty();
    }
    for (size_t k = 0; !is_found && k < plans.size(); ++k) {
        results[plans[k].slot].stray_writes = stray_writes(plans[k], damage, plans.size());
    }
    return {};
}

VkDeviceSize BatchRenderer::alignment() const {
    // Copies need a multiple of 16 (the texel) and gain from the optimal alignment; the shader that
    // reads single samples needs minStorageBufferOffsetAlignment. All are powers of two.
    const VkPhysicalDeviceLimits& limits = device_->capabilities().limits;
    return std::max({VkDeviceSize{64}, limits.minStorageBufferOffsetAlignment,
                     limits.optimalBufferCopyOffsetAlignment});
}

void BatchRenderer::run_chunk(std::vector<CasePlan>& plans, bool read_back,
                              std::vector<Rendered>& results,
                              const std::function<void(std::string_view)>& step,
                              const PlaneStore& store) {
    if (plans.empty()) {
        return;
    }
    std::vector<GuardDamage> damage;
    auto done = read_back && is_large(plans)
                    ? draw_large(plans.front(), results[plans.front().slot], step, store, damage)
                    : draw_chunk(plans, read_back, results, step, store, damage);
    if (done && !damage.empty()) {
        done = blame(plans, damage, results, step);
    }
    const std::vector<std::string> messages = instance_.messages().take();
    for (const CasePlan& plan : plans) {
        if (!done) {
            reject(results[plan.slot], done.error());
        }
        append(results[plan.slot].messages, messages);
    }
    if (!done) {
        device_->vk().vkDeviceWaitIdle(device_->get());
    }
    if (!done && done.error().is_lost) {
        lost_ = done.error().message;
    }
    plans.clear();
    targets_.trim(kept_bytes(device_->capabilities()));
    submission_.trim(kept_bytes(device_->capabilities()));
    pipelines_.trim(kKeptPipelines);
}

std::vector<Rendered> BatchRenderer::draw(std::span<const Rendering> batch, bool read_back,
                                          const std::function<void(std::string_view)>& step,
                                          const PlaneStore& store) {
    std::vector<Rendered> results(batch.size());
    std::vector<CasePlan> plans;
    VkDeviceSize bytes = 0;
    size_t doors = 0;
    step("pipeline");
    for (size_t slot = 0; slot < batch.size(); ++slot) {
        Rendered& result = results[slot];
        if (!lost_.empty()) {
            result.status = Rendered::Status::device_lost;
            result.reason = "the device was lost before: " + lost_;
            continue;
        }
        CasePlan item;
        item.test = batch[slot].test;
        item.reads_hits = batch[slot].reads_hits;
        item.slot = slot;
        const VkDeviceSize size = attachment_bytes(
            item.test->target,
            attachments_of(*item.test, target_layout(device_->capabilities(), *item.test)),
            image_way(*item.test));
        const bool is_alone = is_drawn_alone(*device_, *item.test);
        const auto flush = [&] {
            run_chunk(plans, read_back, results, step, store);
            bytes = 0;
            doors = 0;
            step("pipeline");
        };
        const bool is_full = bytes + size > kChunkBytes || doors == kDoorsOfSubmission;
        if ((is_alone || is_full) && !plans.empty()) {
            flush();
        }
        if (plan(item, result)) {
            bytes += size;
            doors += batch[slot].test->variation.door != cases::Door::none ? size_t{1} : 0;
            plans.push_back(std::move(item));
        }
        if (is_alone) {
            flush();
        }
        append(result.messages, instance_.messages().take());
    }
    run_chunk(plans, read_back, results, step, store);
    return results;
}

Result<BatchRenderer> BatchRenderer::create(const Options& options) {
    auto instance = Instance::create(options);
    if (!instance) {
        return fail(instance.error());
    }
    auto capabilities = choose_device(*instance, options);
    if (!capabilities) {
        return fail(capabilities.error());
    }
    // An older layer takes shader objects for draws without a pipeline, and hands on its own
    // handles.
    if (instance->validation_version().value_or(kShaderObjectHeaders) < kShaderObjectHeaders) {
        capabilities->doors.shader_objects = false;
    }
    auto made = Device::create(*capabilities);
    if (!made) {
        return fail(made.error());
    }
    auto device = std::make_unique<Device>(std::move(*made));
    if (options.longest_wait_ms > 0) {
        constexpr uint64_t kNanoseconds = 1'000'000;  // of a millisecond
        device->set_longest_wait(options.longest_wait_ms * kNanoseconds);
    }
    auto pipelines = PipelineCache::create(*device);
    if (!pipelines) {
        return fail(pipelines.error());
    }
    auto submission = Submission::create(*device);
    if (!submission) {
        return fail(submission.error());
    }
    return BatchRenderer(std::move(*instance), std::move(device), std::move(*pipelines),
                         std::move(*submission));
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

Result<Renderer> Renderer::create(const Options& options) {
    auto body = BatchRenderer::create(options);
    if (!body) {
        return fail(body.error());
    }
    body->ask_sample_locations();
    return Renderer(std::make_unique<Impl>(Impl{std::move(*body)}));
}

const DeviceInfo& Renderer::device() const {
    return impl_->body.device().capabilities().info;
}

std::string Renderer::lacking(const cases::Case& c) const {
    const std::optional<Rejection> rejection = impl_->body.check(c);
    return rejection ? rejection->reason : std::string();
}

std::vector<Rendered> Renderer::render(std::span<const cases::Case> batch,
                                       const std::function<void(std::string_view)>& step,
                                       const PlaneStore& store) {
    return impl_->body.render(
        batch, true, step ? step : [](std::string_view) {}, store);
}

Result<size_t> Renderer::render_bare(std::span<const cases::Case> batch) {
    size_t drawn = 0;
    for (const Rendered& result : impl_->body.render(batch, false, [](std::string_view) {}, {})) {
        if (result.status == Rendered::Status::drawn) {
            ++drawn;
        } else if (result.status != Rendered::Status::unsupported) {
            return fail(Stage::loader, result.reason);
        }
    }
    return drawn;
}

}  // namespace vk_harness
