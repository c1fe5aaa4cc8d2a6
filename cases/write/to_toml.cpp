// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/to_toml.hpp"

#include <fmt/format.h>

#include "cases/base/float_bits.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/words.hpp"
#include "cases/wire/case_bytes.hpp"
#include "cases/write/draw_text.hpp"
#include "cases/write/toml_text.hpp"

namespace cases {

namespace {

std::string strings_text(const std::vector<std::string>& texts) {
    std::vector<std::string> items;
    for (const std::string& text : texts) {
        items.push_back(string_toml(text));
    }
    return array_toml(items, 0);
}

std::string relations_text(const std::vector<Relation>& relations) {
    std::vector<std::string> items;
    for (const Relation& relation : relations) {
        const std::string_view word = word_of(relation.kind);
        switch (relation.kind) {
            case RelationKind::scissor_tiles:
                items.push_back(
                    fmt::format("{{ {} = [{}, {}] }}", word, relation.tile[0], relation.tile[1]));
                break;
            case RelationKind::door:
                items.push_back(
                    fmt::format("{{ {} = [{}] }}", word, string_toml(row_of(relation.door).word)));
                break;
            default:
                items.push_back(string_toml(word));
        }
    }
    return array_toml(items, 0);
}

std::string head_text(const Case& c) {
    TableText table(kFileKeys);
    table.add("format", "1");
    table.add("description", string_toml(c.claim.description));
    if (!c.claim.catches.empty()) {
        table.add("catches", string_toml(c.claim.catches));
    }
    table.add("rules", strings_text(c.claim.rules));
    if (!c.claim.links.empty()) {
        table.add("links", strings_text(c.claim.links));
    }
    if (!c.relations.empty()) {
        table.add("relations", relations_text(c.relations));
    }
    return table.lines();
}

std::string locations_text(const std::vector<std::array<uint8_t, 2>>& locations) {
    std::vector<std::string> items;
    for (const std::array<uint8_t, 2>& location : locations) {
        items.push_back(fmt::format("[{}, {}]", location[0], location[1]));
    }
    return array_toml(items, 0);
}

TableText color_target_text(const ColorTarget& target) {
    TableText color(kTargetColorKeys);
    color.add("format", string_toml(word_of(target.format)));
    const std::string clear = color_text(target.clear);
    if (clear != color_text(ColorTarget().clear)) {
        color.add("clear", clear);
    }
    return color;
}

std::string target_text(const Target& t) {
    TableText table(kTargetKeys);
    table.add_all(t);
    table.add("size", fmt::format("[{}, {}]", t.width, t.height));
    if (t.names_depth) {
        table.add("depth", string_toml(word_of(t.depth_format)));
    }
    if (!t.sample_locations.empty()) {
        table.add("sample_locations", locations_text(t.sample_locations));
    }
    if (!t.has_instruments) {
        table.add("attachments", string_toml(t.has_depth ? "color+depth" : "color"));
    }
    if (!t.other_colors.empty()) {
        std::vector<std::string> colors;
        for (uint32_t k = 0; k < t.color_count(); ++k) {
            colors.push_back(color_target_text(t.color_at(k)).in_line());
        }
        table.add("color", list_toml(colors));
        if (t.judged_color != 0) {
            table.add("judged", std::to_string(t.judged_color));
        }
        return "\n[target]\n" + table.lines();
    }
    std::string out = "\n[target]\n" + table.lines();
    if (t.color) {
        out += "[target.color]\n" + color_target_text(*t.color).lines();
    }
    return out;
}

std::string corners_text(const Corners& c) {
    return fmt::format("[{}, {}, {}, {}]", c.x0, c.y0, c.x1, c.y1);
}

std::string blit_text(const Blit& b, const Target& t) {
    const auto whole = [](uint32_t width, uint32_t height) {
        return Corners{0, 0, static_cast<int32_t>(width), static_cast<int32_t>(height)};
    };
    TableText table(kBlitKeys);
    Blit usual;
    usual.source_format = t.color ? t.color->format : usual.source_format;
    table.add_all(b, usual);
    table.add("size", fmt::format("[{}, {}]", b.source_width, b.source_height));
    if (b.source != whole(b.source_width, b.source_height)) {
        table.add("from", corners_text(b.source));
    }
    if (b.destination != whole(t.width, t.height)) {
        table.add("to", corners_text(b.destination));
    }
    return "\n[blit]\n" + table.lines();
}

// One picture, or an array of them: one a sample, and one a layer.
std::string expect_text(const ExpectedHits& expected, const Target& t) {
    const size_t pictures = size_t{t.samples} * t.layers;
    std::string out = pictures == 1 ? "\n[expect]\nhits = " : "\n[expect]\nhits = [\n";
    for (size_t p = 0; p < pictures; ++p) {
        out += "\"\"\"\n";
        for (size_t j = p * t.height; j < (p + 1) * t.height && j < expected.rows.size(); ++j) {
            out += expected.rows[j] + "\n";
        }
        out += pictures == 1 ? "\"\"\"\n" : "\"\"\",\n";
    }
    return out + (pictures == 1 ? "" : "]\n");
}

std::vector<std::string> rows_of(const Case& c) {
    return c.claim.expected_hits ? c.claim.expected_hits->rows : std::vector<std::string>();
}

// Why the text does not say all that the case is; empty if it does.
std::string objection(const std::string& text, const Case& c) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(text, "", c.id);
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

Expected<std::string> to_toml(const Case& c) {
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
    std::string text = head_text(c) + target_text(c.target);
    for (const Draw& draw : c.draws) {
        text += "\n" + draw_text(draw, c.target);
    }
    if (c.blit) {
        text += blit_text(*c.blit, c.target);
    }
    if (c.claim.expected_hits) {
        text += expect_text(*c.claim.expected_hits, c.target);
    }
    if (const std::string why = objection(text, c); !why.empty()) {
        return failure("{} cannot be written as a case file: {}", c.id, why);
    }
    return text;
}

}  // namespace cases
