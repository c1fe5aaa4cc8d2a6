// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The suite, delivered plane by plane as the reference draws it: no plane alone gives a false
// alarm, and no plane of an empty picture ever passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "cases/load/loader.hpp"
#include "diff/delivered.hpp"
#include "folders.hpp"
#include "rasterizers/captures.hpp"
#include "run/order.hpp"

namespace run {
namespace {

using capture::Delivered;
using capture::HitDetail;

constexpr uint32_t kParts = 150;  // one leaf in so many, by a hash of its id

std::vector<cases::Case> some_cases() {
    std::vector<cases::Case> out;
    for (cases::Case& c : cases::load_suite(test_support::source_dir() + "/cases/suite").cases) {
        uint64_t vertices = 0;
        for (const cases::Draw& d : c.draws) {
            vertices += d.indices ? d.indices->size() : d.positions.size();
        }
        const uint64_t samples = uint64_t{c.target.width} * c.target.height * c.target.samples;
        if (!c.blit && run::shard_of(c.id, kParts) == 1 && samples <= 1U << 12U &&
            vertices <= 1U << 12U) {
            out.push_back(std::move(c));
        }
    }
    return out;
}

// Each plane alone, and all together.
std::map<std::string, Delivered> deliveries(const capture::Capture& capture, bool has_color) {
    Delivered coverage, total, faces, writer, depth, color, all;
    coverage.detail = HitDetail::coverage;
    total.detail = HitDetail::total;
    faces.detail = HitDetail::faces;
    for (const glm::vec4& h : capture.hits) {
        const auto front = static_cast<uint32_t>(h.x), back = static_cast<uint32_t>(h.y);
        coverage.front.push_back(front + back > 0 ? 1U : 0U);
        total.front.push_back(front + back);
        faces.front.push_back(front);
        faces.back.push_back(back);
    }
    for (const capture::Writer& w : capture.writers) {
        writer.draws.push_back(w.draw);
        writer.primitives.push_back(w.primitive);
    }
    depth.depth = capture.depth;
    color.color = capture.color;
    all = faces;
    all.draws = writer.draws;
    all.primitives = writer.primitives;
    all.frag_coord = capture.frag_coord;
    all.depth = capture.depth;
    all.attributes = capture.attributes;
    std::map<std::string, Delivered> out = {{"coverage", coverage}, {"total", total},
                                            {"faces", faces},       {"writer", writer},
                                            {"depth", depth},       {"all", all}};
    for (size_t a = 0; a < capture.attribute_count; ++a) {
        Delivered one;
        one.attributes.at(a) = capture.attributes.at(a);
        out["attribute" + std::to_string(a)] = one;
    }
    if (has_color) {
        out["color"] = color;
    }
    return out;
}

capture::Capture empty_picture(cases::Case c) {
    for (cases::Draw& d : c.draws) {
        d.cull = cases::CullMode::front_and_back;
    }
    return rasterizers::draw_by_reference(c);
}

TEST(DeliveredSuite, NoPlaneGivesAFalseAlarmAndNoEmptyOnePasses) {
    size_t passed = 0, cannot_tell = 0;
    const std::vector<cases::Case> selected = some_cases();
    EXPECT_GT(selected.size(), 10U);
    for (const cases::Case& c : selected) {
        cases::Case whole = c;
        whole.target.has_instruments = true;
        whole.target.has_depth = true;
        const ref::Expectation e = ref::expect(c, {}, cases::Profile::direct3d);
        const bool has_color = c.target.color.has_value();
        for (const auto& [name, planes] :
             deliveries(rasterizers::draw_by_reference(whole), has_color)) {
            const diff::Verdict v = diff::compare_delivered(c, e, planes);
            const bool is_told = v.error.find("a picture in which nothing is drawn") !=
                                 std::string::npos;  // depth and colour cannot always tell
            EXPECT_TRUE(v.ok() || (is_told && v.findings.empty()))
                << c.id << ' ' << name << ": " << v.error
                << (v.findings.empty()
                        ? ""
                        : v.findings[0].rule + " expected " + v.findings[0].expected + ", got " +
                              v.findings[0].got + " at " + std::to_string(v.findings[0].x) + "," +
                              std::to_string(v.findings[0].y));
            passed += v.ok() ? 1U : 0U;
            cannot_tell += is_told ? 1U : 0U;
        }
        if (e.samples.size() > 1024) {
            continue;  // thousands of wrong samples take their time to be told
        }
        for (const auto& [name, planes] : deliveries(empty_picture(whole), has_color)) {
            EXPECT_FALSE(diff::compare_delivered(c, e, planes).ok()) << c.id << ' ' << name;
        }
    }
    EXPECT_GT(passed, 10 * cannot_tell);
}

}  // namespace
}  // namespace run
