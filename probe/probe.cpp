// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/probe.hpp"

#include <algorithm>
#include <array>

#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

struct Experiment {
    std::string_view name;
    void (*measure)(const Bench&);
};
constexpr auto kExperiments = std::to_array<Experiment>({
    {"grid", measure_grid},
    {"viewport", measure_viewport},
    {"ties", measure_ties},
    {"locations", measure_locations},
    {"places", measure_places},
    {"setup", measure_setup},
    {"transform", measure_transform},
    {"precision", measure_precision},
    {"clipping", measure_clipping},
    {"conservative", measure_conservative},
    {"depth", measure_depth},
    {"colors", measure_colors},
    {"blending", measure_blending},
    {"inputs", measure_inputs},
    {"derivatives", measure_derivatives},
    {"resolves", measure_resolves},
    {"blits", measure_blits},
});

size_t place_of(const Property& p) {
    const std::string section = p.section();
    return static_cast<size_t>(std::ranges::find(kSections, section, &Section::name) -
                               kSections.begin());
}

}  // namespace

std::vector<std::string_view> experiments() {
    std::vector<std::string_view> out;
    for (const Experiment& e : kExperiments) {
        out.push_back(e.name);
    }
    return out;
}

Datasheet measure(const Draw& draw, const Promises& promises,
                  const std::function<bool(std::string_view)>& takes) {
    Datasheet sheet;
    const Bench bench{draw, promises, sheet};
    for (const Experiment& e : kExperiments) {
        if (!takes || takes(e.name)) {
            e.measure(bench);
        }
    }
    std::ranges::stable_sort(
        sheet.properties, [](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
    return sheet;
}

}  // namespace probe
