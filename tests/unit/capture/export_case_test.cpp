// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether an export says all that alters the picture. Each structure of a case is taken apart by a
// structured binding, so that a new field does not compile until it stands here too.
#include "capture/exchange/export_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using cases::Case;

// One draw with everything that a draw may have, on a target with everything it may have.
Case full_case() {
    Case c;
    c.id = "a/b";
    c.claim.rules = {"cover.inside"};
    c.target = {4, 2, 4};
    c.target.layers = 2;
    c.target.color = cases::ColorTarget{};
    c.target.sample_locations = {{1, 2}, {3, 4}, {5, 6}, {7, 8}};
    cases::Draw d;
    d.positions = {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}, {1, 1, 0.5F, 1}};
    d.indices = {{0, 1, 2}};
    d.viewport = {0, 0, 4, 2, 0, 1};
    d.scissor = {0, 0, 4, 2};
    d.depth.bias = cases::DepthBias{};
    d.distances = {1, 1, {{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}, {}};
    d.distances.cull = d.distances.clip;
    d.color.blend = cases::Blend{};
    cases::Attribute a;
    a.name = "a";
    a.values = {{1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}, {4, 0, 0, 0}};
    d.attributes = {a};
    c.draws.push_back(d);
    return c;
}

struct Change {
    std::string field;
    std::function<void(Case&)> make;
};

cases::Draw& draw(Case& c) {
    return c.draws.at(0);
}
cases::Attribute& attribute(Case& c) {
    return draw(c).attributes.at(0);
}

std::vector<Change> target_changes() {
    [[maybe_unused]] const auto& [width, height, samples, layers, depth_format,
                                  names_depth,  // not told
                                  sample_locations, color, other_colors,
                                  judged_color,  // not told
                                  instruments,   // no part of the picture
                                  has_depth, depth_clear, depth_load, stencil_load, depth_store,
                                  stencil_store,  // not told
                                  color_resolve, depth_resolve, stencil_resolve, has_stencil,
                                  stencil_clear, frame] =
        cases::Target{};  // the last: how it is looked at
    [[maybe_unused]] const auto& [format, clear, load, store] = cases::ColorTarget{};
    return {
        {"width", [](Case& c) { ++c.target.width; }},
        {"height", [](Case& c) { ++c.target.height; }},
        {"samples",
         [](Case& c) {
             c.target.samples = 2;
             c.target.sample_locations.resize(2);
         }},
        {"layers", [](Case& c) { ++c.target.layers; }},
        {"depth_format", [](Case& c) { c.target.depth_format = cases::DepthFormat::d16_unorm; }},
        {"sample_locations", [](Case& c) { c.target.sample_locations[1][1] = 15; }},
        {"color", [](Case& c) { c.target.color.reset(); }},
        {"color.format", [](Case& c) { c.target.color->format = cases::ColorFormat::r32_uint; }},
        {"color.clear", [](Case& c) { c.target.color->clear.w = 1; }},
        {"has_depth", [](Case& c) { c.target.has_depth = false; }},
        {"depth_clear", [](Case& c) { c.target.depth_clear = 0.5F; }},
        {"color_resolve", [](Case& c) { c.target.color_resolve = cases::Resolve::average; }},
        {"depth_resolve", [](Case& c) { c.target.depth_resolve = cases::Resolve::max; }},
        {"stencil_resolve", [](Case& c) { c.target.stencil_resolve = cases::Resolve::min; }},
        {"has_stencil", [](Case& c) { c.target.has_stencil = true; }},
        {"stencil_clear", [](Case& c) { c.target.stencil_clear = 1; }},
    };
}

std::vector<Change> draw_changes() {
    [[maybe_unused]] const auto& [cleared, topology, positions, instances, first_instance,
                                  offsets,  // the last two are not told
                                  matrix, indices, primitive_restart, attributes, viewport, scissor,
                                  cull, front_face, provoking, rasterizer_discard, conservative,
                                  conservative_extra, fragment_size, discard, discard_attribute,
                                  discard_by, early_tests, frag_depth, query, depth, stencil,
                                  distances, multisample, color,
                                  other_colors,  // not told
                                  layer, viewport_index, where] = cases::Draw{};
    [[maybe_unused]] const auto& [x, y, width, height, min_depth, max_depth] = cases::Viewport{};
    [[maybe_unused]] const auto& [left, top, columns, rows] = cases::Rect{};
    [[maybe_unused]] const auto& [sample_mask, shader_mask, min_sample_shading] =
        cases::Multisample{};
    return {
        {"clear", [](Case& c) { draw(c).clear.emplace(); }},
        {"topology", [](Case& c) { draw(c).topology = cases::Topology::triangle_strip; }},
        {"positions", [](Case& c) { draw(c).positions[3].w = 2; }},
        {"instances", [](Case& c) { draw(c).instances = 2; }},
        {"indices", [](Case& c) { draw(c).indices->back() = 3; }},
        {"no indices", [](Case& c) { draw(c).indices.reset(); }},
        {"primitive_restart", [](Case& c) { draw(c).primitive_restart = true; }},
        {"attributes", [](Case& c) { draw(c).attributes.clear(); }},
        {"viewport.x", [](Case& c) { draw(c).viewport.x = 1; }},
        {"viewport.y", [](Case& c) { draw(c).viewport.y = 1; }},
        {"viewport.width", [](Case& c) { draw(c).viewport.width = 1; }},
        {"viewport.height", [](Case& c) { draw(c).viewport.height = -2; }},
        {"viewport.min_depth", [](Case& c) { draw(c).viewport.min_depth = 0.5F; }},
        {"viewport.max_depth", [](Case& c) { draw(c).viewport.max_depth = 0.5F; }},
        {"scissor.x", [](Case& c) { draw(c).scissor.x = 1; }},
        {"scissor.y", [](Case& c) { draw(c).scissor.y = 1; }},
        {"scissor.width", [](Case& c) { draw(c).scissor.width = 1; }},
        {"scissor.height", [](Case& c) { draw(c).scissor.height = 1; }},
        {"cull", [](Case& c) { draw(c).cull = cases::CullMode::back; }},
        {"front_face", [](Case& c) { draw(c).front_face = cases::FrontFace::clockwise; }},
        {"provoking", [](Case& c) { draw(c).provoking = cases::ProvokingVertex::last; }},
        {"rasterizer_discard", [](Case& c) { draw(c).rasterizer_discard = true; }},
        {"conservative",
         [](Case& c) { draw(c).conservative = cases::Conservative::underestimate; }},
        {"conservative_extra", [](Case& c) { draw(c).conservative_extra = 0.5F; }},
        {"fragment_size",
         [](Case& c) {
             draw(c).fragment_size = {1, 2};
         }},
        {"discard", [](Case& c) { draw(c).discard = cases::Discard::odd_rows; }},
        {"discard_attribute",
         [](Case& c) {
             draw(c).discard = cases::Discard::negative;
             draw(c).discard_attribute = 1;
         }},
        {"discard_by", [](Case& c) { draw(c).discard_by = cases::DiscardBy::demote; }},
        {"early_tests", [](Case& c) { draw(c).early_tests = true; }},
        {"frag_depth", [](Case& c) { draw(c).frag_depth = cases::FragDepth{}; }},
        {"depth.bounds",
         [](Case& c) {
             draw(c).depth.bounds = cases::DepthBounds{0.25F, 1};
         }},
        {"stencil",
         [](Case& c) {
             c.target.has_stencil = true;
             draw(c).stencil.back.reference = 1;
         }},
        {"sample_mask", [](Case& c) { draw(c).multisample.sample_mask = 1; }},
        {"shader_mask", [](Case& c) { draw(c).multisample.shader_mask = 1; }},
        {"min_sample_shading", [](Case& c) { draw(c).multisample.min_sample_shading = 1; }},
        {"layer", [](Case& c) { draw(c).layer = 1; }},
        {"viewport_index", [](Case& c) { draw(c).viewport_index = 1; }},
    };
}

std::vector<Change> depth_changes() {
    [[maybe_unused]] const auto& [compare, write, bias, clamp, clip, negative_one_to_one, bounds] =
        cases::DepthState{};
    [[maybe_unused]] const auto& [constant, limit, slope, representation, is_exact] =
        cases::DepthBias{};
    using Representation = cases::DepthBiasRepresentation;
    return {
        {"compare", [](Case& c) { draw(c).depth.compare = cases::CompareOp::less; }},
        {"write", [](Case& c) { draw(c).depth.write = false; }},
        {"no bias", [](Case& c) { draw(c).depth.bias.reset(); }},
        {"bias.constant", [](Case& c) { draw(c).depth.bias->constant = 1; }},
        {"bias.clamp", [](Case& c) { draw(c).depth.bias->clamp = 1; }},
        {"bias.slope", [](Case& c) { draw(c).depth.bias->slope = 1; }},
        {"bias.representation",
         [](Case& c) { draw(c).depth.bias->representation = Representation::force_unorm; }},
        {"bias.is_exact", [](Case& c) { draw(c).depth.bias->is_exact = true; }},
        {"clamp", [](Case& c) { draw(c).depth.clamp = true; }},
        {"clip", [](Case& c) { draw(c).depth.clip = false; }},
        {"negative_one_to_one", [](Case& c) { draw(c).depth.negative_one_to_one = true; }},
    };
}

std::vector<Change> distance_changes() {
    [[maybe_unused]] const auto& [clip_count, cull_count, clip, cull] = cases::ClipDistances{};
    return {
        {"clip_count", [](Case& c) { draw(c).distances.clip_count = 2; }},
        {"cull_count", [](Case& c) { draw(c).distances.cull_count = 2; }},
        {"clip", [](Case& c) { draw(c).distances.clip[3].x = -1; }},
        {"cull", [](Case& c) { draw(c).distances.cull[3].x = -1; }},
    };
}

std::vector<Change> color_changes() {
    [[maybe_unused]] const auto& [value, index, from, blend, write_mask, logic, alpha_to_one,
                                  alpha_to_coverage] = cases::ColorOutput{};
    [[maybe_unused]] const auto& [color, alpha, constants, second] = cases::Blend{};
    [[maybe_unused]] const auto& [source, destination, op] = cases::BlendEquation{};
    using Factor = cases::BlendFactor;
    return {
        {"value", [](Case& c) { draw(c).color.value.z = 1; }},
        {"attribute", [](Case& c) { draw(c).color.attribute = 0; }},
        {"no blend", [](Case& c) { draw(c).color.blend.reset(); }},
        {"blend.color.source", [](Case& c) { draw(c).color.blend->color.source = Factor::zero; }},
        {"blend.color.destination",
         [](Case& c) { draw(c).color.blend->color.destination = Factor::one; }},
        {"blend.color.op", [](Case& c) { draw(c).color.blend->color.op = cases::BlendOp::max; }},
        {"blend.alpha.source", [](Case& c) { draw(c).color.blend->alpha.source = Factor::zero; }},
        {"blend.alpha.destination",
         [](Case& c) { draw(c).color.blend->alpha.destination = Factor::one; }},
        {"blend.alpha.op", [](Case& c) { draw(c).color.blend->alpha.op = cases::BlendOp::max; }},
        {"blend.second", [](Case& c) { draw(c).color.blend->second.w = 1; }},
        {"alpha_to_one", [](Case& c) { draw(c).color.alpha_to_one = true; }},
        {"texels", [](Case& c) { draw(c).color.from = cases::ColorFrom::texels; }},
        {"alpha_to_coverage", [](Case& c) { draw(c).color.alpha_to_coverage = true; }},
        {"blend.constants", [](Case& c) { draw(c).color.blend->constants.w = 1; }},
        {"write_mask", [](Case& c) { draw(c).color.write_mask = 7; }},
        {"logic", [](Case& c) { draw(c).color.logic = cases::LogicOp::nand; }},
    };
}

std::vector<Change> attribute_changes() {
    [[maybe_unused]] const auto& [name, interpolation, components, values, auxiliary, source, probe,
                                  offset, sample, size, divisor] = cases::Attribute{};
    using cases::Probe;
    const auto probed = [](Probe to, const std::function<void(cases::Attribute&)>& more) {
        return [to, more](Case& c) {
            attribute(c).probe = to;
            more(attribute(c));
        };
    };
    return {
        {"interpolation", [](Case& c) { attribute(c).interpolation = cases::Interpolation::flat; }},
        {"components", [](Case& c) { attribute(c).components = 2; }},
        {"values", [](Case& c) { attribute(c).values[3].x = 7; }},
        {"auxiliary", [](Case& c) { attribute(c).auxiliary = cases::Auxiliary::centroid; }},
        {"source", [](Case& c) { attribute(c).source = cases::Source::sample_id; }},
        {"probe", [](Case& c) { attribute(c).probe = Probe::dx; }},
        {"offset", probed(Probe::at_offset,
                          [](auto& a) {
                              a.probe_offset = {0.25F, 0};
                          })},
        {"offset y", probed(Probe::at_offset,
                            [](auto& a) {
                                a.probe_offset = {0, 0.25F};
                            })},
        {"sample 1", probed(Probe::at_sample, [](auto& a) { a.probe_sample = 1; })},
        {"sample 2", probed(Probe::at_sample, [](auto& a) { a.probe_sample = 2; })},
        {"texture 4 x 2", probed(Probe::lod,
                                 [](auto& a) {
                                     a.texture_size = {4, 2};
                                 })},
        {"texture 4 x 4", probed(Probe::lod,
                                 [](auto& a) {
                                     a.texture_size = {4, 4};
                                 })},
    };
}

Case blit_case() {
    Case c;
    c.id = "a/b";
    c.claim.rules = {"blit.nearest"};
    c.target = {4, 4};
    c.target.color = cases::ColorTarget{};
    c.blit = cases::Blit{};
    c.blit->source_width = c.blit->source_height = 4;
    c.blit->source = c.blit->destination = {0, 0, 2, 2};
    return c;
}

std::vector<Change> blit_changes() {
    [[maybe_unused]] const auto& [format, width, height, pattern, seed, filter, from, to] =
        cases::Blit{};
    [[maybe_unused]] const auto& [x0, y0, x1, y1] = cases::Corners{};
    return {
        {"source_format", [](Case& c) { c.blit->source_format = cases::ColorFormat::bgra8_unorm; }},
        {"source_width", [](Case& c) { ++c.blit->source_width; }},
        {"source_height", [](Case& c) { ++c.blit->source_height; }},
        {"pattern", [](Case& c) { c.blit->pattern = cases::BlitPattern::ramp; }},
        {"seed", [](Case& c) { ++c.blit->seed; }},
        {"filter", [](Case& c) { c.blit->filter = cases::BlitFilter::linear; }},
        {"from x0", [](Case& c) { ++c.blit->source.x0; }},
        {"from y0", [](Case& c) { ++c.blit->source.y0; }},
        {"from x1", [](Case& c) { ++c.blit->source.x1; }},
        {"from y1", [](Case& c) { ++c.blit->source.y1; }},
        {"to x0", [](Case& c) { ++c.blit->destination.x0; }},
        {"to y0", [](Case& c) { ++c.blit->destination.y0; }},
        {"to x1", [](Case& c) { ++c.blit->destination.x1; }},
        {"to y1", [](Case& c) { ++c.blit->destination.y1; }},
    };
}

// What a renderer reads to draw: "needs" repeats it, so it does not count.
std::string drawn(const Case& c) {
    nlohmann::json json = nlohmann::json::parse(capture::export_case(c));
    json.erase("needs");
    return json.dump();
}

// Every change shows, and no two of them look alike.
void expect_told(const Case& base, const std::vector<Change>& changes) {
    std::map<std::string, std::string> seen = {{drawn(base), "nothing"}};
    for (const Change& change : changes) {
        Case other = base;
        change.make(other);
        const auto [it, is_new] = seen.emplace(drawn(other), change.field);
        EXPECT_TRUE(is_new) << change.field << " is exported as " << it->second;
    }
}

TEST(ExportCase, EveryFieldThatAltersThePictureIsTold) {
    expect_told(full_case(), target_changes());
    expect_told(full_case(), draw_changes());
    expect_told(full_case(), depth_changes());
    expect_told(full_case(), distance_changes());
    expect_told(full_case(), color_changes());
    expect_told(full_case(), attribute_changes());
    expect_told(blit_case(), blit_changes());
}

TEST(ExportCase, AControlledDepthBiasIsToldAndNeeded) {
    Case c = full_case();
    c.draws[0].depth.bias =
        cases::DepthBias{3, 0, 0, cases::DepthBiasRepresentation::floating, false};
    const auto json = nlohmann::json::parse(capture::export_case(c));
    EXPECT_EQ(json["draws"][0]["depth"]["bias"]["representation"], "float");
    EXPECT_EQ(json["draws"][0]["depth"]["bias"]["exact"], false);
    EXPECT_THAT(capture::needs_of(c), testing::Contains("depth-bias-control"));
    c.draws[0].depth.bias->representation = cases::DepthBiasRepresentation::format;
    EXPECT_THAT(capture::needs_of(c), testing::Not(testing::Contains("depth-bias-control")));
    c.draws[0].depth.bias->is_exact = true;
    EXPECT_THAT(capture::needs_of(c), testing::Contains("depth-bias-control"));
}

}  // namespace
