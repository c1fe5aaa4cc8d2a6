// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cases/load/parts.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/words.hpp"

namespace cases {

namespace {

constexpr uint64_t kMaxTiles = 4096;

// What is written as a word; scissor tiles are a table.
constexpr std::array<RelationKind, 5> kPlainKinds = {
    RelationKind::same_twice, RelationKind::other_clears, RelationKind::write_masks,
    RelationKind::fewer_attributes, RelationKind::more_attributes};
constexpr WordList<kPlainKinds.size()> kPlainWords = [] {
    WordList<kPlainKinds.size()> words{};
    for (size_t k = 0; k < words.size(); ++k) {
        words[k] = word_of(kPlainKinds[k]);
    }
    return words;
}();

bool shades_samples(const Draw& draw) {
    return draw.multisample.min_sample_shading.has_value() ||
           std::ranges::any_of(draw.attributes, [](const Attribute& a) {
               return a.auxiliary == Auxiliary::sample || a.source == Source::sample_id ||
                      a.source == Source::sample_position;
           });
}

// Why the relation says nothing about this case; empty if it does.
std::string objection(const Relation& relation, const Case& c) {
    const auto any_draw = [&](auto&& has) { return std::ranges::any_of(c.draws, has); };
    const uint32_t attributes = attributes_of(c);
    if (relation.kind != RelationKind::same_twice && relation.kind != RelationKind::door &&
        (c.target.has_operations() ||
         any_draw([](const Draw& draw) { return draw.clear.has_value(); }))) {
        return "does not go with a clear among the draws, nor with load and store operations; "
               "leave it out";
    }
    if (c.target.has_unknown_contents()) {
        return "does not go with contents that are not loaded, since each rendering may have other "
               "ones; leave it out";
    }
    switch (relation.kind) {
        case RelationKind::same_twice:
            return {};
        case RelationKind::door:
            return can_take(relation.door, c)
                       ? std::string()
                       : fmt::format("does not suit the case: it takes {}; leave it out",
                                     row_of(relation.door).takes);
        case RelationKind::scissor_tiles:
            if (const uint64_t tiles = tile_count(c.target, relation); tiles > kMaxTiles) {
                return fmt::format("has {} tiles, at most {} are drawn; make them larger", tiles,
                                   kMaxTiles);
            }
            if (any_draw([&](const Draw& draw) {
                    return relation.tile[0] % draw.fragment_size[0] != 0 ||
                           relation.tile[1] % draw.fragment_size[1] != 0;
                })) {
                return "has tiles that cut fragments; make their sides multiples of fragment_size";
            }
            return {};
        case RelationKind::other_clears:
        case RelationKind::write_masks:
            return c.target.has_instruments
                       ? std::string()
                       : "needs the attachments that count hits; leave out attachments = ...";
        case RelationKind::fewer_attributes:
            if (attributes == 0) {
                return "has no attribute to leave out; add a [[draw.attribute]]";
            }
            if (any_draw(shades_samples)) {
                return "would turn sample shading off; leave it out";
            }
            break;
        case RelationKind::more_attributes:
            if (attributes == 0 || attributes == kMaxAttributes) {
                return fmt::format("needs 1 to {} attributes to copy, not {}", kMaxAttributes - 1,
                                   attributes);
            }
            if (any_draw([&](const Draw& d) { return d.attributes.size() != attributes; })) {
                return "needs the same number of attributes in every draw";
            }
            break;
    }
    if (!c.target.has_instruments) {
        return "needs the attachments that attributes are written to; leave out attachments = ...";
    }
    if (any_draw([&c](const Draw& draw) { return !drawn_attributes(c.target, draw).empty(); })) {
        return "does not go with a colour that is an attribute, nor with a discard by one; leave "
               "it "
               "out";
    }
    return {};
}

// What `{ doors = [...] }` lists, one relation a door.
std::vector<Relation> load_doors(LeafContext& context, const TomlValue& value) {
    std::vector<std::string_view> words;
    for (const DoorRow& row : all_doors()) {
        words.push_back(row.word);
    }
    std::vector<Relation> doors;
    if (!context.array(value, "doors")) {
        return doors;
    }
    for (const TomlValue& element : value.array) {
        if (const std::optional<size_t> word = context.word(element, "a door", words)) {
            doors.push_back({RelationKind::door, {}, all_doors()[*word].door});
        }
    }
    if (value.array.empty()) {
        context.error(value.where, "doors is empty; write one at least, as \"index-16\"");
    }
    return doors;
}

// Adds a relation that the case can have, once.
void add(LeafContext& context, const TomlValue& element, const Relation& relation, const Case& c,
         std::vector<Relation>& relations) {
    const std::string name = relation.kind == RelationKind::door
                                 ? fmt::format("door {}", row_of(relation.door).word)
                                 : fmt::format("relation {}", to_string(relation.kind));
    if (std::ranges::find(relations, relation) != relations.end()) {
        context.error(element.where, fmt::format("the {} stands twice", name));
    } else if (const std::string why = objection(relation, c); !why.empty()) {
        context.error(element.where, fmt::format("the {} {}", name, why));
    } else {
        relations.push_back(relation);
    }
}

}  // namespace

std::vector<Relation> load_relations(LeafContext& context, const TomlValue& value, const Case& c) {
    std::vector<Relation> relations;
    if (!context.array(value, "relations")) {
        return relations;
    }
    for (const TomlValue& element : value.array) {
        Relation relation;
        std::vector<Relation> found;
        if (!element.is(TomlValue::Kind::table)) {
            if (const auto word = context.word(element, "a relation", kPlainWords)) {
                relation.kind = kPlainKinds[*word];
                found = {relation};
            }
        } else if (context.known_keys(element, kRelationKeys);
                   const TomlValue* doors = element.find("doors")) {
            found = load_doors(context, *doors);
        } else if (const TomlValue* tile = element.find("scissor-tiles");
                   tile != nullptr &&
                   context.array_of(*tile, "scissor-tiles", 2, "[width, height]")) {
            relation.kind = RelationKind::scissor_tiles;
            for (size_t k = 0; k < 2; ++k) {
                relation.tile[k] = static_cast<uint32_t>(
                    context.integer(tile->array[k], "a tile's side", 1, kMaxTargetSize)
                        .value_or(1));
            }
            found = {relation};
        }
        if (!context.errors().empty()) {
            continue;
        }
        for (const Relation& one : found) {
            add(context, element, one, c, relations);
        }
    }
    return relations;
}

}  // namespace cases
