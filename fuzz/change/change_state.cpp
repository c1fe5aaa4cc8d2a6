// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "cases/load/matrix.hpp"
#include "cases/model/words.hpp"
#include "fuzz/change/change.hpp"

namespace fuzz {

namespace {

constexpr std::array kTables = {&cases::kTargetKeys, &cases::kTargetColorKeys,
                                &cases::kDrawKeys,   &cases::kDepthKeys,
                                &cases::kColorKeys,  &cases::kAttributeKeys};

// A row of one of these tables that costs a pipeline.
struct Place {
    const cases::KeyTable* table;
    const cases::Key* key;
};
const std::vector<Place>& places() {
    static const std::vector<Place> kAll = [] {
        std::vector<Place> all;
        for (const cases::KeyTable* table : kTables) {
            for (const cases::Key& key : table->keys) {
                if (key.has(cases::Key::kPipeline)) {
                    all.push_back({table, &key});
                }
            }
        }
        return all;
    }();
    return kAll;
}

// The table with these keys, made where it may be missing; nullptr if there is none. Its words end
// in a blank, if there are any.
Document* table_of(Document& document, const cases::KeyTable* keys, Dice& dice, Words& words) {
    Document* target = find(document, "target");
    const bool is_color = keys == &cases::kTargetColorKeys;
    if (keys == &cases::kTargetKeys || is_color) {
        words = fmt::format("{} ", is_color ? "target colour" : "target");
        return target == nullptr || !is_color ? target : color_table(*target);
    }
    Document* draw = any_draw(document, dice, words);
    if (draw == nullptr || keys == &cases::kDrawKeys) {
        return draw;
    }
    if (keys == &cases::kDepthKeys) {
        words += "depth ";
        Document* depth = find(*draw, "depth");
        return depth != nullptr ? depth : &set(*draw, "depth", table());
    }
    if (keys == &cases::kColorKeys) {
        words += "colour ";
        return color_table(*draw);
    }
    Document* attributes = find(*draw, "attribute");
    if (attributes == nullptr || attributes->array.empty()) {
        return nullptr;
    }
    const size_t k = dice.below(attributes->array.size());
    words += fmt::format("attribute {} ", k);
    return &attributes->array[k];
}

Words change_key(Document& document, Dice& dice) {
    const Place& place = places()[dice.below(places().size())];
    Words words;
    Document* in = table_of(document, place.table, dice, words);
    if (in == nullptr) {
        return {};
    }
    const std::string_view key = place.key->name;
    const Document* given = find(*in, key);
    const Document before = given == nullptr ? table() : *given;  // no key here is a table
    const Words set_to = set_any(*in, *place.table, key, dice);
    const Document& now = *find(*in, key);
    if (is_same(before, now)) {
        return {};
    }
    // What a value needs beside it, and what means nothing without it.
    if (key == "probe") {
        const std::string word = now.string;
        for (const char* other : {"sample", "offset", "texture"}) {
            erase(*in, other);
        }
        if (word == "at-sample") {
            set(*in, "sample", number(static_cast<double>(dice.below(4))));
        } else if (word == "at-offset") {
            set(*in, "offset", numbers({dice.fraction(-8, 7, 16), dice.fraction(-8, 7, 16)}));
        } else if (word == "query-lod") {
            set(*in, "texture",
                numbers({static_cast<double>(1U << dice.below(9)),
                         static_cast<double>(1U << dice.below(9))}));
        }
    } else if (key == "source" && now.string != "vertex") {
        for (const char* other : {"values", "constant", "plane", "from", "seed", "components"}) {
            erase(*in, other);
        }
    } else if (key == "blend") {
        erase(*in, "constants");
    } else if (key == "samples") {
        erase(*in, "sample_locations");
    }
    return words + set_to;
}

Words change_bias(Document& /*document*/, Document& draw, Dice& dice) {
    Document bias = table();
    if (!dice.one_in(3)) {
        set(bias, "constant", number(dice.fraction(-9, 9, 1)));
    }
    if (!dice.one_in(3)) {
        set(bias, "slope", number(dice.fraction(-8, 8, 4)));
    }
    if (dice.one_in(3)) {
        set(bias, "clamp", number(dice.fraction(-8, 8, 64)));
    }
    Document* depth = find(draw, "depth");
    if (bias.table.empty()) {
        return depth != nullptr && erase(*depth, "bias") ? "without depth bias" : Words();
    }
    set(depth != nullptr ? *depth : set(draw, "depth", table()), "bias", std::move(bias));
    return "another depth bias";
}

// A key that goes, which then has its default.
Words remove_key(Document& document, Dice& dice) {
    Words words;
    Document* in = table_of(document, dice.of(kTables), dice, words);
    if (in == nullptr || in->table.empty()) {
        return {};
    }
    const std::string key = in->table[dice.below(in->table.size())].key;
    if (key == "vertices" || key == "size" || key == "values" || key == "space") {
        return {};
    }
    if (key == "color") {  // of the target or of a draw: neither goes without the other
        erase_color(document);
    } else {
        erase(*in, key);
    }
    return fmt::format("{}without {}", words, key);
}

Words add_color(Document& document, Dice& dice) {
    Document* target = find(document, "target");
    Document* draws = find(document, "draw");
    if (target == nullptr || draws == nullptr || find(*target, "color") != nullptr) {
        return {};
    }
    const cases::ColorFormatRow& row =
        cases::kColorFormats[dice.below(cases::kColorFormats.size())];
    const bool is_integer = cases::is_integer(row.format);
    Document& color = set(*target, "color", table());
    set(color, "format", text(std::string(row.word)));
    for (Document& draw : draws->array) {
        std::vector<double> value;
        for (uint32_t k = 0; k < 4; ++k) {
            const auto most = static_cast<int64_t>(cases::whole_range(row.format, k).most);
            value.push_back(is_integer
                                ? static_cast<double>(dice.between(0, std::min<int64_t>(most, 255)))
                                : dice.fraction(0, 16, 16));
        }
        Document& of_draw = set(draw, "color", table());
        set(of_draw, "value", numbers(value));
        if (!is_integer && dice.one_in(2)) {
            set(of_draw, "blend", text(std::string(any_of(cases::kBlendWords, dice))));
        }
    }
    if (dice.one_in(3)) {
        constexpr std::string_view kColored[] = {"all", "color", "color+depth"};
        set(*target, "attachments", text(std::string(any_of(kColored, dice))));
    }
    return fmt::format("a colour target of {}", row.word);
}

// An attribute, or a clip or cull distance, for each vertex of a draw.
Words add_input(Document& /*document*/, Document& draw, Dice& dice) {
    static constexpr std::array<std::string_view, 4> kKeys = {"attribute", "attribute",
                                                              "clip_distance", "cull_distance"};
    const Document* vertices = find(draw, "vertices");
    if (vertices == nullptr) {
        return {};
    }
    const std::string_view key = dice.of(kKeys);
    Document input = table();
    std::vector<Document> values;
    const size_t components = key == "attribute" ? 1 + dice.below(4) : 1;
    if (key != "attribute" && dice.one_in(2)) {
        set(input, "half_space",
            numbers({dice.fraction(-3, 3, 1), dice.fraction(-3, 3, 1), dice.fraction(-1, 1, 1),
                     dice.fraction(-8, 8, 8)}));
    } else {
        for (size_t v = 0; v < vertices->array.size(); ++v) {
            std::vector<double> one;
            for (size_t c = 0; c < components; ++c) {
                one.push_back(dice.fraction(-8, 24, 16));
            }
            values.push_back(one.size() == 1 ? number(one[0]) : numbers(one));
        }
        set(input, "values", list(std::move(values)));
    }
    if (key == "attribute") {
        set(input, "interpolation",
            text(std::string(any_of(cases::kWords<cases::Interpolation>, dice))));
    }
    Document* inputs = find(draw, key);
    (inputs != nullptr ? *inputs : set(draw, key, list({}))).array.push_back(std::move(input));
    return fmt::format("one {} more", key);
}

Words add_relation(Document& document, Dice& dice) {
    const std::string_view word = any_of(cases::kWords<cases::RelationKind>, dice);
    Document relation = text(std::string(word));
    if (word == "scissor-tiles") {
        relation = table();
        set(relation, word, numbers({dice.fraction(1, 9, 1), dice.fraction(1, 9, 1)}));
    }
    if (word == "doors") {
        const std::span<const cases::DoorRow> rows = cases::all_doors();
        const std::string_view door = rows[dice.below(rows.size())].word;
        relation = table();
        set(relation, word, list({text(std::string(door))}));
        set(document, "relations", list({std::move(relation)}));
        return fmt::format("the door {}", door);
    }
    set(document, "relations", list({std::move(relation)}));
    return fmt::format("the relation {}", word);
}

// Draws that are borrowed, drawn twice or in another order.
Words change_draws(Document& document, Dice& dice, const Document* other) {
    Document* draws = find(document, "draw");
    if (draws == nullptr || draws->array.empty()) {
        return {};
    }
    const size_t k = dice.below(draws->array.size());
    const uint64_t kind = dice.below(4);
    if (kind == 0 && draws->array.size() > 1) {
        std::swap(draws->array[k], draws->array[(k + 1) % draws->array.size()]);
        return "two draws in the other order";
    }
    if (kind == 1) {
        Document again = draws->array[k];
        draws->array.push_back(std::move(again));
        return fmt::format("draw {} again at the end", k);
    }
    const Document* of_other = other == nullptr ? nullptr : other->find("draw");
    if (of_other == nullptr || of_other->array.empty()) {
        return {};
    }
    // The other draw's triangles with its own state, to this one's target.
    Document borrowed = of_other->array[dice.below(of_other->array.size())];
    erase(borrowed, "color");
    if (const Document* color = draws->array[k].find("color");
        color != nullptr && color->find("attribute") == nullptr) {
        set(borrowed, "color", *color);
    }
    if (kind == 2) {
        draws->array.push_back(std::move(borrowed));
        return "one draw more, of another case";
    }
    draws->array.insert(draws->array.begin(), std::move(borrowed));
    return "one draw before, of another case";
}

}  // namespace

Document* color_table(Document& table) {
    Document* color = find(table, "color");
    return color != nullptr && color->is(Document::Kind::table) ? color : nullptr;
}

Words set_any(Document& table, const cases::KeyTable& keys, std::string_view name, Dice& dice) {
    const cases::Key* row = keys.find(name);
    if (row == nullptr) {
        return {};
    }
    const cases::Key& key = *row;
    Document value = key.kind == cases::KeyKind::flag ? boolean(dice.one_in(2))
                     : key.words.empty() ? number(key.numbers[dice.below(key.numbers.size())])
                                         : text(std::string(any_of(key.words, dice)));
    const auto told = cases::value_text(set(table, key.name, std::move(value)));
    return fmt::format("{} = {}", key.name, told.value_or("?"));
}

Words change_state(Document& document, Dice& dice, const Document* other) {
    if (document.find("blit") != nullptr) {
        return change_blit(document, dice);
    }
    const uint64_t kind = dice.below(28);
    return kind < 12   ? change_key(document, dice)
           : kind < 13 ? change_draw(document, dice, change_bias)
           : kind < 14 ? remove_key(document, dice)
           : kind < 15 ? add_color(document, dice)
           : kind < 17 ? change_draw(document, dice, add_input)
           : kind < 18 ? add_relation(document, dice)
           : kind < 20 ? change_draws(document, dice, other)
           : kind < 21 ? change_draw(document, dice, change_bounds)
           : kind < 22 ? change_draw(document, dice, change_frag_depth)
           : kind < 24 ? change_draw(document, dice, change_codes)
           : kind < 25 ? change_draw(document, dice, change_query)
           : kind < 26 ? change_draw(document, dice, change_fragment_size)
                       : change_stencil(document, dice);
}

}  // namespace fuzz
