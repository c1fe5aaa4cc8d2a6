// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The words that case files and exports have for the enumerations of a case, each table in the
// order of its enumeration.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "cases/base/fields.hpp"
#include "cases/model/case.hpp"

namespace cases {

template <size_t N>
using WordList = std::array<std::string_view, N>;

namespace detail {
// Takes the words from a table of formats.
template <class Row, size_t N>
constexpr WordList<N> words_in(const std::array<Row, N>& rows) {
    WordList<N> words;
    for (size_t k = 0; k < N; ++k) {
        words[k] = rows[k].word;
    }
    return words;
}
}  // namespace detail

// Holds the words of an enumeration; it is empty for those without a table below.
template <class Enum>
inline constexpr WordList<0> kWords = {};

template <>
inline constexpr WordList<3> kWords<Topology> = {"triangle-list", "triangle-strip", "triangle-fan"};
template <>
inline constexpr WordList<4> kWords<CullMode> = {"none", "front", "back", "front-and-back"};
template <>
inline constexpr WordList<2> kWords<FrontFace> = {"counter-clockwise", "clockwise"};
template <>
inline constexpr WordList<7> kWords<Discard> = {"none",  "odd-columns", "odd-rows", "checker",
                                                "front", "back",        "negative"};
template <>
inline constexpr WordList<3> kWords<DiscardBy> = {"kill", "demote", "terminate"};
template <>
inline constexpr WordList<3> kWords<Conservative> = {"none", "overestimate", "underestimate"};
template <>
inline constexpr WordList<9> kWords<Query> = {"none",
                                              "occlusion",
                                              "occlusion-precise",
                                              "input-vertices",
                                              "input-primitives",
                                              "vertex-invocations",
                                              "clipping-invocations",
                                              "clipping-primitives",
                                              "fragment-invocations"};
template <>
inline constexpr WordList<4> kWords<DepthLayout> = {"any", "greater", "less", "unchanged"};
template <>
inline constexpr WordList<3> kWords<Interpolation> = {"smooth", "noperspective", "flat"};
template <>
inline constexpr WordList<3> kWords<Auxiliary> = {"none", "centroid", "sample"};
template <>
inline constexpr WordList<2> kWords<ProvokingVertex> = {"first", "last"};
template <>
inline constexpr WordList<8> kWords<CompareOp> = {
    "never", "less", "equal", "less-or-equal", "greater", "not-equal", "greater-or-equal",
    "always"};
template <>
inline constexpr WordList<8> kWords<StencilOp> = {
    "keep",   "zero",           "replace",       "increment-clamp", "decrement-clamp",
    "invert", "increment-wrap", "decrement-wrap"};
template <>
inline constexpr auto kWords<DepthFormat> = detail::words_in(kDepthFormats);
template <>
inline constexpr WordList<3> kWords<DepthBiasRepresentation> = {"format", "force-unorm", "float"};
template <>
inline constexpr WordList<6> kWords<Source> = {"vertex",    "barycentric",     "sample-mask-in",
                                               "sample-id", "sample-position", "shading-rate"};
template <>
inline constexpr WordList<14> kWords<Probe> = {
    "value",  "at-centroid", "at-sample",     "at-offset",   "dfdx",
    "dfdy",   "dfdx-fine",   "dfdy-fine",     "dfdx-coarse", "dfdy-coarse",
    "fwidth", "fwidth-fine", "fwidth-coarse", "query-lod"};
template <>
inline constexpr WordList<19> kWords<BlendFactor> = {"zero",
                                                     "one",
                                                     "src-color",
                                                     "one-minus-src-color",
                                                     "dst-color",
                                                     "one-minus-dst-color",
                                                     "src-alpha",
                                                     "one-minus-src-alpha",
                                                     "dst-alpha",
                                                     "one-minus-dst-alpha",
                                                     "constant-color",
                                                     "one-minus-constant-color",
                                                     "constant-alpha",
                                                     "one-minus-constant-alpha",
                                                     "src-alpha-saturate",
                                                     "src1-color",
                                                     "one-minus-src1-color",
                                                     "src1-alpha",
                                                     "one-minus-src1-alpha"};
template <>
inline constexpr WordList<5> kWords<BlendOp> = {"add", "subtract", "reverse-subtract", "min",
                                                "max"};
template <>
inline constexpr WordList<9> kWords<ColorFrom> = {"push-constant",  "constant", "uniform",
                                                  "uniform-offset", "storage",  "texture",
                                                  "rendered",       "texels",   "mask"};
template <>
inline constexpr WordList<4> kWords<Frame> = {"copied", "sampled", "second", "part"};
template <>
inline constexpr WordList<5> kWords<Attachments> = {"all", "color", "color+depth", "depth",
                                                    "stencil"};
template <>
inline constexpr WordList<16> kWords<LogicOp> = {
    "clear",         "and",         "and-reverse", "copy",       "and-inverted", "no-op",
    "xor",           "or",          "nor",         "equivalent", "invert",       "or-reverse",
    "copy-inverted", "or-inverted", "nand",        "set"};
template <>
inline constexpr auto kWords<ColorFormat> = detail::words_in(kColorFormats);
template <>
inline constexpr WordList<4> kWords<LoadOp> = {"clear", "load", "dont-care", "none"};
template <>
inline constexpr WordList<3> kWords<StoreOp> = {"store", "dont-care", "none"};
template <>
inline constexpr WordList<5> kWords<Resolve> = {"none", "sample-zero", "average", "min", "max"};
template <>
inline constexpr WordList<2> kWords<BlitFilter> = {"nearest", "linear"};
template <>
inline constexpr WordList<2> kWords<BlitPattern> = {"unique", "ramp"};
template <>
inline constexpr WordList<7> kWords<RelationKind> = {
    "same-twice",       "scissor-tiles",   "other-clears", "write-masks",
    "fewer-attributes", "more-attributes", "doors"};
// DepthState::negative_one_to_one.
inline constexpr WordList<2> kVolumeWords = {"zero-to-one", "negative-one-to-one"};
// Of equations with names; the first one turns blending off.
inline constexpr WordList<8> kBlendWords = {
    "none", "alpha", "premultiplied", "additive", "multiply", "reverse-subtract", "min", "max"};

template <class Enum>
    requires(kWords<Enum>.size() > 0)
inline constexpr size_t kValueCount<Enum> = kWords<Enum>.size();

namespace detail {
template <class Enum>
constexpr bool ends_with(Enum last) {
    return kWords<Enum>.size() == static_cast<size_t>(last) + 1;
}
}  // namespace detail
static_assert(detail::ends_with(Topology::triangle_fan) &&
              detail::ends_with(CullMode::front_and_back) &&
              detail::ends_with(FrontFace::clockwise) && detail::ends_with(Discard::negative) &&
              detail::ends_with(DepthLayout::unchanged) &&
              detail::ends_with(Query::fragment_invocations) &&
              detail::ends_with(Interpolation::flat) && detail::ends_with(Auxiliary::sample) &&
              detail::ends_with(ProvokingVertex::last) && detail::ends_with(CompareOp::always) &&
              detail::ends_with(DepthFormat::d16_unorm) &&
              detail::ends_with(DepthBiasRepresentation::floating) &&
              detail::ends_with(Source::shading_rate) && detail::ends_with(Probe::lod) &&
              detail::ends_with(BlendFactor::one_minus_src1_alpha) &&
              detail::ends_with(BlendOp::max) && detail::ends_with(LogicOp::set) &&
              detail::ends_with(ColorFrom::mask) && detail::ends_with(Frame::part) &&
              detail::ends_with(Resolve::max) && detail::ends_with(BlitFilter::linear) &&
              detail::ends_with(BlitPattern::ramp) && detail::ends_with(kLastRelationKind));

// The word of a value. LeafContext::enumerator() goes the other way.
template <class Enum>
constexpr std::string_view word_of(Enum value) {
    return kWords<Enum>.at(static_cast<size_t>(value));
}

}  // namespace cases
