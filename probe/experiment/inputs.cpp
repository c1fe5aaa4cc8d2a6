// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Constants that stay themselves or do not, from where planes are measured, and whether a triangle
// has the same bits beside other attachments.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "probe/base/scene.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/triangle.hpp"

namespace probe {

namespace {

constexpr uint32_t kSide = 64, kCell = 16, kAcross = kSide / kCell;

// Triangles off the grid; w differs if `is_projected`.
Scene make_scene(const std::string& id, bool is_projected, uint32_t seed) {
    Scene scene(id, kSide, kSide);
    Dice dice(seed);
    for (uint32_t cell = 0; cell < kAcross * kAcross; ++cell) {
        add_triangle(scene, 32, [&](size_t) {
            return Corner{(cell % kAcross) * kCell + dice.real(0, kCell),
                          (cell / kAcross) * kCell + dice.real(0, kCell), dice.real(0, 1),
                          is_projected ? dice.real(1, 8) : 1};
        });
    }
    return scene;
}

struct Constant {
    const char* id;
    const char* question;
    cases::Interpolation interpolation;
    bool is_projected;
};
constexpr auto kConstants = std::to_array<Constant>({
    {"inputs.constant.noperspective", "Noperspective inputs that are the same at all vertices",
     cases::Interpolation::noperspective, false},
    {"inputs.constant.smooth", "Smooth inputs that are the same at all vertices, with one w",
     cases::Interpolation::smooth, false},
    {"inputs.constant.projected", "Smooth inputs that are the same at all vertices, with three w",
     cases::Interpolation::smooth, true},
});

void measure_constant(const Bench& bench, const Constant& q) {
    Finding property(bench, q.id, q.question,
                     "triangles off the grid, each with one number at its three vertices");
    Scene scene = make_scene(q.id, q.is_projected, 101);
    scene.target().has_depth = false;
    cases::Attribute& a = scene.attribute("constant", 1, q.interpolation);
    Dice dice(103);
    for (size_t t = 0; 3 * t < scene.draw().positions.size(); ++t) {
        a.values.insert(a.values.end(), 3,
                        glm::vec4(static_cast<float>(dice.real(-1, 1)), 0, 0, 0));
    }
    const std::vector<glm::vec4> values = a.values;
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    uint64_t exact = 0;
    uint64_t all = 0;
    double largest = 0;  // relative
    for (size_t k = 0; k < picture->sample_count(); ++k) {
        if (is_hit(*picture, k)) {
            const float value = values[picture->writers[k].provoking_vertex].x;
            const float got = picture->attributes[0][k].x;
            ++all;
            exact += std::bit_cast<uint32_t>(value) == std::bit_cast<uint32_t>(got) ? 1U : 0U;
            largest = std::max(
                largest, std::fabs(static_cast<double>(got) / static_cast<double>(value) - 1));
        }
    }
    if (all == 0) {
        property.why = "no fragment was drawn";
        return;
    }
    property.answer = exact == all ? "stay what they are, bit for bit" : "are rounded";
    property.agree = all;
    property.figures = {
        {"exact", 100 * static_cast<double>(exact) / static_cast<double>(all), "% of fragments"},
        {"largest error", largest * 0x1p24, "2^-24 of the number"}};
}

// The same small triangle near the framebuffer's origin and far from it: planes whose constant term
// belongs to the origin lose bits with the distance.
void measure_anchor(const Bench& bench) {
    Finding property(
        bench, "setup.anchor", "From where planes of noperspective inputs are measured",
        "the same small triangles near the framebuffer's origin and 1,000 pixels from it: where "
        "errors grow with the distance, planes are measured from the origin");
    constexpr uint32_t kWide = 1024;
    const auto error = [&](double left, std::string& why) {
        Scene scene(fmt::format("anchor-{}", left), kWide, 16);
        scene.target().has_depth = false;
        cases::Attribute input;
        input.name = "linear";
        input.interpolation = cases::Interpolation::noperspective;
        Dice dice(107);
        std::vector<std::array<double, 3>> values;
        std::vector<Points> points;
        for (int cell = 0; cell < 4; ++cell) {
            Points p;
            do {
                for (Point& at : p) {
                    at = {left + static_cast<double>(dice.whole(0, 3 * 16)) / 16,
                          cell * 4 + static_cast<double>(dice.whole(0, 4 * 16)) / 16};
                }
            } while (std::fabs(doubled_area(p)) < 4);
            scene.add({p[0].x, p[0].y}, {p[1].x, p[1].y}, {p[2].x, p[2].y});
            std::array<double, 3> v{};
            for (double& one : v) {
                input.values.emplace_back(static_cast<float>(dice.real(-1, 1)), 0, 0, 0);
                one = static_cast<double>(input.values.back().x);
            }
            values.push_back(v);
            points.push_back(p);
        }
        scene.draw().attributes = {input};
        const Drawn drawn = bench.draw_one(scene.take());
        why = drawn.why_not;
        double largest = 0;
        for (size_t k = 0; drawn.picture && k < drawn.picture->sample_count(); ++k) {
            if (is_hit(*drawn.picture, k)) {
                const size_t t = drawn.picture->writers[k].provoking_vertex / 3;
                const Point at{static_cast<double>(k % kWide) + 0.5,
                               static_cast<double>(k / kWide) + 0.5};
                const double exact = linear(barycentrics(points[t], at), values[t]);
                ++property.agree;
                largest = std::max(
                    largest,
                    std::fabs(static_cast<double>(drawn.picture->attributes[0][k].x) - exact));
            }
        }
        return largest;
    };
    const double near = error(0, property.why);
    const double far = error(1000, property.why);
    property.figures = {{"largest error near", near * 0x1p24, "2^-24"},
                        {"largest error far", far * 0x1p24, "2^-24"}};
    if (property.agree == 0) {
        property.figures.clear();
        property.why = property.why.empty() ? "no fragment was drawn" : property.why;
    } else if (far > 32 * std::max(near, 0x1p-25)) {
        property.answer = "the framebuffer's origin";
    } else if (far < 8 * std::max(near, 0x1p-25)) {
        property.answer = "the triangle";
    } else {
        property.why = "errors grow with the distance, but by less than such planes' do";
    }
}

struct Beside {
    const char* id;
    const char* question;
    void (*change)(cases::Case& c);
};
constexpr auto kBesides = std::to_array<Beside>({
    {"inputs.beside.color", "A triangle's bits beside a colour target",
     [](cases::Case& c) { c.target.color = cases::ColorTarget{}; }},
    {"inputs.beside.depth", "A triangle's bits without a depth target",
     [](cases::Case& c) { c.target.has_depth = false; }},
    {"inputs.beside.d16", "A triangle's bits beside D16 instead of D32",
     [](cases::Case& c) { c.target.depth_format = cases::DepthFormat::d16_unorm; }},
    {"inputs.beside.inputs", "A triangle's bits beside another input",
     [](cases::Case& c) {
         cases::Attribute other = c.draws.front().attributes.front();
         other.name = "other";
         c.draws.front().attributes.push_back(other);
     }},
    {"inputs.beside.size", "A triangle's bits in a larger target",
     [](cases::Case& c) {
         c.target.width *= 2;
         c.target.height *= 2;
     }},
});

void measure_beside(const Bench& bench) {
    const auto make = [](const std::string& id) {
        Scene scene = make_scene(id, true, 109);
        cases::Attribute& a = scene.attribute("input", 2);
        Dice dice(113);
        for (size_t v = 0; v < scene.draw().positions.size(); ++v) {
            a.values.emplace_back(static_cast<float>(dice.real(-1, 1)),
                                  static_cast<float>(dice.real(-1, 1)), 0, 0);
        }
        return scene.take();
    };
    const Drawn base = bench.draw_one(make("beside"));
    for (const Beside& q : kBesides) {
        Finding property(bench, q.id, q.question,
                         "the same triangles drawn twice, their inputs compared bit for bit");
        cases::Case changed = make(q.id);
        q.change(changed);
        const uint32_t width = changed.target.width;
        const Drawn other = bench.draw_one(std::move(changed));
        if (!base.picture || !other.picture) {
            property.why = base.picture ? other.why_not : base.why_not;
            continue;
        }
        uint64_t same = 0;
        uint64_t all = 0;
        for (uint32_t y = 0; y < kSide; ++y) {
            for (uint32_t x = 0; x < kSide; ++x) {
                const size_t a = size_t{y} * kSide + x;
                const size_t b = size_t{y} * width + x;
                if (is_hit(*base.picture, a) || is_hit(*other.picture, b)) {
                    ++all;
                    same +=
                        is_hit(*base.picture, a) && is_hit(*other.picture, b) &&
                                base.picture->attributes[0][a] == other.picture->attributes[0][b]
                            ? 1U
                            : 0U;
                }
            }
        }
        if (all == 0) {
            property.why = "no fragment was drawn";
            continue;
        }
        property.answer = same == all ? "the same" : "other bits";
        property.agree = same == all ? all : all - same;
        property.contradict = same == all ? 0 : same;
    }
}

}  // namespace

void measure_inputs(const Bench& bench) {
    measure_anchor(bench);
    for (const Constant& q : kConstants) {
        measure_constant(bench, q);
    }
    measure_beside(bench);
}

}  // namespace probe
