// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "random_scene.hpp"

#include <algorithm>

#include "random_color.hpp"

namespace histories {

namespace {

// Where a line of samples is: a pixel below `pixels`, along one axis.
double through_samples(const Scene& scene, uint32_t pixels, bool is_x, Random& random) {
    const uint32_t pixel = random.below(pixels);
    const Place place = place_of(scene, random.below(scene.samples));
    return pixel + (is_x ? place.at_x : place.at_y);
}

// Depths that draws have in common.
const std::vector<double>& depths() {
    static const std::vector<double> all = {0.25, 0.375, 0.5, 0.625};
    return all;
}

void give_plane(const Scene& scene, Triangle& triangle, Random& random) {
    triangle.z0 = random.of(depths());
    triangle.slope = 0;
    if (random.chance(1, 4)) {
        triangle.z0 = std::max(triangle.z0, 0.375);
        triangle.slope = random.chance(1, 2) ? 1.0 / 32 : -1.0 / 32;
        triangle.x0 = through_samples(scene, scene.width - 1, true, random);
    }
}

std::vector<Triangle> random_triangles(const Scene& scene, int number, Random& random) {
    std::vector<Triangle> out;
    const auto count = 1 + random.below(random.chance(1, 2) ? 1 : 3);
    for (uint32_t i = 0; i < count; ++i) {
        Triangle triangle;
        give_plane(scene, triangle, random);
        triangle.is_reversed = random.chance(1, 2);
        if (random.chance(1, 4)) {
            const bool is_x = random.chance(1, 2);
            triangle.shape = {
                is_x ? Shape::Cut::x : Shape::Cut::y,
                through_samples(scene, is_x ? scene.width - 1 : scene.height, is_x, random),
                random.chance(1, 2)};
            if (random.chance(1, 2)) {
                Triangle other = triangle;
                triangle.pair = other.pair = 8 * number + static_cast<int>(i);
                other.shape.is_beyond = !triangle.shape.is_beyond;
                // The same order of corners on the other side is the other facing.
                other.is_reversed = triangle.is_reversed == random.chance(1, 8);
                if (random.chance(1, 3)) {
                    give_plane(scene, other, random);
                }
                out.push_back(other);
            }
        }
        out.push_back(triangle);
    }
    return out;
}

StencilFace random_face(Random& random) {
    const auto op = [&] { return static_cast<StencilOp>(random.below(8)); };
    StencilFace face{static_cast<uint8_t>(random.below(8)), op(), op(), op()};
    face.reference = random.of<uint32_t>({0, 1, 2, 3, 85, 255});
    face.compare_mask = random.of<uint32_t>({255, 255, 1, 3, 240});
    face.write_mask = random.of<uint32_t>({255, 255, 1, 3, 254, 0});
    face.compare = random.chance(1, 3) ? kAlways : face.compare;
    return face;
}

void give_tests(const Scene& scene, Draw& draw, Random& random) {
    if (scene.has_depth()) {
        draw.compare = random.chance(1, 3) ? kAlways : static_cast<uint8_t>(random.below(8));
        draw.writes_depth = random.chance(3, 4);
        if (random.chance(1, 5)) {
            const double low = random.of<double>({0, 0.25, 0.3125, 0.375});
            draw.bounds = {low, low + random.of<double>({0, 0.125, 0.1875, 0.5})};
        }
        if (random.chance(1, 6)) {
            draw.frag_depth = FragDepth{random.of(depths()), random.of(depths()),
                                        static_cast<Discard>(random.below(4))};
        }
    }
    if (scene.has_stencil && random.chance(3, 4)) {
        const StencilFace front = random_face(random);
        draw.stencil = {front, random.chance(1, 2) ? front : random_face(random)};
    }
}

void give_discard(const Scene& scene, Draw& draw, Random& random) {
    if (random.chance(1, 4)) {
        draw.discard = Discard::negative;
        draw.zero = random.below(scene.width - 1) + 0.5;
        if (scene.samples > 1 && random.chance(1, 4)) {
            draw.zero = through_samples(scene, scene.width - 1, true, random);
        }
        draw.sign = random.chance(1, 2) ? 1 : -1;
    } else if (random.chance(1, 6)) {
        draw.discard = static_cast<Discard>(1 + random.below(5));
    }
    draw.has_sample_shading = scene.samples > 1 && random.chance(1, 8);
    draw.discard_by = static_cast<int>(random.below(3));
    draw.early = random.chance(1, draw.discard == Discard::none ? 8 : 3);
    if (random.chance(1, 8)) {
        draw.sample_mask = 1 + random.below(15);
    }
    if (random.chance(1, 8) && !draw.early && draw.discard == Discard::none && !draw.frag_depth) {
        draw.shader_mask = 1 + random.below(15);
    }
}

Draw random_draw(const Scene& scene, int number, Random& random) {
    Draw draw;
    draw.triangles = random_triangles(scene, number, random);
    if (!scene.draws.empty() && random.chance(1, 4)) {
        draw.triangles = random.of(scene.draws).triangles;  // as after a depth prepass
        for (Triangle& triangle : draw.triangles) {
            triangle.pair += triangle.pair < 0 ? 0 : 100 * (number + 1);
        }
    }
    draw.clockwise = random.chance(1, 3);
    draw.culls_front = random.chance(1, 12);
    draw.culls_back = random.chance(1, 12);
    draw.rasterizer_discard = random.chance(1, 40);
    draw.layer = random.below(scene.layers);
    if (random.chance(1, 6)) {
        draw.scissor = {random.below(scene.width), random.below(scene.height),
                        1 + random.below(scene.width), 1 + random.below(scene.height)};
    }
    give_tests(scene, draw, random);
    give_discard(scene, draw, random);
    if (scene.has_instruments() && !draw.early && random.chance(1, 4)) {
        draw.query = random.chance(2, 3) ? Query::precise : Query::occlusion;
    }
    // What is clipped is held to less at profile vulkan, unless it is flat and far from its edges.
    const bool is_plain = std::all_of(
        draw.triangles.begin(), draw.triangles.end(),
        [](const Triangle& t) { return t.shape.cut == Shape::Cut::none && is_same(t.slope, 0); });
    draw.has_wide_viewport =
        !is_plain || draw.discard == Discard::negative || scene.width == 3 || random.chance(1, 2);
    return draw;
}

Scene random_target(Random& random) {
    Scene scene;
    scene.width = 2 + random.below(3);
    scene.height = 1 + random.below(2);
    scene.samples = random.of<uint32_t>({1, 1, 2, 4, 4});
    scene.layers = random.chance(1, 10) ? 2 : 1;
    scene.depth_clear = random.of<double>({0, 0.375, 0.5, 1});
    if (random.chance(1, 6)) {
        scene.depth = static_cast<DepthFormat>(random.below(3));
    }
    scene.has_stencil = random.chance(1, 2);
    scene.stencil_clear = random.of<uint32_t>({0, 0, 1, 2, 255});
    return scene;
}

// A clear of at least one of what the scene has, of the columns below `columns`.
Draw random_clear(const Scene& scene, uint32_t columns, Random& random) {
    Draw draw;
    draw.clear.emplace();
    Clear& clear = *draw.clear;
    do {
        clear.has_color = !scene.colors.empty() && random.chance(1, 2);
        if (scene.has_depth() && random.chance(1, 2)) {
            clear.depth = random.of<double>({0, 0.25, 0.375, 0.5, 1});
        }
        if (scene.has_stencil && random.chance(1, 2)) {
            clear.stencil = random.of<uint32_t>({0, 1, 2, 3, 85, 255});
        }
    } while (!clear.has_color && !clear.depth && !clear.stencil);
    const uint32_t x = random.below(columns), y = random.below(scene.height);
    draw.scissor = {x, y, 1 + random.below(columns - x), 1 + random.below(scene.height - y)};
    draw.layer = random.below(scene.layers);
    give_colors(scene, draw, random);
    return draw;
}

// `is_control_first`: the draws behind it leave its column, the last one, alone.
Scene scene_of_draws(Random& random, bool& is_control_first) {
    Scene scene = random_target(random);
    give_targets(scene, random);
    const uint32_t count = 1 + random.below(4);
    for (uint32_t number = 0; number < count; ++number) {
        scene.draws.push_back(random_draw(scene, static_cast<int>(number), random));
        give_colors(scene, scene.draws.back(), random);
    }
    Draw control;
    control.has_wide_viewport = true;
    control.triangles.push_back({});
    control.triangles[0].z0 = 0.875;
    control.scissor = {scene.width - 1, 0, 1, scene.height};
    give_control_colors(scene, control);
    is_control_first = !random.chance(1, 2);
    if (!is_control_first) {
        scene.draws.push_back(control);
        return scene;
    }
    for (Draw& draw : scene.draws) {  // the others leave its column alone
        if (!draw.scissor || (*draw.scissor)[0] + 1 >= scene.width) {
            draw.scissor = {0, 0, scene.width - 1, scene.height};
        }
        (*draw.scissor)[2] = std::min((*draw.scissor)[2], scene.width - 1 - (*draw.scissor)[0]);
    }
    scene.draws.insert(scene.draws.begin(), control);
    return scene;
}

}  // namespace

Scene random_scene(Random& random) {
    bool is_control_first = false;
    Scene scene = scene_of_draws(random, is_control_first);
    while (scene.draws.size() < kMaxDraws && random.chance(1, 3)) {
        const auto draws = static_cast<uint32_t>(scene.draws.size());
        const Draw clear = random_clear(scene, scene.width - (is_control_first ? 1 : 0), random);
        // Behind a control that comes first, before one that comes last.
        const uint32_t at = (is_control_first ? 1 : 0) + random.below(draws);
        scene.draws.insert(scene.draws.begin() + at, clear);
    }
    return scene;
}

}  // namespace histories
