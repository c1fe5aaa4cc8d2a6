// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/wire/case_bytes.hpp"

#include <bit>

#include "cases/wire/bytes.hpp"

namespace cases {

namespace {

constexpr uint32_t kMagic = 0x45434733;  // "ECG3"

using wire::Reader;
using wire::Writer;

void write(Writer& w, const Attribute& attribute) {
    w.text(attribute.name);
    w.number(attribute.interpolation);
    w.number(attribute.components);
    w.vectors(attribute.values);
    w.number(attribute.auxiliary);
    w.number(attribute.source);
    w.number(attribute.probe);
    w.real(attribute.probe_offset[0]);
    w.real(attribute.probe_offset[1]);
    w.number(attribute.probe_sample);
    w.number(attribute.texture_size[0]);
    w.number(attribute.texture_size[1]);
}

Attribute read_attribute(Reader& r) {
    Attribute a;
    a.name = r.text();
    a.interpolation = r.enumerator(Interpolation::flat);
    a.components = r.number<uint32_t>();
    a.values = r.vectors();
    a.auxiliary = r.enumerator(Auxiliary::sample);
    a.source = r.enumerator(Source::sample_position);
    a.probe = r.enumerator(Probe::lod);
    a.probe_offset[0] = r.real();
    a.probe_offset[1] = r.real();
    a.probe_sample = r.number<uint32_t>();
    a.texture_size[0] = r.number<uint32_t>();
    a.texture_size[1] = r.number<uint32_t>();
    return a;
}

void write(Writer& w, const DepthState& depth) {
    w.number(depth.compare);
    w.flag(depth.write);
    w.flag(depth.bias.has_value());
    if (depth.bias) {
        w.real(depth.bias->constant);
        w.real(depth.bias->clamp);
        w.real(depth.bias->slope);
        w.number(depth.bias->representation);
        w.flag(depth.bias->is_exact);
    }
    w.flag(depth.clamp);
    w.flag(depth.clip.has_value());
    w.flag(depth.clip.value_or(false));
    w.flag(depth.negative_one_to_one);
}

DepthState read_depth(Reader& r) {
    DepthState depth;
    depth.compare = r.enumerator(CompareOp::always);
    depth.write = r.flag();
    if (r.flag()) {
        depth.bias.emplace();
        depth.bias->constant = r.real();
        depth.bias->clamp = r.real();
        depth.bias->slope = r.real();
        depth.bias->representation = r.enumerator(DepthBiasRepresentation::floating);
        depth.bias->is_exact = r.flag();
    }
    depth.clamp = r.flag();
    const bool has_clip = r.flag();
    const bool clip = r.flag();
    if (has_clip) {
        depth.clip = clip;
    }
    depth.negative_one_to_one = r.flag();
    return depth;
}

void write(Writer& w, const BlendEquation& equation) {
    w.number(equation.source);
    w.number(equation.destination);
    w.number(equation.op);
}

BlendEquation read_equation(Reader& r) {
    BlendEquation equation;
    equation.source = r.enumerator(BlendFactor::src_alpha_saturate);
    equation.destination = r.enumerator(BlendFactor::src_alpha_saturate);
    equation.op = r.enumerator(BlendOp::max);
    return equation;
}

void write(Writer& w, const ColorOutput& color) {
    w.vector(color.value);
    w.number(color.attribute);
    w.flag(color.blend.has_value());
    if (color.blend) {
        write(w, color.blend->color);
        write(w, color.blend->alpha);
        w.vector(color.blend->constants);
    }
    w.number(color.write_mask);
}

ColorOutput read_color(Reader& r) {
    ColorOutput color;
    color.value = r.vector();
    color.attribute = r.number<int32_t>();
    if (r.flag()) {
        color.blend.emplace();
        color.blend->color = read_equation(r);
        color.blend->alpha = read_equation(r);
        color.blend->constants = r.vector();
    }
    color.write_mask = r.number<uint8_t>();
    return color;
}

void write(Writer& w, const Blit& blit) {
    w.number(blit.source_format);
    w.number(blit.source_width);
    w.number(blit.source_height);
    w.number(blit.pattern);
    w.number(blit.seed);
    w.number(blit.filter);
    for (const Corners& corners : {blit.source, blit.destination}) {
        for (const int32_t coordinate : {corners.x0, corners.y0, corners.x1, corners.y1}) {
            w.number(coordinate);
        }
    }
}

Blit read_blit(Reader& r) {
    Blit blit;
    blit.source_format = r.enumerator(kLastColorFormat);
    blit.source_width = r.number<uint32_t>();
    blit.source_height = r.number<uint32_t>();
    if (blit.source_width > kMaxTargetSize || blit.source_height > kMaxTargetSize) {
        r.fail();
    }
    blit.pattern = r.enumerator(BlitPattern::ramp);
    blit.seed = r.number<uint32_t>();
    blit.filter = r.enumerator(BlitFilter::linear);
    for (Corners* corners : {&blit.source, &blit.destination}) {
        for (int32_t* coordinate : {&corners->x0, &corners->y0, &corners->x1, &corners->y1}) {
            *coordinate = r.number<int32_t>();
        }
    }
    return blit;
}

void write(Writer& w, const Target& target) {
    w.number(target.width);
    w.number(target.height);
    w.number(target.samples);
    w.number(target.layers);
    w.number(target.depth_format);
    w.number(static_cast<uint64_t>(target.sample_locations.size()));
    for (const std::array<uint8_t, 2>& location : target.sample_locations) {
        w.number(location[0]);
        w.number(location[1]);
    }
    w.flag(target.color.has_value());
    if (target.color) {
        w.number(target.color->format);
        w.vector(target.color->clear);
    }
    w.flag(target.has_instruments);
    w.flag(target.has_depth);
    w.real(target.depth_clear);
    w.number(target.color_resolve);
    w.number(target.depth_resolve);
    w.flag(target.has_stencil);
}

Target read_target(Reader& r) {
    Target target;
    target.width = r.number<uint32_t>();
    target.height = r.number<uint32_t>();
    target.samples = r.number<uint32_t>();
    target.layers = r.number<uint32_t>();
    target.depth_format = r.enumerator(DepthFormat::d16_unorm);
    target.sample_locations.resize(r.count(2));
    for (std::array<uint8_t, 2>& location : target.sample_locations) {
        location[0] = r.number<uint8_t>();
        location[1] = r.number<uint8_t>();
    }
    if (r.flag()) {
        target.color.emplace();
        target.color->format = r.enumerator(kLastColorFormat);
        target.color->clear = r.vector();
    }
    target.has_instruments = r.flag();
    target.has_depth = r.flag();
    target.depth_clear = r.real();
    target.color_resolve = r.enumerator(Resolve::max);
    target.depth_resolve = r.enumerator(Resolve::max);
    target.has_stencil = r.flag();
    return target;
}

void write(Writer& w, const Draw& draw) {
    w.number(draw.topology);
    w.vectors(draw.positions);
    w.flag(draw.indices.has_value());
    if (draw.indices) {
        w.number(static_cast<uint64_t>(draw.indices->size()));
        for (const uint32_t index : *draw.indices) {
            w.number(index);
        }
    }
    w.flag(draw.primitive_restart);
    w.number(static_cast<uint64_t>(draw.attributes.size()));
    for (const Attribute& attribute : draw.attributes) {
        write(w, attribute);
    }
    for (const float f : {draw.viewport.x, draw.viewport.y, draw.viewport.width,
                          draw.viewport.height, draw.viewport.min_depth, draw.viewport.max_depth}) {
        w.number(std::bit_cast<uint32_t>(f));
    }
    w.number(draw.scissor.x);
    w.number(draw.scissor.y);
    w.number(draw.scissor.width);
    w.number(draw.scissor.height);
    w.number(draw.cull);
    w.number(draw.front_face);
    w.number(draw.provoking);
    write(w, draw.depth);
    w.number(draw.distances.clip_count);
    w.number(draw.distances.cull_count);
    w.vectors(draw.distances.clip);
    w.vectors(draw.distances.cull);
    w.number(draw.multisample.sample_mask);
    w.flag(draw.multisample.shader_mask.has_value());
    w.number(draw.multisample.shader_mask.value_or(0));
    w.flag(draw.multisample.min_sample_shading.has_value());
    w.real(draw.multisample.min_sample_shading.value_or(0));
    write(w, draw.color);
    w.number(draw.layer);
    w.number(draw.viewport_index);
}

Draw read_draw(Reader& r) {
    Draw draw;
    draw.topology = r.enumerator(Topology::triangle_fan);
    draw.positions = r.vectors();
    if (r.flag()) {
        draw.indices.emplace(r.count(sizeof(uint32_t)));
        for (uint32_t& index : *draw.indices) {
            index = r.number<uint32_t>();
        }
    }
    draw.primitive_restart = r.flag();
    draw.attributes.resize(r.count(1));
    for (Attribute& attribute : draw.attributes) {
        attribute = read_attribute(r);
        if (!r.good()) {
            break;
        }
    }
    for (float* f : {&draw.viewport.x, &draw.viewport.y, &draw.viewport.width,
                     &draw.viewport.height, &draw.viewport.min_depth, &draw.viewport.max_depth}) {
        *f = std::bit_cast<float>(r.number<uint32_t>());
    }
    draw.scissor.x = r.number<int32_t>();
    draw.scissor.y = r.number<int32_t>();
    draw.scissor.width = r.number<uint32_t>();
    draw.scissor.height = r.number<uint32_t>();
    draw.cull = r.enumerator(CullMode::front_and_back);
    draw.front_face = r.enumerator(FrontFace::clockwise);
    draw.provoking = r.enumerator(ProvokingVertex::last);
    draw.depth = read_depth(r);
    draw.distances.clip_count = r.number<uint32_t>();
    draw.distances.cull_count = r.number<uint32_t>();
    draw.distances.clip = r.vectors();
    draw.distances.cull = r.vectors();
    draw.multisample.sample_mask = r.number<uint32_t>();
    const bool has_shader_mask = r.flag();
    const auto shader_mask = r.number<uint32_t>();
    if (has_shader_mask) {
        draw.multisample.shader_mask = shader_mask;
    }
    const bool has_sample_shading = r.flag();
    const float min_sample_shading = r.real();
    if (has_sample_shading) {
        draw.multisample.min_sample_shading = min_sample_shading;
    }
    draw.color = read_color(r);
    draw.layer = r.number<uint32_t>();
    draw.viewport_index = r.number<uint32_t>();
    return draw;
}

}  // namespace

std::string to_bytes(const Case& c) {
    Writer w;
    w.number(kMagic);
    w.text(c.id);
    write(w, c.target);
    w.number(static_cast<uint64_t>(c.draws.size()));
    for (const Draw& draw : c.draws) {
        write(w, draw);
    }
    w.number(static_cast<uint64_t>(c.relations.size()));
    for (const Relation& relation : c.relations) {
        w.number(relation.kind);
        w.number(relation.tile[0]);
        w.number(relation.tile[1]);
    }
    w.flag(c.blit.has_value());
    if (c.blit) {
        write(w, *c.blit);
    }
    return w.take();
}

Expected<Case> from_bytes(std::span<const char> bytes) {
    Reader r(bytes);
    if (r.number<uint32_t>() != kMagic) {
        return tl::unexpected(Error{{}, "these bytes are not a case of this program"});
    }
    Case c;
    c.id = r.text();
    c.target = read_target(r);
    const size_t draws = r.count(1);
    for (size_t i = 0; i < draws && r.good(); ++i) {
        c.draws.push_back(read_draw(r));
    }
    c.relations.resize(r.count(1 + 2 * sizeof(uint32_t)));
    for (Relation& relation : c.relations) {
        relation.kind = r.enumerator(kLastRelationKind);
        relation.tile = {r.number<uint32_t>(), r.number<uint32_t>()};
        if (relation.tile[0] > kMaxTargetSize || relation.tile[1] > kMaxTargetSize) {
            r.fail();
        }
    }
    if (r.flag()) {
        c.blit = read_blit(r);
    }
    if (!r.good()) {
        return tl::unexpected(Error{{}, "the bytes of a case are cut short or damaged"});
    }
    if (!r.at_end()) {
        return tl::unexpected(Error{{}, "more bytes follow than the case has"});
    }
    return c;
}

std::string target_to_bytes(const Target& target) {
    Writer w;
    write(w, target);
    return w.take();
}

Expected<Target> target_from_bytes(std::span<const char> bytes) {
    Reader r(bytes);
    Target target = read_target(r);
    if (!r.good() || !r.at_end()) {
        return tl::unexpected(Error{{}, "these bytes are not a target of this program"});
    }
    return target;
}

}  // namespace cases
