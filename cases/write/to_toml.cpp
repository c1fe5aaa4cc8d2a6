// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/to_toml.hpp"

#include "cases/load/loader.hpp"
#include "cases/model/words.hpp"
#include "cases/toml/toml_text.hpp"
#include "cases/wire/case_bytes.hpp"
#include "cases/write/draw_tree.hpp"
#include "cases/write/table_tree.hpp"

namespace cases {

namespace {

TomlValue strings(const std::vector<std::string>& texts) {
    std::vector<TomlValue> items;
    for (const std::string& text : texts) {
        items.push_back(tree::text(text));
    }
    return tree::list(std::move(items));
}

TomlValue relations_tree(const std::vector<Relation>& relations) {
    std::vector<TomlValue> items;
    for (const Relation& relation : relations) {
        TomlValue arguments;
        switch (relation.kind) {
            case RelationKind::scissor_tiles:
                arguments = whole_numbers({relation.tile[0], relation.tile[1]});
                break;
            case RelationKind::door:
                arguments = strings({std::string(row_of(relation.door).word)});
                break;
            default:
                items.push_back(tree::text(word_of(relation.kind)));
                continue;
        }
        tree::set(items.emplace_back(), word_of(relation.kind), std::move(arguments));
    }
    return tree::list(std::move(items));
}

TableTree head_tree(const Case& c) {
    TableTree table(kFileKeys);
    table.add("format", tree::number(1));
    table.add("description", tree::text(c.claim.description));
    if (!c.claim.catches.empty()) {
        table.add("catches", tree::text(c.claim.catches));
    }
    table.add("rules", strings(c.claim.rules));
    if (!c.claim.links.empty()) {
        table.add("links", strings(c.claim.links));
    }
    if (!c.relations.empty()) {
        table.add("relations", relations_tree(c.relations));
    }
    return table;
}

TableTree color_target_tree(const ColorTarget& target) {
    TableTree color(kTargetColorKeys);
    color.add("format", tree::text(word_of(target.format)));
    color.add_all(target);
    if (!same_color(target.clear, ColorTarget().clear)) {
        color.add("clear", color_value(target.clear));
    }
    return color;
}

TableTree target_tree(const Target& t) {
    TableTree table(kTargetKeys);
    table.add_all(t);
    table.add("size", whole_numbers({t.width, t.height}));
    if (t.names_depth) {
        table.add("depth", tree::text(word_of(t.depth_format)));
    }
    if (!t.sample_locations.empty()) {
        std::vector<TomlValue> locations;
        for (const std::array<uint8_t, 2>& at : t.sample_locations) {
            locations.push_back(whole_numbers({at[0], at[1]}));
        }
        table.add("sample_locations", tree::list(std::move(locations)));
    }
    if (!t.has_instruments) {
        table.add("attachments", tree::text(word_of(t.attachments())));
    }
    if (!t.other_colors.empty()) {
        std::vector<TomlValue> colors;
        for (uint32_t k = 0; k < t.color_count(); ++k) {
            colors.push_back(color_target_tree(t.color_at(k)).value());
        }
        table.add("color", tree::list(std::move(colors)));
        if (t.judged_color != 0) {
            table.add("judged", tree::number(t.judged_color));
        }
    } else if (t.color) {
        table.add("color", color_target_tree(*t.color));
    }
    return table;
}

TomlValue corners_value(const Corners& c) {
    return whole_numbers({c.x0, c.y0, c.x1, c.y1});
}

TableTree blit_tree(const Blit& b, const Target& t) {
    const auto whole = [](uint32_t width, uint32_t height) {
        return Corners{0, 0, static_cast<int32_t>(width), static_cast<int32_t>(height)};
    };
    TableTree table(kBlitKeys);
    Blit usual;
    usual.source_format = t.color ? t.color->format : usual.source_format;
    table.add_all(b, usual);
    table.add("size", whole_numbers({b.source_width, b.source_height}));
    if (b.source != whole(b.source_width, b.source_height)) {
        table.add("from", corners_value(b.source));
    }
    if (b.destination != whole(t.width, t.height)) {
        table.add("to", corners_value(b.destination));
    }
    return table;
}

// One picture, or an array of them: one a sample, and one a layer.
TableTree expect_tree(const ExpectedHits& expected, const Target& t) {
    std::vector<std::string> pictures(size_t{t.samples} * t.layers);
    for (size_t j = 0; j < expected.rows.size() && j / t.height < pictures.size(); ++j) {
        pictures[j / t.height] += expected.rows[j] + "\n";
    }
    TableTree table(kExpectKeys);
    table.add("hits", pictures.size() == 1 ? tree::text(pictures[0]) : strings(pictures));
    return table;
}

std::vector<std::string> rows_of(const Case& c) {
    return c.claim.expected_hits ? c.claim.expected_hits->rows : std::vector<std::string>();
}

// Why the document does not say all that the case is; empty if it does.
std::string objection(const TomlValue& document, const Case& c) {
    const ExpectedAll<std::vector<Case>> loaded = load_tree(document, c.id);
    if (!loaded) {
        return loaded.error().front().message;
    }
    const Case& back = loaded->front();
    const bool same_words =
        back.claim.description == c.claim.description && back.claim.catches == c.claim.catches &&
        back.claim.rules == c.claim.rules && back.claim.links == c.claim.links &&
        back.variation == c.variation && rows_of(back) == rows_of(c);
    return same_words && to_bytes(back) == to_bytes(c) ? std::string()
                                                       : "it holds what no key of a case file says";
}

}  // namespace

Expected<TomlValue> to_tree(const Case& c) {
    size_t vertices = 0;
    size_t indices = 0;
    for (const Draw& draw : c.draws) {
        vertices += draw.positions.size();
        indices += draw.indices ? draw.indices->size() : 0;
    }
    if (vertices > kMaxWrittenVertices || indices > kMaxWrittenIndices) {
        return failure(
            "{} has {} vertices and {} indices; a case file is written of at most {} and {}", c.id,
            vertices, indices, kMaxWrittenVertices, kMaxWrittenIndices);
    }
    TableTree table = head_tree(c);
    table.add("target", target_tree(c.target));
    std::vector<TomlValue> draws;
    for (const Draw& draw : c.draws) {
        draws.push_back(draw_tree(draw, c.target));
    }
    if (!draws.empty()) {
        table.add("draw", tree::list(std::move(draws)));
    }
    if (c.blit) {
        table.add("blit", blit_tree(*c.blit, c.target));
    }
    if (c.claim.expected_hits) {
        table.add("expect", expect_tree(*c.claim.expected_hits, c.target));
    }
    if (const std::string why = objection(table.value(), c); !why.empty()) {
        return failure("{} cannot be written as a case file: {}", c.id, why);
    }
    return table.value();
}

Expected<std::string> to_toml(const Case& c) {
    const Expected<TomlValue> document = to_tree(c);
    return document ? Expected<std::string>(to_text(*document)) : tl::unexpected(document.error());
}

}  // namespace cases
