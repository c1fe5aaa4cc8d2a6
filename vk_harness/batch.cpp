// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The renderings that a batch of cases is drawn in: mostly one a case, with the depth that the
// device has beside a stencil; several where a case is drawn in parts (parts.hpp).
#include <algorithm>
#include <numeric>

#include "cases/model/derive.hpp"
#include "vk_harness/case_check.hpp"
#include "vk_harness/parts.hpp"
#include "vk_harness/renderer.hpp"

namespace vk_harness {

std::vector<cases::Case> BatchRenderer::with_own_depth(std::span<const cases::Case> batch) const {
    const cases::DepthFormat own = device_->capabilities().beside_stencil;
    std::vector<cases::Case> out;
    if (std::ranges::none_of(batch, [&](const cases::Case& c) {
            return cases::takes_depth_beside_stencil(c.target, own);
        })) {
        return out;
    }
    for (const cases::Case& c : batch) {
        out.push_back(c);
        if (cases::takes_depth_beside_stencil(c.target, own)) {
            out.back().target.depth_format = own;
        }
    }
    return out;
}

namespace {

// What the parts of a case have drawn, as one rendering would. The planes go to `memory` if there
// is some.
Rendered joined(const cases::Case& test, std::span<const Part> parts, std::span<Rendered> drawn,
                size_t slot, const PlaneStore& store) {
    Rendered out = std::move(drawn.front());
    for (Rendered& part : drawn.subspan(1)) {
        std::ranges::move(part.messages, std::back_inserter(out.messages));
        std::ranges::move(part.stray_writes, std::back_inserter(out.stray_writes));
        if (out.status == Rendered::Status::drawn && part.status != Rendered::Status::drawn) {
            out.status = part.status;
            out.reason = part.reason;
        }
    }
    if (out.status != Rendered::Status::drawn || out.capture.hits.empty()) {
        return out;  // of bare drawing nothing is read back
    }
    const capture::Capture first = std::move(out.capture);
    out.capture = capture::Capture();
    out.capture.target = test.target;
    out.capture.has_primitive = first.has_primitive;
    out.capture.has_half_hits = first.has_half_hits;
    out.capture.renderings = static_cast<uint32_t>(parts.size());
    out.capture.attribute_count = cases::attributes_of(test);
    out.capture.counted = first.counted;
    const capture::PlaneSpans planes = placed_planes(out, slot, store);
    for (size_t k = 0; k < parts.size(); ++k) {
        take_part(parts[k], k == 0 ? first : drawn[k].capture, planes);
    }
    return out;
}

}  // namespace

std::vector<Rendered> BatchRenderer::render(std::span<const cases::Case> filed, bool read_back,
                                            const std::function<void(std::string_view)>& step,
                                            const PlaneStore& store) {
    const std::vector<cases::Case> own = with_own_depth(filed);
    const std::span<const cases::Case> batch = own.empty() ? filed : own;
    std::vector<std::vector<Part>> parts;
    std::vector<Rendering> renderings;
    std::vector<std::optional<size_t>> slot_of;  // of a rendering that is its case's only one
    for (size_t slot = 0; slot < batch.size(); ++slot) {
        parts.push_back(parts_of(device_->capabilities(), batch[slot]));
        if (parts.back().empty()) {
            renderings.push_back({&batch[slot]});
            slot_of.emplace_back(slot);
        }
        for (const Part& part : parts.back()) {
            renderings.push_back({&part.test, part.has_fragments});
            slot_of.emplace_back();
        }
    }
    const PlaneStore own_slots = [&](size_t k, uint64_t bytes) {
        return store && slot_of[k] ? store(*slot_of[k], bytes) : std::span<std::byte>();
    };
    std::vector<Rendered> drawn = draw(renderings, read_back, step, own_slots);
    std::vector<Rendered> results;
    size_t next = 0;
    for (size_t slot = 0; slot < batch.size(); ++slot) {
        const size_t count = std::max(parts[slot].size(), size_t{1});
        const std::span<Rendered> its = std::span(drawn).subspan(next, count);
        next += count;
        results.push_back(parts[slot].empty() ? std::move(its.front())
                                              : joined(batch[slot], parts[slot], its, slot, store));
        if (!own.empty()) {
            results.back().capture.target = filed[slot].target;  // which is what was asked for
        }
    }
    return results;
}

std::optional<Rejection> BatchRenderer::check(const cases::Case& c) const {
    const std::vector<cases::Case> own = with_own_depth({&c, 1});
    return check_parts(device_->capabilities(), own.empty() ? c : own.front());
}

}  // namespace vk_harness
