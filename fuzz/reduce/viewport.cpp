// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/viewport.hpp"

#include "fuzz/reduce/measure.hpp"

namespace fuzz {

std::optional<std::array<double, 4>> rectangle(const Document* value) {
    if (value == nullptr || value->array.size() != 4) {
        return std::nullopt;
    }
    std::array<double, 4> out{};
    for (size_t k = 0; k < 4; ++k) {
        const std::optional<double> number = value_of(value->array[k]);
        if (!number) {
            return std::nullopt;
        }
        out.at(k) = *number;
    }
    return out;
}

std::optional<std::array<double, 2>> size_of(const Document& document) {
    const Document* target = document.find("target");
    const Document* size = target == nullptr ? nullptr : target->find("size");
    if (size == nullptr || size->array.size() != 2) {
        return std::nullopt;
    }
    const std::optional<double> width = value_of(size->array[0]);
    const std::optional<double> height = value_of(size->array[1]);
    return width && height ? std::optional(std::array{*width, *height}) : std::nullopt;
}

std::string space_of(const Document& draw) {
    const Document* space = draw.find("space");
    return space == nullptr ? "pixels" : space->string;
}

Document* viewport_of(Document& draw) {
    Document* viewport = find(draw, "viewport");
    return viewport != nullptr && viewport->is(Kind::table) ? find(*viewport, "rect") : viewport;
}

std::array<double, 4> viewport_or(Document& draw, const std::array<double, 2>& size) {
    return rectangle(viewport_of(draw)).value_or(std::array<double, 4>{0, 0, size[0], size[1]});
}

}  // namespace fuzz
