// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/vertex_way.hpp"

#include <algorithm>
#include <cstring>

#include "cases/model/instances.hpp"
#include "vk_harness/device/clip_support.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

namespace {

bool is_constant(const std::vector<glm::vec4>& values) {
    return std::ranges::all_of(values, [&values](const glm::vec4& value) {
        return std::memcmp(&value, &values.front(), sizeof value) == 0;
    });
}

// The bindings whose numbers are the same at every vertex.
uint32_t constant_bindings(const cases::Case& c, const cases::Draw& draw) {
    uint32_t bits = 0;
    for (uint32_t k = 0; k < input_count(c); ++k) {
        const cases::Attribute* attribute = input_attribute(c, draw, k);
        // An input without values is filled with one number, write_vertices().
        if (attribute == nullptr || is_constant(attribute->values)) {
            bits |= 1U << (1 + k);
        }
    }
    if (draw.distances.clip_count > 0 && is_constant(draw.distances.clip)) {
        bits |= 1U << kClipBinding;
    }
    if (draw.distances.cull_count > 0 && is_constant(draw.distances.cull)) {
        bits |= 1U << kCullBinding;
    }
    return bits;
}

// The numbers of different bindings and draws lie in different formats, where there are several.
void choose_formats(const cases::Case& c, const cases::Draw& draw, uint32_t offered,
                    VertexWay& way) {
    const std::vector<glm::vec4> positions = cases::base_positions(draw);
    const size_t salt = positions.size() / 3;
    const auto choose = [&](uint32_t binding, std::span<const glm::vec4> values) {
        way.formats.at(binding) = cases::other_vertex_format(values, offered, salt + binding);
    };
    choose(0, positions);
    for (uint32_t k = 0; k < input_count(c); ++k) {
        const cases::Attribute* attribute = input_attribute(c, draw, k);
        if (attribute != nullptr && attribute->source == cases::Source::vertex) {
            choose(1 + k, attribute->values);
        }
    }
    choose(kClipBinding, draw.distances.clip);
    choose(kCullBinding, draw.distances.cull);
    choose(kOffsetBinding, draw.offsets);
}

}  // namespace

VertexWay vertex_way(const cases::Case& c, const cases::Draw& draw, uint32_t formats) {
    VertexWay way;
    switch (c.variation.door) {
        case cases::Door::stride_padded:
            way.padded = true;
            break;
        case cases::Door::stride_dynamic:
            way.padded = true;
            way.dynamic_stride = true;
            break;
        case cases::Door::interleaved:
        case cases::Door::transform_feedback:
            way.interleaved = true;
            break;
        case cases::Door::vertices_pulled:
        case cases::Door::mesh_shader:
            way.pulled = true;
            break;
        case cases::Door::three_components:
            if (cases::holds(cases::VertexFormat::rgb32_float, cases::base_positions(draw))) {
                way.formats[0] = cases::VertexFormat::rgb32_float;
            }
            break;
        case cases::Door::half_floats:
            if (cases::holds(cases::VertexFormat::rgba16_float, cases::base_positions(draw))) {
                way.formats[0] = cases::VertexFormat::rgba16_float;
            }
            break;
        case cases::Door::exact_formats:
            choose_formats(c, draw, formats, way);
            break;
        case cases::Door::instance_divisor:
            way.instance_rate = constant_bindings(c, draw);
            way.divisors.fill(3);
            break;
        case cases::Door::instance_divisor_zero:
            way.instance_rate = constant_bindings(c, draw);
            way.divisors.fill(0);
            break;
        case cases::Door::instance_rate:
            way.instance_rate = constant_bindings(c, draw);
            break;
        default:
            break;
    }
    if (way.instance_rate != 0 && way.divisors.front() != 1) {
        way.instances = shaders::Instances::shown;
    }
    if (cases::is_instanced(draw)) {
        way.instances = shaders::Instances::placed;
        way.instance_rate = 1U << kOffsetBinding;
        for (uint32_t k = 0; k < input_count(c); ++k) {
            const cases::Attribute* attribute = input_attribute(c, draw, k);
            if (attribute != nullptr && attribute->divisor) {
                way.instance_rate |= 1U << (1 + k);
                way.divisors.at(1 + k) = *attribute->divisor;
            }
        }
    }
    return way;
}

bool adds_restarts(cases::Door door, const cases::Draw& draw) {
    return door == cases::Door::restart_extra && draw.topology != cases::Topology::triangle_list;
}

uint32_t size_of(const VertexWay& way, uint32_t binding) {
    return cases::bytes_of(way.formats.at(binding));
}

uint32_t stride_of(const VertexWay& way, uint32_t binding) {
    return size_of(way, binding) + (way.padded ? 12 + 4 * binding : 0);
}

Bindings bindings_of(uint32_t attribute_count, uint32_t clip_count, uint32_t cull_count,
                     bool has_offsets) {
    Bindings out;
    for (uint32_t binding = 0; binding <= attribute_count; ++binding) {
        out.numbers[out.count++] = binding;
    }
    if (clip_count > 0) {
        out.numbers[out.count++] = kClipBinding;
    }
    if (cull_count > 0) {
        out.numbers[out.count++] = kCullBinding;
    }
    if (has_offsets) {
        out.numbers[out.count++] = kOffsetBinding;
    }
    return out;
}

}  // namespace vk_harness
