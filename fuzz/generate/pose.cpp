// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/pose.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>

#include "fuzz/generate/color.hpp"
#include "fuzz/generate/dice.hpp"

namespace fuzz {

namespace {

size_t index_of(std::string_view name) {
    const std::vector<Feature>& all = features();
    const auto at = std::ranges::find(all, name, &Feature::name);
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
constexpr size_t kAny = 0, kColorsOfNumbers = 10;
constexpr size_t kFactors = 8;  // of "blend"
constexpr std::array<Need, 36> kNeeds = {{
    {"second", "blend", kFactors},
    {"second", "attachments", 1},
    {"alpha_to_one", "attachments", 1},
    {"alpha_to_one", "color", kAny},
    {"discard_by", "discard", 1},
    {"logic", "attachments", 1},
    {"depth-layout", "frag_depth", 1},
    {"depth-bounds", "draws", 1},
    {"resolve", "samples", 1},
    {"resolve", "color", kAny},
    {"depth_resolve", "samples", 1},
    {"sample_locations", "samples", 1},
    {"sample_mask", "samples", 1},
    {"shader_mask", "samples", 1},
    {"sample-shading", "samples", 1},
    {"attachments", "color", kAny},
    {"blend", "color", kAny},
    {"color-from", "color", kAny},
    {"write_mask", "color", kAny},
    {"stencil-masks", "stencil", 1},
    {"stencil-ops", "stencil", 1},
    {"stencil-compare", "stencil", 1},
    {"stencil-compare", "draws", 1},
    {"stencil_clear", "stencil", 1},
    {"compare", "draws", 1},
    {"rasterizer_discard", "draws", 1},
    {"bias", "z", 1},
    {"depth-clamp", "z", 2},
    {"interpolation", "attributes", 1},
    {"auxiliary", "attributes", 1},
    {"source", "attributes", 1},
    {"probe", "attributes", 1},
    {"provoking", "attributes", 1},
    {"viewport_index", "draws", 1},
    {"complement", "clip-distances", 1},
    {"complement", "draws", 1},
}};

// What a feature has to meet to show most of what it does: one of these is mostly on beside it.
struct Company {
    std::string_view feature;
    std::array<std::string_view, 4> others;
};
constexpr std::array<Company, 24> kCompany = {{
    {"second", {"draws", "draws", "samples", "color-from"}},
    {"alpha_to_one", {"blend", "blend", "draws", "color-from"}},
    {"discard", {"attributes", "auxiliary", "discard_by", "draws"}},
    {"query", {"indices", "topology", "w", "clip-distances"}},
    {"query", {"draws", "compare", "discard", "early_tests"}},
    {"query", {"sample_mask", "stencil-compare", "frag_depth", "cull"}},
    {"frag_depth", {"draws", "compare", "depth-bounds", "bias"}},
    {"frag_depth", {"viewport", "depth-clamp", "samples", "early_tests"}},
    {"logic", {"draws", "write_mask", "blend", "color"}},
    {"logic", {"color", "color-from", "cull", "draws"}},
    {"blend", {"draws", "draws", "write_mask", "color-from"}},
    {"write_mask", {"draws", "draws", "color-from", "color"}},
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
// One pose in so many has, besides what it is, what few devices have or what leaves much open, and
// would otherwise be in every pose that had it for its pairs: conservative draws, fragments of
// several pixels, alpha to coverage. The features of it stand last.
constexpr uint64_t kPosesApart = 8, kFirstOfArea = 5, kFirstOfFragments = 2, kFirstOfAlpha = 7;
constexpr size_t kFeaturesApart = 4;

}  // namespace

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
            const auto at = std::ranges::find(row.values, often.value);
            return static_cast<size_t>(at - row.values.begin());
        }
    }
    // A key that has no row any more has no words: its feature has but the default.
    return row.values.size() == first ? 0 : first + dice.below(row.values.size() - first);
}

// The sizes of fragments, but for one pixel, that have at most so many samples.
std::vector<size_t> sizes_of_fragments(const Pose& pose, size_t most) {
    const size_t samples = std::stoul(std::string(pose.value("samples")));
    const std::vector<std::string_view>& sizes = features()[index_of("fragment_size")].values;
    const auto side = [](char digit) { return static_cast<size_t>(digit - '0'); };
    std::vector<size_t> out;
    for (size_t k = 1; k < sizes.size(); ++k) {
        if (side(sizes[k].front()) * side(sizes[k].back()) * samples <= most) {
            out.push_back(k);
        }
    }
    return out;
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
        const size_t feature = dice.below(features().size() - kFeaturesApart);
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
        for (const char* other : {"logic", "attachments", "second", "alpha_to_one"}) {
            set(other, 0);
        }
    }
    if (!pose.is_default("second")) {
        set("blend", kFactors);
    }
    if (!pose.is_default("early_tests") && pose.is_default("discard") &&
        pose.is_default("frag_depth")) {
        set(dice.one_in(2) ? "discard" : "frag_depth", 1);
    }
    // Depths that are equal are compared now and then.
    if (!pose.is_default("compare") && pose.is_default("z") && pose.is_default("frag_depth") &&
        !dice.one_in(4)) {
        set("z", 1);
    }
    for (const Need& need : kNeeds) {
        if (pose.is_default(need.feature) || !pose.is_default(need.other)) {
            continue;
        }
        if (need.value == kAny) {
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
        set("frag_depth", 5);  // gl_FragCoord.z, which alone is the fragment's own depth
    }
    // Of a fragment's own depth with a bias neither is known.
    if (!pose.is_default("depth-layout") || pose.is("frag_depth", "frag-coord")) {
        set("bias", 0);
    }
    if (pose.is("attachments", "color") &&
        (!pose.is_default("depth-bounds") || !pose.is_default("frag_depth"))) {
        set("attachments", 2);  // with a depth
    }
    // Colours of integers are resolved so, and no others.
    if (pose.is("resolve", "sample-zero") && !has_integers(pose)) {
        constexpr size_t kR32Uint = 11;
        set("color", kR32Uint);
    }
    if (!pose.is_default("relation") && pose.value("relation").ends_with("-attributes") &&
        pose.is_default("attributes")) {
        set("attributes", 1);
    }
    return pose;
}

std::optional<Pose> Poses::apart(const Pose& pose) const {
    if (!pose.is_default("blit")) {
        return std::nullopt;
    }
    Pose out = pose;
    const uint64_t number = count_ / kPosesApart + seed_;
    const auto set = [&](std::string_view feature, size_t value) {
        out.set(index_of(feature), value);
    };
    const auto switch_on = [&](std::string_view feature, size_t value) {
        if (pose.is_default(feature)) {
            set(feature, value);
        }
    };
    // What it does not go with is left out, as far as it is often drawn.
    const auto leave_out = [&](std::initializer_list<std::string_view> others) {
        std::ranges::for_each(others, [&](std::string_view other) { set(other, 0); });
    };
    if (count_ % kPosesApart == kFirstOfArea) {
        leave_out({"clip-distances", "cull-distances", "complement"});
        set("conservative", 1 + number % 3);
    } else if (count_ % kPosesApart == kFirstOfFragments) {
        leave_out({"clip-distances", "cull-distances", "complement", "discard", "discard_by",
                   "early_tests", "frag_depth", "depth-layout", "sample-shading", "shader_mask"});
        // Blocks begin at the target's first pixel, not at those of these.
        switch_on(number % 2 == 0 ? "scissor" : "viewport", 1);
        if (pose.is_default("color") && pose.is_default("source")) {
            set("fragment-input", number / 2 % 3);
            switch_on("attributes", number / 2 % 3 == 0 ? 0 : 1);
        }
        const bool has_mask = out.is("fragment-input", "sample-mask-in");
        const std::vector<size_t> sizes = sizes_of_fragments(pose, has_mask ? 16 : 32);
        set("fragment_size", sizes[number / 6 % sizes.size()]);
    } else if (count_ % kPosesApart == kFirstOfAlpha && number % 2 == 0) {
        leave_out({"query", "early_tests"});
        set("alpha_to_coverage", 1);
        set("attachments", 2);  // with a depth
        switch_on("color", 1 + number / 2 % kColorsOfNumbers);
        switch_on("samples", number % 3 == 0 ? 0 : 1);
    } else {
        return std::nullopt;
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
