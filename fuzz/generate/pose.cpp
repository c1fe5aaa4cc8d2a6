// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/pose.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "fuzz/generate/dice.hpp"

namespace fuzz {

namespace {

size_t index_of(std::string_view name) {
    const std::vector<Feature>& all = features();
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const Feature& f) { return f.name == name; });
    if (at == all.end()) {
        std::abort();  // a name that this folder misspells
    }
    return static_cast<size_t>(at - all.begin());
}

// What a feature needs to mean anything, as the other one's value of that number.
struct Need {
    std::string_view feature, other;
    size_t value;
};
constexpr std::array<Need, 29> kNeeds = {{
    {"logic", "attachments", 1},
    {"depth-layout", "frag-depth", 1},
    {"depth-bounds", "draws", 1},
    {"resolve", "samples", 1},
    {"resolve", "color", 1},
    {"depth-resolve", "samples", 1},
    {"sample-locations", "samples", 1},
    {"sample-mask", "samples", 1},
    {"shader-mask", "samples", 1},
    {"sample-shading", "samples", 1},
    {"attachments", "color", 1},
    {"blend", "color", 1},
    {"color-from", "color", 1},
    {"write-mask", "color", 1},
    {"stencil-masks", "stencil", 1},
    {"stencil-ops", "stencil", 1},
    {"stencil-compare", "stencil", 1},
    {"stencil-compare", "draws", 1},
    {"stencil-clear", "stencil", 1},
    {"compare", "draws", 1},
    {"rasterizer-discard", "draws", 1},
    {"bias", "z", 1},
    {"depth-clamp", "z", 2},
    {"interpolation", "attributes", 1},
    {"auxiliary", "attributes", 1},
    {"source", "attributes", 1},
    {"probe", "attributes", 1},
    {"provoking", "attributes", 1},
    {"viewport-index", "draws", 1},
}};

// What a feature has to meet to show most of what it does: one of these is on beside it, too.
struct Company {
    std::string_view feature;
    std::array<std::string_view, 8> others;
};
constexpr std::array<Company, 3> kCompany = {{
    {"query",
     {"draws", "compare", "depth-bounds", "discard", "sample-mask", "stencil-compare", "frag-depth",
      "cull"}},
    {"frag-depth",
     {"draws", "compare", "depth-bounds", "bias", "viewport", "depth-clamp", "samples",
      "early-tests"}},
    {"logic", {"draws", "write-mask", "blend", "color", "color", "color-from", "samples", "draws"}},
}};

}  // namespace

const std::vector<Feature>& features() {
    static const std::vector<Feature> kAll = {
        {"samples", {"1", "4", "2", "8"}},
        {"size", {"16", "odd", "wide", "high", "64", "tiny"}},
        {"layers", {"1", "2", "3"}},
        {"depth", {"d32-float", "d16-unorm", "d24-unorm"}},
        {"attachments", {"all", "color", "color+depth"}},
        {"color",
         {"none", "rgba8-unorm", "bgra8-unorm", "rgba8-srgb", "rgb10a2-unorm", "r5g6b5-unorm",
          "rgba16-unorm", "rgba16-float", "rg16-float", "rgba32-float", "r32-float", "r32-uint",
          "rgba8-uint"}},
        {"blend",
         {"none", "additive", "alpha", "premultiplied", "multiply", "reverse-subtract", "min",
          "max", "factors"}},
        {"color-from", {"value", "attribute"}},
        {"write-mask", {"rgba", "rgb", "r", "gb", "ra"}},
        {"logic",
         {"none", "clear", "and", "and-reverse", "copy", "and-inverted", "no-op", "xor", "or",
          "nor", "equivalent", "invert", "or-reverse", "copy-inverted", "or-inverted", "nand",
          "set"}},
        {"query", {"none", "occlusion", "occlusion-precise"}},
        {"stencil", {"false", "true"}},
        {"stencil-clear", {"0", "given"}},
        {"stencil-compare",
         {"always", "equal", "not-equal", "less", "less-or-equal", "greater", "greater-or-equal",
          "never"}},
        {"stencil-ops", {"count", "same", "faces"}},
        {"stencil-masks", {"whole", "given"}},
        {"resolve", {"none", "average", "sample-zero"}},
        {"depth-resolve", {"none", "sample-zero", "min", "max", "average"}},
        {"sample-locations", {"standard", "own"}},
        {"draws", {"1", "2", "3"}},
        {"topology", {"triangle-list", "triangle-strip", "triangle-fan"}},
        {"indices", {"none", "given", "restart"}},
        {"space", {"pixels", "clip"}},
        {"cull", {"none", "back", "front"}},
        {"front-face", {"counter-clockwise", "clockwise"}},
        {"provoking", {"first", "last"}},
        {"depth-volume", {"zero-to-one", "negative-one-to-one"}},
        {"compare",
         {"always", "less", "less-or-equal", "greater", "greater-or-equal", "equal", "not-equal",
          "never"}},
        {"depth-write", {"true", "false"}},
        {"depth-bounds", {"none", "ends", "below", "above", "one-depth", "whole"}},
        {"frag-depth", {"none", "value", "odd-columns", "odd-rows", "checker", "frag-coord"}},
        {"depth-layout", {"any", "greater", "less", "unchanged"}},
        {"bias", {"none", "constant", "slope", "both", "clamped"}},
        {"depth-clamp", {"false", "true"}},
        {"depth-clip", {"default", "true", "false"}},
        {"sample-mask", {"all", "given"}},
        {"shader-mask", {"all", "given"}},
        {"sample-shading", {"off", "half", "full", "least"}},
        {"discard", {"none", "odd-columns", "odd-rows", "checker", "front", "back"}},
        {"early-tests", {"false", "true"}},
        {"rasterizer-discard", {"none", "first-draw"}},
        {"attributes", {"none", "one", "two", "three"}},
        {"interpolation", {"smooth", "noperspective", "flat", "mixed"}},
        {"auxiliary", {"none", "centroid", "sample"}},
        {"source", {"vertex", "barycentric", "sample-mask-in", "sample-id", "sample-position"}},
        {"probe",
         {"value", "at-centroid", "at-sample", "at-offset", "dfdx", "dfdy", "fwidth", "dfdx-fine",
          "dfdy-fine", "dfdx-coarse", "dfdy-coarse", "query-lod"}},
        {"clip-distances", {"0", "1", "2"}},
        {"cull-distances", {"0", "1"}},
        {"viewport", {"target", "inner", "beyond", "flipped", "fractional", "depth"}},
        {"scissor", {"target", "inner", "beyond", "thin"}},
        {"viewport-index", {"0", "other"}},
        {"relation",
         {"none", "same-twice", "other-clears", "write-masks", "fewer-attributes",
          "more-attributes", "scissor-tiles"}},
        {"w", {"one", "equal", "unequal", "steep", "behind"}},
        {"z", {"half", "plane", "beyond"}},
    };
    return kAll;
}

Pose::Pose() : values_(features().size(), 0) {}

std::string_view Pose::value(std::string_view feature) const {
    const size_t k = index_of(feature);
    return features()[k].values[values_[k]];
}

bool Pose::is_default(std::string_view feature) const {
    return values_[index_of(feature)] == 0;
}

std::vector<std::pair<size_t, size_t>> Pose::active() const {
    std::vector<std::pair<size_t, size_t>> out;
    for (size_t k = 0; k < values_.size(); ++k) {
        if (values_[k] != 0) {
            out.emplace_back(k, values_[k]);
        }
    }
    return out;
}

std::string Pose::text() const {
    std::string text;
    for (const auto& [feature, value] : active()) {
        text += std::string(text.empty() ? "" : " ") + std::string(features()[feature].name) + "=" +
                std::string(features()[feature].values[value]);
    }
    return text.empty() ? "plain" : text;
}

Pose Poses::draw(size_t candidate) const {
    constexpr uint64_t kStream = 1;
    Dice dice(seed_, kStream, count_ * 4096 + candidate);
    Pose pose;
    // Few features at a time: what many switch off between them is never seen otherwise.
    const uint64_t count = 1 + dice.below(7);
    for (uint64_t k = 0; k < count; ++k) {
        const size_t feature = dice.below(features().size());
        pose.set(feature, dice.below(features()[feature].values.size()));
    }
    const auto set = [&pose](std::string_view feature, size_t value) {
        pose.set(index_of(feature), value);
    };
    for (const Company& company : kCompany) {
        const std::string_view other = dice.of(company.others);
        const size_t feature = index_of(other);
        if (!pose.is_default(company.feature) && pose.is_default(other)) {
            pose.set(feature, 1 + dice.below(features()[feature].values.size() - 1));
        }
    }
    // Hits are counted by blending, which a logical operation switches off, and queries are judged
    // by the hits.
    if (!pose.is_default("query")) {
        set("logic", 0);
        set("attachments", 0);
    }
    if (!pose.is_default("early-tests") && pose.is_default("discard") &&
        pose.is_default("frag-depth")) {
        set(dice.one_in(2) ? "discard" : "frag-depth", 1);
    }
    // Depths that are equal are compared now and then.
    if (!pose.is_default("compare") && pose.is_default("z") && pose.is_default("frag-depth") &&
        !dice.one_in(4)) {
        set("z", 1);
    }
    for (const Need& need : kNeeds) {
        if (!pose.is_default(need.feature) && pose.is_default(need.other)) {
            set(need.other, need.value);
        }
    }
    if (pose.is("depth-layout", "unchanged")) {
        set("frag-depth", 5);  // gl_FragCoord.z, which alone is the fragment's own depth
    }
    // Of a fragment's own depth with a bias neither is known.
    if (!pose.is_default("depth-layout") || pose.is("frag-depth", "frag-coord")) {
        set("bias", 0);
    }
    if (pose.is("attachments", "color") &&
        (!pose.is_default("depth-bounds") || !pose.is_default("frag-depth"))) {
        set("attachments", 2);  // with a depth
    }
    // Colours of integers are resolved so, and no others.
    if (pose.is("resolve", "sample-zero") && !pose.value("color").ends_with("-uint")) {
        constexpr size_t kR32Uint = 11;
        set("color", kR32Uint);
    }
    if (!pose.is_default("relation") && pose.value("relation").ends_with("-attributes") &&
        pose.is_default("attributes")) {
        set("attributes", 1);
    }
    return pose;
}

size_t Poses::fresh_pairs(const Pose& pose) const {
    size_t fresh = 0;
    const auto active = pose.active();
    for (size_t a = 0; a < active.size(); ++a) {
        for (size_t b = a; b < active.size(); ++b) {  // a feature with itself: it alone
            fresh += seen_.contains({active[a].first * 64 + active[a].second,
                                     active[b].first * 64 + active[b].second})
                         ? 0U
                         : 1U;
        }
    }
    return fresh;
}

void Poses::take(const Pose& pose) {
    const auto active = pose.active();
    for (size_t a = 0; a < active.size(); ++a) {
        for (size_t b = a; b < active.size(); ++b) {
            seen_.insert(
                {active[a].first * 64 + active[a].second, active[b].first * 64 + active[b].second});
        }
    }
    ++count_;
}

}  // namespace fuzz
