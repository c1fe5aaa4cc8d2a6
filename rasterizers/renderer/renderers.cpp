// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/renderer/renderers.hpp"

#include <algorithm>

#include "diff/resolve.hpp"
#include "rasterizers/algorithms/device.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/software/choice/choice.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/position/limits.hpp"

namespace rasterizers {

using capture::Rendered;

namespace {

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
            to = std::ranges::copy(bytes, to).out;
            plane.clear();
        },
        c, c);
}

// Draws each case by one call.
class BuiltIn : public capture::Renderer {
  public:
    using Draw = std::function<capture::Capture(const cases::Case&)>;
    using Lacking = std::string (*)(const cases::Case&);

    BuiltIn(capture::DeviceInfo device, Draw draw, Lacking lacks = nullptr)
        : device_(std::move(device)), draw_(std::move(draw)), lacking_(lacks) {}
    const capture::DeviceInfo& device() const override { return device_; }
    std::string lacking(const cases::Case& c) const override {
        return c.variation.door != cases::Door::none
                   ? "what draws here has no Vulkan, and so no doors"
               : lacking_ != nullptr ? lacking_(c)
                                     : std::string();
    }
    std::vector<Rendered> render(std::span<const cases::Case> batch, capture::PlaneSet planes,
                                 const capture::Step& step,
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
            capture::Capture drawn = draw_(batch[k]);
            if (planes.any()) {
                results[k].capture = std::move(drawn);
                move_planes(results[k], store, k);
            }
        }
        step("readback");
        return results;
    }

  private:
    capture::DeviceInfo device_;
    Draw draw_;
    Lacking lacking_;
};

capture::DeviceInfo built_in(std::string name) {
    capture::DeviceInfo device;
    device.name = std::move(name);
    device.driver_name = "built in";
    device.uuid = std::string(32, '0');
    device.type = "cpu";
    device.subpixel_bits = 8;
    device.viewport_subpixel_bits = 8;
    device.interpolation_offset_bits = 4;
    device.mipmap_bits = 8;
    device.max_color_attachments = 8;
    device.max_target_size = cases::kMaxTargetSize;
    device.has_primitive_id = true;
    device.rasterizes_degenerates = ref::Limits().rasterizes_degenerates;
    return device;
}

std::string_view choices_of(std::string_view name) {
    return name.substr(std::min(name.find(':'), name.size() - 1) + 1);
}

}  // namespace

Made reference_renderer(const capture::RendererOptions& /*options*/) {
    return std::make_unique<BuiltIn>(built_in("Edgecase reference"), [](const cases::Case& c) {
        capture::Capture drawn = draw_by_reference(c);
        diff::add_dependent_planes(drawn);
        return drawn;
    });
}

Made algorithm_renderer(const capture::RendererOptions& options) {
    const Device* const algorithm = find_device(options.renderer);
    return std::make_unique<BuiltIn>(
        built_in("Edgecase algorithm " + options.renderer),
        [algorithm](const cases::Case& c) {
            capture::Capture drawn = draw_by_algorithm(c, *algorithm);
            diff::add_dependent_planes(drawn);
            return drawn;
        },
        unsupported_reason);
}

Made software_renderer(const capture::RendererOptions& options) {
    software::Device software;
    if (std::string wrong = software::set_choices(software, choices_of(options.renderer));
        !wrong.empty()) {
        return tl::unexpected(
            capture::Failure{capture::Stage::device, std::move(wrong), {}, {}, false});
    }
    capture::DeviceInfo device = built_in("Edgecase software rasterizer");
    device.subpixel_bits = static_cast<uint32_t>(software.subpixel_bits);
    device.overestimation = software::overestimation(software);
    device.rasterizes_degenerates = software.rasterizes_degenerates;
    return std::make_unique<BuiltIn>(std::move(device), [software](const cases::Case& c) {
        return software::captured(c, software);
    });
}

std::string wrong_choices(std::string_view choices) {
    software::Device device;
    return software::set_choices(device, choices);
}

}  // namespace rasterizers
