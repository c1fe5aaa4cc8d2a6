// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include "diagnosis/as_if.hpp"

namespace diagnosis::as_if {

namespace {

using cases::CompareOp;

template <CompareOp from, CompareOp to>
bool compare_as(Case& c) {
    return each(c, [](Draw& d) { return d.depth.compare == from && set(d.depth.compare, to); });
}

bool each_bias(Case& c, bool (*change)(cases::DepthBias&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = (d.depth.bias && change(*d.depth.bias)) || is_changed;
    }
    return is_changed;
}

// Rounds depths that were drawn to multiples of 1/65535.
float rounded(float depth) {
    return std::isfinite(depth) ? std::round(depth * 65535.0F) / 65535.0F : depth;
}

void round_stored(capture::Capture& capture) {
    for (float& depth : capture.depth) {
        const bool is_clear = std::equal_to<>()(depth, capture.target.depth_clear);
        depth = is_clear ? depth : rounded(depth);
    }
}

void round_all(capture::Capture& capture) {
    round_stored(capture);
    for (size_t k = 0; k < capture.frag_coord.size(); ++k) {
        if (k < capture.writers.size() && capture.writers[k].draw != capture::kClearId) {
            capture.frag_coord[k].z = rounded(capture.frag_coord[k].z);
        }
    }
}

const Row kDepthRows[] = {
    // depth
    {"less-or-equal-as-less", "LESS_OR_EQUAL rejects equal depths",
     compare_as<CompareOp::less_or_equal, CompareOp::less>},
    {"greater-as-greater-or-equal", "GREATER lets equal depths pass",
     compare_as<CompareOp::greater, CompareOp::greater_or_equal>},
    {"greater-or-equal-as-greater", "GREATER_OR_EQUAL rejects equal depths",
     compare_as<CompareOp::greater_or_equal, CompareOp::greater>},
    {"not-equal-as-always", "NOT_EQUAL lets all depths pass",
     compare_as<CompareOp::not_equal, CompareOp::always>},
    {"equal-as-less-or-equal", "EQUAL lets smaller depths pass, too",
     compare_as<CompareOp::equal, CompareOp::less_or_equal>},
    {"never-as-always", "NEVER lets all depths pass",
     compare_as<CompareOp::never, CompareOp::always>},
    {"depth-test-off", "There is no depth test, and so no depth is written",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool tests = set(d.depth.compare, CompareOp::always);
             return set(d.depth.write, false) || tests;
         });
     }},
    {"depth-write-off", "Depth is not written",
     [](Case& c) { return each(c, [](Draw& d) { return set(d.depth.write, false); }); }},
    {"bias-no-constant", "The constant of the depth bias counts as 0",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.constant, 0.0F); }); }},
    {"bias-constant-doubled", "The constant of the depth bias counts twice",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.constant, 2 * b.constant); }); }},
    {"bias-no-slope", "The slope of the depth bias counts as 0",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.slope, 0.0F); }); }},
    {"bias-slope-negated", "The slope factor of the depth bias counts negative",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.slope, -b.slope); }); }},
    {"bias-slope-halved", "The slope of the depth bias counts half",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.slope, b.slope / 2); }); }},
    {"bias-clamp-negated", "The clamp of the depth bias is applied to the other side",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.clamp, -b.clamp); }); }},
    {"depth-clamp-off", "Depth is clipped where it is to be clamped",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool clamps = set(d.depth.clamp, false);
             return clamps && set(d.depth.clip, std::optional<bool>(true));
         });
     }},
    {"depth-clip-flipped", "Depth is clipped where that is off, and the reverse",
     [](Case& c) {
         return each(c, [](Draw& d) {
             d.depth.clip = !d.depth.clip.value_or(!d.depth.clamp);
             return true;
         });
     }},
    {"depth-16-bits", "Depths are rounded to multiples of 1/65535", always, round_all},
    {"depth-16-bits-stored", "Depths are stored as multiples of 1/65535", always, round_stored},
};

}  // namespace

std::span<const Row> depth_rows() {
    return kDepthRows;
}

}  // namespace diagnosis::as_if
