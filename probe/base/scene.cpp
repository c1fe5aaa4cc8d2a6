// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/base/scene.hpp"

#include <cmath>
#include <utility>

#include "ref/number/edge_function.hpp"

namespace probe {

Scene::Scene(std::string id, uint32_t width, uint32_t height, uint32_t samples) {
    case_.id = "probe/" + std::move(id);
    case_.target.width = width;
    case_.target.height = height;
    case_.target.samples = samples;
    case_.draws.emplace_back();
    draw().scissor = {0, 0, width, height};
    set_viewport(0, 0, static_cast<float>(width), static_cast<float>(height));
}

void Scene::set_viewport(float x, float y, float width, float height) {
    draw().viewport.x = x;
    draw().viewport.y = y;
    draw().viewport.width = width;
    draw().viewport.height = height;
}

glm::vec4 Scene::clip(const Corner& c) const {
    const cases::Viewport& v = case_.draws.front().viewport;
    const auto ndc = [](double at, float low, float size) {
        const double half = static_cast<double>(size) / 2;
        return (at - static_cast<double>(low) - half) / half;
    };
    return {static_cast<float>(ndc(c.x, v.x, v.width) * c.w),
            static_cast<float>(ndc(c.y, v.y, v.height) * c.w), static_cast<float>(c.z * c.w),
            static_cast<float>(c.w)};
}

void Scene::add(const Corner& a, const Corner& b, const Corner& c) {
    for (const Corner& corner : {a, b, c}) {
        draw().positions.push_back(clip(corner));
    }
}

cases::Attribute& Scene::attribute(const std::string& name, uint32_t components,
                                   cases::Interpolation interpolation) {
    cases::Attribute& out = draw().attributes.emplace_back();
    out.name = name;
    out.components = components;
    out.interpolation = interpolation;
    return out;
}

void add_rectangle(Scene& scene, double left, double top, double right, double bottom, double z) {
    scene.add({left, top, z}, {right, top, z}, {left, bottom, z});
    scene.add({right, top, z}, {right, bottom, z}, {left, bottom, z});
}

Scene make_squares(const std::string& id, const std::vector<glm::vec4>& values, uint32_t samples) {
    Scene scene(id, 2 * kSquaresAcross, 2 * kSquaresAcross, samples);
    scene.target().has_depth = false;
    cases::Attribute& a = scene.attribute("value", 4, cases::Interpolation::flat);
    for (size_t k = 0; k < values.size(); ++k) {
        const double x = 2.0 * static_cast<double>(k % kSquaresAcross);
        const double y = 2.0 * static_cast<double>(k / kSquaresAcross);
        add_rectangle(scene, x, y, x + 2, y + 2);
        a.values.insert(a.values.end(), 6, values[k]);
    }
    scene.draw().color.attribute = 0;
    return scene;
}

int64_t fixed(double pixels) {
    return std::llround(std::ldexp(pixels, ref::kFixedBits));
}

int side(const ref::FixedPoint& a, const ref::FixedPoint& b, const ref::FixedPoint& c,
         const ref::FixedPoint& p) {
    const int turn = ref::sign_of(ref::edge_function(a, b, c));
    int out = turn == 0 ? -1 : 1;
    for (const int edge : {ref::sign_of(ref::edge_function(a, b, p)) * turn,
                           ref::sign_of(ref::edge_function(b, c, p)) * turn,
                           ref::sign_of(ref::edge_function(c, a, p)) * turn}) {
        out = std::min(out, edge);
    }
    return out;
}

bool is_hit(const capture::Capture& picture, size_t index) {
    return picture.hits[index].x + picture.hits[index].y > 0;
}

}  // namespace probe
