// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/reduce.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "cases/load/loader.hpp"
#include "cases/model/triangle.hpp"
#include "fuzz/generate/generator.hpp"
#include "fuzz/reduce/edits.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;
using Kind = Document::Kind;

std::vector<std::string> suite_texts() {
    std::vector<std::string> texts;
    for (const auto& entry : fs::recursive_directory_iterator(EDGECASE_SOURCE_DIR "/cases/suite")) {
        if (entry.path().extension() == ".toml") {
            std::ifstream in(entry.path(), std::ios::binary);
            texts.emplace_back(std::istreambuf_iterator<char>(in),
                               std::istreambuf_iterator<char>());
        }
    }
    return texts;
}

// As read, but for the order of keys and for whole floats.
bool is_same(const Document& a, const Document& b) {
    if (a.is(Kind::floating) || b.is(Kind::floating)) {
        const double x = number_of(a), y = number_of(b);
        return (std::isnan(x) && std::isnan(y)) ||
               (!(x < y) && !(y < x) && std::signbit(x) == std::signbit(y));
    }
    if (a.kind != b.kind || a.boolean != b.boolean || a.integer != b.integer ||
        a.string != b.string || a.array.size() != b.array.size() ||
        a.table.size() != b.table.size()) {
        return false;
    }
    for (size_t k = 0; k < a.array.size(); ++k) {
        if (!is_same(a.array[k], b.array[k])) {
            return false;
        }
    }
    return std::all_of(a.table.begin(), a.table.end(), [&](const auto& entry) {
        const Document* other = b.find(entry.key);
        return other != nullptr && is_same(entry.value, *other);
    });
}

TEST(Document, EveryFileOfTheSuiteIsWrittenAsItWasRead) {
    size_t files = 0;
    for (const std::string& text : suite_texts()) {
        const auto document = cases::read_toml(text, "f");
        ASSERT_TRUE(document);
        const std::string written = to_text(*document);
        const auto again = cases::read_toml(written, "g");
        ASSERT_TRUE(again) << cases::to_string(again.error()) << '\n' << written;
        EXPECT_TRUE(is_same(*document, *again)) << text << "\n---\n" << written;
        EXPECT_EQ(to_text(*again), written);
        ++files;
    }
    EXPECT_GT(files, 600U);
}

// Edits come to documents that others have changed.
TEST(Edits, NoneFailsOnAnyDocument) {
    std::vector<std::string> texts = suite_texts();
    Poses poses(11);
    for (uint64_t k = 0; k < 60; ++k) {
        const Pose pose =
            poses.next([&](const Pose& candidate) { return is_case(11, candidate, k); });
        texts.push_back(case_text(11, pose, k, k * 128));
    }
    size_t applied = 0;
    for (size_t t = 0; t < texts.size(); ++t) {
        const auto document = cases::read_toml(texts[t], "f");
        ASSERT_TRUE(document);
        const std::vector<Edit> all = edits(*document);
        for (size_t k = t % 7; k < all.size(); k += 7) {
            Document changed = *document;
            applied += all[k].apply(changed) ? 1U : 0U;
            for (size_t other = (t + k) % 11; other < all.size(); other += 11) {
                Document twice = changed;
                applied += all[other].apply(twice) ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(applied, 10000U);
}

constexpr const char* kMuch = R"(format = 1
description = "Much."
rules = ["cover.inside"]
relations = ["same-twice"]
[target]
size = [32, 24]
samples = 4
layers = 2
depth = "d32-float"
stencil = true
[target.color]
format = "rgba16-float"
clear = [0.5, 0, 0, 1]
[[draw]]
cull = "none"
scissor = [3, 2, 20, 20]
vertices = [[1, 1], [9.5, 1.25], [1, 9], [20.125, 20], [30, 20], [20, 23], [2, 2], [3, 2], [2, 3]]
depth = { compare = "less", bias = { constant = 3, slope = 1.5 } }
color = { value = [1, 0, 0, 1], blend = "additive", write_mask = "rgb" }
[[draw.attribute]]
interpolation = "noperspective"
values = [[1, 0], [0, 1], [0.25, 0.5], [1, 0], [0, 1], [0.25, 0.5], [1, 0], [0, 1], [0.25, 0.5]]
[[draw]]
topology = "triangle-fan"
vertices = [[16, 12], [20, 12], [18, 18], [10, 14], [9, 3]]
color = { value = [1, 0, 0, 1] }
)";

struct Asked {
    size_t texts = 0;
    Reduced reduced;
};
template <class Test>
Asked reduced_by(const Test& test) {
    Asked asked;
    const Shows shows = [&](const std::vector<std::string>& texts) {
        std::vector<bool> answers;
        for (const std::string& text : texts) {
            const auto loaded = cases::load_text(text, "f", "id");
            EXPECT_TRUE(loaded) << text;  // only cases are asked about
            answers.push_back(loaded && test(loaded->front()));
        }
        asked.texts += texts.size();
        return answers;
    };
    const auto much = cases::load_text(kMuch, "f", "id");
    EXPECT_TRUE(much) << cases::to_string(much.error().front());
    asked.reduced = reduce(*cases::read_toml(kMuch, "f"), shows);
    // No single step is left: another reduction asks about all, and changes nothing.
    const Reduced again = reduce(asked.reduced.document, shows);
    EXPECT_EQ(again.rounds, 1U);
    EXPECT_EQ(to_text(again.document), to_text(asked.reduced.document));
    return asked;
}

TEST(Reduce, LeavesWhatIsNeededAndNoMore) {
    const Asked asked = reduced_by([](const cases::Case& c) {
        return c.target.samples == 4 &&
               std::any_of(c.draws.begin(), c.draws.end(), [&](const cases::Draw& d) {
                   return d.scissor.width == 20 && c.target.width <= 32;
               });
    });
    EXPECT_TRUE(asked.reduced.is_minimal);
    EXPECT_EQ(to_text(asked.reduced.document),
              "format = 1\ndescription = \"Much.\"\nrules = [\"cover.inside\"]\n\n[target]\nsize = "
              "[1, 1]\nsamples = 4\n\n[[draw]]\nscissor = [0, 0, 20, 20]\nvertices = [[20, 20], "
              "[30, 20], [20, 23]]\n");
    EXPECT_THAT(asked.reduced.needs,
                testing::IsSupersetOf({"not with 1 sample", "not without scissor"}));
    EXPECT_LT(asked.texts, 600U);
}

TEST(Reduce, KeepsAnAttribute) {
    const Asked asked = reduced_by([](const cases::Case& c) {
        return std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& d) {
            return std::any_of(d.attributes.begin(), d.attributes.end(), [](const auto& a) {
                return a.interpolation == cases::Interpolation::noperspective;
            });
        });
    });
    EXPECT_TRUE(asked.reduced.is_minimal);
    const auto c = cases::load_text(to_text(asked.reduced.document), "f", "id");
    EXPECT_EQ(cases::assemble(c->front()).size(), 1U);
    EXPECT_THAT(asked.reduced.needs, testing::Contains("not without attribute 0"));
}

TEST(Reduce, KeepsTheFan) {
    const Asked asked = reduced_by([](const cases::Case& c) {
        return cases::assemble(c).size() >= 2 &&
               std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& d) {
                   return d.topology == cases::Topology::triangle_fan;
               });
    });
    EXPECT_TRUE(asked.reduced.is_minimal);
    const auto c = cases::load_text(to_text(asked.reduced.document), "f", "id");
    EXPECT_EQ(cases::assemble(c->front()).size(), 2U);
    EXPECT_EQ(c->front().draws.size(), 1U);
}

TEST(Reduce, WhatNeverShowsStaysAsItIs) {
    const Document document = *cases::read_toml(kMuch, "f");
    const Reduced reduced = reduce(document, [](const std::vector<std::string>& texts) {
        return std::vector<bool>(texts.size(), false);
    });
    EXPECT_EQ(to_text(reduced.document), to_text(document));
    EXPECT_EQ(reduced.rounds, 1U);
}

TEST(Reduce, EndsAfterTheRoundsThatItMayTake) {
    ReduceOptions options;
    options.most_rounds = 2;
    const Reduced reduced = reduce(
        *cases::read_toml(kMuch, "f"),
        [](const std::vector<std::string>& texts) { return std::vector<bool>(texts.size(), true); },
        options);
    EXPECT_EQ(reduced.rounds, 2U);
    EXPECT_FALSE(reduced.is_minimal);
}

}  // namespace
}  // namespace fuzz
