// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/reduce.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "cases/base/checksum.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/triangle.hpp"
#include "cases/wire/case_bytes.hpp"
#include "fuzz/reduce/measure.hpp"
#include "reduce_documents.hpp"
#include "simpler.hpp"
#include "suite_documents.hpp"
#include "tests/share.hpp"

namespace fuzz {
namespace {

using cases::Case;
using testing::ElementsAre;

using Property = std::function<bool(const Case&)>;

// The cases that have the property show the finding.
Shows shows_with(const Property& property) {
    return [property](const std::vector<Candidate>& candidates) {
        EXPECT_FALSE(candidates.empty());
        std::vector<bool> answers;
        for (const Candidate& candidate : candidates) {
            answers.push_back(property(candidate.data));
        }
        return answers;
    };
}

// Whether a triangle of the case covers that point, in pixels, without clipping.
bool covers(const Case& c, double x, double y) {
    return std::ranges::any_of(cases::assemble(c), [&](const cases::Triangle& triangle) {
        const cases::Draw& draw = c.draws[triangle.draw];
        std::array<std::array<double, 2>, 3> p{};
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec4 v = draw.positions[triangle.vertex.at(k)];
            const glm::dvec4 port(draw.viewport.x, draw.viewport.y, draw.viewport.width,
                                  draw.viewport.height);
            p.at(k) = {port.x + port.z / 2 * (v.x / v.w + 1),
                       port.y + port.w / 2 * (v.y / v.w + 1)};
        }
        int left = 0;
        int right = 0;
        for (size_t k = 0; k < 3; ++k) {
            const auto& a = p.at(k);
            const auto& b = p.at((k + 1) % 3);
            const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            left += side > 0 ? 1 : 0;
            right += side < 0 ? 1 : 0;
        }
        return left == 3 || right == 3;
    });
}

bool has_scissor(const Case& c) {
    return std::ranges::any_of(c.draws, [&](const cases::Draw& draw) {
        return draw.scissor != cases::Rect{0, 0, c.target.width, c.target.height};
    });
}

std::vector<Candidate> candidate(const Document& document) {
    return {{to_text(document), load(to_text(document))}};
}

// Nothing that is one step simpler shows the finding, asked anew.
void expect_minimal(const Reduced& reduced, const Shows& shows) {
    EXPECT_TRUE(reduced.is_minimal);
    const Measure least = measure(reduced.document);
    for (const Simpler& one : simpler(reduced.document)) {
        EXPECT_FALSE(shows(candidate(one.document)).front()) << one.step << " of\n"
                                                             << to_text(reduced.document);
        EXPECT_LT(measure(one.document), least) << one.step;
    }
}

TEST(Reduce, LeavesWhatIsNeededAndNoMore) {
    const Property property = [](const Case& c) {
        return c.target.samples == 4 && has_scissor(c) && covers(c, 3.5, 4.5);
    };
    const Shows shows = shows_with(property);
    const Document document = read(kCrowded);
    ASSERT_TRUE(property(load(to_text(document))));
    const Reduced reduced = reduce(document, shows);
    expect_minimal(reduced, shows);
    const Case c = load(to_text(reduced.document));
    EXPECT_EQ(c.draws.size(), 1U);
    EXPECT_EQ(c.draws[0].positions.size(), 3U);
    EXPECT_FALSE(c.target.color);
    EXPECT_TRUE(c.draws[0].attributes.empty());
    EXPECT_EQ(reduced.document.find("draw")->array[0].table.size(), 2U) << "vertices, scissor";
    EXPECT_THAT(reduced.needs,
                ElementsAre("not with 1 sample", "not with 2 samples", "not without scissor"))
        << to_text(reduced.document);
}

// A run that only has to begin for the next one to be wrong is left with one index.
TEST(Reduce, LeavesNoTriangleBesideARestart) {
    const Shows shows = shows_with([](const Case& c) {
        const auto& indices = c.draws[0].indices;
        return indices && covers(c, 3.5, 4.5) && indices->front() != cases::kRestartIndex &&
               std::ranges::count(*indices, cases::kRestartIndex) == 1;
    });
    const Document document = read(
        "format = 1\ndescription = \"Two runs.\"\nrules = [\"cover.inside\"]\n[target]\nsize = [8, "
        "8]\n[[draw]]\ntopology = \"triangle-strip\"\n"
        "vertices = [[0, 0], [1, 0], [0, 1], [2, 2], [8, 2], [2, 8], [8, 8]]\n"
        "indices = [0, 1, 2, \"restart\", 3, 4, 5, 6]\n");
    ASSERT_TRUE(shows(candidate(document)).front());
    const Reduced reduced = reduce(document, shows);
    expect_minimal(reduced, shows);
    const Case c = load(to_text(reduced.document));
    EXPECT_EQ(c.draws[0].indices->size(), 5U) << to_text(reduced.document);
    EXPECT_EQ(cases::assemble(c).size(), 1U);
}

// A list of 300 triangles in rows.
Document many_triangles(size_t count) {
    Document document = read(
        "format = 1\ndescription = \"Many.\"\nrules = [\"cover.inside\"]\n[target]\nsize = [64, "
        "64]\n"
        "[[draw]]\nspace = \"clip\"\n[[draw.attribute]]\ninterpolation = \"flat\"\n");
    Document vertices = list({});
    Document values = list({});
    for (size_t k = 0; k < count; ++k) {
        const double x = -1 + static_cast<double>(k % 20) / 16;
        const double y = -1 + static_cast<double>(k / 20) / 16;
        for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {0x1.7p-4, 0x1p-9}, {0x1p-7, 0x1.5p-4}}) {
            vertices.array.push_back(numbers({x + dx, y + dy, 0.25, 1}));
            values.array.push_back(number(static_cast<double>(k) + 0.5));
        }
    }
    Document& draw = find(document, "draw")->array[0];
    set(draw, "vertices", vertices);
    set(find(draw, "attribute")->array[0], "values", values);
    return document;
}

TEST(Reduce, FindsTwoOfThreeHundredTriangles) {
    const Shows shows = shows_with([](const Case& c) {
        return covers(c, 11, 5.5) && covers(c, 33, 21.5) && c.draws[0].attributes.size() == 1;
    });
    const Document document = many_triangles(300);
    ASSERT_TRUE(shows(candidate(document)).front());
    const Reduced reduced = reduce(document, shows);
    expect_minimal(reduced, shows);
    const Case c = load(to_text(reduced.document));
    EXPECT_EQ(c.draws[0].positions.size(), 6U);
    // Measured: 269 texts in 13 calls.
    EXPECT_LE(reduced.tried, 400U);
    EXPECT_LE(reduced.rounds, 20U);
}

// What a case has that a finding may depend on, in words.
std::set<std::string> properties_of(const Case& c) {
    std::set<std::string> out;
    const auto add = [&](bool is_so, const std::string& what) {
        if (is_so) {
            out.insert(what);
        }
    };
    out.insert(fmt::format("samples {}", c.target.samples));
    add(c.target.layers > 1, "layers");
    add(c.target.color.has_value(), "color");
    add(c.target.color_resolve != cases::Resolve::none, "resolve");
    add(c.target.has_stencil, "stencil");
    add(!c.target.has_instruments, "attachments");
    add(!c.relations.empty(), "relations");
    add(c.draws.size() > 1, "draws");
    add(cases::assemble(c).size() > 1, "triangles");
    for (const cases::Draw& draw : c.draws) {
        add(draw.topology != cases::Topology::triangle_list, "topology");
        add(draw.indices.has_value(), "indices");
        add(draw.primitive_restart, "restart");
        add(draw.cull != cases::CullMode::none, "cull");
        add(draw.depth.compare != cases::CompareOp::always, "compare");
        add(draw.depth.bias.has_value(), "bias");
        add(draw.distances.clip_count > 0, "clip");
        add(draw.distances.cull_count > 0, "cull distance");
        add(draw.color.blend.has_value(), "blend");
        add(draw.color.attribute >= 0, "color of an attribute");
        add(std::ranges::any_of(draw.positions, [](const glm::vec4& p) { return p.w > 1.5F; }),
            "w");
        for (const cases::Attribute& attribute : draw.attributes) {
            out.insert(fmt::format("attribute {} {} {}", static_cast<int>(attribute.interpolation),
                                   static_cast<int>(attribute.source),
                                   static_cast<int>(attribute.probe)));
            add(attribute.components > 1, "components");
        }
    }
    add(has_scissor(c), "scissor");
    return out;
}

// Files that are one case with its vertices written out: what fuzzers and writers of cases make.
std::vector<SuiteDocument> plain_documents() {
    std::vector<SuiteDocument> out = suite_documents();
    std::erase_if(out, [](const SuiteDocument& file) {
        return file.text.find("\n[matrix]") != std::string::npos ||
               file.text.find("\ngenerate") != std::string::npos;
    });
    return out;
}

// Which part of the properties is needed: every third, from one that the text chooses.
std::set<std::string> some_of(const std::set<std::string>& all, size_t from) {
    std::set<std::string> out;
    for (const std::string& one : all) {
        if (from++ % 3 == 0) {
            out.insert(one);
        }
    }
    return out;
}

// "draw 1 with scissor[2] as 16" -> "with scissor[] as": what kind of step it is.
std::string kind_of(std::string words) {
    std::erase_if(words, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
    return words.rfind("draw  ", 0) == 0 ? words.substr(6) : words;
}

// A reduction that is checked: no text twice, no more at once than the batch, a minimum, the same
// again. Counts the kinds of the steps that were taken.
Reduced checked(const Document& document, const Shows& shows,
                std::map<std::string, size_t>& kinds) {
    const ReduceOptions kOptions = {.batch = 32};
    std::set<std::string> asked;
    const Shows once = [&](const std::vector<Candidate>& candidates) {
        EXPECT_LE(candidates.size(), kOptions.batch);
        for (const Candidate& one : candidates) {
            EXPECT_TRUE(asked.insert(one.text).second) << "asked twice:\n" << one.text;
            Case read_again = load(one.text);
            read_again.id = one.data.id;
            EXPECT_EQ(cases::to_bytes(one.data), cases::to_bytes(read_again)) << one.text;
        }
        return shows(candidates);
    };
    Reduced reduced = reduce(document, once, kOptions);
    EXPECT_EQ(asked.size(), reduced.tried);
    expect_minimal(reduced, shows);
    const Reduced again = reduce(document, shows, kOptions);
    EXPECT_EQ(to_text(again.document), to_text(reduced.document));
    EXPECT_EQ(again.steps, reduced.steps);
    EXPECT_EQ(again.needs, reduced.needs);
    EXPECT_EQ(again.rounds, reduced.rounds);
    for (const std::string& step : reduced.steps) {
        ++kinds[kind_of(step)];
    }
    return reduced;
}

// Each kind of step that a reduction of the suite's files takes, without its numbers and names.
constexpr const char* kKinds[] = {
    "as a list without indices",
    "at half the size",
    "attribute  constant with ",
    "clip distance  values with ",
    "color value with ",
    "cull distance  values with ",
    "cut to what is drawn",
    "in pixels",
    "scissor with ",
    "viewport with ",
    "viewport with whole numbers",
    "with  layer",
    "with  sample",
    "with  samples",
    "with attribute  alike at all vertices",
    "with attribute  constant as ",
    "with attribute  from the vertices",
    "with attribute  of one component fewer",
    "with positions of half the digits",
    "with positions of moderate numbers",
    "with positions of whole numbers",
    "with sample mask as ",
    "with smooth attribute ",
    "with w of ",
    "with x of vertex  as ",
    "with y of vertex  as ",
    "with z of /",
    "with z of whole numbers",
    "without  column at the right",
    "without  columns at the left",
    "without  row at the bottom",
    "without  rows at the top",
    "without a colour target",
    "with the format rgbaunorm",
    "without a depth test",
    "without attribute ",
    "without attribute  auxiliary",
    "without attribute  name",
    "without attribute  probe",
    "without catches",
    "without clip distance ",
    "without clip distance  negate",
    "without cull distance ",
    "without culling",
    "without depth",
    "without depth bias slope",
    "without depth volume",
    "without depth write",
    "without draw ",
    "without draws  to ",
    "without expect",
    "without front face",
    "without indices",
    "without layer",
    "without links",
    "without min sample shading",
    "without order",
    "without provoking",
    "without rasterizer discard",
    "without relation ",
    "without relations",
    "without run ",
    "without sample mask",
    "without scissor",
    "without shader mask",
    "without target color clear",
    "without target depth",
    "without target depth clear",
    "without target depth resolve",
    "without target resolve",
    "without target sample locations",
    "without target stencil",
    "without the first  of  triangles",
    "without the last  of  triangles",
    "without topology",
    "without triangle ",
    "without triangles  to ",
    "without unused vertices",
    "without viewport",
    "without viewport index",
    "without what is left over of the list",
    "without z and w",
    "without z and w of vertex ",
};
// Of a file's properties; a share has one of every other file.
constexpr size_t kParts = 3;

// Over the plain files of the suite, each with a part of its properties needed, and answers without
// a reason, which make the search take what no sensible one takes.
TEST(Reduce, EndsAtAMinimumByStepsOfAllKinds) {
    std::map<std::string, size_t> kinds;
    const std::vector<SuiteDocument> files = plain_documents();
    EXPECT_GT(files.size(), 150U);
    const test_support::Share share = test_support::share_of(2 * kParts, files.size());
    const auto reduce_part = [&](size_t k, size_t from) {
        const std::set<std::string> needed = some_of(properties_of(load(files[k].text)), from);
        const Shows shows = shows_with([&](const Case& candidate) {
            return std::ranges::includes(properties_of(candidate), needed);
        });
        const Reduced reduced = checked(read(files[k].text), shows, kinds);
        // Measured: at most 240 texts in 11 calls.
        EXPECT_LE(reduced.tried, 400U) << files[k].name;
        EXPECT_LE(reduced.rounds, 20U) << files[k].name;
    };
    for (size_t k = 0; k < files.size(); ++k) {
        for (size_t from = 0; from < kParts; ++from) {
            if ((k + from) % share.shares == share.share) {
                reduce_part(k, from);
            }
        }
    }
    for (const std::string& needed : properties_of(load(kCrowded))) {
        const Shows shows = shows_with(
            [&](const Case& candidate) { return properties_of(candidate).contains(needed); });
        // Measured: at most 213 texts in 14 calls.
        const Reduced reduced = checked(read(kCrowded), shows, kinds);
        EXPECT_LE(reduced.tried, 400U) << needed;
        EXPECT_LE(reduced.rounds, 20U) << needed;
    }
    // A mask that is needed, but not this one.
    checked(read(kCrowded), shows_with([](const Case& candidate) {
                return std::ranges::any_of(candidate.draws, [](const cases::Draw& draw) {
                    const uint32_t mask = draw.multisample.sample_mask;
                    return mask != 0xffffffffU && mask != 0;
                });
            }),
            kinds);
    for (uint32_t seed = 0; seed < 8; ++seed) {
        const Shows shows = [seed](const std::vector<Candidate>& candidates) {
            std::vector<bool> answers;
            for (const Candidate& one : candidates) {
                answers.push_back(cases::stable_hash(one.text, seed) % 8 < seed);
            }
            return answers;
        };
        const Reduced reduced = checked(read(kCrowded), shows, kinds);
        // Measured: at most 594 texts in 44 calls.
        EXPECT_LE(reduced.tried, 1000U) << seed;
        EXPECT_LE(reduced.rounds, 80U) << seed;
    }
    // Then what is left of the files, until a kind that the share does not take is taken, too.
    const auto is_each_taken = [&] {
        return std::ranges::all_of(kKinds, [&](const char* kind) { return kinds[kind] > 0; });
    };
    for (const size_t k : test_support::spread(files.size())) {
        for (size_t from = 0; from < kParts && !is_each_taken(); ++from) {
            if ((k + from) % share.shares != share.share) {
                reduce_part(k, from);
            }
        }
    }
    for (const char* kind : kKinds) {
        EXPECT_GT(kinds[kind], 0U) << "never taken: " << kind;
    }
}

TEST(Reduce, RoundsNumbersAsFarAsTheyMay) {
    struct Want {
        double given, low, high;
        const char* reduced;
    };
    for (const Want& want : {Want{3.7391, 3.6, 4.4, "4"}, Want{3.5111, 3.4, 3.6, "3.5"},
                             Want{3.2347, 3.2, 3.3, "3.25"}, Want{3.0591, 3.05, 3.07, "3.0625"},
                             Want{3.0041, 3.0035, 3.0045, "3.00390625"},
                             Want{3.00001, 3.000009, 3.000011, "3.0000100135803223"},
                             Want{1.23e8, 300, 1e9, "8192"}, Want{1e-7, 1e-8, 1, "0.03125"},
                             Want{-0.0, -5, 5, "0"}, Want{1e-7, 1e-8, 1e-3, "0.00048828125"}}) {
        Document document = read(R"(
format = 1
description = "A number."
rules = ["cover.inside"]
[target]
size = [1, 1]
[[draw]]
vertices = [[0, 0], [0, 0], [0, 0]]
)");
        const auto x = [](Document& d) -> Document& {
            return find(find(d, "draw")->array[0], "vertices")->array[1].array[0];
        };
        x(document) = number(want.given);
        const Reduced reduced = reduce(document, [&](const std::vector<Candidate>& candidates) {
            std::vector<bool> answers;
            for (const Candidate& one : candidates) {
                Document d = read(one.text);
                const double given = value_of(x(d)).value_or(0);
                answers.push_back(given >= want.low && given <= want.high);
            }
            return answers;
        });
        Document d = reduced.document;
        EXPECT_TRUE(reduced.is_minimal);
        Document only = table();
        set(only, "x", x(d));
        EXPECT_EQ(to_text(only), std::string("x = ") + want.reduced + "\n") << want.given;
    }
}

TEST(Reduce, SaysWhatIsNeeded) {
    const Shows shows = shows_with([](const Case& c) {
        return c.draws.size() >= 2 && c.draws[0].color.blend && c.target.samples >= 2 &&
               !c.draws[0].attributes.empty() &&
               c.draws[0].attributes[0].interpolation == cases::Interpolation::flat &&
               c.target.color->format == cases::ColorFormat::rgba16_float && !c.relations.empty() &&
               c.draws[1].cull == cases::CullMode::back;
    });
    const Reduced reduced = reduce(read(kCrowded), shows);
    expect_minimal(reduced, shows);
    EXPECT_THAT(
        reduced.needs,
        ElementsAre("not without draw 0", "not without draw 1", "not without relations",
                    "not with 1 sample", "not without a colour target",
                    "not with the format rgba8-unorm", "not without attribute 0 in draw 0",
                    "not without blending in draw 0", "not with smooth attribute 0 in draw 0",
                    "not without culling in draw 1"))
        << to_text(reduced.document);
}

TEST(Reduce, StopsAfterSoManyRounds) {
    const Shows shows = shows_with([](const Case& c) { return !c.draws.empty(); });
    const Reduced reduced = reduce(read(kCrowded), shows, {.batch = 1, .most_rounds = 5});
    EXPECT_EQ(reduced.rounds, 5U);
    EXPECT_EQ(reduced.tried, 5U);
    EXPECT_FALSE(reduced.is_minimal);
    EXPECT_LT(measure(reduced.document), measure(read(kCrowded)));
}

TEST(Reduce, AsksNothingOfWhatCannotBeSimpler) {
    const Document document = read(R"(
format = 1
description = "One pixel."
rules = ["cover.inside"]
[target]
size = [1, 1]
[[draw]]
vertices = [[0, 0], [0, 0], [0, 0]]
)");
    EXPECT_TRUE(simpler(document).empty());
    const Reduced reduced = reduce(document, [](const std::vector<Candidate>&) {
        ADD_FAILURE() << "asked";
        return std::vector<bool>();
    });
    EXPECT_TRUE(reduced.is_minimal);
    EXPECT_EQ(reduced.rounds, 0U);
    EXPECT_TRUE(is_same(reduced.document, document));
}

}  // namespace
}  // namespace fuzz
