// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What right case files become.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <set>

#include "cases/load/loader.hpp"
#include "folders.hpp"

namespace cases {

namespace {

const std::string kCaseHead =
    "format = 1\ndescription = \"d\"\ncatches = \"c\"\nrules = [\"cover.inside\", "
    "\"tie.top-left\"]\n"
    "links = [\"https://example.org\"]\n";

std::vector<Case> load(const std::string& toml) {
    ExpectedAll<std::vector<Case>> loaded = load_text(toml, "f.toml", "family/name");
    if (!loaded) {
        for (const Error& error : loaded.error()) {
            ADD_FAILURE() << to_string(error);
        }
        return {};
    }
    return *loaded;
}

// The first draw of a case whose target is width x height.
Draw load_draw(const std::string& draw, int width = 8, int height = 8) {
    const std::vector<Case> all =
        load(kCaseHead + "[target]\nsize = [" + std::to_string(width) + "," +
             std::to_string(height) + "]\n[[draw]]\n" + draw + "\n");
    return all.empty() ? Draw{} : all[0].draws.at(0);
}

using Vectors = std::vector<glm::vec4>;
const std::string kTriangle = "vertices = [[0,0],[8,0],[0,8]]\n";

}  // namespace

TEST(LoadCase, TakesEverything) {
    const std::vector<Case> all = load(kCaseHead + R"(
[target]
size = [8, 4]
samples = 1
[[draw]]
topology = "triangle-strip"
space = "ndc"
vertices = [[-1,-1], [1,-1,0.25], [-1,1,0.5,2]]
indices = [0, 1, 2, "restart", 2, 1, 0]
viewport = { rect = [0.5, 4, 8, -4], depth = [0.25, 1] }
scissor = [1, 2, 3, 4]
cull = "front-and-back"
front_face = "clockwise"
[[draw.attribute]]
name = "colour"
interpolation = "flat"
values = [[1,2],[3,4],[5,"6+1/2"]]
[[draw]]
vertices = [[0,0],[8,0],[0,4]]
[expect]
hits = """
1111?...
12......
........
....9...
"""
)");
    ASSERT_EQ(all.size(), 1U);
    const Case& c = all[0];
    EXPECT_EQ(c.id, "family/name");
    EXPECT_EQ(c.claim.where.file, "f.toml");
    EXPECT_EQ(c.claim.description, "d");
    EXPECT_EQ(c.claim.catches, "c");
    EXPECT_EQ(c.claim.rules, (std::vector<std::string>{"cover.inside", "tie.top-left"}));
    EXPECT_EQ(c.claim.links, std::vector<std::string>{"https://example.org"});
    EXPECT_TRUE(c.claim.parameters.empty());
    EXPECT_EQ(c.target, (Target{8, 4, 1}));
    ASSERT_EQ(c.draws.size(), 2U);
    const Draw& d = c.draws[0];
    EXPECT_EQ(d.topology, Topology::triangle_strip);
    EXPECT_EQ(d.positions, (Vectors{{-1, -1, 0.5, 1}, {1, -1, 0.25, 1}, {-2, 2, 1, 2}}));
    EXPECT_EQ(d.indices, (std::vector<uint32_t>{0, 1, 2, kRestartIndex, 2, 1, 0}));
    EXPECT_TRUE(d.primitive_restart);
    EXPECT_EQ(d.viewport, (Viewport{0.5F, 4, 8, -4, 0.25F, 1}));
    EXPECT_EQ(d.scissor.x, 1);
    EXPECT_EQ(d.scissor.height, 4U);
    EXPECT_EQ(d.cull, CullMode::front_and_back);
    EXPECT_EQ(d.front_face, FrontFace::clockwise);
    EXPECT_EQ(d.where.line, 10U);
    ASSERT_EQ(d.attributes.size(), 1U);
    EXPECT_EQ(d.attributes[0].name, "colour");
    EXPECT_EQ(d.attributes[0].interpolation, Interpolation::flat);
    EXPECT_EQ(d.attributes[0].components, 2U);
    EXPECT_EQ(d.attributes[0].values, (Vectors{{1, 2, 0, 0}, {3, 4, 0, 0}, {5, 6.5, 0, 0}}));
    // The defaults.
    EXPECT_EQ(c.draws[1].viewport, (Viewport{0, 0, 8, 4, 0, 1}));
    EXPECT_EQ(c.draws[1].scissor.width, 8U);
    EXPECT_EQ(c.draws[1].scissor.height, 4U);
    EXPECT_EQ(c.draws[1].cull, CullMode::none);
    EXPECT_FALSE(c.draws[1].indices);
    EXPECT_EQ(c.draws[1].positions, (Vectors{{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {-1, 1, 0.5, 1}}));
    ASSERT_TRUE(c.claim.expected_hits);
    EXPECT_EQ(c.claim.expected_hits->rows,
              (std::vector<std::string>{"1111?...", "12......", "........", "....9..."}));
    EXPECT_TRUE(c.claim.notes.empty());
}

TEST(LoadCase, TakesBomAndCrLf) {
    std::string toml = kCaseHead + "[target]\nsize = [2,1]\n[[draw]]\n" + kTriangle +
                       "[expect]\nhits = \"\"\"\n1.\n\"\"\"\n";
    for (size_t at = 0; (at = toml.find('\n', at)) != std::string::npos; at += 2) {
        toml.replace(at, 1, "\r\n");
    }
    const std::vector<Case> all = load("\xef\xbb\xbf" + toml);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].claim.expected_hits->rows, std::vector<std::string>{"1."});
}

TEST(LoadCase, ReadsMultisampleState) {
    const std::vector<Case> all =
        load(kCaseHead +
             "[target]\nsize = [2, 1]\nsamples = 2\nsample_locations = [[0, 15], [8, \"2^3\"]]\n"
             "[[draw]]\n" +
             kTriangle +
             "sample_mask = 0b10\nshader_mask = 0xfffffffe\nmin_sample_shading = 0.5\n[[draw]]\n" +
             kTriangle + "[expect]\nhits = [\"1.\", \"?2\"]\n");
    ASSERT_EQ(all.size(), 1U);
    const Case& c = all[0];
    EXPECT_EQ(c.target.samples, 2U);
    EXPECT_EQ(c.target.sample_locations, (std::vector<std::array<uint8_t, 2>>{{0, 15}, {8, 8}}));
    EXPECT_EQ(c.draws[0].multisample, (Multisample{2U, 0xfffffffeU, 0.5F}));
    EXPECT_EQ(c.draws[1].multisample, Multisample{});
    ASSERT_TRUE(c.claim.expected_hits);
    EXPECT_EQ(c.claim.expected_hits->rows, (std::vector<std::string>{"1.", "?2"}));
}

TEST(LoadCase, KeepsBitsInClipSpace) {
    const Draw d = load_draw(
        "space = \"clip\"\nvertices = [[-0.0,\"-0\",\"0x1p-149\",\"2^127\"],[0,0,0,0],"
        "[\"0.1f\",1,0,-1]]");
    ASSERT_EQ(d.positions.size(), 3U);
    EXPECT_EQ(std::bit_cast<uint32_t>(d.positions[0].x), 0x80000000U);
    EXPECT_EQ(std::bit_cast<uint32_t>(d.positions[0].y), 0x80000000U);
    EXPECT_EQ(std::bit_cast<uint32_t>(d.positions[0].z), 1U);
    EXPECT_EQ(std::bit_cast<uint32_t>(d.positions[0].w), 0x7f000000U);
    EXPECT_EQ(std::bit_cast<uint32_t>(d.positions[2].x), 0x3dcccccdU);
}

TEST(LoadCase, ConvertsPixelsOnceAndNotesRounding) {
    // x_c = (x - 5) / 5 * w on a target of 10 pixels: 6 -> 1/5, which is no binary32.
    const std::vector<Case> all = load(
        kCaseHead + "[target]\nsize = [10,10]\n[[draw]]\nvertices = [[0,0],[10,0],[6,5,0.25,3]]\n");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].draws[0].positions,
              (Vectors{{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {0.6F, 0, 0.75, 3}}));
    // 0.6f - 0.6 = 2^-24 * 0.4, times 5/3 pixels.
    EXPECT_EQ(all[0].claim.notes,
              std::vector<std::string>{
                  "draw 0: 1 of 3 vertices were rounded to binary32 in clip space, the first is "
                  "vertex 2; x and y moved by at most 3.97e-08 pixels"});
}

TEST(LoadCase, TargetsNeedNotBePowersOfTwo) {
    const Draw d = load_draw("vertices = [[0,0],[100,0],[50,\"37/2\"]]", 100, 37);
    EXPECT_EQ(d.positions, (Vectors{{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {0, 0, 0.5, 1}}));
}

TEST(LoadCase, NotesVerticesWithoutTriangle) {
    const std::vector<Case> all = load(
        kCaseHead + "[target]\nsize = [8,8]\n[[draw]]\nvertices = [[0,0],[8,0],[0,8],[1,1]]\n");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].claim.notes,
              std::vector<std::string>{
                  "draw 0: the last 1 of 4 vertices make no triangle; write 2 more or "
                  "take it away"});
}

TEST(LoadCase, MovesVertices) {
    // Target 8 x 8: pixel p is clip p / 4 - 1.
    const auto xy = [](const std::string& keys) {
        std::vector<std::pair<float, float>> result;
        for (const glm::vec4& p : load_draw("vertices = [[1,2],[8,0],[0,8]]\n" + keys).positions) {
            result.emplace_back((p.x + 1) * 4, (p.y + 1) * 4);
        }
        return result;
    };
    using Points = std::vector<std::pair<float, float>>;
    EXPECT_EQ(xy("rotate = 0"), (Points{{1, 2}, {8, 0}, {0, 8}}));
    EXPECT_EQ(xy("rotate = 90"), (Points{{6, 1}, {8, 8}, {0, 0}}));
    EXPECT_EQ(xy("rotate = 180"), (Points{{7, 6}, {0, 8}, {8, 0}}));
    EXPECT_EQ(xy("rotate = 270"), (Points{{2, 7}, {0, 0}, {8, 8}}));
    EXPECT_EQ(xy("mirror = \"none\""), (Points{{1, 2}, {8, 0}, {0, 8}}));
    EXPECT_EQ(xy("mirror = \"x\""), (Points{{7, 2}, {0, 0}, {8, 8}}));
    EXPECT_EQ(xy("mirror = \"y\""), (Points{{1, 6}, {8, 8}, {0, 0}}));
    EXPECT_EQ(xy("mirror = \"xy\""), (Points{{7, 6}, {0, 8}, {8, 0}}));
    EXPECT_EQ(xy("offset = [\"1/2\", -1]"), (Points{{1.5, 1}, {8.5, -1}, {0.5, 7}}));
    // mirror first, then rotate, then offset: (1,2) -> (7,2) -> (6,7) -> (6,8).
    EXPECT_EQ(xy("offset = [0, 1]\nrotate = 90\nmirror = \"x\"")[0],
              (std::pair<float, float>{6, 8}));
}

TEST(LoadCase, OrdersVerticesAndAttributes) {
    const auto order = [](const std::string& keys) {
        const Draw d = load_draw("vertices = [[0,0],[8,0],[0,8],[1,1],[7,1],[1,7]]\n" + keys +
                                 "\n[[draw.attribute]]\nvalues = [0,1,2,3,4,5]\n"
                                 "[[draw.attribute]]\nplane = \"x+8*y\"");
        std::string text;
        for (size_t i = 0; i < d.positions.size(); ++i) {
            text += std::to_string(static_cast<int>(d.attributes[0].values[i].x));
            const glm::vec4& p = d.positions[i];
            EXPECT_FLOAT_EQ(d.attributes[1].values[i].x, (p.x + 1) * 4 + 8 * (p.y + 1) * 4);
        }
        return text;
    };
    EXPECT_EQ(order(""), "012345");
    EXPECT_EQ(order("winding = \"reversed\""), "021354");
    EXPECT_EQ(order("first = 1"), "120453");
    EXPECT_EQ(order("first = 2"), "201534");
    EXPECT_EQ(order("order = \"reversed\""), "345012");
    EXPECT_EQ(order("winding = \"reversed\"\nfirst = 1\norder = \"reversed\""), "543210");
}

TEST(LoadCase, MakesAttributes) {
    const auto values = [](const std::string& attribute) {
        return load_draw("vertices = [[0,0],[8,0,0.25,2],[0,8]]\n[[draw.attribute]]\n" + attribute)
            .attributes.at(0);
    };
    EXPECT_EQ(values("constant = 0.5").values, (Vectors(3, {0.5, 0, 0, 0})));
    EXPECT_EQ(values("constant = [1,2,3,4]").values, (Vectors(3, {1, 2, 3, 4})));
    EXPECT_EQ(values("constant = [1,2,3,4]").components, 4U);
    EXPECT_EQ(values("constant = 1").name, "attribute0");
    EXPECT_EQ(values("plane = [\"x/64\", \"y+z\", \"w\"]").values,
              (Vectors{{0, 0.5, 1, 0}, {0.125, 0.25, 2, 0}, {0, 8.5, 1, 0}}));
    EXPECT_EQ(values("from = \"barycentric\"").values,
              (Vectors{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}));
    EXPECT_EQ(values("from = \"barycentric\"").components, 3U);
    const Attribute two = values("from = \"barycentric\"\ncomponents = 2");
    EXPECT_EQ(two.components, 2U);
    EXPECT_EQ(two.values, (Vectors{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}));
    const Attribute random = values("from = \"random\"\nseed = 5\ncomponents = 2");
    EXPECT_EQ(random.components, 2U);
    std::set<float> distinct;
    for (const glm::vec4& v : random.values) {
        for (const float f : {v.x, v.y}) {
            EXPECT_GE(f, 0.0F);
            EXPECT_LT(f, 1.0F);
            distinct.insert(f);
        }
        EXPECT_EQ(std::bit_cast<uint32_t>(v.z), 0U);
    }
    EXPECT_EQ(distinct.size(), 6U);
    EXPECT_EQ(random.values, values("from = \"random\"\nseed = 5\ncomponents = 2").values);
    EXPECT_NE(random.values, values("from = \"random\"\nseed = 6\ncomponents = 2").values);
}

TEST(LoadCase, PlanesSeePixelsInEverySpace) {
    const Draw ndc = load_draw(
        "space = \"ndc\"\nvertices = [[-1,-1],[1,-1],[0,\"1/2\"]]\n"
        "[[draw.attribute]]\nplane = [\"x\", \"y\"]");
    EXPECT_EQ(ndc.attributes[0].values, (Vectors{{0, 0, 0, 0}, {8, 0, 0, 0}, {4, 6, 0, 0}}));
    const Draw clip = load_draw(
        "space = \"clip\"\nvertices = [[-1,-1,0,1],[2,-2,0,2],[0,\"1/4\",0,\"1/2\"]]\n"
        "[[draw.attribute]]\nplane = [\"x\", \"y\"]");
    EXPECT_EQ(clip.attributes[0].values, ndc.attributes[0].values);
}

TEST(LoadCase, MatrixMakesLeavesInFileOrder) {
    const std::vector<Case> all = load(kCaseHead + R"(
[matrix]
zoom = [1, 0.5]
cull = ["none", "back"]
deep = ["1/3", -2]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],["8*zoom","deep"],[0,8]]
cull = "cull"
[expect]
"zoom=1,cull=back,deep=-2" = { hits = """
........
........
........
........
........
........
........
.......1
""" }
)");
    ASSERT_EQ(all.size(), 8U);
    const char* const ids[] = {
        "family/name:zoom=1,cull=none,deep=1/3",   "family/name:zoom=1,cull=none,deep=-2",
        "family/name:zoom=1,cull=back,deep=1/3",   "family/name:zoom=1,cull=back,deep=-2",
        "family/name:zoom=0.5,cull=none,deep=1/3", "family/name:zoom=0.5,cull=none,deep=-2",
        "family/name:zoom=0.5,cull=back,deep=1/3", "family/name:zoom=0.5,cull=back,deep=-2",
    };
    for (size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(all[i].id, ids[i]);
        EXPECT_EQ(all[i].draws[0].cull, i % 4 < 2 ? CullMode::none : CullMode::back);
        EXPECT_EQ(all[i].claim.expected_hits.has_value(), i == 3);
        EXPECT_FLOAT_EQ(all[i].draws[0].positions[1].x, i < 4 ? 1.0F : 0.0F);
    }
    EXPECT_EQ(all[5].claim.parameters, (std::vector<std::pair<std::string, std::string>>{
                                           {"zoom", "0.5"}, {"cull", "none"}, {"deep", "-2"}}));
}

// Every pair of values of two keys is left; ids, order, parameters and expectations are those of
// the full product.
TEST(LoadCase, LeavesCanBeThoseThatCoverPairs) {
    const std::string rest = R"(
[matrix]
zoom = [1, 0.5]
cull = ["none", "back"]
deep = ["1/3", -2]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],["8*zoom","deep"],[0,8]]
cull = "cull"
[expect]
"zoom=1,cull=back,deep=1/3" = { hits = """
........
........
........
........
........
........
........
.......1
""" }
)";
    const std::string toml = kCaseHead + "leaves = \"pairs\"" + rest;
    const std::vector<Case> pairs = load(toml);
    const char* const ids[] = {
        "family/name:zoom=1,cull=none,deep=1/3", "family/name:zoom=1,cull=none,deep=-2",
        "family/name:zoom=1,cull=back,deep=1/3", "family/name:zoom=0.5,cull=none,deep=1/3",
        "family/name:zoom=0.5,cull=back,deep=-2"};
    const std::vector<Case> all = load(kCaseHead + "leaves = \"all\"" + rest);
    EXPECT_EQ(all.size(), 8U);
    const ExpectedAll<std::vector<Case>> by_id = load_text(toml, "f", "family/name", Contents::ids);
    ASSERT_TRUE(by_id);
    ASSERT_EQ(by_id->size(), 5U);
    ASSERT_EQ(pairs.size(), 5U);
    for (size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(pairs[i].id, ids[i]);
        EXPECT_EQ((*by_id)[i].id, ids[i]);
        EXPECT_EQ(pairs[i].claim.expected_hits.has_value(), i == 2);
        const auto same = std::find_if(all.begin(), all.end(),
                                       [&](const Case& c) { return c.id == pairs[i].id; });
        ASSERT_NE(same, all.end());
        EXPECT_EQ(pairs[i].claim.parameters, same->claim.parameters);
        EXPECT_EQ(pairs[i].draws[0].positions, same->draws[0].positions);
        EXPECT_EQ(pairs[i].draws[0].cull, same->draws[0].cull);
    }
}

TEST(LoadCase, LeavesCanBeNamed) {
    const std::vector<Case> named = load(kCaseHead + R"(
leaves = ["a=1,b=5", "a=0,b=4", "a=0,b=5"]
[matrix]
a = [0, 1]
b = [4, 5]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,"a"],[8,0],[0,"b"]]
)");
    ASSERT_EQ(named.size(), 3U);
    EXPECT_EQ(named[0].id, "family/name:a=0,b=4");
    EXPECT_EQ(named[1].id, "family/name:a=0,b=5");
    EXPECT_EQ(named[2].id, "family/name:a=1,b=5");
    EXPECT_NE(named[2].draws[0].positions, named[1].draws[0].positions);
}

// A word that is valid for the key means itself even if a matrix key has that name.
TEST(LoadCase, ValidWordsWinOverMatrixKeys) {
    const std::vector<Case> all = load(kCaseHead +
                                       "[matrix]\nback = [1, 2]\n[target]\nsize = [8,8]\n[[draw]]\n"
                                       "vertices = [[0,0],[8,0],[0,\"back\"]]\ncull = \"back\"\n");
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].draws[0].cull, CullMode::back);
}

TEST(LoadSuite, LoadsEverythingThatIsShipped) {
    const Suite suite = load_suite(test_support::source_dir() + "/cases/suite");
    for (const Error& error : suite.errors) {
        ADD_FAILURE() << to_string(error);
    }
    std::set<std::string> ids;
    for (const Case& c : suite.cases) {
        EXPECT_TRUE(ids.insert(c.id).second) << c.id;
        EXPECT_EQ(c.id.find(".toml"), std::string::npos);
    }
    EXPECT_GT(ids.size(), 20U);
    EXPECT_EQ(ids.count("coverage/half-square"), 1U);
    // Several threads read the files; cases stand in the order of the files.
    const auto file_of = [](const Case& c) {
        return std::filesystem::path(c.id.substr(0, c.id.find(':')) + ".toml");
    };
    EXPECT_TRUE(
        std::is_sorted(suite.cases.begin(), suite.cases.end(),
                       [&](const Case& a, const Case& b) { return file_of(a) < file_of(b); }));
}

TEST(LoadSuite, SaysWhatIsWrong) {
    const Suite none = load_suite("/no/such/folder");
    ASSERT_EQ(none.errors.size(), 1U);
    EXPECT_EQ(to_string(none.errors[0]), "/no/such/folder: error: no such folder of case files");
    const std::string empty = testing::TempDir() + "edgecase-empty-suite";
    std::filesystem::create_directories(empty);
    const Suite nothing = load_suite(empty);
    ASSERT_EQ(nothing.errors.size(), 1U);
    EXPECT_EQ(to_string(nothing.errors[0]),
              empty + ": error: the folder has no case file (*.toml)");
    EXPECT_EQ(to_string(load_file("/no/such.toml", ".").error().at(0)),
              "/no/such.toml: error: no such file");
    EXPECT_EQ(to_string(load_file(empty, ".").error().at(0)),
              empty + ": error: this is not a file; name a case file");
}

}  // namespace cases
