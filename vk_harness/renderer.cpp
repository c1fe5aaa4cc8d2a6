// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/batch_renderer.hpp"
#include "vk_harness/own_samples.hpp"

namespace vk_harness {

struct Renderer::Impl {
    explicit Impl(const Options& options) : body(options) {}
    BatchRenderer body;
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

Result<Renderer> Renderer::create(const Options& options) {
    return attempt([&] {
        auto impl = std::make_unique<Impl>(options);
        ask_sample_locations(impl->body);
        return Renderer(std::move(impl));
    });
}

const DeviceInfo& Renderer::device() const {
    return impl_->body.device().capabilities().info;
}

std::string Renderer::lacking(const cases::Case& c) const {
    const std::optional<Rejection> rejection =
        check_renderings(impl_->body.device().capabilities(), c);
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
            return tl::unexpected(Failure{Stage::loader, result.reason, {}, {}});
        }
    }
    return drawn;
}

}  // namespace vk_harness
