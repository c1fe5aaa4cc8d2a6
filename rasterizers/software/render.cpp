// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/render.hpp"

#include <algorithm>

#include "rasterizers/software/depth.hpp"
#include "rasterizers/software/draw_command.hpp"
#include "rasterizers/software/target/blit.hpp"
#include "rasterizers/software/target/resolve_unit.hpp"

namespace software {

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
    out.depth.assign(count, stored_depth(c.target.depth_clear, c.target.depth_format, device));
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
        DrawCommand(c, reversed ? draws - 1 - d : d, device, out, attachments).run();
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
