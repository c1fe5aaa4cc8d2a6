// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The triangles of a case at one profile: what all of its samples are judged from.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/expectation/discards.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/narrowing.hpp"
#include "ref/position/limits.hpp"

namespace ref {

struct Scene {
    // Keeps a reference to the case. `is_told`: as of set_up.
    Scene(const cases::Case& the_case, const Limits& the_limits, cases::Profile the_profile,
          bool is_told);
    Scene(const Scene&) = delete;  // its parts refer to each other
    Scene& operator=(const Scene&) = delete;

    const cases::Case& c;
    Limits limits;
    cases::Profile profile;
    std::vector<cases::Triangle> triangles;
    TriangleSetups setups;
    // The samples that the triangles must or may cover, in drawing order; y counts the rows of the
    // stacked layers.
    std::vector<fast::Span> spans;
    ValueDiscards discards;
    std::optional<DepthTest> depth;  // if the case needs one
    Narrowing narrowing;
};

// The expectation of a scene's case; an onlooker sees each sample as it is judged.
Expectation expect(Scene& scene, Onlooker* onlooker = nullptr);

// What OnDemand asks.
std::function<const Expectation&(size_t)> expect_on_demand(Scene& scene);

}  // namespace ref
