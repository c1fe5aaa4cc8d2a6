// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/batch_renderer.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"
#include "vk_harness/commands/record.hpp"
#include "vk_harness/commands/rendering.hpp"
#include "vk_harness/planner.hpp"
#include "vk_harness/row_reader.hpp"
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

// FragCoord of a case that is drawn elsewhere in its target, as it is at the origin: whole pixels
// are taken off again, exactly.
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

// Whether a rendering gets a submission of its own. A driver would spoil other cases, too, and
// whose fault that is could not be told, if it never left a pipeline's rasterizer discard, blended
// all colours as the first behind a pipeline without any (docs/findings), or lost one of several
// submissions. The host's memory may be refused, and a query begins before any pipeline only in a
// command buffer that has had none. What is submitted twice is alone, too.
bool is_drawn_alone(const Device& device, const cases::Case& c) {
    if (c.variation.door == cases::Door::submissions ||
        c.variation.door == cases::Door::memory_imported ||
        c.variation.door == cases::Door::transform_feedback ||
        c.variation.door == cases::Door::input_attachment ||
        c.variation.door == cases::Door::query_first || c.target.frame == cases::Frame::second) {
        return true;
    }
    const bool is_static =
        c.variation.door == cases::Door::state_static || !device.capabilities().core.dynamic_state;
    return is_static && std::ranges::any_of(c.draws, &cases::Draw::rasterizer_discard);
}

// Whether its pipelines have colours. What draws to none ends its submission: on lavapipe 25 and 26
// the colours of the pipelines behind it are blended as the first one
// (docs/findings/lavapipe-independent-blending.md), which would be another case's.
bool has_colors(const cases::Case& c) {
    return c.blit || c.target.has_instruments || c.target.color;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

// A call that fails is never 'unsupported': what a device does not advertise, check_case has
// rejected before anything is asked of the driver.
Rejection rejection_of(const Failure& failure) {
    return {failure.is_lost ? Rendered::Status::device_lost : Rendered::Status::error,
            std::string(to_string(failure.stage)) + ": " + failure.message};
}

void reject(Rendered& result, Rejection rejection) {
    result.status = rejection.status;
    result.reason = std::move(rejection.reason);
}

// Plans a case; a failure is a rejection, too.
std::optional<Rejection> planned(const Planner& planner, CasePlan& plan) {
    try {
        return planner.plan(plan);
    } catch (const Failure& failure) {
        return rejection_of(failure);
    }
}

Device open_device(const Instance& instance, const Options& options) {
    Capabilities capabilities = choose_device(instance, options);
    // An older layer takes shader objects for draws without a pipeline, and hands on its own
    // handles.
    if (instance.validation_version().value_or(kShaderObjectHeaders) < kShaderObjectHeaders) {
        capabilities.doors.shader_objects = false;
    }
    Device device = Device::create(capabilities);
    if (options.longest_wait_ms > 0) {
        constexpr uint64_t kNanoseconds = 1'000'000;  // of a millisecond
        device.set_longest_wait(options.longest_wait_ms * kNanoseconds);
    }
    return device;
}

}  // namespace

BatchRenderer::BatchRenderer(const Options& options)
    : instance_(Instance::create(options)),
      device_(open_device(instance_, options)),
      pipelines_(device_),
      targets_(device_),
      textures_(device_),
      submission_(device_),
      depth_codes_(device_) {}

BatchRenderer::~BatchRenderer() {
    // Nothing may be freed while the device still works on it, as after a wait that failed.
    device_.vk().vkDeviceWaitIdle(device_.get());
}

std::vector<Rendered> BatchRenderer::render(std::span<const cases::Case> batch, bool read_back,
                                            const Step& step, const PlaneStore& store) {
    const Renderings renderings(device_.capabilities(), batch, store);
    return renderings.joined(draw(renderings.all(), read_back, step, renderings.slots()));
}

std::vector<Rendered> BatchRenderer::draw(std::span<const Rendering> batch, bool read_back,
                                          const Step& step, const PlaneStore& store) {
    const Planner planner(device_, pipelines_, targets_, textures_);
    std::vector<Rendered> results(batch.size());
    std::vector<CasePlan> plans;
    VkDeviceSize bytes = 0;
    size_t doors = 0;
    const auto flush = [&] {
        run_chunk(plans, read_back, results, step, store);
        bytes = 0;
        doors = 0;
        step("pipeline");
    };
    step("pipeline");
    for (size_t slot = 0; slot < batch.size(); ++slot) {
        Rendered& result = results[slot];
        if (!lost_.empty()) {
            reject(result, {Rendered::Status::device_lost, "the device was lost before: " + lost_});
            continue;
        }
        CasePlan item;
        item.test = batch[slot].test;
        item.reads_hits = batch[slot].reads_hits;
        item.slot = slot;
        const VkDeviceSize size = attachment_bytes(
            item.test->target,
            attachments_of(*item.test, target_layout(device_.capabilities(), *item.test)),
            image_way(*item.test));
        const bool is_alone = is_drawn_alone(device_, *item.test);
        const bool is_full = bytes + size > kChunkBytes || doors == kDoorsOfSubmission;
        const bool is_behind_colorless =
            !plans.empty() && has_colors(*item.test) && !has_colors(*plans.back().test);
        if ((is_alone || is_full || is_behind_colorless) && !plans.empty()) {
            flush();
        }
        if (auto rejection = planned(planner, item)) {
            reject(result, *std::move(rejection));
        } else {
            bytes += size;
            doors += item.test->variation.door != cases::Door::none ? size_t{1} : 0;
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

void BatchRenderer::run_chunk(std::vector<CasePlan>& plans, bool read_back,
                              std::vector<Rendered>& results, const Step& step,
                              const PlaneStore& store) {
    if (plans.empty()) {
        return;
    }
    try {
        const auto damage = draw_chunk(plans, read_back, results, step, store);
        if (!damage.empty()) {
            blame(plans, damage, results, step);
        }
    } catch (const Failure& failure) {
        for (const CasePlan& plan : plans) {
            reject(results[plan.slot], rejection_of(failure));
        }
        device_.vk().vkDeviceWaitIdle(device_.get());
        if (failure.is_lost) {
            lost_ = failure.message;
        }
    }
    const std::vector<std::string> messages = instance_.messages().take();
    for (const CasePlan& plan : plans) {
        append(results[plan.slot].messages, messages);
    }
    plans.clear();
    targets_.trim(kept_bytes(device_.capabilities()));
    submission_.trim(kept_bytes(device_.capabilities()));
    pipelines_.trim(kKeptPipelines);
}

std::vector<GuardDamage> BatchRenderer::draw_chunk(std::span<CasePlan> plans, bool read_back,
                                                   std::vector<Rendered>& results, const Step& step,
                                                   const PlaneStore& store) {
    step("record");
    const bool by_rows = read_back && plans.size() == 1 && is_large(plans.front());
    GuardCheck guards(device_);
    const Buffer& vertices = write_vertices_of(plans);
    const bool is_second = plans.front().test->target.frame == cases::Frame::second;
    const auto write_frame = [&](bool is_first) {
        write_vertices(plans.front(), vertices.bytes(), is_first);
        vertices.flush();
    };
    if (is_second) {
        write_frame(true);
    }
    const Buffer* readback = read_back ? &make_readback(plans, by_rows, guards) : nullptr;
    VkCommandBuffer commands = submission_.begin(is_second);
    textures_.record_transitions(commands);
    for (const CasePlan& plan : plans) {
        if (plan.colors) {
            plan.colors->record(commands);
        }
    }
    if (readback != nullptr) {
        guards.record_fills(commands);
    }
    for (CasePlan& plan : plans) {
        record(commands, plan, vertices.get(), readback, by_rows);
        append(results[plan.slot].messages, instance_.messages().take());
    }
    if (readback != nullptr) {
        guards.record_copies(commands, readback->get());
    }
    step("submit");
    submission_.run();
    if (is_second) {
        write_frame(false);
        if (readback != nullptr) {
            poison(readback->bytes().first(plans.front().readback.end));
            readback->flush();
        }
        submission_.repeat();
    }
    for (const CasePlan& plan : plans) {
        results[plan.slot].status = Rendered::Status::drawn;
    }
    if (readback == nullptr) {
        return {};
    }
    step("readback");
    readback->invalidate();
    std::vector<GuardDamage> damage = guards.read(readback->bytes());
    for (const CasePlan& plan : plans) {
        Rendered& result = results[plan.slot];
        const capture::PlaneSpans planes = place_planes(plan, result, store);
        if (plan.queries) {
            result.capture.counted = plan.queries->read();
        }
        if (by_rows) {
            // Damage is told by the images' guards.
            read_by_rows(device_, submission_, targets_, plan, alignment(), !damage.empty(), step,
                         planes);
        } else {
            read_planes(plan.attachments, plan.readback, readback->bytes(), planes);
            read_depth_codes(plan, readback->bytes(), planes, result);
        }
        move_back(plan, planes);
        append(result.stray_writes, changed_surroundings(plan, readback->bytes()));
    }
    return damage;
}

void BatchRenderer::blame(std::span<CasePlan> plans, std::span<const GuardDamage> damage,
                          std::vector<Rendered>& results, const Step& step) {
    bool is_found = false;
    for (size_t k = 0; plans.size() > 1 && k < plans.size(); ++k) {
        std::vector<Rendered> again(results.size());
        const auto alone = draw_chunk(plans.subspan(k, 1), true, again, step, {});
        append(results[plans[k].slot].stray_writes, stray_writes(plans[k], alone, 1));
        is_found = is_found || !alone.empty();
    }
    for (size_t k = 0; !is_found && k < plans.size(); ++k) {
        append(results[plans[k].slot].stray_writes, stray_writes(plans[k], damage, plans.size()));
    }
}

Buffer& BatchRenderer::write_vertices_of(std::span<CasePlan> plans) {
    VkDeviceSize bytes = 0;
    for (CasePlan& plan : plans) {
        bytes = place_vertices(plan, bytes);
    }
    Buffer& vertices = submission_.vertices(bytes);
    for (const CasePlan& plan : plans) {
        write_vertices(plan, vertices.bytes());
        make_door_buffers(device_, pipelines_, plan, vertices.bytes());
    }
    vertices.flush();
    return vertices;
}

Buffer& BatchRenderer::make_readback(std::span<CasePlan> plans, bool by_rows, GuardCheck& guards) {
    VkDeviceSize bytes = 0;
    for (CasePlan& plan : plans) {
        if (!by_rows) {
            plan.readback = make_layout(plan.test->target, plan.attachments, bytes, alignment());
            bytes = place_surroundings(plan, plan.readback.end);
        }
        for (const auto& [guard, name] : guards_of(plan)) {
            guards.add(guard);
        }
    }
    bytes = guards.place(bytes);
    Buffer& readback = submission_.readback(bytes);
    poison(readback.bytes().first(bytes));
    readback.flush();
    return readback;
}

void BatchRenderer::record(VkCommandBuffer& commands, CasePlan& plan, VkBuffer vertices,
                           const Buffer* readback, bool by_rows) {
    if (plan.blit != nullptr) {
        plan.blit->record(device_, commands, *plan.test, plan.attachments.front().clear.color,
                          readback != nullptr ? readback->get() : VK_NULL_HANDLE,
                          readback != nullptr ? plan.readback.offset.front() : 0);
        return;
    }
    if (readback != nullptr) {
        submission_.make_input_sets(pipelines_, plan);
        if (!plan.surroundings.empty()) {
            fill_surroundings(device_, commands, plan, submission_.pattern());
        }
    }
    plan.secondaries = submission_.secondaries(secondaries_of(plan));
    record_draws(device_, pipelines_, commands, plan, vertices, readback != nullptr,
                 [this] { return submission_.next(); });
    if (readback != nullptr && !by_rows) {
        record_copies(device_, pipelines_, commands, plan, readback->get(),
                      plan.test->target.is_read_by_shader()
                          ? submission_.copy_sets(pipelines_, plan)
                          : std::vector<VkDescriptorSet>());
        copy_surroundings(device_, commands, plan, readback->get());
    }
}

VkDeviceSize BatchRenderer::alignment() const {
    // Copies need a multiple of 16 (the texel) and gain from the optimal alignment; the shader that
    // reads single samples needs minStorageBufferOffsetAlignment. All are powers of two.
    const VkPhysicalDeviceLimits& limits = device_.capabilities().limits;
    return std::max({VkDeviceSize{64}, limits.minStorageBufferOffsetAlignment,
                     limits.optimalBufferCopyOffsetAlignment});
}

capture::PlaneSpans BatchRenderer::place_planes(const CasePlan& plan, Rendered& result,
                                                const PlaneStore& store) const {
    const cases::Target& target = plan.test->target;
    capture::Capture& capture = result.capture;
    capture.target = target;
    capture.has_primitive = device_.capabilities().info.has_primitive_id;
    capture.attribute_count = target.has_instruments ? cases::attributes_of(*plan.test) : 0;
    return placed_planes(result, plan.slot, store);
}

void BatchRenderer::read_depth_codes(const CasePlan& plan, std::span<const std::byte> memory,
                                     const capture::PlaneSpans& planes, Rendered& result) {
    const cases::Target& target = plan.test->target;
    const auto depth = std::ranges::find(plan.attachments, Role::depth, &Attachment::role);
    if (target.samples == 1 || target.depth_format != cases::DepthFormat::d24_unorm ||
        depth == plan.attachments.end() || depth->store == cases::StoreOp::dont_care) {
        return;
    }
    if (!asking_) {
        asking_.emplace(device_);
    }
    const auto k = static_cast<size_t>(depth - plan.attachments.begin());
    const std::span words(
        reinterpret_cast<const uint32_t*>(memory.data() + plan.readback.offset[k]),
        planes.depth.size());
    depth_codes_.learn(*asking_, pipelines_, depth->format, words);
    if (auto untold = depth_codes_.decode(depth->format, words, planes.depth)) {
        result.status = Rendered::Status::unsupported;
        result.reason = *std::move(untold);
    }
}

}  // namespace vk_harness
