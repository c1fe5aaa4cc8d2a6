// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How far the numbers of fragments are from the exact ones, in budgets of docs/precision.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "cases/model/sample.hpp"
#include "probe/base/scene.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/triangle.hpp"
#include "ref/value/reference.hpp"

namespace probe {

namespace {

constexpr uint32_t kSide = 128, kCell = 32, kAcross = kSide / kCell;
constexpr size_t kMostSamples = 3000;

// The errors of one quantity.
struct Errors {
    std::vector<double> budgets;  // (got - exact) / budget
    double largest = 0;           // |got - exact|
    double magnitude = 0;         // of the exact numbers
};

struct Question {
    const char* id;
    const char* name;
    ref::QuantityId (*quantity)();
};
constexpr auto kQuestions = std::to_array<Question>({
    {"precision.smooth", "smooth inputs", [] { return ref::QuantityId::of_attribute(0, 0); }},
    {"precision.noperspective", "noperspective inputs",
     [] { return ref::QuantityId::of_attribute(1, 0); }},
    {"precision.depth", "the depth that is stored in D32", [] { return ref::QuantityId{}; }},
    {"precision.frag_coord_z", "FragCoord.z", [] { return ref::QuantityId::of_frag_coord(2); }},
    {"precision.frag_coord_w", "FragCoord.w", [] { return ref::QuantityId::of_frag_coord(3); }},
});
constexpr auto kBarycentrics = std::to_array<Question>({
    {"precision.barycentric", "gl_BaryCoordEXT",
     [] { return ref::QuantityId::of_attribute(0, 0); }},
    {"precision.barycentric_linear", "gl_BaryCoordNoPerspEXT",
     [] { return ref::QuantityId::of_attribute(1, 0); }},
});

// Triangles on the 1/16 grid, so that snapped and unsnapped positions are the same.
Scene make_scene(const std::string& id) {
    Scene scene(id, kSide, kSide);
    Dice dice(59);
    for (uint32_t cell = 0; cell < kAcross * kAcross; ++cell) {
        add_triangle(scene, 256, [&](size_t) {
            // Powers of two as w leave positions exact.
            return Corner{
                (cell % kAcross) * kCell + static_cast<double>(dice.whole(0, 16 * kCell)) / 16,
                (cell / kAcross) * kCell + static_cast<double>(dice.whole(0, 16 * kCell)) / 16,
                dice.real(0, 1), std::ldexp(1.0, static_cast<int>(dice.whole(0, 3)))};
        });
    }
    return scene;
}

void add_inputs(Scene& scene) {
    Dice dice(61);
    const size_t count = scene.draw().positions.size();
    for (const auto mode : {cases::Interpolation::smooth, cases::Interpolation::noperspective}) {
        cases::Attribute& a = scene.attribute("input", 1, mode);
        for (size_t v = 0; v < count; ++v) {
            a.values.emplace_back(static_cast<float>(dice.real(-1, 1)), 0, 0, 0);
        }
    }
}

ref::FragmentValues values_at(const capture::Capture& picture, size_t index) {
    ref::FragmentValues out;
    out.frag_coord = picture.frag_coord[index];
    out.depth = picture.depth[index];
    for (uint32_t a = 0; a < picture.attribute_count; ++a) {
        out.attributes.at(a) = picture.attributes.at(a)[index];
    }
    return out;
}

std::map<std::string, Errors> errors_of(const cases::Case& c, const capture::Capture& picture,
                                        const ref::Limits& limits) {
    ref::ValueReference reference(c, limits, cases::Profile::direct3d);
    std::map<std::string, Errors> out;
    size_t hits = 0;
    for (size_t k = 0; k < picture.sample_count(); ++k) {
        hits += is_hit(picture, k) ? 1U : 0U;
    }
    const size_t step = std::max<size_t>(hits / kMostSamples, 1);
    size_t seen = 0;
    for (size_t k = 0; k < picture.sample_count(); ++k) {
        if (!is_hit(picture, k) || seen++ % step != 0) {
            continue;
        }
        const ref::FragmentValues got = values_at(picture, k);
        const uint32_t t = picture.writers[k].provoking_vertex / 3;
        for (const ref::ExpectedValue& v : reference.expected(t, cases::sample_at(c.target, k))) {
            if (v.part.empty() && v.budget > 0) {
                Errors& e = out[to_text(v.quantity)];
                const double error =
                    static_cast<double>(ref::number_of(got, v.quantity)) - v.nearest;
                e.budgets.push_back(error / v.budget);
                e.largest = std::max(e.largest, std::fabs(error));
                e.magnitude = std::max(e.magnitude, std::fabs(v.nearest));
            }
        }
    }
    return out;
}

void settle(Property& property, Errors errors) {
    std::vector<double>& all = errors.budgets;
    if (all.empty()) {
        property.why = "no fragment has such a number";
        return;
    }
    std::ranges::sort(all);
    double sum = 0;
    double squares = 0;
    for (const double e : all) {
        sum += e;
        squares += e * e;
        // Two budgets are accepted in a run (docs/precision.md).
        (std::fabs(e) <= 2 ? property.agree : property.contradict) += 1;
    }
    const auto n = static_cast<double>(all.size());
    const double largest = std::max(std::fabs(all.front()), std::fabs(all.back()));
    const double bits = errors.largest > 0 ? -std::log2(errors.largest / errors.magnitude) : 24;
    property.answer = fmt::format("{:.0f} bits", std::floor(std::min(bits, 24.0)));
    property.figures = {{"bits", std::min(bits, 24.0), ""},
                        {"largest error", largest, "budgets"},
                        {"mean error", sum / n, "budgets"},
                        {"root of the mean square", std::sqrt(squares / n), "budgets"}};
    property.picture.kind = PictureKind::curve;
    property.picture.axes = {"share of the fragments, by their error", "error, budgets"};
    for (size_t k = 0; k <= 32; ++k) {
        const size_t at = std::min(all.size() - 1, k * all.size() / 32);
        property.picture.points.push_back({static_cast<double>(k) / 32, all[at]});
    }
}

void measure(const Bench& bench, Scene scene, std::span<const Question> questions) {
    const Drawn drawn = bench.draw_one(scene.get());
    std::map<std::string, Errors> errors;
    if (drawn.picture) {
        errors = errors_of(scene.get(), *drawn.picture, bench.promises.limits);
    }
    for (const Question& q : questions) {
        Finding property(
            bench, q.id, fmt::format("Bits of {} that are right", q.name),
            "triangles on the 1/16 grid with w of 1 to 8, against exact numbers; bits are of the "
            "largest number; the observations are fragments, and agree within two budgets");
        if (!drawn.picture) {
            property.why = drawn.why_not;
            continue;
        }
        settle(property, errors[to_text(q.quantity())]);
    }
}

}  // namespace

void measure_precision(const Bench& bench) {
    Scene plain = make_scene("precision");
    add_inputs(plain);
    measure(bench, std::move(plain), kQuestions);
    Scene barycentric = make_scene("precision-barycentric");
    for (const auto mode : {cases::Interpolation::smooth, cases::Interpolation::noperspective}) {
        barycentric.attribute("barycentric", 3, mode).source = cases::Source::barycentric;
    }
    measure(bench, std::move(barycentric), kBarycentrics);
}

}  // namespace probe
