// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The smallest scenes that the enumerator of histories and the judge once said different things of.
#include <gtest/gtest.h>

#include "judge.hpp"
#include "queries.hpp"

namespace histories {
namespace {

using cases::Profile;

constexpr size_t kFloats = 8;  // rgba32-float

uint32_t set_of(std::initializer_list<PlaneNumber> planes) {
    uint32_t set = 0;
    for (const PlaneNumber plane : planes) {
        set |= 1U << plane;
    }
    return set;
}

Draw draw_of(std::vector<Triangle> triangles, size_t colors = 0, const Numbers& value = {}) {
    Draw draw;
    draw.triangles = std::move(triangles);
    draw.has_wide_viewport = true;
    draw.colors.assign(colors, {value, std::nullopt, 15});
    return draw;
}

// What lies on one side of a line through the centres of row 0.
Triangle half(bool is_beyond, int pair = -1) {
    Triangle triangle;
    triangle.shape = {Shape::Cut::y, 0.5, is_beyond};
    triangle.pair = pair;
    return triangle;
}

std::array<StencilFace, 2> stencil_of(StencilOp pass, uint32_t reference = 0) {
    StencilFace face;
    face.pass = pass;
    face.reference = reference;
    return {face, face};
}

// A history of each sample at a profile, the first one, as planes that may be changed.
std::vector<Shown> picture_at(const Scene& scene, Profile profile = Profile::direct3d) {
    Random random(1);
    return shown(picture_of(scene, profile, random));
}

// Both say that sample `index` is wrong at `level` and stricter profiles, and right at looser ones.
void expect_level(const Scene& scene, const Planes& planes, const std::vector<Shown>& picture,
                  size_t index, std::optional<Profile> level) {
    Judge judge(scene);
    ASSERT_EQ(judge.error(), "");
    for (const Profile profile : cases::kProfiles) {
        const bool is_right = !level || profile < *level;
        EXPECT_EQ(is_allowed(scene, profile, planes, picture, index), is_right);
        const diff::Verdict verdict = judge.judge(planes, picture, {}, profile);
        EXPECT_EQ(verdict.error, "");
        EXPECT_EQ(verdict.ok(), is_right) << to_string(profile);
        EXPECT_EQ(verdict.ok() ? level : verdict.level, level) << to_string(profile);
    }
}

// The depth is a clear's, so that it tells nothing of the draw, but the other values do.
TEST(JointPlanes, ValuesTellThatNothingWasDrawnBesideADepthThatWasCleared) {
    Scene scene;
    scene.width = 2;
    scene.draws = {draw_of({{}}), {}};
    scene.draws[1].clear = Clear{false, 0.25, std::nullopt};
    const Planes planes{set_of({kFragCoord, kDepth})};
    auto picture = picture_at(scene);
    expect_level(scene, planes, picture, 0, std::nullopt);
    picture[0][kFragCoord] = Seen{};
    expect_level(scene, planes, picture, 0, Profile::vulkan);
}

// Of two triangles one covers the sample on their edge, and alpha or a value may take that away.
class PairThatMayBeTakenAway : public testing::Test {
  protected:
    static Scene scene_of(void (*change)(Draw&)) {
        Scene scene;
        scene.attachments = Attachments::color;
        scene.colors.push_back({kFloats, {}});
        scene.draws = {draw_of({{}}, 1, {0, 1, 0, 0}),
                       draw_of({half(false, 0), half(true, 0)}, 1, {0.25, 0, 0, 0.5})};
        scene.draws[1].colors[0].blend = {BlendPart{Factor::one, Factor::one, BlendOp::add},
                                          BlendPart{Factor::one, Factor::one, BlendOp::add}};
        change(scene.draws[1]);
        return scene;
    }
    // What the pair adds to the sample, fragment by fragment.
    static void expect_levels(const Scene& scene) {
        const Planes planes{set_of({kColor})};
        auto picture = picture_at(scene);
        const auto& format = scene.colors[0].about();
        Codes& codes = picture[0][kColor].color;
        codes =
            written(format, clear_codes(scene.colors[0]), scene.draws[0], scene.draws[0].colors[0]);
        expect_level(scene, planes, picture, 0, std::nullopt);
        codes = written(format, codes, scene.draws[1], scene.draws[1].colors[0]);
        expect_level(scene, planes, picture, 0, std::nullopt);
        codes = written(format, codes, scene.draws[1], scene.draws[1].colors[0]);
        expect_level(scene, planes, picture, 0, Profile::vulkan);
    }
};

TEST_F(PairThatMayBeTakenAway, ByAlphaIsAtMostOne) {
    expect_levels(scene_of([](Draw& draw) { draw.alpha_to_coverage = true; }));
}
TEST_F(PairThatMayBeTakenAway, ByAValueIsAtMostOne) {
    expect_levels(scene_of([](Draw& draw) { draw.discard = Discard::negative; }));
}

// What is discarded of a pair at one sample of a pixel is at the others, too.
TEST_F(PairThatMayBeTakenAway, IsSoAtAllSamplesOfAPixel) {
    Scene scene = scene_of([](Draw& draw) { draw.discard = Discard::negative; });
    scene.samples = 2;
    for (Triangle& triangle : scene.draws[1].triangles) {
        triangle.shape.cut = Shape::Cut::x;
        triangle.shape.edge = 0.25;  // through sample 1; sample 0 lies beyond
    }
    const Planes planes{set_of({kColor})};
    auto picture = picture_at(scene);
    for (Shown& sample : picture) {
        sample[kColor].color =
            written(scene.colors[0].about(), {}, scene.draws[0], scene.draws[0].colors[0]);
    }
    expect_level(scene, planes, picture, 0, std::nullopt);
    picture[1][kColor].color = written(scene.colors[0].about(), picture[1][kColor].color,
                                       scene.draws[1], scene.draws[1].colors[0]);
    expect_level(scene, planes, picture, 0, Profile::direct3d);
}

// Two draws meet at the sample with one face, and hits do not tell which of them covers it.
class CountOfOneOfTwo : public testing::Test {
  protected:
    Scene scene_;
    CountOfOneOfTwo() {
        scene_.draws = {draw_of({half(false)}), draw_of({half(true)}), draw_of({{}})};
        scene_.draws[0].triangles[0].is_reversed = true;
    }
    // It is draw 1, so that nothing is counted of draw 0.
    void expect_none() {
        Judge judge(scene_);
        ASSERT_EQ(judge.error(), "");
        const auto picture = picture_at(scene_);
        const Planes planes = whole_of(scene_);
        for (const Profile profile : cases::kProfiles) {
            EXPECT_TRUE(judge.judge(planes, picture, {0, 0, 0}, profile).ok());
            const diff::Verdict verdict = judge.judge(planes, picture, {1, 0, 0}, profile);
            EXPECT_EQ(verdict.error, "");
            EXPECT_FALSE(verdict.ok()) << to_string(profile);
            EXPECT_EQ(verdict.level, Profile::vulkan);
        }
    }
};

TEST_F(CountOfOneOfTwo, GoesWithTheStencil) {
    scene_.has_stencil = true;
    for (size_t draw = 0; draw < 3; ++draw) {
        scene_.draws[draw].stencil = stencil_of(draw == 2 ? StencilOp::keep : StencilOp::replace,
                                                1 + static_cast<uint32_t>(draw));
    }
    scene_.draws[0].query = Query::precise;
    expect_none();
}

TEST_F(CountOfOneOfTwo, GoesWithTheColour) {
    scene_.colors.push_back({kFloats, {}});
    for (size_t draw = 0; draw < 3; ++draw) {
        scene_.draws[draw].colors.push_back({{1.0 + static_cast<double>(draw), 0, 0, 0},
                                             std::nullopt,
                                             draw == 2 ? 2U : 15U});  // the last one leaves red
    }
    scene_.draws[0].query = Query::occlusion;
    expect_none();
}

// One hit of the second draw: at direct3d the first draw has another. The stencil contradicts
// both already where the first one need not cover the sample.
TEST(JointPlanes, AContradictionHasTheLevelOfAllPlanes) {
    Scene scene;
    scene.width = 2;
    scene.has_stencil = true;
    scene.draws = {draw_of({half(true)}), draw_of({{}}), draw_of({{}})};
    scene.draws[2].scissor = {1, 0, 1, 1};  // a control
    scene.draws[0].stencil = stencil_of(StencilOp::replace, 5);
    scene.draws[2].stencil = stencil_of(StencilOp::keep);
    scene.draws[1].stencil = stencil_of(StencilOp::keep);
    scene.draws[1].discard = Discard::negative;
    Planes planes{set_of({kHits, kAttributeV}), capture::HitDetail::total};
    auto picture = picture_at(scene);
    for (Seen& plane : picture[0]) {
        plane.front = 1;
        plane.back = 0;
        plane.draw = 1;
        plane.triangle = 0;
        plane.stencil = 5;
    }
    expect_level(scene, planes, picture, 0, Profile::direct3d);
    planes.set |= set_of({kStencil});
    expect_level(scene, planes, picture, 0, Profile::vulkan);
}

// A fragment that only passes the depth bounds where another one was: no history has two hits of
// the three.
TEST(JointPlanes, HitsBetweenThoseOfAllHistoriesAreWrong) {
    Scene scene;
    scene.depth_clear = 1;
    scene.draws = {draw_of({{}}), draw_of({{}}), draw_of({{}})};
    scene.draws[0].discard = Discard::negative;
    scene.draws[1].bounds = {0.25, 0.75};
    const Planes planes{set_of({kHits}), capture::HitDetail::total};
    auto picture = picture_at(scene);
    for (uint32_t hits = 0; hits <= 4; ++hits) {
        picture[0][kHits].front = hits;
        picture[0][kHits].back = 0;
        expect_level(scene, planes, picture, 0,
                     hits == 1 || hits == 3 ? std::nullopt : std::optional(Profile::vulkan));
    }
}

}  // namespace
}  // namespace histories
