// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that leave out draws, triangles and vertices, and turn what is left into lists.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "fuzz/reduce/draw_shape.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

namespace {

std::string span_of(std::string_view noun, const Range& range) {
    return range.end - range.begin == 1
               ? fmt::format("without {} {}", noun, range.begin)
               : fmt::format("without {}s {} to {}", noun, range.begin, range.end - 1);
}

// Leaves out elements [begin, end) of the indices or vertices of a draw.
void add_removal(const Document& document, size_t draw, const Range& elements,
                 const std::string& what, std::vector<Step>& steps) {
    const auto apply = [draw, elements](Document& d) {
        Document* table = draw_at(d, draw);
        return table != nullptr && remove_elements(*table, elements.begin, elements.end);
    };
    Step& step = add_in_draw(document, draw, what, apply, steps);
    step.phase = Phase::removal;
    step.need.clear();
    step.begin = elements.begin;
    step.end = elements.end;
    step.of = "vertices";
}

// Strips and fans end sooner or begin later: by half, a quarter, ... or one of their triangles.
void add_ends(const Document& document, size_t draw, const DrawShape& shape, const Segment& segment,
              std::vector<Step>& steps) {
    const size_t triangles = triangle_count(shape, segment);
    // The first vertex of a fan is in all of its triangles.
    const size_t first = segment.begin + (shape.is_strip ? 0 : 1);
    for (size_t size = triangles; size > 1;) {
        size = (size + 1) / 2;
        add_removal(document, draw, {segment.end - size, segment.end},
                    fmt::format("without the last {} of {} triangles", size, triangles), steps);
        add_removal(document, draw, {first, first + size},
                    fmt::format("without the first {} of {} triangles", size, triangles), steps);
    }
}

void add_segments(const Document& document, size_t draw, const DrawShape& shape,
                  std::vector<Step>& steps) {
    for (const Range& part : parts_of(shape.segments.size())) {
        // With the restart behind them, or before them if they are the last.
        const bool is_last = part.end == shape.segments.size();
        const size_t begin = shape.segments[part.begin].begin;
        const size_t end = shape.segments[part.end - 1].end;
        add_removal(document, draw,
                    {is_last ? begin - std::min<size_t>(begin, 1) : begin, is_last ? end : end + 1},
                    span_of("run", part), steps);
    }
}

// What a run with one triangle or none may do without: it need not draw to be wrong, as where its
// restart is taken for a vertex.
void add_single_indices(const Document& document, size_t draw, const Segment& segment,
                        std::vector<Step>& steps) {
    if (segment.end - segment.begin > 3) {
        return;  // add_ends makes it shorter
    }
    for (size_t k = segment.begin; k < segment.end; ++k) {
        add_removal(document, draw, {k, k + 1}, span_of("index", {k, k + 1}), steps);
    }
}

bool drop_unused(Document& document, size_t draw) {
    Document* table = draw_at(document, draw);
    Document* indices = table == nullptr ? nullptr : find(*table, "indices");
    if (indices == nullptr) {
        return false;
    }
    const DrawShape shape = shape_of(*table);
    std::set<size_t> used(shape.order.begin(), shape.order.end());
    used.erase(SIZE_MAX);
    if (used.size() >= shape.vertices || used.empty() || *used.rbegin() >= shape.vertices) {
        return false;
    }
    choose_vertices(*table, {used.begin(), used.end()});
    for (size_t k = 0; k < shape.order.size(); ++k) {
        if (shape.order[k] != SIZE_MAX) {
            const auto rank = std::distance(used.begin(), used.find(shape.order[k]));
            indices->array[k] = number(static_cast<double>(rank));
        }
    }
    return true;
}

bool is_last_provoking(const Document& draw) {
    const Document* provoking = draw.find("provoking");
    return provoking != nullptr && provoking->string == "last";
}

bool choose_checked(Document& draw, const DrawShape& shape, const std::vector<size_t>& chosen) {
    if (chosen.empty() || *std::ranges::max_element(chosen) >= shape.vertices) {
        return false;
    }
    choose_vertices(draw, chosen);
    erase(draw, "indices");
    return true;
}

bool to_list(Document& document, size_t draw) {
    Document* table = draw_at(document, draw);
    if (table == nullptr) {
        return false;
    }
    const DrawShape shape = shape_of(*table);
    if (!choose_checked(*table, shape, triangle_vertices(shape, is_last_provoking(*table)))) {
        return false;
    }
    erase(*table, "topology");
    return true;
}

bool without_indices(Document& document, size_t draw) {
    Document* table = draw_at(document, draw);
    if (table == nullptr) {
        return false;
    }
    const DrawShape shape = shape_of(*table);
    return shape.has_indices && !shape.has_restart && choose_checked(*table, shape, shape.order);
}

void add_reshape(const Document& document, size_t draw, const std::string& what,
                 bool (*apply)(Document&, size_t), std::vector<Step>& steps) {
    add_in_draw(
        document, draw, what, [draw, apply](Document& d) { return apply(d, draw); }, steps)
        .phase = Phase::reshape;
}

}  // namespace

void add_draw_steps(const Document& document, std::vector<Step>& steps) {
    const size_t count = draw_count(document);
    for (const Range& part : parts_of(count)) {
        Step step;
        step.phase = Phase::draws;
        step.words = span_of("draw", part);
        step.need = part.end - part.begin == 1 ? "not " + step.words : "";
        step.begin = part.begin;
        step.end = part.end;
        step.of = "draws";
        step.apply = [part](Document& d) {
            Document* draws = find(d, "draw");
            if (draws == nullptr || part.end > draws->array.size()) {
                return false;
            }
            draws->array.erase(draws->array.begin() + static_cast<ptrdiff_t>(part.begin),
                               draws->array.begin() + static_cast<ptrdiff_t>(part.end));
            return true;
        };
        steps.push_back(std::move(step));
    }
}

void add_triangle_steps(const Document& document, std::vector<Step>& steps) {
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        const DrawShape shape = shape_of(document.find("draw")->array[draw]);
        if (shape.vertices == 0) {
            continue;
        }
        if (shape.has_restart) {
            add_segments(document, draw, shape, steps);
        }
        for (const Segment& segment : shape.segments) {
            if (shape.has_restart) {
                add_single_indices(document, draw, segment, steps);
            }
            if (!shape.is_list) {
                add_ends(document, draw, shape, segment, steps);
                continue;
            }
            const size_t triangles = triangle_count(shape, segment);
            for (const Range& part : parts_of(triangles)) {
                add_removal(document, draw, {3 * part.begin, 3 * part.end},
                            span_of("triangle", part), steps);
            }
            if (segment.end > 3 * triangles) {
                add_removal(document, draw, {3 * triangles, segment.end},
                            "without what is left over of the list", steps);
            }
        }
        if (shape.has_indices) {
            add_reshape(document, draw, "without unused vertices", drop_unused, steps);
            steps.back().need.clear();
        }
    }
}

void add_topology_steps(const Document& document, std::vector<Step>& steps) {
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        const DrawShape shape = shape_of(document.find("draw")->array[draw]);
        if (shape.vertices == 0) {
            continue;
        }
        if (!shape.is_list || shape.has_indices) {
            add_reshape(document, draw, "as a list without indices", to_list, steps);
        }
        if (!shape.is_list && shape.has_indices && !shape.has_restart) {
            add_reshape(document, draw, "with its indices written out", without_indices, steps);
        }
    }
}

}  // namespace fuzz
