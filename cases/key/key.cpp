// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/key/key.hpp"

#include <algorithm>
#include <array>

#include "cases/model/words.hpp"

namespace cases {

namespace {

// --- rows of each kind ---
constexpr Key other(std::string_view name, int64_t least = 0, int64_t most = 0) {
    return {.name = name, .least = least, .most = most};
}
constexpr Key word(std::string_view name, Words words) {
    return {.name = name, .kind = KeyKind::word, .words = words, .absent = words.front()};
}
constexpr Key flag(std::string_view name) {
    return {.name = name, .kind = KeyKind::flag, .absent = "false"};
}
constexpr Key whole(std::string_view name, int64_t least, int64_t most) {
    return {.name = name, .kind = KeyKind::whole, .least = least, .most = most};
}
constexpr Key bits(std::string_view name, int64_t most) {
    return {.name = name, .kind = KeyKind::bits, .most = most};
}
constexpr Key number(std::string_view name) {
    return {.name = name, .kind = KeyKind::number};
}
constexpr Key share(std::string_view name) {
    return {.name = name, .kind = KeyKind::share};
}
constexpr Key table(std::string_view name, const KeyTable& keys) {
    return {.name = name, .kind = KeyKind::table, .keys = &keys};
}

// --- words that no enumeration has, and values to try ---
constexpr WordList<3> kSpaces = {"pixels", "ndc", "clip"};
constexpr WordList<4> kMirrors = {"none", "x", "y", "xy"};
constexpr WordList<2> kDirections = {"given", "reversed"};
constexpr WordList<2> kMadeValues = {"barycentric", "random"};
constexpr WordList<1> kDepthSources = {"frag-coord"};
constexpr WordList<6> kWriteMasks = {"rgba", "rgb", "r", "g", "ba", "a"};
constexpr auto kSampleCounts = std::to_array<double>({1, 2, 4, 8, 16});
constexpr auto kFew = std::to_array<double>({0, 1, 2});
constexpr auto kLayerCounts = std::to_array<double>({1, 2, 3});
constexpr auto kDepths = std::to_array<double>({0, 0.125, 0.375, 0.5, 1});
constexpr auto kShares = std::to_array<double>({0, 0.25, 0.5, 1});
constexpr auto kMasks = std::to_array<double>({0, 1, 2, 3, 5, 8, 10, 15});
// Where stencil operations end or begin anew, and where a mask takes bits away.
constexpr auto kStencils = std::to_array<double>({0, 1, 2, 127, 128, 170, 254, 255});
constexpr int64_t kAllBits = UINT32_MAX;
constexpr int64_t kLastViewport = 15;         // maxViewports is at least 16 with multiViewport
constexpr std::string_view kEquals = "= {}";  // behind the name of the key

constexpr auto kFile = std::to_array<Key>({
    other("format").silent(),
    other("description").silent(),
    other("catches").silent(),
    other("rules").silent(),
    other("links").silent(),
    other("leaves"),
    table("relations", kRelationKeys),
    other("matrix"),
    other("fuzz"),
    table("target", kTargetKeys),
    table("blit", kBlitKeys),
    table("draw", kDrawKeys),
    table("expect", kExpectKeys),
});

constexpr auto kTarget = std::to_array<Key>({
    other("size").silent(),
    whole("samples", 1, 16).tries(kSampleCounts).plain("1").pipeline(),
    whole("layers", 1, kMaxLayers).tries(kLayerCounts).plain("1").pipeline(),
    word("depth", kWords<DepthFormat>).as("depth_format").near("depth {}").any_word().pipeline(),
    share("depth_clear")
        .tries(kDepths)
        .plain("0.375")
        .pipeline()
        .advises(", which Vulkan does not allow"),
    other("sample_locations").plain("the standard ones"),
    word("resolve", kWords<Resolve>).as("color_resolve").near(kEquals).pipeline(),
    word("depth_resolve", kWords<Resolve>).near(kEquals).pipeline(),
    word("stencil_resolve", kWords<Resolve>).near(kEquals).pipeline(),
    flag("stencil").pipeline(),
    whole("stencil_clear", 0, kStencilBits).tries(kStencils).plain("0"),
    word("depth_load", kWords<LoadOp>),
    word("stencil_load", kWords<LoadOp>),
    word("depth_store", kWords<StoreOp>),
    word("stencil_store", kWords<StoreOp>),
    word("attachments", kWords<Attachments>).near(kEquals).pipeline(),
    word("frame", kWords<Frame>).near(kEquals),
    table("color", kTargetColorKeys).plain("none"),
    other("judged", 0, kMaxColorTargets - 1).as("judged_color").plain("0"),
});

constexpr auto kTargetColor = std::to_array<Key>({
    word("format", kWords<ColorFormat>)
        .names("the colour format")
        .near("the format {}")
        .plain("")
        .silent()
        .pipeline(),
    other("clear").plain("0, 0, 0, 0"),
    word("load", kWords<LoadOp>),
    word("store", kWords<StoreOp>),
});

constexpr auto kDraw = std::to_array<Key>({
    table("clear", kClearKeys).plain("none").silent().shape(),
    word("topology", kWords<Topology>).plain("list").pipeline(),
    word("space", kSpaces).plain("pixels, z = 1/2, w = 1"),
    other("vertices").silent().shape(),
    other("generate").shape(),
    other("indices").plain("none").shape(),
    whole("instances", 1, kMaxInstances).plain("1"),
    whole("first_instance", 0, kMaxInstances - 1).tries(kFew).plain("0"),
    other("offsets").plain("0 for all instances").shape(),
    flag("matrix").pipeline(),
    table("viewport", kViewportKeys).plain("the target"),
    other("scissor").plain("the target"),
    whole("viewport_index", 0, kLastViewport).tries(kFew).plain("0").pipeline(),
    whole("layer", 0, kMaxLayers - 1).tries(kFew).plain("0").pipeline(),
    word("cull", kWords<CullMode>).near(kEquals).pipeline(),
    word("front_face", kWords<FrontFace>).near(kEquals).pipeline(),
    word("provoking", kWords<ProvokingVertex>)
        .as("provoking_vertex")
        .near("the {} vertex as provoking one")
        .pipeline(),
    flag("rasterizer_discard").pipeline(),
    word("conservative", kWords<Conservative>).pipeline(),
    number("conservative_extra").plain("0"),
    other("fragment_size").plain("[1, 1]"),
    word("discard", kWords<Discard>).near(kEquals).pipeline(),
    other("discard_attribute").plain("the first one"),
    word("discard_by", kWords<DiscardBy>).near(kEquals).pipeline(),
    flag("early_tests").pipeline(),
    table("frag_depth", kFragDepthKeys).plain("the shader writes no depth"),
    word("query", kWords<Query>).near(kEquals),
    table("depth", kDepthKeys).plain("test always passes, depth written"),
    word("depth_volume", kVolumeWords).as("volume").near(kEquals).pipeline(),
    table("stencil", kStencilKeys).plain("front faces +1, back faces -1, modulo 256"),
    bits("sample_mask", kAllBits).tries(kMasks).plain("all ones").pipeline(),
    bits("shader_mask", kAllBits).tries(kMasks).plain("not written").pipeline(),
    share("min_sample_shading")
        .tries(kShares)
        .plain("disabled")
        .pipeline()
        .advises("; write the fraction of the samples that is shaded at least"),
    table("color", kColorKeys),
    word("mirror", kMirrors).shape(),
    other("rotate").plain("0").shape(),
    other("offset").plain("[0, 0]").shape(),
    word("winding", kDirections).shape(),
    whole("first", 0, 2).plain("0").shape(),
    word("order", kDirections).shape(),
    table("clip_distance", kDistanceKeys).plain("none"),
    table("cull_distance", kDistanceKeys).plain("none"),
    table("attribute", kAttributeKeys).as("attributes").plain("none"),
});

constexpr auto kClear = std::to_array<Key>({
    other("rects").plain("the target").silent(),
    whole("layers", 1, kMaxLayers).tries(kLayerCounts).plain("1"),
    other("color").plain("stays"),
    share("depth").tries(kDepths).plain("stays").advises(", which Vulkan does not allow"),
    whole("stencil", 0, kStencilBits).tries(kStencils).plain("stays"),
});

constexpr auto kViewport = std::to_array<Key>({other("rect"), other("depth")});

constexpr auto kDepth = std::to_array<Key>({
    word("compare", kWords<CompareOp>)
        .near("the comparison {}")
        .plain("always")
        .any_word()
        .pipeline(),
    flag("write").plain("true").pipeline(),
    table("bias", kBiasKeys).plain("no bias"),
    flag("clamp").pipeline(),
    flag("clip").plain("not `clamp`").pipeline(),
    other("bounds").plain("no test"),
});

constexpr auto kBias = std::to_array<Key>({
    number("constant").plain("0"),
    number("slope").plain("0"),
    number("clamp").plain("0"),
    word("representation", kWords<DepthBiasRepresentation>),
    flag("exact"),
});

// The keys of one face, and before them those of a table for a face alone.
constexpr auto kStencil = std::to_array<Key>({
    word("compare", kWords<CompareOp>).near("the comparison {}").plain("always").any_word(),
    word("fail", kWords<StencilOp>).near(kEquals),
    word("depth_fail", kWords<StencilOp>).near(kEquals),
    word("pass", kWords<StencilOp>).near(kEquals),
    bits("compare_mask", kAllBits).tries(kStencils).plain("0xff"),
    bits("write_mask", kAllBits).tries(kStencils).plain("0xff"),
    bits("reference", kStencilBits).tries(kStencils).plain("0"),
    table("front", kStencilFaceKeys).plain("as for both"),
    table("back", kStencilFaceKeys).plain("as for both"),
});
constexpr size_t kFaceTables = 2;

constexpr auto kFragDepth = std::to_array<Key>({
    number("value"),
    number("other"),
    // A depth is written by the pixel, not by the face.
    word("where", Words(kWords<Discard>).first(static_cast<size_t>(Discard::front))).near(kEquals),
    word("from", kDepthSources).plain(""),
    word("layout", kWords<DepthLayout>).near(kEquals),
});

constexpr auto kColor = std::to_array<Key>({
    other("value"),
    other("attribute").any_word(),
    word("from", kWords<ColorFrom>).near("the colour from a {}").pipeline(),
    table("blend", kBlendKeys).tries(kBlendWords).near(kEquals).plain("none").any_word().pipeline(),
    other("constants").plain("0, 0, 0, 0"),
    other("second"),
    word("logic", kWords<LogicOp>).names("the logical operation").near(kEquals).plain("none"),
    flag("alpha_to_one"),
    flag("alpha_to_coverage"),
    other("write_mask").tries(kWriteMasks).plain("`\"rgba\"`").any_word().pipeline(),
});

constexpr auto kBlend = std::to_array<Key>({
    word("source", kWords<BlendFactor>).names("the blend factor source").plain("one").any_word(),
    word("destination", kWords<BlendFactor>).names("the blend factor destination").any_word(),
    word("op", kWords<BlendOp>).names("the blend op").any_word(),
    table("alpha", kBlendAlphaKeys).plain("as for colour"),
});

constexpr auto kAttribute = std::to_array<Key>({
    other("name").plain("attribute0, attribute1, ...").silent(),
    word("source", kWords<Source>).any_word().pipeline(),
    word("interpolation", kWords<Interpolation>).near("{} interpolation").pipeline(),
    word("auxiliary", kWords<Auxiliary>).near(kEquals).pipeline(),
    other("values").silent(),
    other("constant"),
    other("plane"),
    word("from", kMadeValues).plain(""),
    whole("seed", 0, INT64_MAX).plain("1"),
    other("components", 1, 4).plain("3, or 1 of random"),
    word("probe", kWords<Probe>).pipeline(),
    other("sample", 0, 15).as("probe_sample"),
    other("offset"),
    other("texture"),
    whole("divisor", 0, kMaxInstances).tries(kFew).plain("read at each vertex").pipeline(),
});

constexpr auto kDistance = std::to_array<Key>({
    other("values").silent(),
    other("constant"),
    other("plane"),
    other("half_space").silent(),
    flag("negate"),
});

constexpr auto kBlit = std::to_array<Key>({
    other("size").plain("required").silent(),
    word("format", kWords<ColorFormat>)
        .as("source_format")
        .names("the colour format")
        .plain("the target's")
        .silent(),
    word("pattern", kWords<BlitPattern>),
    whole("seed", 0, INT32_MAX).plain("1"),
    word("filter", kWords<BlitFilter>),
    other("from").plain("the whole image"),
    other("to").plain("the whole image"),
    flag("clip"),
});

constexpr auto kExpect = std::to_array<Key>({other("hits")});
constexpr auto kRelation = std::to_array<Key>({other("scissor-tiles"), other("doors")});
constexpr auto kOpenRange = std::to_array<Key>(
    {other("from"), other("to"), other("step").plain("1"), other("nominal").plain("`from`")});

}  // namespace

constinit const KeyTable kFileKeys = {"a case file", kFile};
constinit const KeyTable kTargetKeys = {"[target]", kTarget};
constinit const KeyTable kTargetColorKeys = {"[target.color]", kTargetColor};
constinit const KeyTable kDrawKeys = {"[[draw]]", kDraw};
constinit const KeyTable kClearKeys = {"clear", kClear};
constinit const KeyTable kViewportKeys = {"viewport", kViewport};
constinit const KeyTable kDepthKeys = {"depth", kDepth};
constinit const KeyTable kBiasKeys = {"bias", kBias};
constinit const KeyTable kStencilKeys = {"stencil", kStencil};
constinit const KeyTable kStencilFaceKeys = {
    "a face", std::span(kStencil).first(kStencil.size() - kFaceTables)};
constinit const KeyTable kFragDepthKeys = {"frag_depth", kFragDepth};
constinit const KeyTable kColorKeys = {"color", kColor};
constinit const KeyTable kBlendKeys = {"blend", kBlend};
constinit const KeyTable kBlendAlphaKeys = {"blend.alpha",
                                            std::span(kBlend).first(kBlend.size() - 1)};
constinit const KeyTable kAttributeKeys = {"[[draw.attribute]]", kAttribute};
constinit const KeyTable kDistanceKeys = {"a distance", kDistance};
constinit const KeyTable kBlitKeys = {"[blit]", kBlit};
constinit const KeyTable kExpectKeys = {"[expect]", kExpect};
constinit const KeyTable kRelationKeys = {"a relation", kRelation};
constinit const KeyTable kOpenRangeKeys = {"a range", kOpenRange};

const Key* KeyTable::find(std::string_view key) const {
    const auto row = std::ranges::find(keys, key, &Key::name);
    return row == keys.end() ? nullptr : &*row;
}

const Key* KeyTable::find_field(std::string_view field) const {
    const auto row = std::ranges::find_if(
        keys, [&](const Key& k) { return (k.field.empty() ? k.name : k.field) == field; });
    return row == keys.end() ? nullptr : &*row;
}

const Key* find_key(const KeyTable* table, std::string_view key) {
    return table == nullptr ? nullptr : table->find(key);
}

const KeyTable* keys_in(const KeyTable* table, std::string_view key) {
    const Key* row = find_key(table, key);
    return row == nullptr ? nullptr : row->keys;
}

}  // namespace cases
