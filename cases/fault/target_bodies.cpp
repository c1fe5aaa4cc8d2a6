// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <utility>

#include "cases/fault/bodies.hpp"
#include "cases/fault/neighbour.hpp"
#include "cases/format/color_format.hpp"

namespace cases::fault {

namespace {

template <BlendFactor from, BlendFactor to>
bool factor_as(BlendEquation& e) {
    const bool is_source = replace(e.source, from, to);
    return replace(e.destination, from, to) || is_source;
}

bool exchange_operands(Draw& d) {
    constexpr std::pair<LogicOp, LogicOp> kPairs[] = {{LogicOp::and_reverse, LogicOp::and_inverted},
                                                      {LogicOp::or_reverse, LogicOp::or_inverted},
                                                      {LogicOp::copy, LogicOp::no_op},
                                                      {LogicOp::copy_inverted, LogicOp::invert}};
    return std::ranges::any_of(kPairs, [&](const auto& pair) {
        return exchange(d.color.logic, std::optional(pair.first), std::optional(pair.second));
    });
}

// Puts constant alphas that take samples away to their other end; integers count as an alpha of 0,
// with which nothing is drawn.
bool exchange_alpha(Case& c) {
    if (!c.target.color) {
        return false;
    }
    const bool is_of_integers = is_integer(c.target.color->format);
    return any_of(c.draws, [&](Draw& d) {
        if (!d.color.alpha_to_coverage) {
            return false;
        }
        if (is_of_integers) {
            return set(d.rasterizer_discard, true);
        }
        if (d.color.attribute >= 0) {
            return false;
        }
        float& alpha = d.color.value.w;
        alpha = alpha >= 1 ? 0.0F : 1.0F;
        return true;
    });
}

bool first_for_second(BlendFactor& factor) {
    constexpr BlendFactor kFirst[] = {BlendFactor::src_color, BlendFactor::one_minus_src_color,
                                      BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
    const bool is_second_source = is_second(factor);
    if (is_second_source) {
        factor = kFirst[static_cast<size_t>(factor) - static_cast<size_t>(BlendFactor::src1_color)];
    }
    return is_second_source;
}

bool blend_twice(Case& c) {
    std::vector<Draw> draws;
    for (const Draw& d : c.draws) {
        draws.insert(draws.end(), d.color.blend && !d.color.logic ? 2 : 1, d);
    }
    const bool is_changed = draws.size() > c.draws.size();
    c.draws = std::move(draws);
    return is_changed;
}

template <Taken taken>
bool take_from_next(Case& c) {
    return c.target.color_count() > 1 &&
           take_from(c, (c.target.judged_color + 1) % c.target.color_count(), taken);
}

// Takes the last texel from one side of a blit's region.
void shorten(int32_t& begin, int32_t& end) {
    --(end > begin ? end : begin);
}

const Body kTargetBodies[] = {
    // colour
    {"blend-ignored"_fault, [](Draw& d) { return set(d.color.blend, std::optional<Blend>()); }},
    {"blend-twice"_fault, blend_twice},
    {"blend-factors-exchanged"_fault,
     [](BlendEquation& e) {
         std::swap(e.source, e.destination);
         return e.source != e.destination;
     }},
    {"blend-off-unless-adding"_fault,
     [](Draw& d) {
         const bool adds = !d.color.blend || (d.color.blend->color.op == BlendOp::add &&
                                              d.color.blend->alpha.op == BlendOp::add);
         return !adds && (d.color.blend.reset(), true);
     }},
    {"blend-alpha-replaced"_fault, [](Blend& b) { return set(b.alpha, BlendEquation{}); }},
    {"src-alpha-as-one"_fault, factor_as<BlendFactor::src_alpha, BlendFactor::one>},
    {"src-alpha-as-dst-alpha"_fault, factor_as<BlendFactor::src_alpha, BlendFactor::dst_alpha>},
    {"one-minus-src-alpha-as-one"_fault,
     factor_as<BlendFactor::one_minus_src_alpha, BlendFactor::one>},
    {"dst-alpha-as-one"_fault, factor_as<BlendFactor::dst_alpha, BlendFactor::one>},
    {"dst-color-as-src-color"_fault, factor_as<BlendFactor::dst_color, BlendFactor::src_color>},
    {"constant-color-as-alpha"_fault,
     factor_as<BlendFactor::constant_color, BlendFactor::constant_alpha>},
    {"second-as-first"_fault,
     [](BlendEquation& e) {
         const bool is_source = first_for_second(e.source);
         return first_for_second(e.destination) || is_source;
     }},
    {"min-max-exchanged"_fault,
     [](BlendEquation& e) { return exchange(e.op, BlendOp::min, BlendOp::max); }},
    {"subtract-adds"_fault,
     [](BlendEquation& e) { return replace(e.op, BlendOp::subtract, BlendOp::add); }},
    {"blend-constants-red-blue"_fault,
     [](Blend& b) {
         std::swap(b.constants.x, b.constants.z);
         return b.constants.x < b.constants.z || b.constants.x > b.constants.z;
     }},
    {"write-mask-ignored"_fault, [](Draw& d) { return set(d.color.write_mask, uint8_t{0xf}); }},
    {"write-mask-no-alpha"_fault,
     [](Draw& d) {
         return set(d.color.write_mask, static_cast<uint8_t>(d.color.write_mask & 7U));
     }},
    {"write-mask-red-blue"_fault,
     [](Draw& d) {
         const unsigned m = d.color.write_mask;
         return set(d.color.write_mask,
                    static_cast<uint8_t>((m & 0xaU) | (m & 1U) << 2U | (m & 4U) >> 2U));
     }},
    {"logic-ignored"_fault, [](Draw& d) { return set(d.color.logic, std::optional<LogicOp>()); }},
    {"logic-operands-exchanged"_fault, exchange_operands},
    {"alpha-to-coverage-opposite"_fault, exchange_alpha},
    {"alpha-to-one-ignored"_fault, [](Draw& d) { return set(d.color.alpha_to_one, false); }},
    {"targets-state-of-next"_fault, take_from_next<Taken::state>},
    {"targets-color-of-next"_fault, take_from_next<Taken::color>},
    {"targets-clear-of-next"_fault, take_from_next<Taken::clear>},
    // blits
    {"blit-mirrored-x"_fault,
     [](Case& c) { return c.blit && (std::swap(c.blit->source.x0, c.blit->source.x1), true); }},
    {"blit-mirrored-y"_fault,
     [](Case& c) { return c.blit && (std::swap(c.blit->source.y0, c.blit->source.y1), true); }},
    {"blit-source-column-lost"_fault,
     [](Case& c) { return c.blit && (shorten(c.blit->source.x0, c.blit->source.x1), true); }},
    {"blit-destination-row-lost"_fault,
     [](Case& c) {
         return c.blit && (shorten(c.blit->destination.y0, c.blit->destination.y1), true);
     }},
};

}  // namespace

std::span<const Body> target_bodies() {
    return kTargetBodies;
}

}  // namespace cases::fault
