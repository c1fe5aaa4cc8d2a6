// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/backend.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "capture/blank_capture.hpp"
#include "capture/capture.hpp"
#include "diff/consistency.hpp"
#include "diff/resolve.hpp"
#include "rasterizers/color_planes.hpp"
#include "ref/blit/blit.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/value.hpp"

namespace cli {

using vk_harness::DeviceInfo;
using vk_harness::Rendered;

namespace {

class VulkanBackend : public Backend {
  public:
    explicit VulkanBackend(vk_harness::Renderer renderer) : renderer_(std::move(renderer)) {}
    const DeviceInfo& device() const override { return renderer_.device(); }
    std::vector<Rendered> render(const std::vector<cases::Case>& batch,
                                 const std::function<void(std::string_view)>& step,
                                 const vk_harness::PlaneStore& store) override {
        return renderer_.render(batch, step, store);
    }

  private:
    vk_harness::Renderer renderer_;
};

// Moves the planes of a capture to where the store wants them, if anywhere.
void move_planes(Rendered& rendered, const vk_harness::PlaneStore& store, size_t slot) {
    if (!store) {
        return;
    }
    diff::Capture& c = rendered.capture;
    rendered.placed = store(slot, diff::plane_bytes(c.target, c.attribute_count));
    if (rendered.placed.empty()) {
        return;
    }
    std::byte* to = rendered.placed.data();
    const auto move = [&to](auto& plane) {
        const auto bytes = std::as_bytes(std::span(plane));
        to = std::copy(bytes.begin(), bytes.end(), to);
        plane.clear();
    };
    move(c.hits);
    move(c.writers);
    move(c.frag_coord);
    for (auto& attribute : c.attributes) {
        move(attribute);
    }
    move(c.color);
    move(c.depth);
    move(c.stencil);
    move(c.resolved_color);
    move(c.resolved_depth);
}

// Draws without a driver: with an algorithm, or as the reference expects it.
class ReferenceBackend : public Backend {
  public:
    explicit ReferenceBackend(const ref::algorithms::Device* algorithm) : algorithm_(algorithm) {
        device_.name = "Edgecase reference";
        device_.driver_name = "reference";
        device_.driver_info = "version 1.0.0";
        device_.uuid = std::string(32, '0');
        device_.device_type = "cpu";
        device_.api_version = 1U << 22 | 3U << 12;  // VK_API_VERSION_1_3
        device_.subpixel_bits = 8;
        device_.viewport_subpixel_bits = 8;
        device_.interpolation_offset_bits = 4;
        device_.mipmap_bits = 8;
        device_.max_color_attachments = 8;
        device_.max_target_size = cases::kMaxTargetSize;
        device_.has_primitive_id = true;
        if (algorithm_ != nullptr) {
            device_.name = "Edgecase algorithm " + std::string(algorithm_->name);
            device_.driver_name = algorithm_->name;
        }
    }
    const DeviceInfo& device() const override { return device_; }
    std::vector<Rendered> render(const std::vector<cases::Case>& batch,
                                 const std::function<void(std::string_view)>& step,
                                 const vk_harness::PlaneStore& store) override {
        step("submit");
        std::vector<Rendered> results(batch.size());
        for (size_t k = 0; k < batch.size(); ++k) {
            if (algorithm_ != nullptr) {
                results[k].reason = ref::algorithms::unsupported_reason(batch[k]);
            }
            if (!results[k].reason.empty()) {
                results[k].status = Rendered::Status::unsupported;
                continue;
            }
            results[k].status = Rendered::Status::drawn;
            results[k].capture = algorithm_ != nullptr ? draw_by_algorithm(batch[k], *algorithm_)
                                                       : draw_by_reference(batch[k]);
            diff::add_dependent_planes(results[k].capture);
            move_planes(results[k], store, k);
        }
        step("readback");
        return results;
    }

  private:
    const ref::algorithms::Device* algorithm_;
    DeviceInfo device_;
};

// The first allowed pair of hits, fewest first.
std::pair<uint32_t, uint32_t> pick_hits(const ref::HitBounds& bounds) {
    for (uint32_t total = bounds.total_min; total <= bounds.total_max; ++total) {
        for (uint32_t front = 0; front <= total; ++front) {
            if (bounds.allows(front, total - front)) {
                return {front, total - front};
            }
        }
    }
    return {0, 0};
}

// Where the reference's value of that name is kept: "attribute 1.x", "depth", "frag_coord.w".
float* value_slot(diff::Capture& capture, size_t index, const std::string& quantity) {
    if (quantity == "depth") {
        return &capture.depth[index];
    }
    const size_t dot = quantity.rfind('.');
    if (dot == std::string::npos || dot + 2 != quantity.size()) {
        return nullptr;
    }
    const size_t component = std::string("xyzw").find(quantity[dot + 1]);
    if (component == std::string::npos) {
        return nullptr;
    }
    const auto at = static_cast<glm::vec4::length_type>(component);
    if (quantity.rfind("frag_coord", 0) == 0) {
        return &capture.frag_coord[index][at];
    }
    if (quantity.rfind("attribute ", 0) == 0 && quantity[10] >= '0' && quantity[10] <= '3') {
        const size_t a = static_cast<size_t>(quantity[10] - '0');
        return a < capture.attribute_count ? &capture.attributes[a][index][at] : nullptr;
    }
    return nullptr;
}

}  // namespace

namespace {

diff::Capture blit_by_reference(const cases::Case& c) {
    const ref::BlitReference reference(c);
    diff::Capture capture;
    capture.target = c.target;
    for (uint32_t y = 0; y < c.target.height; ++y) {
        for (uint32_t x = 0; x < c.target.width; ++x) {
            capture.color.push_back(reference.nominal(x, y));
        }
    }
    return capture;
}

}  // namespace

diff::Capture draw_by_reference(const cases::Case& c) {
    if (c.blit) {
        return blit_by_reference(c);
    }
    const ref::Limits limits;
    const ref::Expectation expectation = ref::expect(c, limits, cases::Profile::direct3d);
    ref::ValueReference values(c, limits, cases::Profile::direct3d);

    diff::Capture capture = diff::blank_capture(c);
    const size_t n = capture.sample_count();
    for (size_t index = 0; index < n; ++index) {
        const ref::SampleExpectation& sample = expectation.samples[index];
        const auto [front, back] = pick_hits(sample.hits);
        if (front + back == 0 || sample.writers_count == 0) {
            continue;
        }
        capture.hits[index].x = static_cast<float>(front);
        capture.hits[index].y = static_cast<float>(back);
        capture.hits[index].w += static_cast<float>(front + back);
        const uint32_t t = expectation.writers[sample.writers_begin + sample.writers_count - 1];
        const ref::Triangle& triangle = expectation.triangles[t];
        capture.writers[index] = {triangle.draw, triangle.primitive, triangle.provoking,
                                  diff::kClearId};
        const ref::SampleId id = ref::sample_at(c.target, index);
        capture.frag_coord[index] =
            glm::vec4(static_cast<float>(id.x) + 0.5F, static_cast<float>(id.y) + 0.5F, 0.0F, 1.0F);
        const size_t attributes = c.draws[triangle.draw].attributes.size();
        for (size_t a = 0; a < attributes; ++a) {
            capture.attributes[a][index] = glm::vec4(0);
        }
        const bool writes_depth = c.draws[triangle.draw].depth.write;
        for (const ref::ExpectedValue& value : values.expected(t, id)) {
            if (value.quantity == "depth" && !writes_depth) {
                continue;
            }
            if (float* slot = value_slot(capture, index, value.quantity); slot != nullptr) {
                *slot = static_cast<float>(value.nearest);
            }
        }
        if (!writes_depth && sample.depth_count > 0) {
            const uint32_t last =
                expectation.depth_writers[sample.depth_begin + sample.depth_count - 1];
            for (const ref::ExpectedValue& value : values.expected(last, id)) {
                if (value.quantity == "depth") {
                    capture.depth[index] = static_cast<float>(value.nearest);
                }
            }
        }
    }
    diff::add_color_plane(capture, c, expectation);
    diff::drop_unattached(capture, c);
    diff::vary(capture, c.variation);
    return capture;
}

vk_harness::Result<std::unique_ptr<Backend>> make_backend(const WorkerOptions& options) {
    if (!options.renderer.empty()) {
        return std::make_unique<ReferenceBackend>(ref::algorithms::find_device(options.renderer));
    }
    vk_harness::Result<vk_harness::Renderer> renderer =
        vk_harness::Renderer::create(options.vulkan);
    if (!renderer) {
        return tl::unexpected(renderer.error());
    }
    return std::make_unique<VulkanBackend>(std::move(*renderer));
}

}  // namespace cli
