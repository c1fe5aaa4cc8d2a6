// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/generate/vertices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/base/counted.hpp"
#include "cases/base/float_bits.hpp"

namespace cases {

namespace {

constexpr std::array<const char*, 4> kComponent = {"x", "y", "z", "w"};

bool check_binary32(LeafContext& context, const Number& n, const SourceLocation& where,
                    const std::string& what) {
    const Rounded rounded = round_to_binary32(n);
    if (rounded.exact) {
        return true;
    }
    if (std::isinf(rounded.value)) {
        context.error(where, fmt::format("{} is larger than the largest binary32", what));
        return false;
    }
    const Neighbours near = neighbours(n.value);
    context.error(where, fmt::format("{} is not a binary32; its neighbours are \"{:a}\" ({}) and "
                                     "\"{:a}\" ({})",
                                     what, near.below, shortest(near.below), near.above,
                                     shortest(near.above)));
    return false;
}

std::optional<ExactVertex> read_vertex(LeafContext& context, const TomlValue& value, Space space,
                                       size_t number) {
    const std::string what = fmt::format("vertex {}", number);
    if (!context.array(value, what)) {
        return std::nullopt;
    }
    const size_t size = value.array.size();
    if (space == Space::clip ? size != 4 : size < 2 || size > 4) {
        context.error(
            value.where,
            fmt::format("{} has {}; write {}", what, counted(size, "number"),
                        space == Space::clip ? "[x,y,z,w]" : "[x,y], [x,y,z] or [x,y,z,w]"));
        return std::nullopt;
    }
    ExactVertex vertex = exact_vertex(0, 0);
    for (size_t i = 0; i < size; ++i) {
        const std::string component = fmt::format("{} of {}", kComponent.at(i), what);
        std::optional<Number> n = space == Space::clip
                                      ? context.any_binary32(value.array[i], component)
                                      : context.number(value.array[i], component);
        if (!n || (space != Space::pixels &&
                   !check_binary32(context, *n, value.array[i].where, component))) {
            return std::nullopt;
        }
        vertex.xyzw.at(i) = std::move(*n);
    }
    if (space != Space::clip && vertex.w() == 0) {
        context.error(value.array[3].where,
                      fmt::format("w of {} is 0, which only the space \"clip\" can express", what));
        return std::nullopt;
    }
    return vertex;
}

struct Scale {
    mpq_class origin;  // pixels
    mpq_class half;    // half the viewport's size, pixels; negative for a flipped one
};
Scale scale(float start, float size) {
    const mpq_class half = exact(static_cast<double>(size)) / 2;
    return {exact(static_cast<double>(start)) + half, half};
}

}  // namespace

ExactVertex exact_vertex(mpq_class x, mpq_class y) {
    ExactVertex vertex;
    vertex.xyzw[0].value = std::move(x);
    vertex.xyzw[1].value = std::move(y);
    vertex.xyzw[2].value = mpq_class(1, 2);
    vertex.xyzw[3].value = 1;
    return vertex;
}

bool is_finite(const ExactVertex& vertex) {
    return std::ranges::none_of(vertex.xyzw,
                                [](const Number& n) { return n.non_finite.has_value(); });
}

std::optional<std::vector<ExactVertex>> read_vertices(LeafContext& context, const TomlValue& value,
                                                      Space space) {
    if (!context.array(value, "vertices")) {
        return std::nullopt;
    }
    if (value.array.size() > kMaxVertices) {
        context.error(value.where, fmt::format("{} vertices are too many; a draw has at most {}",
                                               value.array.size(), kMaxVertices));
        return std::nullopt;
    }
    std::vector<ExactVertex> vertices;
    bool good = true;
    for (const TomlValue& element : value.array) {
        std::optional<ExactVertex> vertex = read_vertex(context, element, space, vertices.size());
        good = good && vertex.has_value();
        vertices.push_back(vertex ? std::move(*vertex) : ExactVertex{});
    }
    return good ? std::optional(std::move(vertices)) : std::nullopt;
}

std::optional<PixelPosition> pixel_position(const ExactVertex& vertex, Space space,
                                            const Viewport& viewport) {
    if (space == Space::pixels) {
        return PixelPosition{vertex.x(), vertex.y()};
    }
    if (!is_finite(vertex) || vertex.w() == 0) {
        return std::nullopt;
    }
    const Scale sx = scale(viewport.x, viewport.width);
    const Scale sy = scale(viewport.y, viewport.height);
    const mpq_class divisor = space == Space::clip ? vertex.w() : mpq_class(1);
    return PixelPosition{vertex.x() / divisor * sx.half + sx.origin,
                         vertex.y() / divisor * sy.half + sy.origin};
}

std::optional<std::vector<glm::vec4>> to_clip(LeafContext& context,
                                              const std::vector<ExactVertex>& vertices, Space space,
                                              const Viewport& viewport, const SourceLocation& where,
                                              const std::string& name,
                                              std::vector<std::string>& notes,
                                              const TomlValue* list) {
    const bool is_listed = list != nullptr && list->is(TomlValue::Kind::array) &&
                           list->array.size() == vertices.size();
    const auto place_of = [&](size_t v) { return is_listed ? list->array[v].where : where; };
    const Scale sx = scale(viewport.x, viewport.width);
    const Scale sy = scale(viewport.y, viewport.height);
    std::vector<glm::vec4> result;
    result.reserve(vertices.size());
    size_t rounded_vertices = 0;
    size_t first_rounded = 0;
    mpq_class worst = 0;  // pixels
    std::array<Number, 3> scaled;
    // Most vertices have the w of the one before.
    float last_w = 1;
    mpq_class last_exact_w = 1;
    const auto exact_of = [&](float value) -> const mpq_class& {
        if (!same_bits(value, last_w)) {
            last_w = value;
            last_exact_w = exact(static_cast<double>(value));
        }
        return last_exact_w;
    };
    for (size_t v = 0; v < vertices.size(); ++v) {
        const ExactVertex& given = vertices[v];
        const Rounded w = round_to_binary32(given.xyzw[3]);
        if ((std::isinf(w.value) && !w.exact) ||
            (space != Space::clip && std::fpclassify(w.value) == FP_ZERO)) {
            context.error(place_of(v),
                          fmt::format("w of vertex {} is not a binary32 other than zero", v));
            return std::nullopt;
        }
        if (space != Space::clip) {
            const mpq_class& exact_w = exact_of(w.value);
            for (size_t i = 0; i < 3; ++i) {
                Number& n = scaled.at(i);
                n.negative_zero = given.xyzw.at(i).negative_zero;
                if (space == Space::pixels && i < 2) {
                    const Scale& s = i == 0 ? sx : sy;
                    n.value = given.xyzw.at(i).value - s.origin;
                    n.value /= s.half;
                    n.negative_zero = false;
                } else {
                    n.value = given.xyzw.at(i).value;
                }
                if (exact_w != 1) {
                    n.value *= exact_w;
                }
                n.negative_zero = n.value == 0 && (n.negative_zero != (exact_w < 0));
            }
        }
        const auto clip = [&](size_t i) -> const Number& {
            return space == Space::clip || i == 3 ? given.xyzw.at(i) : scaled.at(i);
        };
        std::array<float, 4> bits{};
        bool is_exact = w.exact;
        for (size_t i = 0; i < 4; ++i) {
            const Rounded rounded = i == 3 ? w : round_to_binary32(clip(i));
            if (std::isinf(rounded.value) && !rounded.exact) {
                context.error(place_of(v), fmt::format("{} of vertex {} is larger than the largest "
                                                       "binary32 in clip space",
                                                       kComponent.at(i), v));
                return std::nullopt;
            }
            bits.at(i) = rounded.value;
            is_exact = is_exact && rounded.exact;
        }
        result.emplace_back(bits[0], bits[1], bits[2], bits[3]);
        if (is_exact) {
            continue;
        }
        first_rounded = rounded_vertices == 0 ? v : first_rounded;
        ++rounded_vertices;
        const mpq_class& exact_w = exact_of(w.value);
        for (size_t i = 0; i < 2; ++i) {
            mpq_class moved = abs(exact(static_cast<double>(bits.at(i))) - clip(i).value);
            moved /= exact_w;
            moved *= i == 0 ? sx.half : sy.half;
            worst = std::max<mpq_class>(worst, abs(moved));
        }
    }
    if (rounded_vertices != 0) {
        notes.push_back(fmt::format(
            "{}: {} of {} vertices were rounded to binary32 in clip space, the first is vertex {}; "
            "x and y moved by at most {:.3g} pixels",
            name, rounded_vertices, vertices.size(), first_rounded, worst.get_d()));
    }
    return result;
}

}  // namespace cases
