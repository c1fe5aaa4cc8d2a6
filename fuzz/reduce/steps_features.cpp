// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that switch off what concerns the whole case, and leave out inputs of shaders.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "cases/base/counted.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

namespace {

using cases::counted;

size_t whole(const Document* value, size_t otherwise) {
    const std::optional<double> number = value == nullptr ? std::nullopt : value_of(*value);
    return number && *number >= 0 && *number < 1e6 ? static_cast<size_t>(*number) : otherwise;
}

bool with_samples(Document& document, size_t samples) {
    Document* target = find(document, "target");
    if (target == nullptr || whole(target->find("samples"), 1) <= samples) {
        return false;
    }
    set(*target, "samples", number(static_cast<double>(samples)));
    if (Document* locations = find(*target, "sample_locations");
        locations != nullptr && locations->array.size() > samples) {
        locations->array.resize(samples);
    }
    if (samples == 1) {
        for (const char* key :
             {"samples", "sample_locations", "resolve", "depth_resolve", "stencil_resolve"}) {
            erase(*target, key);
        }
    }
    for_each_draw(document, [samples](Document& draw) {
        Document* attributes = find(draw, "attribute");
        if (attributes == nullptr) {
            return;
        }
        for (Document& attribute : attributes->array) {
            if (Document* sample = find(attribute, "sample");
                sample != nullptr && whole(sample, 0) >= samples) {
                *sample = number(static_cast<double>(samples - 1));
            }
        }
    });
    return true;
}

bool with_layers(Document& document, size_t layers) {
    Document* target = find(document, "target");
    if (target == nullptr || whole(target->find("layers"), 1) <= layers) {
        return false;
    }
    set(*target, "layers", number(static_cast<double>(layers)));
    if (layers == 1) {
        erase(*target, "layers");
    }
    for_each_draw(document, [layers](Document& draw) {
        Document* layer = find(draw, "layer");
        if (layer != nullptr && layers == 1) {
            erase(draw, "layer");
        } else if (layer != nullptr && whole(layer, 0) >= layers) {
            *layer = number(static_cast<double>(layers - 1));
        }
    });
    return true;
}

// The list of a key becomes one of its elements.
bool take_one(Document& table, size_t judged) {
    Document* color = find(table, "color");
    if (color == nullptr || judged >= color->array.size()) {
        return false;
    }
    Document one = color->array[judged];
    *color = std::move(one);
    return true;
}

bool with_one_color(Document& document) {
    Document* target = find(document, "target");
    const size_t judged = target == nullptr ? 0 : whole(target->find("judged"), 0);
    if (target == nullptr || !take_one(*target, judged)) {
        return false;
    }
    erase(*target, "judged");
    for_each_draw(document, [judged](Document& draw) { take_one(draw, judged); });
    return true;
}

// Without one of several colour targets that is not judged; of two, one is left.
bool without_color_at(Document& document, size_t location) {
    Document* target = find(document, "target");
    Document* color = target == nullptr ? nullptr : find(*target, "color");
    if (color == nullptr || color->array.size() < 3 || location >= color->array.size()) {
        return false;
    }
    const size_t judged = whole(target->find("judged"), 0);
    if (judged == location) {
        return false;
    }
    if (judged > location) {
        set(*target, "judged", number(static_cast<double>(judged - 1)));
    }
    erase_at(target, "color", location);
    for_each_draw(document, [&](Document& draw) { erase_at(&draw, "color", location); });
    return true;
}

// The stencil of the target goes with what all draws say of it.
bool without_stencil(Document& document) {
    Document* target = find(document, "target");
    if (target == nullptr || !erase(*target, "stencil")) {
        return false;
    }
    erase(*target, "stencil_clear");
    for_each_draw(document, [](Document& draw) { erase(draw, "stencil"); });
    return true;
}

bool with_plain_format(Document& document) {
    Document* target = find(document, "target");
    Document* color = target == nullptr ? nullptr : find(*target, "color");
    Document* format = color == nullptr ? nullptr : find(*color, "format");
    if (format == nullptr || format->string == kPlainFormat) {
        return false;
    }
    *format = text(std::string(kPlainFormat));
    return true;
}

// The name by which a draw's colour calls an attribute.
std::string name_of(const Document& attribute, size_t number) {
    const Document* name = attribute.find("name");
    return name != nullptr ? name->string : fmt::format("attribute{}", number);
}

bool without_attribute(Document& document, size_t draw, size_t attribute) {
    Document* table = draw_at(document, draw);
    Document* attributes = table == nullptr ? nullptr : find(*table, "attribute");
    if (attributes == nullptr || attribute >= attributes->array.size()) {
        return false;
    }
    Document* color = find(*table, "color");
    Document* name = color == nullptr ? nullptr : find(*color, "attribute");
    if (name != nullptr && name->string == name_of(attributes->array[attribute], attribute)) {
        erase(*color, "attribute");
        set(*color, "value", numbers({1, 1, 1, 1}));
    } else if (name != nullptr) {
        // Names that are not written count the attributes.
        for (size_t k = attribute + 1; k < attributes->array.size(); ++k) {
            if (attributes->array[k].find("name") == nullptr &&
                name->string == name_of(attributes->array[k], k)) {
                name->string = fmt::format("attribute{}", k - 1);
                break;
            }
        }
    }
    return erase_at(table, "attribute", attribute);
}

void add_feature(const std::string& words, std::function<bool(Document&)> apply,
                 std::vector<Step>& steps) {
    steps.push_back({.words = words, .need = "not " + words, .apply = std::move(apply)});
}

void add_input(const Document& document, size_t draw, std::string_view of, size_t k,
               const std::string& words, std::function<bool(Document&)> apply,
               std::vector<Step>& steps) {
    Step& step = add_in_draw(document, draw, words, std::move(apply), steps);
    step.phase = Phase::removal;
    step.begin = k;
    step.end = k + 1;
    step.of = of;
}

}  // namespace

void add_feature_steps(const Document& document, std::vector<Step>& steps) {
    for (const char* key : {"expect", "relations", "links", "catches"}) {
        if (document.find(key) != nullptr) {
            add_feature(
                fmt::format("without {}", key), [key](Document& d) { return erase(d, key); },
                steps);
            steps.back().need = std::string_view(key) == "relations" ? steps.back().need : "";
        }
    }
    const Document* relations = document.find("relations");
    for (size_t k = 0; relations != nullptr && k < relations->array.size(); ++k) {
        add_feature(
            fmt::format("without relation {}", k),
            [k](Document& d) { return erase_at(&d, "relations", k); }, steps);
        steps.back().phase = Phase::removal;
        steps.back().begin = k;
        steps.back().end = k + 1;
        steps.back().of = "relations";
    }
    const Document* target = document.find("target");
    if (target == nullptr) {
        return;
    }
    // One first; two, four, ... come into question where that is not enough.
    const size_t samples = whole(target->find("samples"), 1);
    for (size_t fewer = 1; fewer < samples; fewer *= 2) {
        add_feature(
            "with " + counted(fewer, "sample"),
            [fewer](Document& d) { return with_samples(d, fewer); }, steps);
    }
    const size_t layers = whole(target->find("layers"), 1);
    for (size_t fewer = 1; fewer < layers; fewer *= 2) {
        add_feature(
            "with " + counted(fewer, "layer"),
            [fewer](Document& d) { return with_layers(d, fewer); }, steps);
    }
    if (layers > 2) {
        add_feature(
            "with " + counted(layers - 1, "layer"),
            [layers](Document& d) { return with_layers(d, layers - 1); }, steps);
    }
    const Document* draws = document.find("draw");
    if (draws != nullptr && std::ranges::any_of(draws->array, [](const Document& draw) {
            return draw.find("stencil") != nullptr;
        })) {
        add_feature("without a stencil", without_stencil, steps);
    }
    if (const Document* color = target->find("color")) {
        if (color->is(Kind::array)) {
            add_feature("with one colour target", with_one_color, steps);
        }
        for (size_t k = 0; k < color->array.size(); ++k) {
            add_feature(
                fmt::format("without colour target {}", k),
                [k](Document& d) { return without_color_at(d, k); }, steps);
        }
        add_feature("without a colour target", erase_color, steps);
        add_feature(fmt::format("with the format {}", kPlainFormat), with_plain_format, steps);
    }
}

void add_input_steps(const Document& document, std::vector<Step>& steps) {
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        const Document& table = document.find("draw")->array[draw];
        if (const Document* attributes = table.find("attribute")) {
            for (size_t k = 0; k < attributes->array.size(); ++k) {
                add_input(
                    document, draw, "attributes", k, fmt::format("without attribute {}", k),
                    [draw, k](Document& d) { return without_attribute(d, draw, k); }, steps);
            }
        }
        for (const char* key : {"clip_distance", "cull_distance"}) {
            const Document* distances = table.find(key);
            for (size_t k = 0; distances != nullptr && k < distances->array.size(); ++k) {
                add_input(
                    document, draw, key, k,
                    fmt::format("without {} distance {}", std::string_view(key).substr(0, 4), k),
                    [draw, key, k](Document& d) { return erase_at(draw_at(d, draw), key, k); },
                    steps);
            }
        }
    }
}

}  // namespace fuzz
