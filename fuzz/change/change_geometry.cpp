// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fuzz/change/change.hpp"
#include "fuzz/reduce/measure.hpp"

namespace fuzz {

namespace {

// How far numbers are moved: a unit, halves, what the coarsest grid that a device may have tells
// apart, a subpixel of the commonest, and less than that.
constexpr std::array<double, 6> kSteps = {1, 0.5, 0x1p-4, 0x1p-8, 0x1p-8, 0x1p-12};

bool is_clip(const Document& draw) {
    const Document* space = draw.find("space");
    return space != nullptr && space->string != "pixels";
}

std::string_view topology_of(const Document& draw) {
    const Document* topology = draw.find("topology");
    return topology == nullptr ? "triangle-list" : std::string_view(topology->string);
}

// Changes a draw, if its vertices are told one by one.
template <Words (*change)(Document& draw, Document& vertices, Dice& dice)>
Words change_vertices(Document& document, Dice& dice) {
    return change_draw(document, dice, [](Document&, Document& draw, Dice& rolled) {
        Document* vertices = find(draw, "vertices");
        return vertices == nullptr || vertices->array.empty() ? Words()
                                                              : change(draw, *vertices, rolled);
    });
}

Words move_vertex(Document& draw, Document& vertices, Dice& dice) {
    const size_t k = dice.below(vertices.array.size());
    Document& vertex = vertices.array[k];
    if (vertex.array.empty()) {
        return {};
    }
    // Mostly x or y.
    const size_t c = dice.one_in(4) ? dice.below(vertex.array.size()) : dice.below(2);
    return c < vertex.array.size() && change_number(vertex.array[c], dice, is_clip(draw))
               ? fmt::format("vertex {} moved", k)
               : Words();
}

Words move_all(Document& draw, Document& vertices, Dice& dice) {
    if (is_clip(draw)) {
        return {};
    }
    const double step = dice.of(kSteps);
    const std::array<double, 2> by = {step * dice.fraction(-2, 2, 1),
                                      step * dice.fraction(-2, 2, 1)};
    for (Document& vertex : vertices.array) {
        for (size_t c = 0; c < 2 && c < vertex.array.size(); ++c) {
            const std::optional<double> now = value_of(vertex.array[c]);
            if (!now) {
                return {};
            }
            vertex.array[c] = number(*now + by.at(c));
        }
    }
    return fmt::format("moved by {}, {}", by[0], by[1]);
}

Words repeat_or_swap(Document& /*draw*/, Document& vertices, Dice& dice) {
    const size_t a = dice.below(vertices.array.size()), b = dice.below(vertices.array.size());
    if (a == b) {
        return {};
    }
    if (dice.one_in(2)) {
        std::swap(vertices.array[a], vertices.array[b]);
        return fmt::format("vertices {} and {} exchanged", a, b);
    }
    Document copy = vertices.array[b];
    vertices.array[a] = std::move(copy);
    return fmt::format("vertex {} in place of {}", b, a);
}

// The vertex once more, with its values.
void repeat_vertex(Document& draw, Document& vertices, size_t k) {
    Document copy = vertices.array[k];
    vertices.array.push_back(std::move(copy));
    for_each_values(draw, [k](Document& values) {
        if (k < values.array.size()) {
            Document value = values.array[k];
            values.array.push_back(std::move(value));
        }
    });
}

Words add_triangle(Document& draw, Document& vertices, Dice& dice) {
    const size_t fresh = topology_of(draw) == "triangle-list" ? 3 : 1;
    Document* indices = find(draw, "indices");
    for (size_t n = 0; n < fresh; ++n) {
        repeat_vertex(draw, vertices, dice.below(vertices.array.size()));
        Document& vertex = vertices.array.back();
        for (size_t c = 0; c < 2 && c < vertex.array.size(); ++c) {
            if (const std::optional<double> now = value_of(vertex.array[c])) {
                const double step = dice.of(kSteps);
                const double moved = *now + step * dice.fraction(-6, 6, 1);
                vertex.array[c] =
                    number(is_clip(draw) ? static_cast<double>(static_cast<float>(moved)) : moved);
            }
        }
        if (indices != nullptr) {
            indices->array.push_back(number(static_cast<double>(
                dice.one_in(2) ? dice.below(vertices.array.size()) : vertices.array.size() - 1)));
        }
    }
    return "one triangle more";
}

Words drop_triangle(Document& draw, Document& vertices, Dice& dice) {
    const size_t size = topology_of(draw) == "triangle-list" ? 3 : 1;
    Document* indices = find(draw, "indices");
    const size_t count = (indices != nullptr ? *indices : vertices).array.size();
    if (count < size + 3) {
        return {};
    }
    const auto first = static_cast<ptrdiff_t>(size * dice.below(count / size));
    const auto cut = [&](Document& values) {
        if (static_cast<ptrdiff_t>(values.array.size()) >= first + static_cast<ptrdiff_t>(size)) {
            values.array.erase(values.array.begin() + first,
                               values.array.begin() + first + static_cast<ptrdiff_t>(size));
        }
    };
    if (indices != nullptr) {
        cut(*indices);
    } else {
        cut(vertices);
        for_each_values(draw, cut);
    }
    return fmt::format("without the triangle at {}", first);
}

Words change_indices(Document& draw, Document& vertices, Dice& dice) {
    Document* indices = find(draw, "indices");
    if (indices == nullptr) {
        std::vector<double> in_turn;
        for (size_t k = 0; k < vertices.array.size(); ++k) {
            in_turn.push_back(static_cast<double>(k));
        }
        set(draw, "indices", numbers(in_turn));
        return "with indices in turn";
    }
    if (indices->array.empty()) {
        return {};
    }
    const size_t k = dice.below(indices->array.size());
    if (topology_of(draw) != "triangle-list" && dice.one_in(3)) {
        indices->array.insert(indices->array.begin() + static_cast<ptrdiff_t>(k), text("restart"));
        return fmt::format("restart before index {}", k);
    }
    indices->array[k] = number(static_cast<double>(dice.below(vertices.array.size())));
    return fmt::format("index {} changed", k);
}

// A scissor or a viewport that is moved, or given where the target stood for it.
Words move_window(Document& document, Dice& dice) {
    Words words;
    Document* draw = any_draw(document, dice, words);
    const Document* target = document.find("target");
    const Document* size = target == nullptr ? nullptr : target->find("size");
    if (draw == nullptr || size == nullptr || size->array.size() != 2) {
        return {};
    }
    const bool is_scissor = dice.one_in(2);
    const char* key = is_scissor ? "scissor" : "viewport";
    const double width = value_of(size->array[0]).value_or(1);
    const double height = value_of(size->array[1]).value_or(1);
    Document* window = find(*draw, key);
    if (window != nullptr && window->is(Kind::table)) {
        window = find(*window, "rect");
    }
    if (window == nullptr) {
        if (find(*draw, key) != nullptr) {
            return {};
        }
        window = &set(*draw, key, numbers({0, 0, width, height}));
    }
    if (window->array.size() != 4) {
        return {};
    }
    for (int n = dice.one_in(2) ? 1 : 2; n > 0; --n) {
        Document& side = window->array[dice.below(4)];
        const std::optional<double> now = value_of(side);
        if (!now) {
            return {};
        }
        const uint64_t kind = dice.below(12);
        side = number(kind == 0                 ? *now * 2
                      : kind == 1               ? *now + 65536
                      : kind < 4 && !is_scissor ? *now + dice.fraction(-8, 8, 16)
                                                : *now + dice.fraction(-3, 3, 1));
    }
    return fmt::format("{}another {}", words, key);
}

// All four numbers of a position twice as large, or half: the same place.
Words scale_vertex(Document& draw, Document& vertices, Dice& dice) {
    if (!is_clip(draw)) {
        return {};
    }
    const size_t k = dice.below(vertices.array.size());
    const double by = dice.one_in(2) ? 2 : 0.5;
    for (Document& number_of : vertices.array[k].array) {
        const std::optional<double> now = value_of(number_of);
        if (!now) {
            return {};
        }
        number_of = number(*now * by);
    }
    return fmt::format("vertex {} times {}", k, by);
}

Words spoil_number(Document& draw, Document& vertices, Dice& dice) {
    if (!is_clip(draw)) {
        return {};
    }
    const size_t k = dice.below(vertices.array.size());
    Document& vertex = vertices.array[k];
    if (vertex.array.empty()) {
        return {};
    }
    static constexpr std::array<std::string_view, 3> kBad = {"nan", "inf", "-inf"};
    const std::string_view bad = dice.of(kBad);
    vertex.array[dice.below(vertex.array.size())] = text(std::string(bad));
    return fmt::format("vertex {} with {}", k, bad);
}

// Numbers below a value, but for vertices and what makes a target larger.
void collect_numbers(Document& value, std::vector<Document*>& all) {
    if (value.is(Kind::table)) {
        for (cases::TomlEntry& entry : value.table) {
            if (entry.key != "vertices" && entry.key != "indices" && entry.key != "size" &&
                entry.key != "layers" && entry.key != "samples" && entry.key != "format") {
                collect_numbers(entry.value, all);
            }
        }
    } else if (value.is(Kind::array)) {
        for (Document& element : value.array) {
            collect_numbers(element, all);
        }
    } else if (value_of(value)) {
        all.push_back(&value);
    }
}

Words change_any_number(Document& document, Dice& dice) {
    std::vector<Document*> all;
    for (const char* key : {"target", "draw", "blit"}) {
        if (Document* part = find(document, key)) {
            collect_numbers(*part, all);
        }
    }
    return !all.empty() && change_number(*all[dice.below(all.size())], dice, false)
               ? "another number"
               : Words();
}

Words borrow_triangles(Document& document, Dice& dice, const Document* other) {
    Words words;
    Document* draw = any_draw(document, dice, words);
    const Document* draws = other == nullptr ? nullptr : other->find("draw");
    if (draw == nullptr || draws == nullptr || draws->array.empty() ||
        !append_vertices(*draw, draws->array[dice.below(draws->array.size())])) {
        return {};
    }
    return words + "with the triangles of another case";
}

}  // namespace

Document* any_draw(Document& document, Dice& dice, Words& words) {
    Document* draws = find(document, "draw");
    if (draws == nullptr || draws->array.empty()) {
        return nullptr;
    }
    const size_t k = dice.below(draws->array.size());
    words = draws->array.size() == 1 ? "" : fmt::format("draw {} ", k);
    return &draws->array[k];
}

Words change_draw(Document& document, Dice& dice,
                  Words (*change)(Document& document, Document& draw, Dice& dice)) {
    Words words;
    Document* draw = any_draw(document, dice, words);
    const Words what = draw == nullptr ? Words() : change(document, *draw, dice);
    return what.empty() ? what : words + what;
}

double other_number(double value, Dice& dice) {
    double step = dice.of(kSteps);
    step = dice.one_in(2) ? step : -step;
    switch (dice.below(10)) {
        case 0:
            return -value;
        case 1:
            return value * 2;
        case 2:
            return value / 2;
        case 3:
            return std::floor(value) + (dice.one_in(2) ? 0.5 : 0.0);
        case 4: {  // the next binary32
            const auto near = static_cast<float>(value);
            const float beyond = std::numeric_limits<float>::max() * (step > 0 ? 1.0F : -1.0F);
            return static_cast<double>(std::nextafter(near, beyond));
        }
        default:
            return value + step;
    }
}

bool change_number(Document& value, Dice& dice, bool is_binary32) {
    const std::optional<double> now = value_of(value);
    if (!now) {
        return false;
    }
    const double other = other_number(*now, dice);
    value = number(is_binary32 ? static_cast<double>(static_cast<float>(other)) : other);
    return true;
}

bool append_vertices(Document& draw, const Document& from) {
    constexpr size_t kMost = 512;
    Document* vertices = find(draw, "vertices");
    const Document* more = from.find("vertices");
    if (vertices == nullptr || more == nullptr || vertices->array.empty() ||
        is_clip(draw) != is_clip(from) || vertices->array.size() + more->array.size() > kMost) {
        return false;
    }
    const size_t before = vertices->array.size();
    if (Document* indices = find(draw, "indices")) {
        const Document* own = from.find("indices");
        const size_t count = own == nullptr ? more->array.size() : own->array.size();
        for (size_t k = 0; k < count; ++k) {
            if (own != nullptr && own->array[k].is(Kind::string)) {
                indices->array.push_back(own->array[k]);
                continue;
            }
            const double index =
                own == nullptr ? static_cast<double>(k) : value_of(own->array[k]).value_or(0);
            indices->array.push_back(number(index + static_cast<double>(before)));
        }
    }
    vertices->array.insert(vertices->array.end(), more->array.begin(), more->array.end());
    for_each_values(draw, [&](Document& values) {
        for (size_t k = 0; k < more->array.size() && !values.array.empty(); ++k) {
            Document value = values.array[k % before];
            values.array.push_back(std::move(value));
        }
    });
    return true;
}

Words change_geometry(Document& document, Dice& dice, const Document* other) {
    switch (dice.below(18)) {
        case 0:
        case 1:
        case 2:
        case 3:
        case 4:
            return change_vertices<move_vertex>(document, dice);
        case 5:
            return change_vertices<move_all>(document, dice);
        case 6:
            return change_vertices<repeat_or_swap>(document, dice);
        case 7:
        case 8:
            return change_vertices<add_triangle>(document, dice);
        case 9:
            return change_vertices<drop_triangle>(document, dice);
        case 10:
            return change_vertices<change_indices>(document, dice);
        case 11:
        case 12:
            return move_window(document, dice);
        case 13:
            return change_vertices<scale_vertex>(document, dice);
        case 14:
            return dice.one_in(4) ? change_vertices<spoil_number>(document, dice)
                                  : change_vertices<move_vertex>(document, dice);
        case 15:
        case 16:
            return change_any_number(document, dice);
        default:
            return borrow_triangles(document, dice, other);
    }
}

}  // namespace fuzz
