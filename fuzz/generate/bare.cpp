// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/bare.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/model/way.hpp"
#include "cases/model/words.hpp"
#include "cases/write/to_toml.hpp"
#include "fuzz/generate/source.hpp"

namespace fuzz {

namespace {

constexpr uint64_t kPoseStream = 11;

// The features beside a way, some of them more often.
constexpr std::array<std::string_view, 22> kOfAll = {
    "viewport-place", "viewport-place", "viewport-place", "scissor-place", "scissor-place",
    "viewport",       "scissor",        "topology",       "topology",      "indices",
    "cull",           "cull",           "front_face",     "provoking",     "samples",
    "sample_mask",    "layers",         "depth-clamp",    "depth-clip",    "depth_volume",
    "clip-distances", "viewport_index"};
constexpr std::array<std::string_view, 6> kOfDepth = {"compare", "compare", "bias",
                                                      "bias",    "depth",   "depth-write"};
constexpr std::array<std::string_view, 3> kOfStencil = {"stencil-compare", "stencil-ops",
                                                        "stencil-masks"};

void set_geometry(Pose& pose, Dice& dice) {
    const auto sometimes = [&](std::string_view feature, uint64_t times) {
        if (dice.one_in(times)) {
            pose.set(feature, value_of(feature, 1, dice));
        }
    };
    sometimes("draws", 2);
    sometimes("size", 2);
    sometimes("w", 4);
    sometimes("z", 3);
}

// What is attached, and whether depths are written or tested.
struct Attached {
    bool depth = false, stencil = false;
};
Attached attach(Pose& pose, Dice& dice) {
    if (pose.is("way", "bare-beside")) {
        const bool has_depth = dice.one_in(2);
        if (!has_depth || dice.one_in(2)) {
            pose.set("stencil", 1);
        }
        return {has_depth, !pose.is_default("stencil")};
    }
    if (pose.is("way", "bare-stencil")) {
        pose.set("stencil", dice.below(2));
        return {false, !pose.is_default("stencil")};
    }
    return {pose.value("way").starts_with("bare-depth") || pose.is("way", "prepass"), false};
}

// Colours of vertices: as the way has them, one for all, or a plane over the target, as rectangles
// of two triangles have them.
void color_vertices(cases::Draw& draw, Dice& dice) {
    if (draw.color.attribute < 0 || draw.color.from == cases::ColorFrom::texels) {
        return;
    }
    std::vector<glm::vec4>& values =
        draw.attributes.at(static_cast<size_t>(draw.color.attribute)).values;
    const uint64_t kind = dice.below(3);
    const auto eighths = [&](int64_t low, int64_t high) {
        glm::vec4 out{};
        for (int k = 0; k < 4; ++k) {
            out[k] = static_cast<float>(dice.fraction(low, high, 8));
        }
        return out;
    };
    const glm::vec4 at = eighths(2, 6), right = eighths(-2, 2), down = eighths(-2, 2);
    for (size_t v = 0; v < values.size() && kind > 0; ++v) {
        const glm::vec4& p = draw.positions.at(v);
        values[v] = kind == 1 ? at : at + right * p.x + down * p.y;
    }
}

}  // namespace

Pose bare_pose(uint64_t seed, uint64_t number, size_t candidate) {
    // Of all candidates alike, since those with the most pairs of features are never plain. After
    // so many others are tried: no features may go with these.
    constexpr size_t kAlike = 12;
    Dice common(seed, kPoseStream + 2, number * 4096 + candidate / kAlike);
    const uint64_t count = common.below(3);
    Pose pose;
    pose.set("way", value_of("way", 1, common));
    if (!pose.value("way").starts_with("bare-depth") && !pose.is("way", "bare-stencil")) {
        pose.set("bare-format", common.one_in(2) ? 0 : value_of("bare-format", 1, common));
    }
    set_geometry(pose, common);
    if ((pose.is("way", "bare-color-texels") || pose.is("way", "bare-color-mask")) &&
        pose.is("size", "large")) {
        pose.set("size", 0);  // such ways take few samples
    }
    const Attached attached = attach(pose, common);
    Dice dice(seed, kPoseStream, number * 4096 + candidate);
    uint64_t states = 0;
    const auto switch_on = [&](std::string_view feature) {
        // A mask of one sample has one bit.
        const std::string_view one =
            feature == "sample_mask" && pose.is_default("samples") ? "samples" : feature;
        states += pose.is_default(one) ? 1U : 0U;
        pose.set(one, value_of(one, 1, dice));
    };
    if (pose.is("way", "bare-beside") && attached.depth) {
        switch_on("compare");
    }
    while (states < count) {
        const uint64_t kind = dice.below(3);
        if (kind == 0 && attached.depth) {
            switch_on(dice.of(kOfDepth));
        } else if (kind == 1 && attached.stencil) {
            switch_on(dice.of(kOfStencil));
        } else {
            switch_on(dice.of(kOfAll));
        }
    }
    // What shows them.
    const auto is_any = [&](auto... features) { return !(pose.is_default(features) && ...); };
    if (is_any("compare", "stencil-compare", "viewport_index") && pose.is_default("draws")) {
        pose.set("draws", 1);
    }
    if (is_any("compare", "bias", "depth-clamp") && pose.is_default("z")) {
        pose.set("z", pose.is_default("depth-clamp") ? 1 : 2);
    }
    return pose;
}

std::string by_way_of(const Pose& pose, const std::string& text, Dice& dice) {
    const std::span<const cases::WayRow> ways = cases::all_ways();
    const auto way = std::ranges::find(ways, pose.value("way"), &cases::WayRow::word);
    const std::optional<cases::Case> base = load_one(text, "bare");
    std::optional<cases::Case> c = base ? cases::by_way(*way, *base) : std::nullopt;
    if (!c) {
        return {};
    }
    if (c->target.color && c->target.frame != cases::Frame::sampled) {
        const auto& words = cases::kWords<cases::ColorFormat>;
        const auto word = std::ranges::find(words, pose.value("bare-format"));
        c->target.color->format = static_cast<cases::ColorFormat>(word - words.begin());
    }
    if (pose.is("way", "bare-beside") && pose.is_default("compare")) {
        c->target.has_depth = c->target.names_depth = false;
    }
    for (cases::Draw& draw : c->draws) {
        color_vertices(draw, dice);
    }
    return cases::to_toml(*c).value_or("");
}

}  // namespace fuzz
