// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The key `relations`: what is read, and every sentence said of it.
#include <gtest/gtest.h>

#include "cases/load/loader.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/rule.hpp"

namespace cases {
namespace {

const std::string kAttribute = "[[draw.attribute]]\nconstant = 1\n";

std::string relation_file(const std::string& relations, const std::string& more = "",
                          const std::string& top = "") {
    return "format = 1\ndescription = \"d\"\nrules = [\"repeat.same\"]\nrelations = " + relations +
           "\n" + top + "[target]\nsize = [8, 4]\n[[draw]]\nvertices = [[0,0],[8,0],[0,4]]\n" +
           more;
}

std::string relation_error(const std::string& text) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(text, "f", "id");
    return loaded ? "no error" : to_string(loaded.error().front());
}

std::vector<std::string> names(const std::string& text) {
    std::vector<std::string> result;
    const ExpectedAll<std::vector<Case>> loaded = load_text(text, "f", "id");
    for (const Derivation& d : derivations(loaded.value().front())) {
        result.push_back(d.name);
    }
    return result;
}

}  // namespace

TEST(Relations, AreReadInOrder) {
    EXPECT_EQ(names(relation_file(R"(["same-twice", { scissor-tiles = [7, 3] }, "other-clears"])")),
              (std::vector<std::string>{"same-twice", "same-twice, later", "scissor-tiles 7x3",
                                        "other-clears"}));
    EXPECT_EQ(
        names(
            relation_file(R"(["write-masks", "fewer-attributes", "more-attributes"])", kAttribute)),
        (std::vector<std::string>{"write-masks, every other attachment", "write-masks, the others",
                                  "fewer-attributes", "more-attributes"}));
}

TEST(Relations, TakeMatrixKeys) {
    const std::string text =
        relation_file(R"(["r", { scissor-tiles = ["k", "k+1"] }])", "",
                      "[matrix]\nr = [\"same-twice\", \"other-clears\"]\nk = [2, 3]\n");
    const ExpectedAll<std::vector<Case>> loaded = load_text(text, "f", "id");
    ASSERT_TRUE(loaded);
    ASSERT_EQ(loaded->size(), 4U);
    EXPECT_EQ((*loaded)[3].relations,
              (std::vector<Relation>{{RelationKind::other_clears, {}},
                                     {RelationKind::scissor_tiles, {3, 4}}}));
}

TEST(Relations, EveryRuleIsOneOfTheList) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(
        relation_file(R"(["same-twice", { scissor-tiles = [7, 3] }, "other-clears", "write-masks",
                 "fewer-attributes", "more-attributes"])",
                      kAttribute),
        "f", "id");
    ASSERT_TRUE(loaded);
    for (const Derivation& d : derivations(loaded->front())) {
        EXPECT_NE(find_rule(d.rule), nullptr) << d.name;
    }
}

TEST(Relations, EverySentence) {
    const std::vector<std::pair<std::string, std::string>> table = {
        {relation_file("1"), "f:4:13: error: relations is the number 1; write an array"},
        {relation_file(R"(["twice"])"),
         R"(f:4:14: error: a relation is "twice"; write "same-twice", "other-clears", )"
         R"("write-masks", "fewer-attributes" or "more-attributes")"},
        {relation_file(R"([{ tiles = [1, 2] }])"),
         R"(f:4:16: error: a relation has no key "tiles"; its keys are scissor-tiles, doors)"},
        {relation_file(R"([{ scissor-tiles = [1] }])"),
         "f:4:32: error: scissor-tiles has 1 number; write [width, height]"},
        {relation_file(R"([{ scissor-tiles = [0, 1] }])"),
         "f:4:33: error: a tile's side is not an integer from 1 to 16384"},
        {relation_file(R"(["same-twice", "same-twice"])"),
         "f:4:28: error: the relation same-twice stands twice"},
        {relation_file(R"(["fewer-attributes"])"),
         "f:4:14: error: the relation fewer-attributes has no attribute to leave out; add a "
         "[[draw.attribute]]"},
        {relation_file(R"(["more-attributes"])"),
         "f:4:14: error: the relation more-attributes needs 1 to 3 attributes to copy, not 0"},
        {relation_file(R"(["more-attributes"])",
                       kAttribute + "[[draw]]\nvertices = [[0,0],[8,0],[0,4]]\n"),
         "f:4:14: error: the relation more-attributes needs the same number of attributes in every "
         "draw"},
    };
    for (const auto& [text, expected] : table) {
        EXPECT_EQ(relation_error(text), expected);
    }
    std::string large = relation_file(R"([{ scissor-tiles = [1, 1] }])");
    large.replace(large.find("[8, 4]"), 6, "[65, 64]");
    EXPECT_EQ(relation_error(large),
              "f:4:14: error: the relation scissor-tiles has 4160 tiles, at most 4096 are drawn; "
              "make them larger");
}

}  // namespace cases
