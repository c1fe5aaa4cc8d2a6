// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/attribute_probe.hpp"

#include <fmt/format.h>

#include "cases/model/words.hpp"

namespace cases {

namespace {

uint32_t components_of(Source source) {
    switch (source) {
        case Source::barycentric:
            return 3;
        case Source::sample_position:
            return 2;
        case Source::vertex:
        case Source::sample_mask_in:
        case Source::sample_id:
        case Source::shading_rate:
            break;
    }
    return 1;
}

bool read_offset(LeafContext& context, const TomlValue& value, Attribute& attribute) {
    const std::optional<std::vector<Number>> numbers = context.numbers(value, "offset", 2);
    if (!numbers) {
        return false;
    }
    for (size_t i = 0; i < 2; ++i) {
        const SourceLocation& where = value.array[i].where;
        const std::optional<float> offset = context.binary32((*numbers)[i], where, "offset");
        if (!offset) {
            return false;
        }
        if (*offset < kMinProbeOffset || *offset > kMaxProbeOffset) {
            context.error(where,
                          fmt::format("the offset {} lies outside of {} to {}, which is what "
                                      "every device has; write a smaller one",
                                      *offset, kMinProbeOffset, kMaxProbeOffset));
            return false;
        }
        attribute.probe_offset[i] = *offset;
    }
    return true;
}

bool read_texture(LeafContext& context, const TomlValue& value, Attribute& attribute) {
    if (!context.array_of(value, "texture", 2, "[width, height]")) {
        return false;
    }
    for (size_t i = 0; i < 2; ++i) {
        const std::optional<int64_t> side =
            context.integer(value.array[i], "texture", 1, kMaxTextureSide);
        if (!side) {
            return false;
        }
        attribute.texture_size[i] = static_cast<uint32_t>(*side);
    }
    return true;
}

// A key that goes with one probe: there if and only if that is the probe.
bool belongs(LeafContext& context, const TomlValue& table, const char* key, bool is_wanted,
             Probe probe) {
    const TomlValue* value = table.find(key);
    const std::string_view word = word_of(probe);
    if (is_wanted && value == nullptr) {
        context.error(table.where, fmt::format("probe = \"{}\" needs the key {}", word, key));
        return false;
    }
    if (!is_wanted && value != nullptr) {
        context.error(value->where, fmt::format("{} goes with probe = \"{}\" only", key, word));
        return false;
    }
    return true;
}

}  // namespace

bool read_source(LeafContext& context, const TomlValue& table, const Target& target,
                 Attribute& attribute) {
    const TomlValue* value = table.find("source");
    if (attribute.source == Source::vertex) {
        return true;
    }
    if (attribute.source == Source::sample_position && !target.sample_locations.empty()) {
        context.error(value->where,
                      "gl_SamplePosition has no value in a target with sample_locations; write "
                      "source = \"sample-id\", or leave sample_locations out");
        return false;
    }
    attribute.components = components_of(attribute.source);
    for (const std::string_view key :
         {"values", "constant", "plane", "from", "seed", "components", "probe"}) {
        if (const TomlValue* other = table.find(key)) {
            context.error(other->where, fmt::format("{} goes with source = \"vertex\" only", key));
            return false;
        }
    }
    const bool is_barycentric = attribute.source == Source::barycentric;
    for (const std::string_view key : {"interpolation", "auxiliary"}) {
        if (const TomlValue* other = table.find(key); other != nullptr && !is_barycentric) {
            context.error(
                other->where,
                fmt::format("{} goes with source = \"vertex\" or \"barycentric\" only", key));
            return false;
        }
    }
    if (attribute.interpolation == Interpolation::flat) {
        context.error(value->where,
                      "source = \"barycentric\" is smooth or noperspective, never flat");
        return false;
    }
    return true;
}

bool read_probe(LeafContext& context, const TomlValue& table, uint32_t samples,
                Attribute& attribute) {
    const bool is_flat = attribute.interpolation == Interpolation::flat;
    const auto goes_with_flat = [&](const char* key, bool is_usual) {
        if (is_flat && !is_usual) {
            context.error(
                table.find(key)->where,
                fmt::format("a flat attribute is the same everywhere; leave {} out", key));
        }
        return !is_flat || is_usual;
    };
    if (!goes_with_flat("auxiliary", attribute.auxiliary == Auxiliary::none) ||
        !goes_with_flat("probe", attribute.probe == Probe::value)) {
        return false;
    }
    const Probe probe = attribute.probe;
    if (!belongs(context, table, "offset", probe == Probe::at_offset, Probe::at_offset) ||
        !belongs(context, table, "sample", probe == Probe::at_sample, Probe::at_sample) ||
        !belongs(context, table, "texture", probe == Probe::lod, Probe::lod)) {
        return false;
    }
    if (probe == Probe::at_offset && !read_offset(context, *table.find("offset"), attribute)) {
        return false;
    }
    if (!context.read(table, kAttributeKeys, "sample", attribute.probe_sample,
                      int64_t{samples} - 1)) {
        return false;
    }
    if (probe == Probe::lod) {
        if (attribute.components != 2) {
            context.error(table.where,
                          fmt::format("probe = \"query-lod\" looks up coordinates of 2 "
                                      "components; the attribute has {}",
                                      attribute.components));
            return false;
        }
        return read_texture(context, *table.find("texture"), attribute);
    }
    return true;
}

void check_shared_inputs(LeafContext& context, const std::vector<Attribute>& attributes,
                         const std::vector<SourceLocation>& where) {
    for (size_t i = 0; i < attributes.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            const Attribute& a = attributes[k];
            const Attribute& b = attributes[i];
            if (a.probe == Probe::lod && b.probe == Probe::lod &&
                a.texture_size != b.texture_size) {
                context.error(where[i],
                              "two attributes of one draw look up different textures; write the "
                              "same size or put them into two draws");
            }
            if (a.source == Source::barycentric && b.source == Source::barycentric &&
                a.interpolation == b.interpolation && a.auxiliary != b.auxiliary) {
                context.error(where[i],
                              "two attributes of one draw place the same barycentric input "
                              "differently; write the same auxiliary or put them into two draws");
            }
        }
    }
}

}  // namespace cases
