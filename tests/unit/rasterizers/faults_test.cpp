// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The catalogue of faults: each row is told apart from all others, breaks rules, and has a body;
// each body has a row, and rules are exercised by rows that have a change.
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "cases/fault/bodies.hpp"
#include "cases/fault/change.hpp"
#include "cases/fault/fault.hpp"
#include "cases/model/rule.hpp"
#include "rasterizers/strength/picture.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/exercise/exercise_table.hpp"

namespace {

using cases::FaultRow;
using cases::kFaults;
using cases::operator""_fault;

TEST(Faults, AreToldApart) {
    std::set<std::string_view> names, sentences;
    for (const FaultRow& row : kFaults) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_TRUE(sentences.insert(row.sentence).second) << row.sentence;
        EXPECT_TRUE(row.sentence.ends_with('.')) << row.name;
        EXPECT_EQ(cases::find_fault(row.name), row.fault) << row.name;
        EXPECT_EQ(&cases::row_of(row.fault), &row) << row.name;
    }
    EXPECT_EQ(cases::find_fault("no-such-fault"), cases::kNoFault);
}

TEST(Faults, BreakRules) {
    for (const FaultRow& row : kFaults) {
        std::istringstream words{std::string(row.rules)};
        size_t rules = 0;
        for (std::string rule; words >> rule; ++rules) {
            EXPECT_NE(cases::find_rule(rule), nullptr) << row.name << ": " << rule;
        }
        EXPECT_GT(rules, 0U) << row.name;
    }
}

// What the software device has no code for it draws by a change of the case or of the picture; that
// it has code for the others docs/mutants.md is made from.
TEST(Faults, HaveABody) {
    for (const FaultRow& row : kFaults) {
        if (!cases::has_code(row.fault)) {
            EXPECT_TRUE(cases::has_change(row.fault) || software::has_picture(row.fault))
                << row.name;
        } else {
            EXPECT_FALSE(software::has_picture(row.fault)) << row.name;
        }
    }
}

TEST(Faults, HaveOneChange) {
    std::set<cases::Fault> changed;
    for (const auto bodies : {cases::fault::geometry_bodies(), cases::fault::input_bodies(),
                              cases::fault::depth_bodies(), cases::fault::target_bodies()}) {
        for (const cases::fault::Body& body : bodies) {
            EXPECT_TRUE(changed.insert(body.fault).second) << to_string(body.fault);
            EXPECT_TRUE(cases::has_change(body.fault)) << to_string(body.fault);
        }
    }
}

// A rule is exercised by a change, and the change says which rule it breaks.
TEST(Faults, ExerciseTheRulesThatTheyBreak) {
    size_t count = 0;
    for (const cases::Rule& rule : cases::all_rules()) {
        const ref::ExerciseRow* row = ref::find_exercise(rule.id);
        for (size_t k = 0; row != nullptr && k < row->ways.size(); ++k) {
            const cases::Fault fault = row->ways.at(k).fault;
            if (fault == cases::kNoFault) {
                continue;
            }
            ++count;
            EXPECT_TRUE(cases::has_change(fault)) << rule.id << ": " << to_string(fault);
            const std::string rules = " " + std::string(cases::row_of(fault).rules) + " ";
            EXPECT_NE(rules.find(" " + std::string(rule.id) + " "), std::string::npos)
                << to_string(fault) << " does not say that it breaks " << rule.id;
        }
    }
    EXPECT_GT(count, 60U);
}

// The proof of an exercise is drawn by code of the device, not by the change that found it.
TEST(Faults, AreDrawnByTheDevicesCodeWhereItHasSome) {
    cases::Case c;
    c.target = {4, 4, 1};
    cases::Draw draw;
    draw.positions = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    draw.viewport = {0, 0, 4, 4, 0, 1};
    draw.scissor = {1, 1, 2, 2};
    c.draws = {draw};
    ASSERT_TRUE(cases::has_code("scissor-ignored"_fault));
    cases::Case open = c;
    ASSERT_TRUE(cases::take_with("scissor-ignored"_fault, open));
    EXPECT_EQ(open.draws[0].scissor.width, 4U);
    const auto hits = [&](cases::Fault fault) {
        software::Device device;
        device.fault = fault;
        const capture::Capture drawn = software::captured(c, device);
        return std::ranges::count_if(drawn.hits, [](const auto& h) { return h.x + h.y > 0; });
    };
    EXPECT_EQ(hits(cases::kNoFault), 4);
    EXPECT_EQ(hits("scissor-ignored"_fault), 16);     // by code
    EXPECT_EQ(hits("scissor-column-lost"_fault), 2);  // by a change of the case
    EXPECT_EQ(hits("draw-nothing"_fault), 0);
}

}  // namespace
