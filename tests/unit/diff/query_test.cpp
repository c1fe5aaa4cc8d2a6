// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Wrong numbers planted in what queries counted.
#include <gtest/gtest.h>

#include "cases/model/rule_ids.hpp"
#include "cases/model/words.hpp"
#include "diff/consistency.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

using cases::Profile;
using cases::Query;

// Three draws: 10 pixels that may be hit by one draw alone, nothing, and all 64.
cases::Case asked(Query query) {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {5, 0}, {0, 5}});
    c.draws.push_back(pixel_case(8, 8, {{8, 0}, {16, 0}, {8, 8}}).draws[0]);
    c.draws.push_back(pixel_case(8, 8, {{0, 0}, {16, 0}, {0, 16}}).draws[0]);
    for (cases::Draw& draw : c.draws) {
        draw.query = query;
    }
    return c;
}

Verdict verdict_of(const cases::Case& c, const capture::Capture& capture,
                   Profile profile = Profile::direct3d) {
    return compare(c, ref::expect(c, {}, profile), capture);
}

// The one finding of a capture whose query of a draw counted something else.
Finding finding_with(const cases::Case& c, size_t draw, uint64_t count) {
    capture::Capture wrong = rasterizers::draw_by_reference(c);
    wrong.counted[draw] = count;
    const Verdict verdict = verdict_of(c, wrong);
    EXPECT_EQ(verdict.finding_total(), 1U) << verdict.error;
    return verdict.findings.empty() ? Finding{} : verdict.findings[0];
}

TEST(QueryJudge, EveryOtherNumberIsWrong) {
    const cases::Case c = asked(Query::occlusion_precise);
    const capture::Capture right = rasterizers::draw_by_reference(c);
    EXPECT_EQ(right.counted, (std::vector<uint64_t>{10, 0, 64}));
    EXPECT_TRUE(verdict_of(c, right).ok());
    for (const auto& [draw, count] :
         {std::pair(0U, 9U), {0U, 11U}, {0U, 1U}, {1U, 1U}, {2U, 63U}, {2U, 65U}, {2U, 0U}}) {
        const Finding finding = finding_with(c, draw, count);
        EXPECT_EQ(finding.rule, "query.occlusion");
        EXPECT_EQ(finding.level, Profile::vulkan);
        EXPECT_EQ(finding.quantity, "occlusion query of draw " + std::to_string(draw));
        EXPECT_EQ(finding.expected, std::to_string(right.counted[draw]));
        EXPECT_EQ(finding.got, std::to_string(count));
    }
}

// No sample is wrong where a count is: none is marked, and no pixel is told.
TEST(QueryJudge, AWrongCountBelongsToNoSample) {
    const cases::Case c = asked(Query::occlusion_precise);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    capture.counted = {9, 0, 63};
    Verdict verdict = verdict_of(c, capture);
    ASSERT_EQ(verdict.findings.size(), 2U);
    EXPECT_TRUE(verdict.findings[0].of_case);
    EXPECT_TRUE(verdict.findings[1].of_case);
    EXPECT_EQ(verdict.count_wrong_samples(), 0U);
    EXPECT_EQ(verdict.level, Profile::vulkan);
    EXPECT_EQ(verdict.finding_total(), 2U);
    // Beside a wrong sample that one alone is marked, and it alone spans the box of what is wrong.
    set_hits(capture, 5 * 8 + 6, 0, 2);
    verdict = verdict_of(c, capture);
    EXPECT_EQ(verdict.count_wrong_samples(), 1U);
    EXPECT_EQ((std::array{verdict.min_x, verdict.min_y, verdict.max_x, verdict.max_y}),
              (std::array{6U, 5U, 6U, 5U}));
}

// Another picture has to count as many, and the sentence says so of the query, not of a sample.
TEST(QueryJudge, ACountThatADoorChangesBelongsToNoSample) {
    cases::Case c = asked(Query::occlusion_precise);
    c.relations = {{cases::RelationKind::same_twice, {}}};
    c.doors = {cases::Door::secondary};
    const std::vector<cases::Derivation> derivations = cases::derivations(c);
    const capture::Capture base = rasterizers::draw_by_reference(c);
    capture::Capture derived = base;
    derived.counted[2] = 63;
    std::vector<Consistency> found;
    for (const cases::Derivation& derivation : derivations) {
        found.push_back(compare_bits(c, base, derived, derivation));
    }
    Verdict verdict = verdict_of(c, base);
    add_differences(c, derivations, found, verdict);
    ASSERT_EQ(verdict.findings.size(), 3U);  // twice, later, and through the door
    for (const Finding& finding : verdict.findings) {
        EXPECT_TRUE(finding.of_case);
        EXPECT_EQ(finding.quantity.find("occlusion query of draw 2, "), 0U) << finding.quantity;
        EXPECT_EQ(finding.why.find("has other bits"), std::string::npos) << finding.why;
        EXPECT_NE(finding.why.find("the query counts as many"), std::string::npos) << finding.why;
    }
    EXPECT_EQ(verdict.count_wrong_samples(), 0U);
}

TEST(QueryJudge, AnyNumberButZeroTellsOfSamples) {
    const cases::Case c = asked(Query::occlusion);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    EXPECT_EQ(capture.counted, (std::vector<uint64_t>{1, 0, 1}));
    EXPECT_TRUE(verdict_of(c, capture).ok());
    EXPECT_EQ(finding_with(c, 0, 0).expected, "not 0");
    EXPECT_EQ(finding_with(c, 1, 1).expected, "0");
    EXPECT_EQ(finding_with(c, 1, 1).got, "not 0");
}

// One triangle of 10 pixels and 3 vertices. All of these lie on borders of the clip volume: whether
// one is inside of it only Direct3D says. At vulkan nothing says which draw covers what all do.
TEST(QueryJudge, StatisticsHaveALeastAndAtDirect3DAMost) {
    struct Row {
        Query query;
        uint64_t least, most;
    };
    for (const Row& row : {Row{Query::input_vertices, 3, 3},
                           {Query::input_primitives, 1, 1},
                           {Query::vertex_invocations, 3, 3},
                           {Query::clipping_invocations, 1, 1},
                           {Query::clipping_primitives, 1, 1},
                           {Query::fragment_invocations, 10, 36}}) {
        const cases::Case c = asked(row.query);
        const std::string name = std::string(cases::word_of(row.query)) + " of draw 0";
        capture::Capture capture = rasterizers::draw_by_reference(c);
        EXPECT_TRUE(verdict_of(c, capture).ok()) << name;
        EXPECT_EQ(capture.counted[0], row.least) << name;
        const Finding less = finding_with(c, 0, row.least - 1);
        EXPECT_EQ(less.rule, "query.statistics");
        const bool is_clipped = row.query == Query::clipping_primitives;
        EXPECT_EQ(less.level, is_clipped                                 ? Profile::direct3d
                              : row.query == Query::clipping_invocations ? Profile::practice
                                                                         : Profile::vulkan)
            << name;
        EXPECT_EQ(less.quantity, name);
        EXPECT_EQ(less.expected, (is_clipped ? "" : "at least ") + std::to_string(row.least));
        EXPECT_TRUE(less.of_case);
        const Finding more = finding_with(c, 0, row.most + 1);
        EXPECT_EQ(more.level, Profile::direct3d) << name;
        EXPECT_EQ(more.got, std::to_string(row.most + 1));
        capture.counted[0] = row.most;
        EXPECT_TRUE(verdict_of(c, capture).ok()) << name;
        capture.counted[0] = 1000000;
        EXPECT_TRUE(verdict_of(c, capture, Profile::practice).ok()) << name;
        capture.counted[0] = capture::kNotCounted;
        EXPECT_EQ(verdict_of(c, capture, Profile::vulkan).findings.at(0).got, "no result");
    }
}

TEST(QueryJudge, StatisticsOfOtherRenderingsAreNotCompared) {
    cases::Case c = asked(Query::vertex_invocations);
    c.relations = {{cases::RelationKind::same_twice, {}}};
    const capture::Capture base = rasterizers::draw_by_reference(c);
    capture::Capture derived = base;
    // A cache of vertices, or an early test, may do its work in one of them and not in the other.
    derived.counted[1] += 5;
    const std::vector<cases::Derivation> derivations = cases::derivations(c);
    EXPECT_EQ(compare_bits(c, base, derived, derivations[0]).different, 0U);
    derived.counted[1] = capture::kNotAsked;
    EXPECT_EQ(compare_bits(c, base, derived, derivations[0]).different, 0U);
}

TEST(QueryJudge, DrawsWithoutQueriesAreNotJudged) {
    cases::Case c = asked(Query::occlusion_precise);
    c.draws[0].query = Query::none;
    capture::Capture capture = rasterizers::draw_by_reference(c);
    EXPECT_EQ(capture.counted[0], 0U);
    capture.counted[0] = 5;
    EXPECT_TRUE(verdict_of(c, capture).ok());
}

TEST(QueryJudge, CountsFollowFromWhatTheDeviceShows) {
    // Sample (2, 2) lies on the first triangle's edge: its owner is the device's choice at vulkan.
    const cases::Case c = asked(Query::occlusion_precise);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    set_hits(capture, 2 * 8 + 2, 0, 2);
    EXPECT_EQ(verdict_of(c, capture, Profile::vulkan).findings.at(0).expected, "11");
    capture.counted[0] = 11;
    EXPECT_TRUE(verdict_of(c, capture, Profile::vulkan).ok());
    // At direct3d the hit is the finding, and what is counted follows from it.
    const Verdict strict = verdict_of(c, capture);
    ASSERT_EQ(strict.finding_total(), 1U);
    EXPECT_EQ(strict.findings[0].rule, "tie.top-left");
}

// A known failure must not hide what queries count wrongly: ten of the 64 samples are hit once
// more.
TEST(QueryJudge, SamplesThatAreRightBoundTheCountsBesideWrongHits) {
    const cases::Case c = asked(Query::occlusion_precise);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    for (size_t index = 40; index < 50; ++index) {
        set_hits(capture, index, 0, 2);
    }
    const auto wrong_queries = [&](uint64_t first, uint64_t last) {
        capture.counted = {first, 0, last};
        const Verdict verdict = verdict_of(c, capture);
        std::vector<std::string> out;
        for (const Finding& finding : verdict.findings) {
            if (finding.rule == cases::rule::query_occlusion) {
                out.push_back(finding.quantity + ": " + finding.expected);
            } else {
                EXPECT_EQ(finding.kind, FindingKind::double_hit);
            }
        }
        return out;
    };
    EXPECT_TRUE(wrong_queries(10, 54).empty());
    EXPECT_TRUE(wrong_queries(10, 64).empty());
    EXPECT_EQ(wrong_queries(10, 53),
              (std::vector<std::string>{"occlusion query of draw 2: 54 to 64"}));
    EXPECT_EQ(wrong_queries(9, 27),
              (std::vector<std::string>{"occlusion query of draw 0: 10 to 20",
                                        "occlusion query of draw 2: 54 to 64"}));
}

TEST(QueryJudge, ACaptureWithoutCountsIsNoPass) {
    const cases::Case c = asked(Query::occlusion_precise);
    capture::Capture capture = rasterizers::draw_by_reference(c);
    capture.counted.clear();
    EXPECT_EQ(verdict_of(c, capture).error, "the capture lacks what the case's queries counted");
}

TEST(QueryJudge, AQueryWithoutAResultIsWrong) {
    for (const Query query : {Query::occlusion, Query::occlusion_precise}) {
        for (const size_t draw : {size_t{1}, size_t{2}}) {
            const Finding finding = finding_with(asked(query), draw, capture::kNotCounted);
            EXPECT_EQ(finding.rule, "query.occlusion");
            EXPECT_EQ(finding.level, Profile::vulkan);
            EXPECT_EQ(finding.got, "no result");
        }
    }
}

// Whether fragments that are discarded after early tests count may differ from pipeline to
// pipeline at vulkan.
TEST(QueryJudge, OtherPipelinesMayCountWhatIsDiscardedEarly) {
    cases::Case c = asked(Query::occlusion_precise);
    c.draws[2].discard = cases::Discard::checker;
    c.draws[2].early_tests = true;
    c.relations.push_back({cases::RelationKind::write_masks});
    c.relations.push_back({cases::RelationKind::same_twice});
    const capture::Capture base = rasterizers::draw_by_reference(c);
    for (const cases::Derivation& derivation : cases::derivations(c)) {
        capture::Capture other = base;
        vary(other, derivation.variation);
        other.counted[2] = 32;
        const std::vector<Consistency> found = {compare_bits(c, base, other, derivation)};
        for (const Profile profile : cases::kProfiles) {
            Verdict verdict = verdict_of(c, base, profile);
            add_differences(c, std::span(&derivation, 1), found, verdict);
            const bool is_demanded =
                derivation.kind == cases::RelationKind::same_twice || profile != Profile::vulkan;
            EXPECT_EQ(verdict.findings.size(), is_demanded ? 1U : 0U) << derivation.name;
        }
    }
}

TEST(QueryJudge, OtherRenderingsCountAsMany) {
    cases::Case c = asked(Query::occlusion_precise);
    c.relations.push_back({});
    const capture::Capture base = rasterizers::draw_by_reference(c);
    capture::Capture other = base;
    const std::vector<cases::Derivation> derivations = cases::derivations(c);
    EXPECT_EQ(compare_bits(c, base, other, derivations[0]).different, 0U);
    other.counted[2] = 63;
    const Consistency found = compare_bits(c, base, other, derivations[0]);
    EXPECT_EQ(found.different, 1U);
    Verdict verdict = verdict_of(c, base);
    add_differences(c, derivations, std::vector{found, Consistency{}}, verdict);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "repeat.same");
    EXPECT_EQ(verdict.findings[0].quantity, "occlusion query of draw 2, same-twice");
    EXPECT_EQ(verdict.findings[0].expected, "64");
    EXPECT_EQ(verdict.findings[0].got, "63");
}

}  // namespace
}  // namespace diff
