// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/neighbour.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "cases/model/derive.hpp"
#include "rasterizers/software/target/store.hpp"

namespace software {

namespace {

bool is_fixed(cases::ColorFormat format) {
    const Number number = layout_of(format).channels[0].number;
    return number == Number::unorm || number == Number::srgb || number == Number::snorm;
}

template <class Is>
bool any_other(const cases::Target& target, const Is& is) {
    return std::ranges::any_of(target.other_colors,
                               [&](const cases::ColorTarget& other) { return is(other.format); });
}

void take_state(cases::ColorOutput& output, const cases::ColorOutput& other) {
    output.blend = other.blend;
    output.write_mask = other.write_mask;
}

}  // namespace

glm::vec4 clear_of(const cases::Target& target, const Device& device) {
    const cases::ColorTarget& own = *target.color;
    const cases::ColorTarget& first = target.color_at(0);
    const bool is_first = device.fault == "targets-clear-of-first"_fault &&
                          is_integer(first.format) == is_integer(own.format);
    return own.load == cases::LoadOp::dont_care ? glm::vec4(1) - own.clear
           : is_first                           ? first.clear
                                                : own.clear;
}

cases::ColorOutput output_beside(const cases::Case& c, const cases::Draw& draw,
                                 cases::ColorOutput output, const Device& device) {
    const cases::Target& target = c.target;
    const uint32_t count = target.color_count();
    const uint32_t own = target.judged_color;
    if (count < 2) {
        return output;
    }
    switch (device.fault) {
        case "targets-state-of-first"_fault:
            take_state(output, cases::output_at(target, draw, 0));
            break;
        case "targets-state-of-first-draw"_fault:
            if (own > 0) {
                take_state(output, c.draws.front().color);
            }
            break;
        case "targets-mask-of-next"_fault:
            output.write_mask = cases::output_at(target, draw, (own + 1) % count).write_mask;
            break;
        case "targets-masked-together"_fault:
            if (std::ranges::any_of(draw.other_colors,
                                    [](const auto& other) { return other.write_mask == 0; })) {
                output.write_mask = 0;
            }
            break;
        case "targets-blended-together"_fault:
            for (uint32_t k = 0; k < count && !output.blend; ++k) {
                output.blend = cases::output_at(target, draw, k).blend;
            }
            break;
        case "targets-unblended-beside-integers"_fault:
            if (any_other(target, [](cases::ColorFormat f) { return is_integer(f); })) {
                output.blend.reset();
            }
            break;
        default:
            break;
    }
    if (is_integer(target.color->format)) {
        output.blend.reset();
    }
    return output;
}

const cases::ColorOutput& reaching(const cases::Target& target, const cases::Draw& draw,
                                   const Device& device) {
    const uint32_t count = target.color_count();
    uint32_t from = target.judged_color;
    if (device.fault == "targets-color-of-first"_fault && count > 1) {
        from = 0;
    } else if (device.fault == "targets-color-shifted"_fault && count > 1) {
        from = (from + count - 1) % count;
    }
    const bool is_of_class =
        count < 2 || is_integer(target.color_at(from).format) == is_integer(target.color->format);
    return is_of_class && from != target.judged_color ? cases::output_at(target, draw, from)
                                                      : draw.color;
}

glm::vec4 passed(const cases::Target& target, const glm::vec4& value, const Device& device) {
    const bool is_clamped = device.fault == "targets-clamped-together"_fault &&
                            !is_integer(target.color->format) && any_other(target, is_fixed);
    return is_clamped ? glm::clamp(value, 0.0F, 1.0F) : value;
}

std::optional<size_t> place_in(const cases::Target& target, size_t index, const Device& device) {
    const uint32_t count = target.color_count();
    const uint32_t own = target.judged_color;
    if (count < 2) {
        return index;
    }
    switch (device.fault) {
        case "targets-last-lost"_fault:
            return own + 1 == count ? std::nullopt : std::optional(index);
        case "targets-samples-of-first"_fault:
            return own > 0 && index % target.samples != 0 ? std::nullopt : std::optional(index);
        case "targets-layers-of-first"_fault:
            return own > 0 ? index % (size_t{target.width} * target.height * target.samples)
                           : index;
        default:
            return index;
    }
}

}  // namespace software
