// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/changes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/model/sample.hpp"
#include "ref/color/neighbour.hpp"

namespace ref {

using cases::Attribute;
using cases::Auxiliary;
using cases::Case;
using cases::CullMode;
using cases::Draw;
using cases::FrontFace;
using cases::Interpolation;
using cases::Probe;
using cases::ProvokingVertex;

namespace {

// Whether the field had another value.
template <class T>
bool set(T& field, const T& value) {
    const bool is_other = !(field == value);
    field = value;
    return is_other;
}

template <class Change>
bool change_draws(Case& c, const Change& change) {
    bool is_changed = false;
    for (Draw& draw : c.draws) {
        is_changed = change(draw) || is_changed;
    }
    return is_changed;
}

template <class Change>
bool change_attributes(Case& c, const Change& change) {
    return change_draws(c, [&](Draw& draw) {
        bool is_changed = false;
        for (Attribute& attribute : draw.attributes) {
            is_changed = change(attribute) || is_changed;
        }
        return is_changed;
    });
}

}  // namespace

bool open_scissors(Case& c) {
    const cases::Rect whole{0, 0, c.target.width, c.target.height};
    return change_draws(c, [&](Draw& draw) { return set(draw.scissor, whole); });
}

bool cover_by_samples(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.conservative, cases::Conservative::none); });
}

bool write_all_samples(Case& c) {
    return change_draws(c, [](Draw& draw) {
        const bool is_masked = set(draw.multisample.sample_mask, 0xffffffffU);
        return set(draw.multisample.shader_mask, std::optional<uint32_t>()) || is_masked;
    });
}

bool reverse_masks(Case& c) {
    // Whether the samples of the target are others.
    const auto reverse = [&](uint32_t& mask) {
        uint32_t now = 0, reversed = 0;
        for (uint32_t s = 0; s < c.target.samples; ++s) {
            const uint32_t bit = mask >> s & 1U;
            now |= bit << s;
            reversed |= bit << (c.target.samples - 1 - s);
        }
        mask = reversed;
        return now != reversed;
    };
    return change_draws(c, [&](Draw& draw) {
        const bool is_changed = reverse(draw.multisample.sample_mask);
        return (draw.multisample.shader_mask && reverse(*draw.multisample.shader_mask)) ||
               is_changed;
    });
}

bool drop_clip_distances(Case& c) {
    return change_draws(c, [](Draw& draw) {
        draw.distances.clip.clear();
        return set(draw.distances.clip_count, 0U);
    });
}

bool put_zero_distances_outside(Case& c) {
    return change_draws(c, [](Draw& draw) {
        bool is_changed = false;
        for (glm::vec4& distances : draw.distances.clip) {
            for (uint32_t k = 0; k < draw.distances.clip_count; ++k) {
                float& distance = distances[static_cast<int>(k)];
                if (std::fpclassify(distance) == FP_ZERO) {
                    distance = -1;
                    is_changed = true;
                }
            }
        }
        return is_changed;
    });
}

bool drop_cull_distances(Case& c) {
    return change_draws(c, [](Draw& draw) {
        draw.distances.cull.clear();
        return set(draw.distances.cull_count, 0U);
    });
}

bool cull_nothing(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.cull, CullMode::none); });
}

bool cull_other_faces(Case& c) {
    return change_draws(c, [](Draw& draw) {
        return set(draw.cull, draw.cull == CullMode::front  ? CullMode::back
                              : draw.cull == CullMode::back ? CullMode::front
                                                            : draw.cull);
    });
}

bool turn_faces(Case& c) {
    return change_draws(c, [](Draw& draw) {
        return set(draw.front_face, draw.front_face == FrontFace::clockwise
                                        ? FrontFace::counter_clockwise
                                        : FrontFace::clockwise);
    });
}

bool draw_what_is_discarded(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.rasterizer_discard, false); });
}

bool discard_no_value(Case& c) {
    return change_draws(c, [](Draw& draw) {
        return discards_by_value(draw) && set(draw.discard, cases::Discard::none);
    });
}

bool discard_nothing(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.discard, cases::Discard::none); });
}

bool test_late(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.early_tests, false); });
}

bool draw_to_first_layer(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.layer, 0U); });
}

bool draw_to_last_layer(Case& c) {
    return change_draws(c, [&](Draw& draw) { return set(draw.layer, c.target.layers - 1); });
}

namespace {
bool move_samples_to(Case& c, std::array<uint8_t, 2> place) {
    const auto now = cases::sample_locations(c.target);
    if (std::ranges::all_of(now, [&](const auto& location) { return location == place; })) {
        return false;
    }
    c.target.sample_locations.assign(c.target.samples, place);
    return true;
}
}  // namespace

bool move_samples_to_centre(Case& c) {
    return move_samples_to(c, {8, 8});
}

bool move_samples_to_first(Case& c) {
    return move_samples_to(c, cases::sample_locations(c.target).front());
}

bool toggle_depth_clip(Case& c) {
    return change_draws(c, [](Draw& draw) {
        draw.depth.clip = !draw.depth.clip.value_or(!draw.depth.clamp);
        return true;
    });
}

bool toggle_volume(Case& c) {
    return change_draws(c, [](Draw& draw) {
        draw.depth.negative_one_to_one = !draw.depth.negative_one_to_one;
        return true;
    });
}

bool compare_always(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.depth.compare, cases::CompareOp::always); });
}

bool write_no_depth(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.frag_depth, std::optional<cases::FragDepth>()); });
}

bool drop_bounds(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.depth.bounds, std::optional<cases::DepthBounds>()); });
}

bool narrow_bounds(Case& c) {
    return change_draws(c, [](Draw& draw) {
        if (!draw.depth.bounds) {
            return false;
        }
        draw.depth.bounds->min = std::nextafter(draw.depth.bounds->min, 2.0F);
        draw.depth.bounds->max = std::nextafter(draw.depth.bounds->max, -1.0F);
        return true;
    });
}

bool drop_bias(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.depth.bias, std::optional<cases::DepthBias>()); });
}

bool enlarge_bias(Case& c) {
    return change_draws(c, [](Draw& draw) {
        if (!draw.depth.bias) {
            return false;
        }
        draw.depth.bias->constant *= 256;
        draw.depth.bias->slope *= 256;
        return true;
    });
}

bool turn_bias(Case& c) {
    return change_draws(c, [](Draw& draw) {
        if (!draw.depth.bias) {
            return false;
        }
        draw.depth.bias->constant = -draw.depth.bias->constant;
        draw.depth.bias->slope = -draw.depth.bias->slope;
        return true;
    });
}

bool level_depths(Case& c) {
    return change_draws(c, [](Draw& draw) {
        const glm::vec4 first = draw.positions.front();
        bool is_changed = false;
        for (glm::vec4& p : draw.positions) {
            is_changed = set(p, {p.x, p.y, first.z / first.w * p.w, p.w}) || is_changed;
        }
        return is_changed;
    });
}

bool take_centroids_at_centre(Case& c) {
    return change_attributes(c, [](Attribute& a) {
        return a.auxiliary == Auxiliary::centroid && set(a.auxiliary, Auxiliary::none);
    });
}

bool take_centroids_at_samples(Case& c) {
    return change_attributes(c, [](Attribute& a) {
        return a.auxiliary == Auxiliary::centroid && set(a.auxiliary, Auxiliary::sample);
    });
}

bool ignore_perspective(Case& c) {
    return change_attributes(c, [](Attribute& a) {
        return a.interpolation == Interpolation::smooth &&
               set(a.interpolation, Interpolation::noperspective);
    });
}

bool forget_division(Case& c) {
    return change_draws(c, [](Draw& draw) {
        bool is_changed = false;
        for (Attribute& a : draw.attributes) {
            if (a.interpolation != Interpolation::smooth || a.values.empty()) {
                continue;
            }
            a.interpolation = Interpolation::noperspective;
            for (size_t v = 0; v < a.values.size(); ++v) {
                a.values[v] /= draw.positions[v].w;
            }
            is_changed = true;
        }
        return is_changed;
    });
}

bool take_other_w(Case& c) {
    constexpr float kLargest = 0x1p120F;  // and what is not finite stays as it is
    return change_draws(c, [](Draw& draw) {
        bool is_changed = false;
        for (size_t v = 0; v < draw.positions.size(); v += 3) {
            glm::vec4& p = draw.positions[v];
            if (std::fabs(p.x) < kLargest && std::fabs(p.y) < kLargest &&
                std::fabs(p.z) < kLargest && std::fabs(p.w) < kLargest) {
                p *= 2.0F;
                is_changed = true;
            }
        }
        return is_changed;
    });
}

bool level_w(Case& c) {
    return change_draws(c, [](Draw& draw) {
        const float w = draw.positions.front().w;
        bool is_changed = false;
        for (glm::vec4& p : draw.positions) {
            const glm::vec4 leveled = p * (w / p.w);
            const bool is_finite = std::isfinite(leveled.x) && std::isfinite(leveled.y) &&
                                   std::isfinite(leveled.z) && leveled.w > 0;
            is_changed = (is_finite && set(p, leveled)) || is_changed;
        }
        return is_changed;
    });
}

bool interpolate_flats(Case& c) {
    return change_attributes(c, [](Attribute& a) {
        return a.interpolation == Interpolation::flat &&
               set(a.interpolation, Interpolation::noperspective);
    });
}

bool take_other_vertex(Case& c) {
    return change_draws(c, [](Draw& draw) {
        return set(draw.provoking, draw.provoking == ProvokingVertex::first
                                       ? ProvokingVertex::last
                                       : ProvokingVertex::first);
    });
}

bool level_attributes(Case& c) {
    return change_attributes(c, [](Attribute& a) {
        bool is_changed = false;
        for (glm::vec4& value : a.values) {
            is_changed = set(value, glm::vec4(a.values.front())) || is_changed;
        }
        return is_changed;
    });
}

bool drop_probes(Case& c, Probe probe) {
    return change_attributes(
        c, [&](Attribute& a) { return a.probe == probe && set(a.probe, Probe::value); });
}

bool probe_at_corner(Case& c, Probe probe) {
    return change_attributes(c, [&](Attribute& a) {
        a.probe_offset = a.probe == probe ? std::array{-0.5F, -0.5F} : a.probe_offset;
        return a.probe == probe && set(a.probe, Probe::at_offset);
    });
}

bool turn_provoking(Case& c, ProvokingVertex convention) {
    return change_draws(c, [&](Draw& draw) {
        return draw.provoking == convention &&
               set(draw.provoking, convention == ProvokingVertex::first ? ProvokingVertex::last
                                                                        : ProvokingVertex::first);
    });
}

bool blend_nothing(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.color.blend, std::optional<cases::Blend>()); });
}

bool exchange_factors(Case& c) {
    return change_draws(c, [](Draw& draw) {
        if (!draw.color.blend) {
            return false;
        }
        const cases::Blend before = *draw.color.blend;
        std::swap(draw.color.blend->color.source, draw.color.blend->color.destination);
        std::swap(draw.color.blend->alpha.source, draw.color.blend->alpha.destination);
        return !(*draw.color.blend == before);
    });
}

bool operate_nothing(Case& c) {
    return change_draws(
        c, [](Draw& draw) { return set(draw.color.logic, std::optional<cases::LogicOp>()); });
}

bool exchange_operands(Case& c) {
    using cases::LogicOp;
    constexpr std::pair<LogicOp, LogicOp> kPairs[] = {{LogicOp::and_reverse, LogicOp::and_inverted},
                                                      {LogicOp::or_reverse, LogicOp::or_inverted},
                                                      {LogicOp::copy, LogicOp::no_op},
                                                      {LogicOp::copy_inverted, LogicOp::invert}};
    return change_draws(c, [&](Draw& draw) {
        for (const auto& [one, other] : kPairs) {
            if (draw.color.logic == one || draw.color.logic == other) {
                return set(draw.color.logic, std::optional(draw.color.logic == one ? other : one));
            }
        }
        return false;
    });
}

bool exchange_alpha(Case& c) {
    if (!c.target.color) {
        return false;
    }
    const bool is_of_integers = cases::is_integer(c.target.color->format);
    return change_draws(c, [&](Draw& draw) {
        if (!draw.color.alpha_to_coverage) {
            return false;
        }
        // Integers as an alpha of 0: nothing is drawn.
        if (is_of_integers) {
            return set(draw.rasterizer_discard, true);
        }
        if (draw.color.attribute >= 0) {
            return false;
        }
        float& alpha = draw.color.value.w;
        alpha = alpha >= 1 ? 0.0F : 1.0F;
        return true;
    });
}

bool keep_alpha(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.color.alpha_to_one, false); });
}

bool take_first_for_second(Case& c) {
    using cases::BlendFactor;
    return change_draws(c, [](Draw& draw) {
        if (!draw.color.blend || !takes_second(*draw.color.blend)) {
            return false;
        }
        constexpr BlendFactor kFirst[] = {BlendFactor::src_color, BlendFactor::one_minus_src_color,
                                          BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
        for (cases::BlendEquation* e : {&draw.color.blend->color, &draw.color.blend->alpha}) {
            for (BlendFactor* factor : {&e->source, &e->destination}) {
                if (is_second(*factor)) {
                    *factor = kFirst[static_cast<size_t>(*factor) -
                                     static_cast<size_t>(BlendFactor::src1_color)];
                }
            }
        }
        return true;
    });
}

bool blend_twice(Case& c) {
    std::vector<Draw> draws;
    for (const Draw& draw : c.draws) {
        draws.insert(draws.end(), draw.color.blend && !draw.color.logic ? 2 : 1, draw);
    }
    const bool is_changed = draws.size() > c.draws.size();
    c.draws = std::move(draws);
    return is_changed;
}

bool write_all_components(Case& c) {
    return change_draws(c, [](Draw& draw) { return set(draw.color.write_mask, uint8_t{0xf}); });
}

namespace {

bool take_from_next(Case& c, color::Taken taken) {
    return c.target.color_count() > 1 &&
           color::take_from(c, (c.target.judged_color + 1) % c.target.color_count(), taken);
}

}  // namespace

bool take_state_of_next(Case& c) {
    return take_from_next(c, color::Taken::state);
}

bool take_color_of_next(Case& c) {
    return take_from_next(c, color::Taken::color);
}

bool clear_as_next(Case& c) {
    return take_from_next(c, color::Taken::clear);
}

}  // namespace ref
