// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that make the target smaller, most of them while the picture stays where it is.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cases/base/counted.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/triangle.hpp"
#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/steps.hpp"
#include "fuzz/reduce/viewport.hpp"

namespace fuzz {

namespace {

struct Crop {
    double left = 0, top = 0, right = 0, bottom = 0;  // whole pixels that go at each side
};

// A number moved by `by`; false if it is no number.
bool move(Document& value, double by) {
    const std::optional<double> given = value_of(value);
    if (given && std::fpclassify(by) != FP_ZERO) {
        value = number(*given - by);
    }
    return given.has_value();
}

bool crop_draw(Document& draw, const Crop& crop, const std::array<double, 2>& before,
               const std::array<double, 2>& after) {
    const bool is_moved = crop.left > 0 || crop.top > 0;
    const bool is_in_pixels = space_of(draw) == "pixels";
    Document* vertices = find(draw, "vertices");
    if (vertices == nullptr && is_moved) {
        return false;  // a generator places them by the target's size
    }
    if (Document* rect = viewport_of(draw)) {
        if (rect->array.size() != 4 || !move(rect->array[0], crop.left) ||
            !move(rect->array[1], crop.top)) {
            return false;
        }
    } else if (!is_in_pixels) {
        const Document whole = numbers({-crop.left, -crop.top, before[0], before[1]});
        Document* viewport = find(draw, "viewport");
        set(viewport == nullptr ? draw : *viewport, viewport == nullptr ? "viewport" : "rect",
            whole);
    }
    if (Document* scissor = find(draw, "scissor")) {
        const auto given = rectangle(scissor);
        if (!given) {
            return false;
        }
        const auto [x, y, width, height] = *given;
        const double left = std::clamp(x - crop.left, 0.0, after[0]);
        const double top = std::clamp(y - crop.top, 0.0, after[1]);
        const double right = std::clamp(x + width - crop.left, left, after[0]);
        const double bottom = std::clamp(y + height - crop.top, top, after[1]);
        *scissor = numbers({left, top, right - left, bottom - top});
    }
    if (is_in_pixels && is_moved) {
        for (Document& vertex : vertices->array) {
            if (vertex.array.size() < 2 || !move(vertex.array[0], crop.left) ||
                !move(vertex.array[1], crop.top)) {
                return false;
            }
        }
    }
    return true;
}

bool cropped(Document& document, const Crop& crop) {
    const std::optional<std::array<double, 2>> before = size_of(document);
    if (!before) {
        return false;
    }
    const std::array<double, 2> after = {(*before)[0] - crop.left - crop.right,
                                         (*before)[1] - crop.top - crop.bottom};
    if (after[0] < 1 || after[1] < 1) {
        return false;
    }
    set(*find(document, "target"), "size", numbers({after[0], after[1]}));
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        if (!crop_draw(*draw_at(document, draw), crop, *before, after)) {
            return false;
        }
    }
    return true;
}

// Half the target, with everything in it at half its size.
bool at_half_size(Document& document) {
    const std::optional<std::array<double, 2>> size = size_of(document);
    if (!size || (*size)[0] < 2 || (*size)[1] < 2) {
        return false;
    }
    set(*find(document, "target"), "size",
        numbers({std::floor((*size)[0] / 2), std::floor((*size)[1] / 2)}));
    const auto halve = [](Document& value, bool is_whole) {
        const std::optional<double> given = value_of(value);
        if (given) {
            value = number(is_whole ? std::floor(*given / 2) : *given / 2);
        }
        return given.has_value();
    };
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        Document& table = *draw_at(document, draw);
        if (Document* vertices = find(table, "vertices");
            vertices != nullptr && space_of(table) == "pixels") {
            for (Document& vertex : vertices->array) {
                if (vertex.array.size() < 2 || !halve(vertex.array[0], false) ||
                    !halve(vertex.array[1], false)) {
                    return false;
                }
            }
        }
        for (Document* rect : {viewport_of(table), find(table, "scissor")}) {
            if (rect == nullptr) {
                continue;
            }
            for (Document& side : rect->array) {
                if (!halve(side, rect != viewport_of(table))) {
                    return false;
                }
            }
        }
    }
    return true;
}

using Box = std::array<double, 4>;  // left, top, right, bottom in pixels

// Within the viewport and the scissor of a draw.
Box box_of(const cases::Draw& draw) {
    const auto x = static_cast<double>(draw.viewport.x);
    const auto y = static_cast<double>(draw.viewport.y);
    const auto width = static_cast<double>(draw.viewport.width);
    const auto height = static_cast<double>(draw.viewport.height);
    const double left = draw.scissor.x;
    const double top = draw.scissor.y;
    return {std::max(left, x), std::max(top, std::min(y, y + height)),
            std::min(left + draw.scissor.width, x + width),
            std::min(top + draw.scissor.height, std::max(y, y + height))};
}

// Around a triangle of a draw; nothing if it may reach anywhere.
std::optional<Box> box_of(const cases::Draw& draw, const cases::Triangle& triangle) {
    const double half_width = static_cast<double>(draw.viewport.width) / 2;
    const double half_height = static_cast<double>(draw.viewport.height) / 2;
    Box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const uint32_t vertex : triangle.vertex) {
        const glm::dvec4 p = draw.positions[vertex];
        if (!(p.w > 0) || !std::isfinite(p.x) || !std::isfinite(p.y)) {
            return std::nullopt;
        }
        const double x = static_cast<double>(draw.viewport.x) + half_width * (p.x / p.w + 1);
        const double y = static_cast<double>(draw.viewport.y) + half_height * (p.y / p.w + 1);
        box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
    }
    return box;
}

bool is_empty(const Box& box) {
    return !(box[0] < box[2] && box[1] < box[3]);
}

// What goes beyond all that is drawn: around the triangles within viewports and scissors.
Crop around_triangles(const Document& document) {
    const auto loaded = cases::load_tree(document, "case");
    if (!loaded || loaded->empty()) {
        return {};
    }
    const cases::Case& c = loaded->front();
    const Box whole = {0, 0, static_cast<double>(c.target.width),
                       static_cast<double>(c.target.height)};
    Box all = {whole[2], whole[3], 0, 0};
    for (const cases::Triangle& triangle : cases::assemble(c)) {
        const cases::Draw& draw = c.draws[triangle.draw];
        const Box outer = box_of(draw);
        const Box inner = box_of(draw, triangle).value_or(outer);
        const Box drawn = {std::max(inner[0], outer[0]), std::max(inner[1], outer[1]),
                           std::min(inner[2], outer[2]), std::min(inner[3], outer[3])};
        if (!is_empty(drawn)) {
            all = {std::min(all[0], drawn[0]), std::min(all[1], drawn[1]),
                   std::max(all[2], drawn[2]), std::max(all[3], drawn[3])};
        }
    }
    if (is_empty(all)) {
        return {};
    }
    return {std::max(std::floor(all[0]), 0.0), std::max(std::floor(all[1]), 0.0),
            std::max(whole[2] - std::ceil(all[2]), 0.0),
            std::max(whole[3] - std::ceil(all[3]), 0.0)};
}

void add_target(const std::string& words, std::function<bool(Document&)> apply,
                std::vector<Step>& steps) {
    steps.push_back({.phase = Phase::target, .words = words, .apply = std::move(apply)});
}

void add_crop(const Crop& crop, const std::string& words, std::vector<Step>& steps) {
    add_target(
        words, [crop](Document& d) { return cropped(d, crop); }, steps);
}

// A side of a picture, smaller by a half, a quarter, ..., one.
void add_blit_sides(const Document& document, std::vector<Step>& steps) {
    for (const char* name : {"target", "blit"}) {
        const Document* table = document.find(name);
        const Document* size = table == nullptr ? nullptr : table->find("size");
        for (size_t side = 0; size != nullptr && side < size->array.size(); ++side) {
            const double whole = value_of(size->array[side]).value_or(0);
            for (double less = whole; less > 1;) {
                less = std::ceil(less / 2);
                add_target(
                    fmt::format("with a {} of {} {} in place of {}", name,
                                side == 0 ? "width" : "height", whole - less, whole),
                    [name, side, less](Document& d) {
                        Document* to = find(*find(d, name), "size");
                        return move(to->array[side], less);
                    },
                    steps);
            }
        }
    }
}

}  // namespace

void add_target_steps(const Document& document, std::vector<Step>& steps) {
    const std::optional<std::array<double, 2>> size = size_of(document);
    if (!size) {
        return;
    }
    if (document.find("blit") != nullptr) {
        add_blit_sides(document, steps);
        return;
    }
    const Crop around = around_triangles(document);
    if (around.left + around.top + around.right + around.bottom > 0) {
        add_crop(around, "cut to what is drawn", steps);
    }
    add_target("at half the size", at_half_size, steps);
    for (size_t level = 1; level < 16; ++level) {
        const double part = std::ldexp(1.0, static_cast<int>(level));
        const double columns = std::floor((*size)[0] / part);
        const double rows = std::floor((*size)[1] / part);
        if (columns >= 1) {
            const std::string words = cases::counted(static_cast<uint64_t>(columns), "column");
            add_crop({.right = columns}, "without " + words + " at the right", steps);
            add_crop({.left = columns}, "without " + words + " at the left", steps);
        }
        if (rows >= 1) {
            const std::string words = cases::counted(static_cast<uint64_t>(rows), "row");
            add_crop({.bottom = rows}, "without " + words + " at the bottom", steps);
            add_crop({.top = rows}, "without " + words + " at the top", steps);
        }
    }
}

}  // namespace fuzz
