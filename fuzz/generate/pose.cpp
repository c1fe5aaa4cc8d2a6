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
// Not one value, but any; of colours one of numbers, not of integers.
constexpr size_t kAny = 0;
constexpr std::array<Need, 31> kNeeds = {{
    {"logic", "attachments", 1},
    {"depth-layout", "frag-depth", 1},
    {"depth-bounds", "draws", 1},
    {"resolve", "samples", 1},
    {"resolve", "color", kAny},
    {"depth-resolve", "samples", 1},
    {"sample-locations", "samples", 1},
    {"sample-mask", "samples", 1},
    {"shader-mask", "samples", 1},
    {"sample-shading", "samples", 1},
    {"attachments", "color", kAny},
    {"blend", "color", kAny},
    {"color-from", "color", kAny},
    {"write-mask", "color", kAny},
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
    {"complement", "clip-distances", 1},
    {"complement", "draws", 1},
}};

// What a feature has to meet to show most of what it does: one of these is mostly on beside it.
struct Company {
    std::string_view feature;
    std::array<std::string_view, 4> others;
};
constexpr std::array<Company, 20> kCompany = {{
    {"query", {"draws", "compare", "discard", "early-tests"}},
    {"query", {"sample-mask", "stencil-compare", "frag-depth", "cull"}},
    {"frag-depth", {"draws", "compare", "depth-bounds", "bias"}},
    {"frag-depth", {"viewport", "depth-clamp", "samples", "early-tests"}},
    {"logic", {"draws", "write-mask", "blend", "color"}},
    {"logic", {"color", "color-from", "cull", "draws"}},
    {"blend", {"draws", "draws", "write-mask", "color-from"}},
    {"write-mask", {"draws", "draws", "color-from", "color"}},
    {"interpolation", {"w", "w", "topology", "provoking"}},
    {"auxiliary", {"w", "w", "samples", "probe"}},
    {"probe", {"w", "w", "samples", "topology"}},
    {"provoking", {"topology", "topology", "interpolation", "indices"}},
    {"depth-clamp", {"viewport", "bias", "bias", "depth-clip"}},
    {"bias", {"depth", "depth", "depth-clamp", "viewport"}},
    {"stencil-ops", {"stencil-compare", "stencil-masks", "compare", "draws"}},
    {"stencil-compare", {"stencil-ops", "stencil-ops", "compare", "discard"}},
    {"stencil-masks", {"stencil-ops", "stencil-ops", "stencil-compare", "draws"}},
    {"scissor", {"size", "size", "size", "viewport"}},
    {"clip-distances", {"w", "draws", "topology", "attributes"}},
    {"cull-distances", {"topology", "w", "indices", "clip-distances"}},
}};

// Values that show more than the feature's others: each is drawn one time in so many.
struct Often {
    std::string_view feature, value;
    uint64_t times;
};
constexpr std::array<Often, 10> kOften = {{
    {"blend", "factors", 2},
    {"probe", "query-lod", 5},
    {"probe", "at-offset", 6},
    {"source", "sample-mask-in", 3},
    {"viewport", "depth", 4},
    {"w", "unequal", 3},
    {"interpolation", "flat", 4},
    {"interpolation", "noperspective", 4},
    {"color", "rgba8-srgb", 8},
    {"samples", "4", 2},  // 2 and 8 are rarely supported
}};

// One pose in so many is a blit: it has next to no features, and would never be taken for its
// pairs. All but its filter and the target's size is the geometries'.
constexpr uint64_t kPosesOfBlit = 48, kFirstOfBlit = 8;
// One pose in so many has conservative draws besides what it is, unless that does not go with them:
// many devices lack them, and would lose every pose that had them for its pairs.
constexpr uint64_t kPosesOfArea = 8, kFirstOfArea = 5;
// And one in so many has fragments of several pixels, which few devices have, too.
constexpr uint64_t kFirstOfFragments = 2;
// These two are drawn apart, and stand last.
constexpr size_t kAreaFeatures = 2;

}  // namespace

const std::vector<Feature>& features() {
    static const std::vector<Feature> kAll = {
        {"samples", {"1", "4", "2", "8"}},
        {"blit", {"none", "nearest", "linear"}},
        {"size", {"16", "odd", "wide", "high", "64", "tiny", "large"}},
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
        {"cull-distances", {"0", "1", "2"}},
        {"complement", {"false", "true"}},
        {"viewport", {"target", "inner", "beyond", "flipped", "fractional", "depth"}},
        {"scissor", {"target", "inner", "beyond", "thin"}},
        {"viewport-index", {"0", "other"}},
        {"relation",
         {"none", "same-twice", "other-clears", "write-masks", "fewer-attributes",
          "more-attributes", "scissor-tiles"}},
        {"w", {"one", "equal", "unequal", "steep", "behind"}},
        {"z", {"half", "plane", "beyond"}},
        {"conservative", {"none", "overestimate", "underestimate", "extra"}},
        {"fragment-size", {"1x1", "2x1", "2x2", "1x2", "4x2", "2x4", "4x4"}},
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

size_t value_of(size_t feature, size_t first, Dice& dice) {
    const Feature& row = features()[feature];
    for (const Often& often : kOften) {
        if (often.feature == row.name && dice.one_in(often.times)) {
            const auto at = std::find(row.values.begin(), row.values.end(), often.value);
            return static_cast<size_t>(at - row.values.begin());
        }
    }
    return first + dice.below(row.values.size() - first);
}

Pose Poses::draw(size_t candidate) const {
    constexpr uint64_t kStream = 1;
    if (count_ % kPosesOfBlit == kFirstOfBlit) {
        return blit(count_ / kPosesOfBlit + seed_);
    }
    Dice dice(seed_, kStream, count_ * 4096 + candidate);
    Pose pose;
    const auto set = [&pose](std::string_view feature, size_t value) {
        pose.set(index_of(feature), value);
    };
    // Any value but the default, which is the first.
    const auto switch_on = [&](size_t feature) { pose.set(feature, value_of(feature, 1, dice)); };
    // Few features at a time: what many switch off between them is never seen otherwise.
    const uint64_t count = 1 + dice.below(6);
    for (uint64_t k = 0; k < count; ++k) {
        const size_t feature = dice.below(features().size() - kAreaFeatures);
        pose.set(feature, value_of(feature, 0, dice));
    }
    set("blit", 0);
    for (const Company& company : kCompany) {
        const std::string_view other = dice.of(company.others);
        if (!pose.is_default(company.feature) && pose.is_default(other) && !dice.one_in(3)) {
            switch_on(index_of(other));
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
        if (pose.is_default(need.feature) || !pose.is_default(need.other)) {
            continue;
        }
        if (need.value == kAny) {
            constexpr size_t kColorsOfNumbers = 10;
            set(need.other, 1 + dice.below(kColorsOfNumbers));
        } else {
            set(need.other, need.value);
        }
    }
    // The mask of one sample has one bit.
    if (pose.is("source", "sample-mask-in") && pose.is_default("samples") && !dice.one_in(4)) {
        switch_on(index_of("samples"));
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

namespace {

// What a fragment size goes with (cases/load/load_target.cpp).
bool goes_with_fragments(const Pose& pose) {
    constexpr std::string_view kOthers[] = {
        "blit",           "clip-distances",   "cull-distances", "complement", "probe", "source",
        "sample-shading", "sample-locations", "shader-mask",    "frag-depth", "query", "discard"};
    return std::ranges::all_of(kOthers, [&](std::string_view f) { return pose.is_default(f); }) &&
           !pose.is("auxiliary", "sample") && !pose.is("relation", "scissor-tiles");
}

}  // namespace

Pose Poses::with_area(const Pose& pose) const {
    Pose out = pose;
    const bool goes_with_it = pose.is_default("clip-distances") &&
                              pose.is_default("cull-distances") && pose.is_default("probe") &&
                              pose.is_default("blit") && !pose.is("auxiliary", "centroid");
    const uint64_t number = count_ / kPosesOfArea + seed_;
    if (count_ % kPosesOfArea == kFirstOfArea && goes_with_it) {
        const size_t feature = index_of("conservative");
        out.set(feature, 1 + number % (features()[feature].values.size() - 1));
    }
    if (count_ % kPosesOfArea == kFirstOfFragments && goes_with_fragments(pose)) {
        // Of four samples and more the first four sizes have 32 samples at most.
        const size_t feature = index_of("fragment-size");
        const bool is_any = pose.is("samples", "1") || pose.is("samples", "2");
        const size_t sizes = is_any ? features()[feature].values.size() - 1 : 3;
        out.set(feature, 1 + number % sizes);
    }
    return out;
}

Pose Poses::blit(uint64_t number) {
    Pose pose;
    pose.set(index_of("blit"), 1 + number % 2);
    const size_t size = index_of("size");
    pose.set(size, number / 2 % features()[size].values.size());
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
