// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/derive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"

namespace cases {

namespace {

std::string_view rule_of(const Relation& relation) {
    switch (relation.kind) {
        case RelationKind::same_twice:
            return rule::repeat_same;
        case RelationKind::scissor_tiles:
            return rule::repeat_scissor;
        case RelationKind::other_clears:
            return rule::repeat_clears;
        case RelationKind::write_masks:
            return rule::repeat_write_masks;
        case RelationKind::door:
            return row_of(relation.door).rule;
        case RelationKind::fewer_attributes:
        case RelationKind::more_attributes:
            break;
    }
    return rule::repeat_attachments;
}

// Depth writes of the case decide nothing else, so they may be left out; and depth is cleared as
// usual, in a format that holds the other clear value.
bool depth_is_only_written(const Case& c) {
    const bool is_usual = c.target.depth_format == DepthFormat::d32_float &&
                          c.target.depth_clear >= kDepthClear &&
                          c.target.depth_clear <= kDepthClear;
    return is_usual && std::ranges::all_of(c.draws, [](const Draw& draw) {
               return draw.depth.compare == CompareOp::always && !draw.depth.bounds;
           });
}

// Those of the file, then the doors that a run asks for besides.
std::vector<Relation> all_relations(const Case& c) {
    std::vector<Relation> all = c.relations;
    for (const Door door : c.doors) {
        const Relation relation{RelationKind::door, {}, door};
        if (std::ranges::find(all, relation) == all.end()) {
            all.push_back(relation);
        }
    }
    return all;
}

void drop_attributes(Case& c) {
    for (Draw& draw : c.draws) {
        draw.attributes.clear();
    }
}

void copy_attributes(Case& c) {
    for (Draw& draw : c.draws) {
        const size_t count = draw.attributes.size();
        for (size_t k = 0; k < count && draw.attributes.size() < kMaxAttributes; ++k) {
            Attribute copy = draw.attributes[k];
            copy.name += " again";
            draw.attributes.push_back(std::move(copy));
        }
    }
}

}  // namespace

std::string_view to_string(RelationKind kind) {
    return word_of(kind);
}

uint64_t tile_count(const Target& target, const Relation& relation) {
    const auto along = [](uint64_t size, uint64_t tile) {
        return tile == 0 ? 1 : (size + tile - 1) / tile;
    };
    return along(target.width, relation.tile[0]) * along(target.height, relation.tile[1]);
}

bool takes_depth_beside_stencil(const Target& target, DepthFormat beside_stencil) {
    return target.has_depth && target.has_stencil && !target.names_depth &&
           target.depth_format == DepthFormat::d32_float && target.depth_format != beside_stencil;
}

Draw clear_draw(const Target& target, Clear clear, uint32_t layer) {
    Draw out;
    out.positions = {{-1, -1, 0.5, 1}, {-1, 3, 0.5, 1}, {3, -1, 0.5, 1}};
    out.viewport.width = static_cast<float>(target.width);
    out.viewport.height = static_cast<float>(target.height);
    out.scissor = {0, 0, target.width, target.height};
    out.layer = layer;
    out.depth.write = clear.depth.has_value();
    if (clear.depth) {
        out.frag_depth.emplace().value = *clear.depth;
    }
    const StencilFace face{.pass = clear.stencil ? StencilOp::replace : StencilOp::keep,
                           .reference = clear.stencil.value_or(0)};
    out.stencil = {face, face};
    out.color.value = clear.color.value_or(glm::vec4(0));
    out.color.write_mask = clear.color ? 0xf : 0;
    out.other_colors.resize(target.other_colors.size());
    out.clear = std::move(clear);
    return out;
}

uint32_t attributes_of(const Case& c) {
    size_t count = 0;
    for (const Draw& draw : c.draws) {
        count = std::max(count, draw.attributes.size());
    }
    return static_cast<uint32_t>(count);
}

bool has_two_numbers(const Attribute& a) {
    switch (a.source) {
        case Source::barycentric:
            return false;
        case Source::sample_position:
        case Source::sample_mask_in:
        case Source::sample_id:
        case Source::shading_rate:
            return true;
        case Source::vertex:
            break;
    }
    return a.probe == Probe::lod || std::ranges::all_of(a.values, [](const glm::vec4& value) {
               return std::bit_cast<uint32_t>(value.z) == 0 &&
                      std::bit_cast<uint32_t>(value.w) == 0;
           });
}

const ColorOutput& output_at(const Target& target, const Draw& draw, uint32_t location) {
    return location == target.judged_color
               ? draw.color
               : draw.other_colors.at(location - (location > target.judged_color ? 1U : 0U));
}

glm::vec4 blend_constants(const Draw& draw) {
    if (draw.color.blend) {
        return draw.color.blend->constants;
    }
    const auto blended = std::ranges::find_if(
        draw.other_colors, [](const ColorOutput& o) { return o.blend.has_value(); });
    return blended == draw.other_colors.end() ? glm::vec4(0) : blended->blend->constants;
}

std::vector<uint32_t> drawn_attributes(const Target& target, const Draw& draw) {
    std::vector<uint32_t> out;
    for (uint32_t location = 0; location < target.color_count(); ++location) {
        const int32_t attribute = output_at(target, draw, location).attribute;
        if (attribute >= 0 && std::ranges::find(out, attribute) == out.end()) {
            out.push_back(static_cast<uint32_t>(attribute));
        }
    }
    if (is_texture(draw.color.from) && draw.color.attribute < 0) {
        out.push_back(0);
    }
    const auto discards = static_cast<int32_t>(draw.discard_attribute);
    if (discards_by_value(draw) && std::ranges::find(out, discards) == out.end()) {
        out.push_back(draw.discard_attribute);
    }
    return out;
}

std::vector<Derivation> derivations(const Case& c) {
    std::vector<Derivation> result;
    for (const Relation& relation : all_relations(c)) {
        Derivation d;
        d.name = to_string(relation.kind);
        d.rule = rule_of(relation);
        d.kind = relation.kind;
        switch (relation.kind) {
            case RelationKind::same_twice:
                result.push_back(d);
                d.name += ", later";
                d.variation.later = true;
                break;
            case RelationKind::scissor_tiles:
                d.name += fmt::format(" {}x{}", relation.tile[0], relation.tile[1]);
                d.variation.tile = relation.tile;
                break;
            case RelationKind::other_clears:
                d.variation.other_clears = true;
                d.variation.other_depth_clear = depth_is_only_written(c);
                break;
            case RelationKind::write_masks:
                // Every attachment is written in one of the two.
                d.variation.masked = 0x55;
                d.name = "write-masks, every other attachment";
                result.push_back(d);
                d.variation.masked = 0xaa;
                d.variation.masks_depth = depth_is_only_written(c);
                d.name = "write-masks, the others";
                break;
            case RelationKind::door:
                d.name = fmt::format("door {}", row_of(relation.door).word);
                d.variation.door = relation.door;
                // A count that a driver keeps too long shall not fall on the other doors.
                d.variation.later = relation.door == Door::indirect_count ||
                                    relation.door == Door::indirect_after_count;
                for (const Draw& draw : c.draws) {
                    d.variation.splits.push_back(split_of(relation.door, draw));
                }
                break;
            case RelationKind::fewer_attributes:
            case RelationKind::more_attributes:
                break;
        }
        result.push_back(std::move(d));
    }
    return result;
}

bool claims_doors_alone(const Case& c) {
    return std::ranges::all_of(c.claim.rules,
                               [](const std::string& rule) { return rule.starts_with("door."); });
}

Case derive(const Case& c, const Derivation& derivation) {
    Case derived = c;
    derived.relations.clear();
    derived.doors.clear();
    derived.claim.expected_hits.reset();
    derived.variation = derivation.variation;
    if (derivation.kind == RelationKind::fewer_attributes) {
        drop_attributes(derived);
    } else if (derivation.kind == RelationKind::more_attributes) {
        copy_attributes(derived);
    }
    return derived;
}

}  // namespace cases
