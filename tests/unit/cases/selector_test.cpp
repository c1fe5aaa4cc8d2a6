// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/select/selector.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "cases/load/loader.hpp"
#include "folders.hpp"

namespace cases {

namespace {

std::vector<Case> suite() {
    std::vector<Case> all;
    const auto add = [&](const char* id, std::vector<std::string> rules) {
        Case c;
        c.id = id;
        c.claim.rules = std::move(rules);
        const std::string path = c.id.substr(0, c.id.find(':'));
        c.claim.where.file = "no-such-folder/" + path + ".toml";
        all.push_back(std::move(c));
    };
    add("coverage/half-square", {"cover.inside"});          // 0
    add("coverage/size:k=1,o=64", {"cover.inside"});        // 1
    add("coverage/size:k=2,o=63.5", {"cover.outside"});     // 2
    add("coverage/deep/one", {"cover.inside"});             // 3
    add("ties/apex:rotation=90", {"tie.top-left"});         // 4
    add("ties/apex-up", {"tie.top-left", "cover.inside"});  // 5
    add("alone", {"depth.linear"});                         // 6
    return all;
}

std::string chosen(const std::vector<std::string>& selectors, const std::string& input = "") {
    std::istringstream stream(input);
    const Expected<std::vector<size_t>> result = select(suite(), selectors, stream);
    if (!result) {
        return to_string(result.error());
    }
    std::string text;
    for (const size_t i : *result) {
        text += std::to_string(i);
    }
    return text;
}

}  // namespace

TEST(Selector, WorkedTable) {
    const std::pair<std::vector<std::string>, std::string> rows[] = {
        {{}, "0123456"},
        {{"**"}, "0123456"},
        {{"*"}, "6"},
        {{"coverage/half-square"}, "0"},
        {{"coverage/*"}, "012"},
        {{"coverage/**"}, "0123"},
        {{"**/one"}, "3"},
        {{"**/alone"}, "6"},
        {{"coverage/**/one"}, "3"},
        {{"coverage/**/half-square"}, "0"},
        {{"coverage/size"}, "12"},
        {{"coverage/size:k=1,o=64"}, "1"},
        {{"coverage/size:*"}, "12"},
        {{"coverage/size:k=2*"}, "2"},
        {{"coverage/size:*o=64"}, "1"},
        {{"*/apex*"}, "45"},
        {{"*/apex"}, "4"},
        {{"ties/*", "alone"}, "456"},
        {{"alone", "ties/*"}, "456"},
        {{"!ties/**"}, "01236"},
        {{"!ties/**", "!alone"}, "0123"},
        {{"coverage/**", "!coverage/size:k=1,o=64"}, "023"},
        {{"!coverage/size:k=1,o=64", "coverage/**"}, "023"},
        {{"coverage/size", "!coverage/size"}, ""},
        {{"@rule:tie.top-left"}, "45"},
        {{"@rule:cover.*"}, "01235"},
        {{"!@rule:cover.*"}, "46"},
    };
    for (const auto& [selectors, expected] : rows) {
        std::string shown;
        for (const std::string& s : selectors) {
            shown += s + " ";
        }
        EXPECT_EQ(chosen(selectors), expected) << shown;
    }
}

// What the words of docs/cli.md say, by trying every length of every star.
bool matches_by_trying(std::string_view pattern, std::string_view text) {
    if (pattern.empty()) {
        return text.empty();
    }
    if (pattern[0] != '*') {
        return !text.empty() && text[0] == pattern[0] &&
               matches_by_trying(pattern.substr(1), text.substr(1));
    }
    const bool is_deep = pattern.starts_with("**");
    const bool is_folders = pattern.starts_with("**/");
    const std::string_view rest = pattern.substr(is_folders ? 3 : is_deep ? 2 : 1);
    for (size_t n = 0; n <= text.size(); ++n) {
        if (!is_deep && n > 0 && (text[n - 1] == '/' || text[n - 1] == ':')) {
            return false;
        }
        if ((!is_folders || n == 0 || text[n - 1] == '/') &&
            matches_by_trying(rest, text.substr(n))) {
            return true;
        }
    }
    return false;
}

TEST(Selector, StarsMatchWhatTryingFinds) {
    std::mt19937 random(5);
    std::uniform_int_distribution<size_t> length(0, 7);
    const auto word = [&](std::string_view letters) {
        std::string out;
        for (size_t n = length(random); n > 0; --n) {
            out += letters[random() % letters.size()];
        }
        return out;
    };
    size_t matching = 0;
    for (int n = 0; n < 200000; ++n) {
        const std::string pattern = word("a/***:");
        const std::string text = word("aa//:");
        const bool expected = matches_by_trying(pattern, text) ||
                              matches_by_trying(pattern, text.substr(0, text.find(':')));
        ASSERT_EQ(glob_matches(pattern, text), expected) << pattern << " on " << text;
        matching += expected ? 1U : 0U;
    }
    EXPECT_GT(matching, 20000U);
}

TEST(Selector, ManyStarsEnd) {
    std::string pattern;
    for (int n = 0; n < 10000; ++n) {
        pattern += "**/";
    }
    std::string id(200, 'a');
    id += "/b";
    EXPECT_FALSE(glob_matches(pattern + "x", id));
}

TEST(Selector, ReadsStandardInput) {
    EXPECT_EQ(chosen({"-"}, "ties/apex-up\n\n# a comment\n  alone \r\n"), "56");
    EXPECT_EQ(chosen({"-", "!alone"}, "ties/*\nalone"), "45");
    EXPECT_EQ(chosen({"-"}, "# nothing\n"),
              "error: standard input names no case; write one selector a line");
}

TEST(Selector, NamedCasesAreChosenWhateverTheirIds) {
    const auto with = [](const std::vector<size_t>& named, const std::vector<std::string>& rest) {
        std::istringstream none;
        return select(suite(), rest, none, named).value();
    };
    EXPECT_EQ(with({6}, {}), (std::vector<size_t>{6}));
    EXPECT_EQ(with({6}, {"!coverage/**"}), (std::vector<size_t>{6}));
    EXPECT_EQ(with({6, 1}, {"ties/apex-up"}), (std::vector<size_t>{1, 5, 6}));
    EXPECT_EQ(with({6, 1}, {"!alone"}), (std::vector<size_t>{1}));
}

TEST(Selector, SaysWhatIsWrong) {
    const std::pair<std::string, std::string> rows[] = {
        {"coverage/half-squar",
         "error: no case matches coverage/half-squar; did you mean coverage/half-square?"},
        {"coverage/size:k=3,o=64",
         "error: no case matches coverage/size:k=3,o=64; did you mean coverage/size:k=1,o=64?"},
        {"coverage/size:k=1",
         "error: no case matches coverage/size:k=1; did you mean coverage/size:k=1,o=64?"},
        {"coverage/size:winding=reversed",
         "error: no case matches coverage/size:winding=reversed; coverage/size has 2 leaves, the "
         "first is coverage/size:k=1,o=64"},
        {"coverage/half-square:side=12345",
         "error: no case matches coverage/half-square:side=12345; coverage/half-square has no "
         "leaves"},
        {"nothing-like-it", "error: no case matches nothing-like-it"},
        {"@rule:cover.insid", "error: no rule is called cover.insid; did you mean cover.inside?"},
        {"@rule:clip.volume", "error: no case checks the rule clip.volume"},
        {"@family:x", "error: the selector @family:x is unknown; write @rule:PATTERN or a case id"},
        {"", "error: a selector is empty; write a case id or a pattern"},
        {std::string(4097, '*'),
         "error: a selector has 4097 characters, the most are 4096; write several selectors"},
        {"!", "error: a selector is empty; write a case id or a pattern"},
        // "*" does not cross ':'.
        {"ties/a*90", "error: no case matches ties/a*90; did you mean ties/apex?"},
        // A family is no case.
        {"ties", "error: no case matches ties; did you mean ties/**?"},
        {"ties/", "error: no case matches ties/; did you mean ties/**?"},
        {"tise/**", "error: no case matches tise/**; did you mean ties/**?"},
        // The first part of a word may be the family's beginning, or near to it.
        {"cover/**", "error: no case matches cover/**; did you mean coverage/**?"},
        {"cove/edge/w-ratio",
         "error: no case matches cove/edge/w-ratio; did you mean coverage/**?"},
        {"coverge/edge/w-ratio",
         "error: no case matches coverge/edge/w-ratio; did you mean coverage/**?"},
        {"co/**", "error: no case matches co/**"},
        {"coverage/nothing-like-it/**", "error: no case matches coverage/nothing-like-it/**"},
        {"nowhere.toml", "error: there is no case file nowhere.toml"},
        {"!tie/apex-up", "error: no case matches tie/apex-up; did you mean ties/apex-up?"},
    };
    for (const auto& [selector, message] : rows) {
        EXPECT_EQ(chosen({selector}), message);
    }
}

TEST(Selector, TakesPathsOfTheSuite) {
    const std::string root = test_support::source_dir() + "/cases/suite";
    const Suite loaded = load_suite(root);
    ASSERT_FALSE(loaded.cases.empty());
    std::istringstream none;
    const auto count = [&](const std::string& path) {
        return select(loaded.cases, {path}, none).value_or(std::vector<size_t>{}).size();
    };
    EXPECT_EQ(count(root), loaded.cases.size());
    EXPECT_EQ(count(root + "/coverage/half-square.toml"), 1U);
    EXPECT_GT(count(root + "/coverage/"), 1U);
    EXPECT_LT(count(root + "/coverage"), loaded.cases.size());
}

TEST(NearestName, IsNearOrNothing) {
    const std::vector<std::string> words = {"vertices", "viewport", "cull", "none"};
    EXPECT_EQ(nearest_name("vertexes", words), "vertices");
    EXPECT_EQ(nearest_name("viewprot", words), "viewport");
    EXPECT_EQ(nearest_name("cul", words), "cull");
    EXPECT_EQ(nearest_name("", words), "");
    EXPECT_EQ(nearest_name("shader", words), "");
    EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace cases
