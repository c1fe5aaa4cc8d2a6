// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "random_color.hpp"

#include <cmath>

namespace histories {

namespace {

using Kind = ColorFormat::Kind;

// Where codes are combined bit by bit, or sRGB is decoded, a half is no number that all store
// alike.
Numbers random_numbers(Kind kind, bool is_binary, Random& random) {
    Numbers out{};
    for (double& number : out) {
        if (kind == Kind::integer) {
            number = random.of<double>({0, 1, 2, 7, 64, 255});
        } else if (kind == Kind::floating) {
            number = random.of<double>({0, 0.25, 0.5, 1, 2});
        } else {
            number = is_binary || random.chance(2, 3) ? random.below(2) : 0.5;
        }
    }
    return out;
}

BlendPart random_part(bool may_take_second, Random& random) {
    static const std::vector<BlendPart> usual = {
        {Factor::one, Factor::one, BlendOp::add},
        {Factor::src_alpha, Factor::inv_src_alpha, BlendOp::add},
        {Factor::one, Factor::inv_src_alpha, BlendOp::add},
        {Factor::dst, Factor::zero, BlendOp::add},
        {Factor::one, Factor::one, BlendOp::reverse_subtract},
        {Factor::one, Factor::one, BlendOp::min},
        {Factor::one, Factor::one, BlendOp::max}};
    if (random.chance(2, 3)) {
        return random.of(usual);
    }
    const uint32_t factors = may_take_second ? 19 : 15;
    return {static_cast<Factor>(random.below(factors)), static_cast<Factor>(random.below(factors)),
            static_cast<BlendOp>(random.below(5))};
}

}  // namespace

void give_targets(Scene& scene, Random& random) {
    if (random.chance(1, 4)) {
        return;
    }
    const uint32_t count = random.chance(1, 8) ? 2 : 1;
    for (uint32_t i = 0; i < count; ++i) {
        ColorTarget target;
        target.format = random.below(static_cast<uint32_t>(kColorFormats.size()));
        target.clear = random_numbers(target.about().kind, true, random);
        scene.colors.push_back(target);
    }
    scene.judged = random.below(count);
    if (random.chance(1, 2)) {
        scene.attachments = random.chance(1, 3) ? Attachments::color : Attachments::color_and_depth;
        scene.has_logic = random.chance(1, 3);
    }
}

void give_colors(const Scene& scene, Draw& draw, Random& random) {
    const bool is_alone = !scene.has_instruments();
    if (is_alone && scene.colors.size() == 1) {
        draw.alpha_to_one = random.chance(1, 8);
        draw.alpha_to_coverage = random.chance(1, 6) && !draw.early;
    }
    if (scene.has_logic && random.chance(1, 2)) {
        draw.logic = random.below(16);
    }
    draw.constants = random_numbers(Kind::unorm, true, random);
    draw.second = random_numbers(Kind::unorm, true, random);
    for (const ColorTarget& target : scene.colors) {
        const Kind kind = target.about().kind;
        ColorState state;
        // Halves only where nothing is combined bit by bit, by this draw or a later one.
        state.value = random_numbers(kind, scene.has_logic || kind == Kind::srgb, random);
        if (draw.alpha_to_coverage && kind != Kind::integer) {
            state.value[3] = random.of<double>({0, 0.25, 0.5, 1});
        }
        // Blending takes a half for either neighbour where the alpha has few bits.
        if (target.about().bits[3] == 2 && !draw.alpha_to_coverage) {
            state.value[3] = std::ceil(state.value[3]);
        }
        if (kind != Kind::integer && random.chance(1, 2)) {
            const bool may_take_second = is_alone && scene.colors.size() == 1;
            const BlendPart color = random_part(may_take_second, random);
            state.blend = {color,
                           random.chance(1, 2) ? color : random_part(may_take_second, random)};
        }
        if (random.chance(1, 5)) {
            state.write_mask = 1 + random.below(15);
        }
        if (draw.alpha_to_coverage && kind != Kind::floating && kind != Kind::integer) {
            state.blend.reset();  // codes of such an alpha are stored as either neighbour
            state.write_mask = (state.write_mask & 7) != 0 ? state.write_mask & 7 : 7;
        }
        draw.colors.push_back(state);
    }
}

void give_control_colors(const Scene& scene, Draw& draw) {
    for (const ColorTarget& target : scene.colors) {
        ColorState state;
        for (size_t c = 0; c < 4; ++c) {
            state.value[c] = is_same(target.clear[c], 0) ? 1 : 0;
        }
        draw.colors.push_back(state);
    }
}

}  // namespace histories
