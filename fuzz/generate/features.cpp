// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/key/key.hpp"
#include "cases/model/way.hpp"
#include "fuzz/generate/color.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

namespace {

// The words of a key, behind a word for its absence if none of them is.
std::vector<std::string_view> words(const cases::KeyTable& keys, std::string_view name,
                                    std::string_view absent = {}) {
    const cases::Key* key = keys.find(name);
    std::vector<std::string_view> all;
    if (!absent.empty() || key == nullptr) {
        all.push_back(absent);
    }
    if (key != nullptr) {
        all.insert(all.end(), key->words.begin(), key->words.end());
    }
    return all;
}

std::vector<std::string_view> words_of_formats() {
    std::vector<std::string_view> all = {"none"};
    for (const cases::ColorFormatRow& format : kPoseFormats) {
        all.push_back(format.word);
    }
    return all;
}

std::vector<std::string_view> words_of_ways() {
    std::vector<std::string_view> all = {"none"};
    for (const cases::WayRow& way : cases::all_ways()) {
        all.push_back(way.word);
    }
    return all;
}

}  // namespace

const std::vector<Feature>& features() {
    static const std::vector<Feature> kAll = {
        {"samples", {"1", "4", "2", "8"}},
        {"blit", {"none", "nearest", "linear"}},
        {"size", {"16", "odd", "wide", "high", "64", "tiny", "large"}},
        {"layers", {"1", "2", "3"}},
        {"depth", {"d32-float", "d16-unorm", "d24-unorm"}},
        // Depth or a stencil alone is drawn by ways, in bare poses.
        {"attachments", {"all", "color", "color+depth"}},
        {"color", words_of_formats()},
        {"blend",
         {"none", "additive", "alpha", "premultiplied", "multiply", "reverse-subtract", "min",
          "max", "factors"}},
        {"second", {"false", "true"}},
        {"alpha_to_one", {"false", "true"}},
        {"color-from", {"value", "attribute"}},
        {"write_mask", {"rgba", "rgb", "r", "gb", "ra"}},
        {"logic", words(cases::kColorKeys, "logic", "none")},
        {"query", {"none", "occlusion", "occlusion-precise", "statistics"}},
        {"stencil", {"false", "true"}},
        {"stencil_clear", {"0", "given"}},
        {"stencil-compare",
         {"always", "equal", "not-equal", "less", "less-or-equal", "greater", "greater-or-equal",
          "never"}},
        {"stencil-ops", {"count", "same", "faces"}},
        {"stencil-masks", {"whole", "given"}},
        {"resolve", {"none", "average", "sample-zero"}},
        {"depth_resolve", {"none", "sample-zero", "min", "max", "average"}},
        {"sample_locations", {"standard", "own"}},
        {"draws", {"1", "2", "3"}},
        {"topology", words(cases::kDrawKeys, "topology")},
        {"indices", {"none", "given", "restart"}},
        {"space", {"pixels", "clip"}},
        {"cull", {"none", "back", "front"}},
        {"front_face", words(cases::kDrawKeys, "front_face")},
        {"provoking", words(cases::kDrawKeys, "provoking")},
        {"depth_volume", words(cases::kDrawKeys, "depth_volume")},
        {"compare",
         {"always", "less", "less-or-equal", "greater", "greater-or-equal", "equal", "not-equal",
          "never"}},
        {"depth-write", {"true", "false"}},
        {"depth-bounds", {"none", "ends", "below", "above", "one-depth", "whole"}},
        {"frag_depth", {"none", "value", "odd-columns", "odd-rows", "checker", "frag-coord"}},
        {"depth-layout", words(cases::kFragDepthKeys, "layout")},
        {"bias", {"none", "constant", "slope", "both", "clamped"}},
        {"depth-clamp", {"false", "true"}},
        {"depth-clip", {"default", "true", "false"}},
        {"sample_mask", {"all", "given"}},
        {"shader_mask", {"all", "given"}},
        {"sample-shading", {"off", "half", "full", "least"}},
        {"discard", {"none", "odd-columns", "odd-rows", "checker", "front", "back"}},
        {"discard_by", words(cases::kDrawKeys, "discard_by")},
        {"early_tests", {"false", "true"}},
        {"rasterizer_discard", {"none", "first-draw"}},
        {"attributes", {"none", "one", "two", "three"}},
        {"interpolation", {"smooth", "noperspective", "flat", "mixed"}},
        {"auxiliary", words(cases::kAttributeKeys, "auxiliary")},
        {"source", {"vertex", "barycentric", "sample-mask-in", "sample-id", "sample-position"}},
        {"probe",
         {"value", "at-centroid", "at-sample", "at-offset", "dfdx", "dfdy", "fwidth", "dfdx-fine",
          "dfdy-fine", "dfdx-coarse", "dfdy-coarse", "query-lod"}},
        {"clip-distances", {"0", "1", "2"}},
        {"cull-distances", {"0", "1", "2"}},
        {"complement", {"false", "true"}},
        {"viewport", {"target", "inner", "beyond", "flipped", "fractional", "depth"}},
        {"scissor", {"target", "inner", "beyond", "thin"}},
        {"viewport_index", {"0", "other"}},
        {"relation",
         {"none", "same-twice", "other-clears", "write-masks", "fewer-attributes",
          "more-attributes", "scissor-tiles"}},
        {"w", {"one", "equal", "unequal", "steep", "behind"}},
        {"z", {"half", "plane", "beyond"}},
        // Drawn apart, or bare (kFeaturesApart of pose.cpp): they stay last.
        {"conservative", {"none", "overestimate", "underestimate", "extra"}},
        {"fragment_size", {"1x1", "2x1", "2x2", "1x2", "4x2", "2x4", "4x4"}},
        {"fragment-input", {"none", "sample-mask-in", "shading-rate"}},
        {"alpha_to_coverage", {"false", "true"}},
        // Of bare poses alone (bare.hpp).
        {"way", words_of_ways()},
        {"bare-format",
         {"rgba8-unorm", "bgra8-unorm", "rgba8-srgb", "bgra8-srgb", "a8b8g8r8-unorm", "r8-unorm",
          "rg8-unorm", "a1r5g5b5-unorm", "r4g4b4a4-unorm", "rgba16-snorm", "r16-float",
          "r11g11b10-float"}},
        {"viewport-place", {"target", "beside", "around", "far"}},
        {"scissor-place", {"target", "beside", "far"}},
    };
    return kAll;
}

}  // namespace fuzz
