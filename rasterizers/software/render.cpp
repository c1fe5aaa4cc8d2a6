// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/render.hpp"

#include <algorithm>

#include "cases/model/sample.hpp"
#include "rasterizers/software/depth.hpp"
#include "rasterizers/software/draw_command.hpp"
#include "rasterizers/software/target/blit.hpp"
#include "rasterizers/software/target/resolve_unit.hpp"

namespace software {

namespace {

// Clears what draw number `number` names in its rectangles.
void clear(const cases::Case& c, uint32_t number, const Device& device, capture::Capture& out,
           Attachments& attachments) {
    const cases::Draw& draw = c.draws[number];
    const cases::Clear& what = *draw.clear;
    const auto clear_sample = [&](size_t index) {
        if (what.color) {
            attachments.color.clear(index, number);
        }
        if (what.depth) {
            out.depth[index] = stored_depth(*what.depth, c.target.depth_format, device);
        }
        if (what.stencil) {
            attachments.stencil.clear(index, *what.stencil);
        }
    };
    for (const cases::Rect& r : what.rects) {
        const auto x = static_cast<uint32_t>(r.x), y = static_cast<uint32_t>(r.y);
        for (uint32_t layer = draw.layer; layer < draw.layer + what.layers; ++layer) {
            for (uint32_t j = y; j < y + r.height; ++j) {
                const size_t first = index_of(c.target, {x, j, 0, layer});
                for (size_t k = 0; k < size_t{r.width} * c.target.samples; ++k) {
                    clear_sample(first + k);
                }
            }
        }
    }
}

}  // namespace

capture::Capture render(const cases::Case& c, const Device& device) {
    if (c.blit) {
        return blit(c, device);
    }
    capture::Capture out;
    out.target = c.target;
    out.has_primitive = true;
    const size_t count = out.sample_count();
    out.hits.assign(count, glm::vec4(0, 0, capture::kHitGuard, capture::kHitGuard));
    out.writers.assign(count, capture::Writer{});
    out.frag_coord.assign(count, glm::vec4(capture::kClearValue));
    const float unknown = c.target.depth_load == cases::LoadOp::dont_care ? 1 - c.target.depth_clear
                                                                          : c.target.depth_clear;
    out.depth.assign(count, stored_depth(unknown, c.target.depth_format, device));
    for (const cases::Draw& draw : c.draws) {
        out.attribute_count =
            std::max(out.attribute_count, static_cast<uint32_t>(draw.attributes.size()));
    }
    for (uint32_t a = 0; a < out.attribute_count; ++a) {
        out.attributes[a].assign(count, glm::vec4(capture::kClearValue));
    }
    Attachments attachments{{c, device}, {c, device}, {c, device}};
    const auto finish = [&] {
        out.color = attachments.color.read_back();
        out.stencil = attachments.stencil.values();
        out.counted = attachments.queries.results();
        resolve(out, device);
    };
    const auto draws =
        device.fault == "draws-nothing"_fault ? 0U : static_cast<uint32_t>(c.draws.size());
    for (uint32_t d = 0; d < draws; ++d) {
        if (d + 1 == draws && device.fault == "resolve-early"_fault) {
            finish();
        }
        const bool reversed = device.fault == "draws-reversed"_fault;
        const uint32_t number = reversed ? draws - 1 - d : d;
        if (!c.draws[number].clear) {
            DrawCommand(c, number, device, out, attachments).run();
        } else if (!c.draws[number].rasterizer_discard) {
            clear(c, number, device, out, attachments);
        }
    }
    const capture::Capture early = device.fault == "resolve-early"_fault ? out : capture::Capture{};
    finish();
    if (device.fault == "resolve-early"_fault) {
        out.resolved_color = early.resolved_color;
        out.resolved_depth = early.resolved_depth;
        out.resolved_stencil = early.resolved_stencil;
    }
    return out;
}

}  // namespace software
