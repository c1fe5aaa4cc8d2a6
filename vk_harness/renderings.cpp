// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/renderings.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"

namespace vk_harness {

namespace {

std::vector<cases::Case> with_own_depth(const Capabilities& capabilities,
                                        std::span<const cases::Case> batch) {
    const cases::DepthFormat own = capabilities.beside_stencil;
    const auto takes_own = [own](const cases::Case& c) {
        return cases::takes_depth_beside_stencil(c.target, own);
    };
    if (std::ranges::none_of(batch, takes_own)) {
        return {};
    }
    std::vector<cases::Case> out(batch.begin(), batch.end());
    for (cases::Case& c : out) {
        if (takes_own(c)) {
            c.target.depth_format = own;
        }
    }
    return out;
}

// What the parts of a case have drawn, as one rendering would. The planes go to `memory` if there
// is some.
Rendered join_parts(const cases::Case& test, std::span<const Part> parts, std::span<Rendered> drawn,
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
    out.capture.attribute_count = cases::attributes_of(test);
    out.capture.counted = first.counted;
    const capture::PlaneSpans planes = placed_planes(out, slot, store);
    for (size_t k = 0; k < parts.size(); ++k) {
        take_part(parts[k], k == 0 ? first : drawn[k].capture, planes);
    }
    return out;
}

}  // namespace

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

Renderings::Renderings(const Capabilities& capabilities, std::span<const cases::Case> filed,
                       const PlaneStore& store)
    : filed_(filed),
      store_(&store),
      own_(with_own_depth(capabilities, filed)),
      batch_(own_.empty() ? filed : own_) {
    parts_.reserve(batch_.size());  // stable addresses
    for (size_t slot = 0; slot < batch_.size(); ++slot) {
        const std::vector<Part>& parts = parts_.emplace_back(parts_of(capabilities, batch_[slot]));
        if (parts.empty()) {
            all_.push_back({&batch_[slot]});
            slot_of_.emplace_back(slot);
        }
        for (const Part& part : parts) {
            all_.push_back({&part.test, part.has_fragments});
            slot_of_.emplace_back();
        }
    }
}

PlaneStore Renderings::slots() const {
    return [this](size_t k, uint64_t bytes) {
        return *store_ && slot_of_[k] ? (*store_)(*slot_of_[k], bytes) : std::span<std::byte>();
    };
}

std::vector<Rendered> Renderings::joined(std::vector<Rendered> drawn) const {
    std::vector<Rendered> results;
    size_t next = 0;
    for (size_t slot = 0; slot < batch_.size(); ++slot) {
        const std::vector<Part>& parts = parts_[slot];
        const size_t count = std::max(parts.size(), size_t{1});
        const std::span<Rendered> its = std::span(drawn).subspan(next, count);
        next += count;
        results.push_back(parts.empty() ? std::move(its.front())
                                        : join_parts(batch_[slot], parts, its, slot, *store_));
        if (!own_.empty()) {
            results.back().capture.target = filed_[slot].target;  // which is what was asked for
        }
    }
    return results;
}

std::optional<Rejection> check_renderings(const Capabilities& capabilities, const cases::Case& c) {
    const std::vector<cases::Case> own = with_own_depth(capabilities, {&c, 1});
    return check_parts(capabilities, own.empty() ? c : own.front());
}

}  // namespace vk_harness
