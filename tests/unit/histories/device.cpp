// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "fragment_depth.hpp"

namespace histories {

namespace {

using cases::Profile;

bool asked(uint8_t passing, uint8_t possible, const Pick& pick) {
    if ((passing & possible) == 0 || (possible & ~passing) == 0) {
        return (passing & possible) != 0;
    }
    return pick(2) != 0;
}

uint8_t relation(uint32_t a, uint32_t b) {
    return a < b ? kLess : a > b ? kGreater : kEqual;
}

uint32_t operated(StencilOp op, uint32_t stored, uint32_t reference) {
    switch (op) {
        case StencilOp::keep:
            return stored;
        case StencilOp::zero:
            return 0;
        case StencilOp::replace:
            return reference;
        case StencilOp::inc:
            return std::min(stored + 1, 255U);
        case StencilOp::dec:
            return stored == 0 ? 0 : stored - 1;
        case StencilOp::invert:
            return ~stored & 255;
        case StencilOp::inc_wrap:
            return (stored + 1) & 255;
        case StencilOp::dec_wrap:
            return (stored - 1) & 255;
    }
    return stored;
}

bool is_of_pixel(Discard which, const Place& place) {
    return (which == Discard::odd_columns && place.x % 2 == 1) ||
           (which == Discard::odd_rows && place.y % 2 == 1) ||
           (which == Discard::checker && (place.x + place.y) % 2 == 1);
}

// Where the shader's inputs are evaluated, if the device does as all do.
double evaluated_at(const Draw& draw, const Place& place) {
    return draw.has_sample_shading ? place.at_x : place.x + 0.5;
}

double attribute_at(const Draw& draw, const Place& place) {
    return draw.discard == Discard::negative ? draw.sign * (evaluated_at(draw, place) - draw.zero)
                                             : 1;
}

// With several samples the text says only that inputs are evaluated somewhere in the pixel; with
// sample shading devices of all profiles do so at its centre or at the sample.
bool is_place_free(const Scene& scene, const Draw& draw, const Freedom& freedom) {
    return scene.samples > 1 && !freedom.is_device && draw.discard == Discard::negative &&
           (freedom.profile < Profile::direct3d || draw.has_sample_shading);
}

// The fragments of one sample, and what is stored there.
class Sample {
  public:
    Sample(const Scene& scene, const Place& place, const Freedom& freedom, const Kept& kept,
           const Pick& pick, const Fault& fault)
        : scene_(scene), place_(place), freedom_(freedom), kept_(kept), pick_(pick), fault_(fault) {
        depth_ = {scene.depth_clear, stored_depth(scene, scene.depth_clear), true, nullptr,
                  nullptr};
        seen_.stencil = scene.stencil_clear;
        if (!scene.colors.empty()) {
            seen_.color = clear_codes(scene.colors[scene.judged]);
        }
    }

    void draw(size_t number) {
        if (scene_.draws[number].clear && !is_wrong(Wrong::is_lost, number)) {
            clear(number);
        }
        for (size_t t = 0; t < scene_.draws[number].triangles.size(); ++t) {
            draw_triangle(number, t);
        }
    }

    Seen seen() const {
        Seen seen = seen_;
        seen.is_color_large = seen.is_color_large ||
                              (!scene_.colors.empty() &&
                               is_color_large(scene_.colors[scene_.judged].about(), seen.color));
        seen.depth = freedom_.is_device ? depth_.computed : depth_.number;
        return seen;
    }

  private:
    const Scene& scene_;
    const Place& place_;
    const Freedom& freedom_;
    const Kept& kept_;
    const Pick& pick_;
    const Fault& fault_;
    Depth depth_;
    Seen seen_;
    // Whether what lies beyond an edge has the sample on it: of all triangles that meet there, or
    // of a pair.
    std::map<std::pair<bool, double>, bool> is_beyond_owner_;
    std::map<int, bool> is_beyond_of_pair_;

    bool is_wrong(Wrong what, size_t number) const {
        return fault_.what == what && fault_.draw == number;
    }

    bool is_culled(size_t number, const Triangle& triangle) const {
        const Draw& draw = scene_.draws[number];
        return !is_wrong(Wrong::cull_ignored, number) &&
               (is_front(draw, triangle) ? draw.culls_front : draw.culls_back);
    }

    // Whether a triangle that is none of the pair ends at the pair's edge: of three the judge holds
    // no two to each other.
    bool meets_others(const Triangle& triangle) const {
        return std::ranges::any_of(scene_.draws, [&](const Draw& draw) {
            return std::ranges::any_of(draw.triangles, [&](const Triangle& t) {
                return t.shape.cut == triangle.shape.cut && t.pair != triangle.pair &&
                       is_same(t.shape.edge, triangle.shape.edge);
            });
        });
    }

    // Both of the pair are drawn, and the edge has the same ends in all coordinates.
    bool is_pair_held(size_t number, const Triangle& triangle) const {
        if (meets_others(triangle)) {
            return false;
        }
        int drawn = 0;
        for (const Triangle& t : scene_.draws[number].triangles) {
            const bool is_one =
                t.pair == triangle.pair && !is_culled(number, t) &&
                is_same(depth_at(t, t.shape.edge), depth_at(triangle, t.shape.edge)) &&
                (t.shape.cut == Shape::Cut::x || is_same(t.slope, triangle.slope));
            drawn += is_one ? 1 : 0;
        }
        return drawn == 2;
    }

    template <class Key>
    bool first_pick(std::map<Key, bool>& of, const Key& key) const {
        const auto found = of.find(key);
        if (found == of.end()) {
            return of.emplace(key, pick_(2) != 0).first->second;
        }
        return found->second;
    }

    bool covers(size_t number, const Triangle& triangle) {
        const Shape& shape = triangle.shape;
        if (shape.cut == Shape::Cut::none) {
            return true;
        }
        const double at = shape.cut == Shape::Cut::x ? place_.at_x : place_.at_y;
        if (!is_same(at, shape.edge)) {
            return (at > shape.edge) == shape.is_beyond;
        }
        // What lies beyond has a left edge there, or a top one.
        if (freedom_.profile == Profile::direct3d) {
            return shape.is_beyond;
        }
        // A device answers once for all that meet at an edge, and the text asks that of pairs.
        if (freedom_.is_device) {
            const std::pair<bool, double> edge(shape.cut == Shape::Cut::x, shape.edge);
            return first_pick(is_beyond_owner_, edge) == shape.is_beyond;
        }
        if (triangle.pair >= 0 && is_pair_held(number, triangle)) {
            return first_pick(is_beyond_of_pair_, triangle.pair) == shape.is_beyond;
        }
        return pick_(2) != 0;
    }

    // Whether the fragment shader keeps the fragment.
    bool is_kept(size_t number, size_t t) {
        const Draw& draw = scene_.draws[number];
        if (is_wrong(Wrong::discard_ignored, number)) {
            return true;
        }
        const bool is_front_face = is_front(draw, draw.triangles[t]);
        switch (draw.discard) {
            case Discard::none:
                return !is_wrong(Wrong::discards_all, number);
            case Discard::front:
                return !is_front_face;
            case Discard::back:
                return is_front_face;
            case Discard::negative:
                if (!is_sign_open(scene_, draw, place_, freedom_)) {
                    return attribute_at(draw, place_) > 0;
                }
                return is_shared(scene_, draw, freedom_) ? kept_[number][t] : pick_(2) != 0;
            default:
                return !is_of_pixel(draw.discard, place_);
        }
    }

    bool survives_alpha(const Draw& draw) {
        if (!draw.alpha_to_coverage || scene_.colors.empty() ||
            scene_.colors[0].about().kind == ColorFormat::Kind::integer) {
            return true;
        }
        const double alpha = draw.colors[0].value[3];
        const bool is_end = alpha <= 0 || alpha >= 1;
        const bool is_decided = freedom_.profile == Profile::direct3d && scene_.samples > 1;
        if (is_end && (freedom_.is_device || (is_decided && !draw.shader_mask))) {
            return alpha > 0;
        }
        return pick_(2) != 0;
    }

    Depth depth_of(const Draw& draw, const Triangle& triangle) const {
        if (draw.frag_depth && !draw.early) {
            const FragDepth& written = *draw.frag_depth;
            const double number =
                is_of_pixel(written.where, place_) ? written.other : written.value;
            return {number, stored_depth(scene_, number), true, nullptr, nullptr};
        }
        return computed_depth(scene_, draw, triangle, place_, freedom_);
    }

    bool is_within_bounds(size_t number) {
        const Draw& draw = scene_.draws[number];
        if (!draw.bounds || is_wrong(Wrong::bounds_ignored, number)) {
            return true;
        }
        const auto bound = [&](double b) {
            return Depth{b, stored_depth(scene_, b), true, nullptr, nullptr};
        };
        const Depth low = bound((*draw.bounds)[0]), high = bound((*draw.bounds)[1]);
        return asked(kEqual | kGreater, relations(scene_, freedom_, depth_, low), pick_) &&
               asked(kEqual | kLess, relations(scene_, freedom_, depth_, high), pick_);
    }

    // Depth bounds, stencil and depth: whether the fragment passes them all.
    bool passes(size_t number, const Triangle& triangle) {
        const Draw& draw = scene_.draws[number];
        if (scene_.has_depth() && !is_within_bounds(number)) {
            return false;
        }
        const bool is_front_face =
            is_front(draw, triangle) != is_wrong(Wrong::face_exchanged, number);
        StencilFace face;  // of a draw that counts
        face.pass = is_front_face ? StencilOp::inc_wrap : StencilOp::dec_wrap;
        if (draw.stencil) {
            face = (*draw.stencil)[is_front_face ? 0 : 1];
        }
        const auto operate = [&](StencilOp op) {
            if (!is_wrong(Wrong::stencil_kept, number)) {
                const uint32_t mask = face.write_mask & 255;
                seen_.stencil =
                    (seen_.stencil & ~mask) | (operated(op, seen_.stencil, face.reference) & mask);
            }
        };
        if (scene_.has_stencil && !is_wrong(Wrong::stencil_ignored, number)) {
            const uint32_t mask = face.compare_mask & 255;
            if ((relation(face.reference & mask, seen_.stencil & mask) & face.compare) == 0) {
                operate(face.fail);
                return false;
            }
        }
        const Depth depth = depth_of(draw, triangle);
        bool is_passed = true;
        if (scene_.has_depth() && !is_wrong(Wrong::depth_ignored, number)) {
            const auto compare = static_cast<uint8_t>(
                is_wrong(Wrong::depth_reversed, number) ? ~draw.compare & 7 : draw.compare);
            is_passed = asked(compare, relations(scene_, freedom_, depth, depth_), pick_);
        }
        if (scene_.has_stencil && !is_wrong(Wrong::stencil_ignored, number)) {
            operate(is_passed ? face.pass : face.depth_fail);
        }
        if (is_passed && draw.writes_depth != is_wrong(Wrong::depth_kept, number)) {
            depth_ = depth;
        }
        return is_passed;
    }

    void draw_triangle(size_t number, size_t t) {
        const Draw& draw = scene_.draws[number];
        const Triangle& triangle = draw.triangles[t];
        if (draw.rasterizer_discard || draw.layer != place_.layer || is_culled(number, triangle) ||
            is_wrong(Wrong::is_lost, number)) {
            return;
        }
        if (!covers(number, triangle)) {
            return;
        }
        if (!is_in_scissor(draw)) {
            return;
        }
        const bool has_masks = !is_wrong(Wrong::mask_ignored, number);
        if (has_masks && (draw.sample_mask >> place_.sample & 1) == 0) {
            return;
        }
        const bool kept = is_kept(number, t);
        const bool is_early = draw.early && !is_wrong(Wrong::early_as_late, number);
        if (!is_early && !kept) {
            return;
        }
        if (has_masks && draw.shader_mask && (*draw.shader_mask >> place_.sample & 1) == 0) {
            return;
        }
        if (!survives_alpha(draw)) {
            return;
        }
        if (!passes(number, triangle)) {
            return;
        }
        ++seen_.counted[number];
        if (kept) {
            write(number, t);
            if (is_wrong(Wrong::written_twice, number)) {
                write(number, t);
            }
        }
    }

    // No test, mask or blending applies, and nothing counts it.
    void clear(size_t number) {
        const Draw& draw = scene_.draws[number];
        if (draw.layer != place_.layer || !is_in_scissor(draw)) {
            return;
        }
        if (draw.clear->has_color) {
            seen_.color = clear_codes(
                {scene_.colors[scene_.judged].format, draw.colors[scene_.judged].value});
        }
        if (draw.clear->depth) {
            depth_ = {*draw.clear->depth, stored_depth(scene_, *draw.clear->depth), true, nullptr,
                      nullptr};
        }
        seen_.stencil = draw.clear->stencil.value_or(seen_.stencil);
    }

    bool is_in_scissor(const Draw& draw) const {
        if (!draw.scissor) {
            return true;
        }
        const auto& [x, y, width, height] = *draw.scissor;
        return place_.x >= x && place_.x < x + width && place_.y >= y && place_.y < y + height;
    }

    void write(size_t number, size_t t) {
        const Draw& draw = scene_.draws[number];
        const Triangle& triangle = draw.triangles[t];
        ++(is_front(draw, triangle) != is_wrong(Wrong::face_exchanged, number) ? seen_.front
                                                                               : seen_.back);
        seen_.draw = static_cast<int>(number);
        seen_.triangle = static_cast<int>(t);
        seen_.is_at_sample = draw.has_sample_shading;
        seen_.z = depth_at(triangle, evaluated_at(draw, place_));
        seen_.z_free = scene_.samples > 1 ? std::abs(triangle.slope) : 0;
        seen_.a = attribute_at(draw, place_);
        seen_.a_free = is_place_free(scene_, draw, freedom_) ? 1 : 0;
        if (!scene_.colors.empty()) {
            ColorState state = draw.colors[scene_.judged];
            if (is_wrong(Wrong::blend_ignored, number)) {
                state.blend.reset();
            }
            seen_.color = written(scene_.colors[scene_.judged].about(), seen_.color, draw, state);
        }
    }
};

}  // namespace

bool is_sign_open(const Scene& scene, const Draw& draw, const Place& place,
                  const Freedom& freedom) {
    if (is_place_free(scene, draw, freedom) && std::abs(place.x + 0.5 - draw.zero) < 0.5) {
        return true;
    }
    return is_same(attribute_at(draw, place), 0);
}

// Where the text lets invocations be repeated, a device may decide anew for each sample: to be sure
// of what is wrong, at practice too; a device that does so is one of profile vulkan.
bool is_shared(const Scene& scene, const Freedom& freedom) {
    return scene.samples == 1 || freedom.profile == Profile::direct3d ||
           (freedom.is_device && freedom.profile == Profile::practice);
}

bool is_shared(const Scene& scene, const Draw& draw, const Freedom& freedom) {
    return is_shared(scene, freedom) && (scene.samples == 1 || !draw.has_sample_shading);
}

Seen draw_sample(const Scene& scene, const Place& place, const Freedom& freedom, const Kept& kept,
                 const Pick& pick, const Fault& fault) {
    Sample sample(scene, place, freedom, kept, pick, fault);
    for (size_t number = 0; number < scene.draws.size(); ++number) {
        sample.draw(number);
    }
    return sample.seen();
}

}  // namespace histories
