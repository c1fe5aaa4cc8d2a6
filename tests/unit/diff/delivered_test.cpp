// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Planes of renderers that deliver only some: what is there is judged, what is not is not, and a
// picture without a triangle never passes.
#include "diff/delivered.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/load/loader.hpp"
#include "cases/model/rule_ids.hpp"
#include "perfect_capture.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/strength/strength.hpp"

namespace {

using capture::Delivered;
using capture::HitDetail;
using cases::Profile;
using testing::ElementsAre;
using testing::IsEmpty;

// Two triangles that overlap, with depth and two attributes.
cases::Case two_triangles() {
    cases::Case c = pixel_case(8, 8, {{1, 1}, {7, 1}, {1, 7}, {2, 2}, {2, 7}, {7, 2}});
    add_attribute(c, cases::Interpolation::smooth, {0, 6, 1, 3, 9, 5});
    add_attribute(c, cases::Interpolation::flat, {1, 1, 1, 2, 2, 2});
    c.draws[0].positions[1].z = 0.25F;
    return c;
}

enum Plane : uint32_t {
    kCoverage = 1,
    kTotal = 2,
    kFaces = 4,
    kWriter = 8,
    kFragCoord = 16,
    kDepth = 32,
    kAttribute0 = 64,
    kAttribute1 = 128,
    kEnd = 256
};

capture::Delivered take(const capture::Capture& capture, uint32_t planes) {
    capture::Delivered out;
    const uint32_t detail = planes & (kCoverage | kTotal | kFaces);
    for (const glm::vec4& h : capture.hits) {
        const auto front = static_cast<uint32_t>(h.x), back = static_cast<uint32_t>(h.y);
        if (detail == kFaces) {
            out.front.push_back(front);
            out.back.push_back(back);
        } else if (detail != 0) {
            out.front.push_back(detail == kTotal ? front + back : front + back > 0);
        }
    }
    out.detail = detail == kFaces      ? capture::HitDetail::faces
                 : detail == kTotal    ? capture::HitDetail::total
                 : detail == kCoverage ? capture::HitDetail::coverage
                                       : capture::HitDetail::none;
    for (const capture::Writer& w : capture.writers) {
        if ((planes & kWriter) != 0) {
            out.draws.push_back(w.draw);
            out.primitives.push_back(w.primitive);
        }
    }
    out.frag_coord = (planes & kFragCoord) != 0 ? capture.frag_coord : out.frag_coord;
    out.depth = (planes & kDepth) != 0 ? capture.depth : out.depth;
    out.attributes[0] =
        (planes & kAttribute0) != 0 ? capture.attributes[0] : std::vector<glm::vec4>();
    out.attributes[1] =
        (planes & kAttribute1) != 0 ? capture.attributes[1] : std::vector<glm::vec4>();
    return out;
}

bool is_possible(uint32_t planes) {
    const uint32_t detail = planes & (kCoverage | kTotal | kFaces);
    return planes != 0 && (detail & (detail - 1)) == 0;
}

struct Fixture {
    cases::Case c = two_triangles();
    ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    capture::Capture right = perfect_capture(c, e);
};

TEST(Delivered, EverySubsetOfARightCapturePasses) {
    const Fixture f;
    for (uint32_t planes = 1; planes < kEnd; ++planes) {
        if (is_possible(planes)) {
            const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(f.right, planes));
            EXPECT_TRUE(v.ok()) << planes << ' ' << v.error
                                << (v.findings.empty() ? "" : v.findings[0].expected);
        }
    }
}

// A depth may be that of a discarded fragment, and then is no hit.
TEST(Delivered, EverySubsetOfDiscardsThatStorePasses) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"A case.\"\nrules = [\"cover.inside\"]\n"
        "[target]\nsize = [8, 8]\nstencil = true\ncolor = { format = \"rgba8-unorm\" }\n"
        "[[draw]]\ndiscard = \"checker\"\nearly_tests = true\n"
        "color = { value = [1, 0, 0, 1] }\n"
        "vertices = [[0,0,0.25], [8,0,0.25], [0,8,0.125]]\n"
        "[[draw]]\ndepth = { compare = \"less\" }\nstencil = { pass = \"invert\" }\n"
        "color = { value = [0, 1, 0, 1] }\n"
        "vertices = [[2,2,0.375], [8,2,0], [2,8,0.375]]\n",
        "case.toml", "case");
    ASSERT_TRUE(loaded) << loaded.error().front().message;
    const cases::Case& c = loaded->front();
    const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    const capture::Capture right = software::captured(c, software::Device{});
    for (uint32_t planes = 1; planes < kAttribute0; ++planes) {
        for (const bool has_color : {false, true}) {
            if (is_possible(planes)) {
                capture::Delivered delivered = take(right, planes);
                delivered.color = has_color ? right.color : delivered.color;
                const diff::Verdict v = diff::compare_delivered(c, e, delivered);
                EXPECT_TRUE(v.ok()) << planes << ' ' << v.error
                                    << (v.findings.empty() ? "" : v.findings[0].expected);
            }
        }
    }
}

TEST(Delivered, EverySubsetOfAClearedCaptureFails) {
    Fixture f;
    for (size_t k = 0; k < f.right.sample_count(); ++k) {
        clear_sample(f.right, k);
    }
    for (uint32_t planes = 1; planes < kEnd; ++planes) {
        if (is_possible(planes)) {
            const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(f.right, planes));
            EXPECT_FALSE(v.ok()) << planes;
            EXPECT_EQ(v.error, "") << planes;
        }
    }
}

TEST(Delivered, AWrongPlaneFailsWhereItIsDeliveredAndNowhereElse) {
    const Fixture f;
    const size_t at = 3 * 8 + 3;  // both triangles cover pixel (3, 3)
    ASSERT_EQ(f.e.samples[at].hits.total_min, 2U);
    const auto check = [&](uint32_t plane, uint32_t seen_by, auto damage, diff::FindingKind kind) {
        capture::Capture wrong = f.right;
        damage(wrong);
        for (uint32_t planes = 1; planes < kEnd; ++planes) {
            if (!is_possible(planes)) {
                continue;
            }
            const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(wrong, planes));
            EXPECT_EQ(v.ok(), (planes & seen_by) == 0) << plane << " of " << planes;
            if (!v.ok()) {
                ASSERT_EQ(v.findings.size(), 1U) << planes;
                EXPECT_EQ(v.findings[0].kind, kind);
                EXPECT_EQ((std::array{v.findings[0].x, v.findings[0].y}), (std::array{3U, 3U}));
            }
        }
    };
    check(
        kTotal, kTotal | kFaces, [&](auto& w) { set_hits(w, at, 2, 1); },
        diff::FindingKind::double_hit);
    check(
        kFaces, kFaces, [&](auto& w) { set_hits(w, at, 2, 0); }, diff::FindingKind::value);
    check(
        kDepth, kDepth, [&](auto& w) { w.depth[at] = 0.9F; }, diff::FindingKind::value);
    check(
        kAttribute0, kAttribute0, [&](auto& w) { w.attributes[0][at].x = 100; },
        diff::FindingKind::value);
    check(
        kFragCoord, kFragCoord, [&](auto& w) { w.frag_coord[at].x = 9; }, diff::FindingKind::value);
}

// Flat values tell the triangles apart: the first one's are wrong, whether or not writers are
// there.
TEST(Delivered, ValuesHaveToBeOfOneTriangle) {
    const Fixture f;
    const size_t at = 3 * 8 + 3;
    capture::Capture wrong = f.right;
    ref::ValueReference values(f.c, f.e.limits, f.e.profile);
    write_fragment(wrong, f.c, f.e, values, 0, {3, 3, 0});
    wrong.writers[at] = f.right.writers[at];
    for (const uint32_t planes :
         {uint32_t{kAttribute1}, kAttribute0 | kWriter, kDepth | kCoverage}) {
        const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(wrong, planes));
        EXPECT_FALSE(v.ok()) << planes;
    }
}

TEST(Delivered, WritersInAnotherOrderAreFound) {
    Fixture f;
    const size_t at = 3 * 8 + 3;
    f.right.writers[at] = {0, 0, 0, capture::kClearId};
    const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(f.right, kWriter));
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].rule, "order.primitive");
    f.right.writers[at] = {7, 9, 0, capture::kClearId};  // no such triangle
    EXPECT_EQ(diff::compare_delivered(f.c, f.e, take(f.right, kWriter)).findings.size(), 1U);
}

TEST(Delivered, AMissingPlaneIsNamed) {
    const Fixture f;
    EXPECT_THAT(diff::not_judged(f.c, take(f.right, kCoverage)),
                ElementsAre("number of hits", "faces", "writer", "FragCoord", "depth",
                            "attribute 0", "attribute 1"));
    EXPECT_THAT(diff::not_judged(f.c, take(f.right, kTotal | kDepth | kAttribute1)),
                ElementsAre("faces", "writer", "FragCoord", "attribute 0"));
    EXPECT_THAT(diff::not_judged(f.c, take(f.right, kEnd - 1 - kCoverage - kTotal)), IsEmpty());
    EXPECT_TRUE(capture::Delivered{}.is_empty());
    EXPECT_FALSE(take(f.right, kDepth).is_empty());
}

// Both instances draw primitive 0, so that nobody is judged by it.
TEST(Delivered, PrimitivesDoNotTellInstancesApart) {
    Fixture f;
    f.c.draws[0].instances = 2;
    f.e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    f.right = perfect_capture(f.c, f.e);
    const uint32_t all = kEnd - 1 - kCoverage - kTotal;
    EXPECT_THAT(diff::not_judged(f.c, take(f.right, all)), ElementsAre("writer"));
    for (uint32_t planes = 1; planes < kEnd; ++planes) {
        if (is_possible(planes)) {
            EXPECT_TRUE(diff::compare_delivered(f.c, f.e, take(f.right, planes)).ok()) << planes;
        }
    }
}

// Another picture is judged on the same planes as the delivered one, coverage alone included.
TEST(Delivered, APictureIsCutToThePlanesThatWereDelivered) {
    const Fixture f;
    for (const uint32_t planes : std::initializer_list<uint32_t>{
             kCoverage, kTotal, kCoverage | kDepth, kDepth | kAttribute1, kWriter,
             kEnd - 1 - kCoverage - kTotal}) {
        const capture::Delivered delivered = take(f.right, planes);
        const std::vector<std::string> words = diff::not_judged(f.c, delivered);
        const capture::Delivered cut = diff::judged_planes(f.c, f.right, words);
        EXPECT_EQ(diff::not_judged(f.c, cut), words) << planes;
        EXPECT_EQ(cut.detail, delivered.detail) << planes;
        EXPECT_EQ(cut.front, delivered.front) << planes;
        EXPECT_TRUE(diff::compare_delivered(f.c, f.e, cut).ok()) << planes;
    }
}

// Renderers elsewhere deliver hits of every case, and pictures of colour alone have none.
TEST(Delivered, APictureOfTheColourAloneHasNoHits) {
    Fixture f;
    f.c.target.color = {cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
    f.c.draws[0].color.value = {1, 1, 1, 1};
    f.c.target.has_instruments = false;
    const capture::Capture picture = rasterizers::draw_by_reference(f.c);
    ASSERT_TRUE(picture.hits.empty());
    const capture::Delivered cut = diff::judged_planes(f.c, picture, {"stencil"});
    EXPECT_EQ(cut.detail, capture::HitDetail::none);
    EXPECT_FALSE(cut.color.empty());
    const auto e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    const diff::Verdict v = diff::compare_delivered(f.c, e, cut);
    EXPECT_TRUE(v.ok()) << v.error;
}

// Coverage that a renderer delivers beside a colour is levelled as the case says, by which alpha
// may take a sample away at vulkan and at practice.
TEST(Delivered, ASampleThatAlphaMayTakeIsMissingAtDirect3DAlone) {
    Fixture f;
    f.c.target.samples = 4;
    f.c.target.color = {cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
    f.c.draws[0].color.value = {1, 1, 1, 1};
    f.c.draws[0].color.alpha_to_coverage = true;
    f.e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    f.right = perfect_capture(f.c, f.e);
    f.c.target.has_instruments = false;
    f.e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    capture::Delivered delivered = take(f.right, kCoverage);
    EXPECT_TRUE(diff::compare_delivered(f.c, f.e, delivered).ok());
    const auto seen = std::find(delivered.front.begin(), delivered.front.end(), 1U);
    ASSERT_NE(seen, delivered.front.end());
    *seen = 0;
    const diff::Verdict v = diff::compare_delivered(f.c, f.e, delivered);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].rule, cases::rule::sample_alpha_to_coverage);
    EXPECT_EQ(v.findings[0].level, Profile::direct3d);
}

TEST(Delivered, DepthThatIsNotWrittenTellsNothing) {
    Fixture f;
    f.c.draws[0].depth.write = false;
    f.e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    for (float& z : f.right.depth) {
        z = f.c.target.depth_clear;
    }
    const diff::Verdict alone = diff::compare_delivered(f.c, f.e, take(f.right, kDepth));
    EXPECT_EQ(alone.error,
              "of the delivered planes (depth) a picture in which nothing is drawn would pass too; "
              "deliver coverage or hits");
    EXPECT_TRUE(diff::compare_delivered(f.c, f.e, take(f.right, kDepth | kCoverage)).ok());
    f.right.depth[3 * 8 + 3] = 0.5F;
    EXPECT_FALSE(diff::compare_delivered(f.c, f.e, take(f.right, kDepth | kCoverage)).ok());
}

TEST(Delivered, ADepthWhereNothingWasHitContradictsTheHits) {
    Fixture f;
    f.right.depth[0] = 0.9F;
    for (const uint32_t said : {uint32_t{kCoverage}, uint32_t{kWriter}, uint32_t{kFaces}}) {
        const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(f.right, said | kDepth));
        ASSERT_EQ(v.findings.size(), 1U);
        EXPECT_EQ(v.findings[0].rule, "write.consistent");
        EXPECT_TRUE(diff::compare_delivered(f.c, f.e, take(f.right, said | kAttribute0)).ok());
    }
}

TEST(Delivered, AnyValueMayLieWhereNothingWasHit) {
    Fixture f;
    f.right.attributes[0][0] = glm::vec4(0);
    f.right.frag_coord[0] = glm::vec4(0.5F);
    EXPECT_TRUE(
        diff::compare_delivered(f.c, f.e, take(f.right, kCoverage | kFragCoord | kAttribute0))
            .ok());
    // But alone the values say what was hit.
    const diff::Verdict v = diff::compare_delivered(f.c, f.e, take(f.right, kAttribute0));
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].kind, diff::FindingKind::extra);
}

TEST(Delivered, ContradictionsAreFound) {
    Fixture f;
    capture::Delivered planes = take(f.right, kCoverage | kWriter);
    planes.front[3 * 8 + 3] = 0;
    const diff::Verdict v = diff::compare_delivered(f.c, f.e, planes);
    ASSERT_EQ(v.findings.size(), 1U);
    EXPECT_EQ(v.findings[0].rule, "write.consistent");
}

// A colour that is the clear one says that nothing was drawn, unless hits and writer know better.
TEST(Delivered, HitsAndWriterTellWhatIsBehindAColour) {
    Fixture f;
    const capture::Delivered known = take(f.right, kTotal | kWriter);
    f.c.target.color = cases::ColorTarget{cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
    f.c.draws[0].color.value = {1, 0, 0, 1};
    f.e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    capture::Delivered planes;
    for (size_t k = 0; k < f.e.samples.size(); ++k) {
        const auto sample = f.e.samples[k];
        planes.color.push_back(sample.hits.total_min > 0 ? capture::ColorCodes{255, 0, 0, 255}
                                                         : capture::ColorCodes{});
    }
    planes.color[3 * 8 + 3] = {};
    const auto kind_of = [&] {
        const diff::Verdict verdict = diff::compare_delivered(f.c, f.e, planes);
        EXPECT_EQ(verdict.findings.size(), 1U);
        return verdict.findings.at(0).kind;
    };
    EXPECT_EQ(kind_of(), diff::FindingKind::missing);
    planes.detail = known.detail;
    planes.front = known.front;
    EXPECT_EQ(kind_of(), diff::FindingKind::missing);
    planes.draws = known.draws;
    planes.primitives = known.primitives;
    EXPECT_EQ(kind_of(), diff::FindingKind::value);
}

// A tie that another choice of owner decides is at most direct3d's, whatever else is known: the
// samples on the right edge of a triangle that shows its back.
TEST(Delivered, WithoutFacesATieIsNoWrongFace) {
    for (const bool is_back : {false, true}) {
        cases::Case c =
            is_back
                ? pixel_case(8, 8, {{1, 1}, {1, 7}, {4.5F, 4.5F}, {4.5F, 4.5F}, {1, 7}, {4.5F, 7}})
                : pixel_case(8, 8, {{1, 1}, {4.5F, 4.5F}, {1, 7}, {4.5F, 4.5F}, {4.5F, 7}, {1, 7}});
        const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
        const ref::Expectation loose = ref::expect(c, ref::Limits{8}, Profile::practice);
        capture::Capture other = perfect_capture(c, e);
        const capture::Capture any = perfect_capture(c, loose);
        size_t changed = 0;
        for (size_t k = 0; k < e.samples.size(); ++k) {
            if (e.samples[k].hits.total_max == 0 && loose.samples[k].hits.total_max == 1) {
                ++changed;
                const cases::Triangle& t = loose.triangles[loose.writers_of(loose.samples[k])[0]];
                const float back = loose.samples[k].hits.back_max > 0 ? 1 : 0;
                other.hits[k] = {1 - back, back, capture::kHitGuard, capture::kHitGuard + 1};
                other.writers[k] = {t.draw, t.primitive, t.provoking, capture::kClearId};
            }
        }
        ASSERT_GT(changed, 0U);
        for (const uint32_t planes : {kCoverage, kTotal, kFaces, kWriter}) {
            for (const uint32_t more : {0U, uint32_t{kWriter}}) {
                const diff::Verdict v = diff::compare_delivered(c, e, take(other, planes | more));
                EXPECT_EQ(v.finding_total(), changed) << planes << ' ' << is_back;
                EXPECT_EQ(v.level, Profile::direct3d) << planes << ' ' << is_back;
                EXPECT_NE(v.findings.at(0).rule, cases::rule::face_area_sign);
                EXPECT_TRUE(diff::compare_delivered(c, loose, take(other, planes | more)).ok());
            }
        }
    }
}

TEST(Delivered, ColourAloneIsJudged) {
    Fixture f;
    f.c.target.color = cases::ColorTarget{cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
    f.c.draws[0].color.value = {1, 0, 0, 1};
    f.e = ref::expect(f.c, ref::Limits{8}, Profile::direct3d);
    capture::Delivered planes;
    for (size_t k = 0; k < f.e.samples.size(); ++k) {
        planes.color.push_back(f.e.samples[k].hits.total_min > 0
                                   ? capture::ColorCodes{255, 0, 0, 255}
                                   : capture::ColorCodes{});
    }
    EXPECT_TRUE(diff::compare_delivered(f.c, f.e, planes).ok());
    planes.color[3 * 8 + 3] = {254, 0, 0, 255};
    EXPECT_EQ(diff::compare_delivered(f.c, f.e, planes).findings.size(), 1U);
    planes.color.assign(64, {});
    EXPECT_FALSE(diff::compare_delivered(f.c, f.e, planes).ok());
    // Where the hits are wrong the colour tells nothing more, elsewhere it is judged.
    const auto drawn = [&](size_t k) { return f.e.samples[k].hits.total_min > 0; };
    planes.detail = capture::HitDetail::total;
    for (size_t k = 0; k < 64; ++k) {
        planes.front.push_back(f.e.samples[k].hits.total_min);
        planes.color[k] = drawn(k) ? capture::ColorCodes{255, 0, 0, 255} : capture::ColorCodes{};
    }
    EXPECT_TRUE(diff::compare_delivered(f.c, f.e, planes).ok());
    const size_t missing = 3 * 8 + 3, wrong = 3 * 8 + 2, extra = 63;
    ASSERT_TRUE(drawn(missing) && drawn(wrong) && !drawn(extra));
    planes.front[missing] = 0;
    planes.color[missing] = {};
    planes.front[extra] = 1;
    planes.color[extra] = {255, 0, 0, 255};
    planes.color[wrong] = {254, 0, 0, 255};
    const diff::Verdict verdict = diff::compare_delivered(f.c, f.e, planes);
    EXPECT_EQ(verdict.finding_total(), 3U);
    EXPECT_EQ(verdict.marks[wrong], diff::SampleMark::value);
    planes = {};
    planes.color.assign(64, {});
    // A colour that is the clear colour tells nothing of what was drawn.
    f.c.draws[0].color.value = {0, 0, 0, 0};
    EXPECT_THAT(diff::compare_delivered(f.c, f.e, planes).error,
                testing::HasSubstr("(color) a picture in which nothing is drawn would pass"));
}

}  // namespace
