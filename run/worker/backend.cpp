// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/backend.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "capture/capture.hpp"
#include "diff/resolve.hpp"
#include "rasterizers/software/choice/choice.hpp"
#include "rasterizers/strength/strength.hpp"

namespace run {

using capture::DeviceInfo;
using capture::Rendered;

namespace {

class VulkanBackend : public Backend {
  public:
    explicit VulkanBackend(vk_harness::Renderer renderer) : renderer_(std::move(renderer)) {}
    const DeviceInfo& device() const override { return renderer_.device(); }
    std::string lacking(const cases::Case& c) const override { return renderer_.lacking(c); }
    std::vector<Rendered> render(const std::vector<cases::Case>& batch,
                                 const std::function<void(std::string_view)>& step,
                                 const capture::PlaneStore& store) override {
        return renderer_.render(batch, step, store);
    }

  private:
    vk_harness::Renderer renderer_;
};

// Moves the planes of a capture to where the store wants them, if anywhere.
void move_planes(Rendered& rendered, const capture::PlaneStore& store, size_t slot) {
    if (!store) {
        return;
    }
    capture::Capture& c = rendered.capture;
    rendered.placed = store(slot, capture::plane_bytes(c.target, c.attribute_count));
    if (rendered.placed.empty()) {
        return;
    }
    std::byte* to = rendered.placed.data();
    capture::for_each_plane(
        [&to](const capture::Plane&, auto& plane) {
            const auto bytes = std::as_bytes(std::span(plane));
            to = std::copy(bytes.begin(), bytes.end(), to);
            plane.clear();
        },
        c, c);
}

// Draws without a driver: with an algorithm, with the software rasterizer, or as the reference
// expects it.
class ReferenceBackend : public Backend {
  public:
    ReferenceBackend(const rasterizers::Device* algorithm,
                     const std::optional<software::Device>& software)
        : algorithm_(algorithm), software_(software) {
        device_.name = "Edgecase reference";
        device_.driver_name = "built in";
        device_.uuid = std::string(32, '0');
        device_.type = "cpu";
        device_.subpixel_bits = 8;
        device_.viewport_subpixel_bits = 8;
        device_.interpolation_offset_bits = 4;
        device_.mipmap_bits = 8;
        device_.max_color_attachments = 8;
        device_.max_target_size = cases::kMaxTargetSize;
        device_.has_primitive_id = true;
        device_.rasterizes_degenerates = ref::Limits().rasterizes_degenerates;
        if (algorithm_ != nullptr) {
            device_.name = "Edgecase algorithm " + std::string(algorithm_->name);
        }
        if (software_) {
            device_.name = "Edgecase software rasterizer";
            device_.subpixel_bits = static_cast<uint32_t>(software_->subpixel_bits);
            device_.overestimation = software::overestimation(*software_);
            device_.rasterizes_degenerates = software_->rasterizes_degenerates;
        }
    }
    const DeviceInfo& device() const override { return device_; }
    std::string lacking(const cases::Case& c) const override {
        return c.variation.door != cases::Door::none
                   ? "what draws here has no Vulkan, and so no doors"
               : algorithm_ != nullptr ? rasterizers::unsupported_reason(c)
                                       : std::string();
    }
    std::vector<Rendered> render(const std::vector<cases::Case>& batch,
                                 const std::function<void(std::string_view)>& step,
                                 const capture::PlaneStore& store) override {
        step("submit");
        std::vector<Rendered> results(batch.size());
        for (size_t k = 0; k < batch.size(); ++k) {
            results[k].reason = lacking(batch[k]);
            if (!results[k].reason.empty()) {
                results[k].status = Rendered::Status::unsupported;
                continue;
            }
            results[k].status = Rendered::Status::drawn;
            if (software_) {
                results[k].capture = software::captured(batch[k], *software_);
            } else {
                results[k].capture = algorithm_ != nullptr
                                         ? rasterizers::draw_by_algorithm(batch[k], *algorithm_)
                                         : rasterizers::draw_by_reference(batch[k]);
                diff::add_dependent_planes(results[k].capture);
            }
            move_planes(results[k], store, k);
        }
        step("readback");
        return results;
    }

  private:
    const rasterizers::Device* algorithm_;
    std::optional<software::Device> software_;
    DeviceInfo device_;
};

}  // namespace

capture::Result<std::unique_ptr<Backend>> make_backend(const WorkerOptions& options) {
    if (!options.renderer.name.empty()) {
        std::optional<software::Device> software;
        std::string_view words = options.renderer.name;
        if (words.starts_with(kSoftware)) {
            words.remove_prefix(std::min(words.size(), kSoftware.size() + 1));  // and a ':'
            software.emplace();
            if (const std::string wrong = software::set_choices(*software, words); !wrong.empty()) {
                return tl::unexpected(capture::Failure{capture::Stage::device, wrong, {}, {}});
            }
        }
        return std::make_unique<ReferenceBackend>(rasterizers::find_device(options.renderer.name),
                                                  software);
    }
    capture::Result<vk_harness::Renderer> renderer = vk_harness::Renderer::create(options.renderer);
    if (!renderer) {
        return tl::unexpected(renderer.error());
    }
    return std::make_unique<VulkanBackend>(std::move(*renderer));
}

}  // namespace run
