// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole datasheet; what cannot be told; the vote; what travels as JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "probe/base/vote.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/tell/compare.hpp"
#include "probe/tell/json.hpp"
#include "probe/tell/page.hpp"
#include "probe/tell/text.hpp"
#include "software.hpp"

namespace probe {
namespace {

using cases::operator""_fault;

using testing::HasSubstr;

const Datasheet& usual() {
    static const Datasheet kSheet = sheet_of({});
    return kSheet;
}

// The software device with what it is made with: everything but what it has no choice of.
TEST(Datasheet, OfTheUsualDeviceTellsEverything) {
    for (const Property& p : usual().properties) {
        EXPECT_TRUE(p.is_known()) << p.id << ": " << p.why;
        EXPECT_EQ(p.contradict, 0U) << p.id << ": " << p.answer;
        EXPECT_GT(p.agree, 0U) << p.id;
        EXPECT_FALSE(p.question.empty()) << p.id;
        EXPECT_FALSE(p.experiment.empty()) << p.id;
        EXPECT_TRUE(std::any_of(kSections.begin(), kSections.end(), [&](const Section& s) {
            return s.name == p.section();
        })) << p.id;
    }
}

TEST(Datasheet, OfADeviceThatDrawsNothingTellsNothing) {
    software::Device device;
    device.fault = "draws-nothing"_fault;
    const Datasheet sheet = sheet_of(device);
    EXPECT_EQ(sheet.properties.size(), usual().properties.size());
    for (const Property& p : sheet.properties) {
        EXPECT_FALSE(p.is_known()) << p.id << ": " << p.answer;
        EXPECT_FALSE(p.why.empty()) << p.id;
    }
}

TEST(Datasheet, OfADeviceThatSupportsNothingSaysWhy) {
    const Draw draw = [](std::vector<cases::Case> cases) {
        return std::vector<Drawn>(cases.size(), {{}, "the device has no triangles"});
    };
    const Datasheet sheet = measure(draw, {});
    EXPECT_EQ(sheet.properties.size(), usual().properties.size());
    for (const Property& p : sheet.properties) {
        EXPECT_FALSE(p.is_known()) << p.id << ": " << p.answer;
        EXPECT_FALSE(p.why.empty()) << p.id;
    }
}

// Errors that are no choice are seen as what they are, or not told: never as a choice.
TEST(Datasheet, OfFaultsIsNoOtherChoice) {
    using cases::Fault;
    const auto of = [](Fault fault, std::vector<std::string_view> only) {
        software::Device device;
        device.fault = fault;
        return sheet_of(device, only);
    };
    EXPECT_EQ(of("ties-all-inclusive"_fault, {"ties"}).answer("ties.rule"), "every edge");
    EXPECT_EQ(of("ties-all-exclusive"_fault, {"ties"}).answer("ties.rule"), "no edge");
    EXPECT_EQ(of("ties-bottom-too"_fault, {"ties"}).answer("ties.rule"), kCannotTell);
    EXPECT_EQ(of("coarse-snapping"_fault, {"grid"}).answer("grid.bits.x"), "4");
    const Datasheet rough = of("reciprocal-12-bits"_fault, {"precision"});
    EXPECT_GE(rough.find("precision.smooth")->figures.at(0).value, 11);
    EXPECT_LE(rough.find("precision.smooth")->figures.at(0).value, 13);
    EXPECT_GT(rough.find("precision.smooth")->contradict, 0U);
    EXPECT_EQ(rough.find("precision.noperspective")->contradict, 0U);
    EXPECT_NE(of("samples-upside-down"_fault, {"locations"}).answer("samples.4"),
              "the standard locations");
}

TEST(Vote, NeedsDecisiveObservations) {
    Property property;
    Vote none({"a", "b"});
    none.add([](size_t) { return true; });
    none.settle(property);
    EXPECT_EQ(property.answer, kCannotTell);
    EXPECT_THAT(property.why, HasSubstr("no observation"));
}

TEST(Vote, DoesNotChooseBetweenEquals) {
    Property property;
    Vote vote({"a", "b", "c"});
    vote.add([](size_t k) { return k < 2; });
    vote.settle(property);
    EXPECT_EQ(property.answer, kCannotTell);
    EXPECT_THAT(property.why, HasSubstr("'a' and 'b' explain alike"));
    // Two candidates of one name are no two answers.
    Property named;
    vote.settle(named, [](size_t k) { return k < 2 ? "ab" : "c"; });
    EXPECT_EQ(named.answer, "ab");
}

TEST(Vote, RefusesWhatIsContradicted) {
    Property property;
    Vote vote({"a", "b"});
    for (int k = 0; k < 10; ++k) {
        vote.add([](size_t n) { return n == 0; });
    }
    vote.add([](size_t n) { return n == 1; });
    vote.settle(property);
    EXPECT_EQ(property.answer, kCannotTell);
    EXPECT_EQ(property.agree, 10U);
    EXPECT_EQ(property.contradict, 1U);
    EXPECT_THAT(property.why, HasSubstr("contradicted by 1 of 11"));
}

TEST(Vote, CountsWhatNoCandidateExplainsAgainstAll) {
    Property property;
    Vote vote({"a", "b"});
    for (int k = 0; k < 10; ++k) {
        vote.add([](size_t n) { return n == 0; });
        vote.add([](size_t) { return false; });
    }
    vote.settle(property);
    EXPECT_EQ(property.answer, kCannotTell);
}

TEST(Snapping, RoundsAsItsNameSays) {
    const auto at = [](Rounding rounding, int64_t fixed) {
        return Snapping{8, rounding}(fixed) / 256;
    };
    // Units of 2^-8 pixel are 256; 2.5 units and -2.5 units, 2.25 and -2.25.
    EXPECT_EQ(at(Rounding::nearest_even, 640), 2);
    EXPECT_EQ(at(Rounding::nearest_even, -640), -2);
    EXPECT_EQ(at(Rounding::nearest_even, 896), 4);
    EXPECT_EQ(at(Rounding::nearest_up, 640), 3);
    EXPECT_EQ(at(Rounding::nearest_up, -640), -2);
    EXPECT_EQ(at(Rounding::nearest_down, 640), 2);
    EXPECT_EQ(at(Rounding::nearest_down, -640), -3);
    EXPECT_EQ(at(Rounding::floor, 576), 2);
    EXPECT_EQ(at(Rounding::floor, -576), -3);
    EXPECT_EQ(at(Rounding::ceil, 576), 3);
    EXPECT_EQ(at(Rounding::ceil, -576), -2);
}

TEST(Json, GivesBackTheDatasheet) {
    Datasheet sheet = usual();
    sheet.device = {{"device", "a \"name\""}, {"driver", "d"}};
    const auto back = from_json(to_json(sheet));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->device, sheet.device);
    ASSERT_EQ(back->properties.size(), sheet.properties.size());
    for (size_t k = 0; k < sheet.properties.size(); ++k) {
        EXPECT_EQ(back->properties[k], sheet.properties[k]) << sheet.properties[k].id;
    }
}

TEST(Json, RefusesWhatIsNoDatasheet) {
    EXPECT_THAT(from_json("{").error().message, HasSubstr("it is no JSON"));
    EXPECT_THAT(from_json("[]").error().message, HasSubstr("no datasheet"));
    EXPECT_THAT(from_json(R"({"schema": "edgecase-results-1"})").error().message,
                HasSubstr("no datasheet"));
    EXPECT_THAT(from_json(R"({"schema": "edgecase-probe-1"})").error().message,
                HasSubstr("missing"));
    EXPECT_THAT(
        from_json(R"({"schema": "edgecase-probe-1", "device": {}, "properties": [{"id": 3}]})")
            .error()
            .message,
        HasSubstr("another type"));
}

TEST(Compare, TellsOtherAnswersAlone) {
    software::Device device;
    device.ties = software::TieRule::top_right;
    const Datasheet a = sheet_of({}, {"ties"});
    const Datasheet b = sheet_of(device, {"ties"});
    EXPECT_TRUE(differences(a, a).empty());
    const std::vector<Difference> all = differences(a, b);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].id, "ties.rule");
    EXPECT_EQ(all[0].a, "top-left");
    EXPECT_EQ(all[0].b, "top-right");
    EXPECT_THAT(comparison_text(a, b, "a.json", "gpu"),
                HasSubstr("1 other answers, 0 answers the same"));
    // A property that one of them lacks.
    EXPECT_EQ(differences(a, {}).at(0).b, "not asked");
    EXPECT_EQ(differences({}, a).at(0).a, "not asked");
}

TEST(Page, HasAPictureOfEachKind) {
    const std::string page = to_html(usual());
    EXPECT_THAT(page, HasSubstr("<line class=\"own\""));
    EXPECT_THAT(page, HasSubstr("<path class=\"line\""));
    EXPECT_THAT(to_svg(usual().find("grid.rounding.x")->picture), HasSubstr("<path"));
    EXPECT_THAT(page, HasSubstr(">error, budgets</text>"));
    EXPECT_THAT(page, HasSubstr("<p>" + how_many_are_known(usual()) + "</p>"));
    for (const Property& p : usual().properties) {
        EXPECT_THAT(page, HasSubstr("<tr id=\"" + p.id + "\">"));
        EXPECT_THAT(page, HasSubstr("<code>" + p.id + "</code>"));
    }
    Datasheet odd;
    odd.device = {{"device", "<&\">"}};
    EXPECT_THAT(to_html(odd), HasSubstr("Datasheet of &lt;&amp;&quot;&gt;"));
}

TEST(Text, TellsHowSureItIs) {
    Datasheet sheet;
    sheet.device = {{"device", "d"}};
    sheet.properties = {{"ties.rule", "Q", "top-left", 12, 0, "E", ""},
                        {"grid.bits.x", "R", std::string(kCannotTell), 0, 0, "F", "no picture"}};
    EXPECT_EQ(to_text(sheet, false),
              "device  d\n\nSubpixel grid\n  R  cannot tell\n      no picture\n\nSamples on edges\n"
              "  Q  top-left  (12 of 12)\n\n1 of 2 properties could be told; in parentheses: "
              "decisive observations that agree\n");
    EXPECT_THAT(to_text(sheet, true), HasSubstr("ties.rule: E\n"));
}

}  // namespace
}  // namespace probe
