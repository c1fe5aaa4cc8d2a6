// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Devices with one error, drawn by the software device and judged as in a run: the diagnosis names
// the error, and none is made of a device that has none.
#include "diagnosis/diagnose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "capture/checksum.hpp"
#include "cases/base/checksum.hpp"
#include "cases/base/parallel.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/sample.hpp"
#include "diagnosis/condition.hpp"
#include "diagnosis/hypothesis.hpp"
#include "diff/delivered.hpp"
#include "folders.hpp"
#include "rasterizers/strength/strength.hpp"
#include "run/judge.hpp"
#include "share.hpp"

namespace {

using diagnosis::Hypothesis;

constexpr int kBits = 8;

uint64_t samples_of(const cases::Case& c) {
    return uint64_t{c.target.width} * c.target.rows() * c.target.samples;
}

// Small cases of the suite, one of each file, eight of each family.
const std::vector<cases::Case>& small_suite() {
    static const std::vector<cases::Case> kCases = [] {
        const auto suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
        std::vector<cases::Case> out;
        std::map<std::string, size_t> of_file;
        std::map<std::string, size_t> of_family;
        for (const cases::Case& c : suite.cases) {
            const std::string file = c.id.substr(0, c.id.find(':'));
            const std::string family = c.id.substr(0, c.id.find('/'));
            if (samples_of(c) <= 1024 && c.draws.size() < 6 && of_file[file]++ < 1 &&
                of_family[family]++ < 8) {
                out.push_back(c);
            }
        }
        return out;
    }();
    return kCases;
}

// The run of a device that does as the hypothesis says; nothing is done to other cases.
// `locations`: of its samples, as cases::parse_sample_locations takes them.
report::Run run_of(const Hypothesis& h, cases::Profile profile = cases::Profile::direct3d,
                   const std::string& locations = "") {
    const ref::Limits limits = ref::limits_of(kBits, locations);
    report::Run run;
    run.profile = profile;
    run.device.subpixel_bits = kBits;
    run.device.sample_locations = locations;
    Hypothesis right;
    for (const cases::Case& c : small_suite()) {
        report::CaseRecord record = run::planned_case(c);
        const cases::Case placed = ref::as_drawn(c, limits).value_or(c);
        std::optional<capture::Capture> drawn = diagnosis::draw(h, placed);
        if (!drawn) {
            drawn = diagnosis::draw(right, placed);
        }
        drawn->target = c.target;
        run::judge(record, c, *drawn, {}, limits, profile, run::KeepPictures::failed);
        run.cases.push_back(std::move(record));
    }
    return run;
}

std::vector<report::Diagnosis> diagnose(const report::Run& run,
                                        const diagnosis::Bound& bound = {}) {
    std::map<std::string, const cases::Case*> by_id;
    for (const cases::Case& c : small_suite()) {
        by_id.emplace(c.id, &c);
    }
    return diagnosis::diagnose(
        run,
        [&](const std::string& id) {
            const auto found = by_id.find(id);
            return found == by_id.end() ? nullptr : found->second;
        },
        bound);
}

const Hypothesis& named(const std::string& name) {
    static const std::vector<Hypothesis> kAll = diagnosis::known_hypotheses(kBits);
    for (const Hypothesis& h : kAll) {
        if (h.name == name) {
            return h;
        }
    }
    throw std::runtime_error("no hypothesis is called " + name);
}

class Named : public testing::TestWithParam<const char*> {};

// Every other error by a commit, others as the suite grows.
TEST_P(Named, IsToldFirst) {
    if (!test_support::share_of(2, small_suite().size()).has(GetParam())) {
        GTEST_SKIP() << "EDGECASE_SUITE_SHARE=1/1 tests all errors";
    }
    const std::vector<report::Diagnosis> list = diagnose(run_of(named(GetParam())));
    ASSERT_FALSE(list.empty());
    EXPECT_THAT(list.front().names, testing::Contains(GetParam()));
    EXPECT_GT(list.front().cases, 0U);
    EXPECT_EQ(list.front().samples, list.front().same_samples);
    EXPECT_EQ(list.front().against, 0U);
    EXPECT_EQ(list.front().passed_against, 0U);
    // Each case that was tried is repeated or not; examples are the first that are.
    EXPECT_EQ(list.front().explained.size(), list.front().cases);
    EXPECT_EQ(list.front().explained.size() + list.front().unexplained.size(), list.front().tried);
    for (size_t k = 0; k < list.front().examples.size(); ++k) {
        EXPECT_EQ(list.front().examples[k], list.front().explained[k]);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Errors, Named,
    testing::Values("viewport-mirrored-y", "scissor-wider", "draw-first-only", "strip-as-list",
                    "position-w-one", "cull-back-always", "noperspective-as-flat",
                    "depth-range-swapped", "never-as-always", "bias-no-slope", "src-alpha-as-one",
                    "write-mask-no-alpha", "clip-distance-culls", "blit-mirrored-x",
                    "ties-bottom-right", "floor-snapping", "affine", "provoking-last",
                    "one-over-w-cached", "interpolate-at-centre-w", "scissor-half-early",
                    "depth-samples-mirrored", "values-at-corner", "stencil-faces-exchanged",
                    "resolve-one-sample", "subpixel-bits-4", "stencil-off",
                    "stencil-cleared-to-one", "stencil-cleared-to-all"),
    [](const auto& test) {
        std::string name = test.param;
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

// Of cases with four samples alone, of which a mirrored picture covers others than at the standard
// locations.
TEST(Diagnose, ADeviceWithSamplesOfItsOwn) {
    const char* const kFault = "viewport-mirrored-y";
    report::Run run = run_of(named(kFault), cases::Profile::direct3d, "1,5;9,2;13,11;4,14");
    std::set<std::string> of_four;
    for (const cases::Case& c : small_suite()) {
        if (c.target.samples == 4 && c.target.sample_locations.empty()) {
            of_four.insert(c.id);
        }
    }
    std::erase_if(run.cases, [&](const report::CaseRecord& r) { return !of_four.contains(r.id); });
    ASSERT_GE(run.cases.size(), 10U);
    const std::vector<report::Diagnosis> list = diagnose(run);
    ASSERT_FALSE(list.empty());
    EXPECT_THAT(list.front().names, testing::Contains(kFault));
    EXPECT_GT(list.front().cases, 0U);
    EXPECT_EQ(list.front().samples, list.front().same_samples);
    EXPECT_EQ(list.front().against, 0U);
}

// A renderer elsewhere delivers no stencil: what a hypothesis leaves there does not count, and of
// fewer planes no other plane does.
TEST(Diagnose, ComparesOnlyWhatWasDelivered) {
    const Hypothesis& fault = named("stencil-off");
    const std::vector<std::vector<std::string>> left_out = {{"stencil"},
                                                            {"stencil", "writer", "faces"}};
    for (const std::vector<std::string>& words : left_out) {
        report::Run run;
        run.device.subpixel_bits = kBits;
        for (const cases::Case& c : small_suite()) {
            if (c.blit || !c.target.has_instruments || c.target.color) {
                continue;
            }
            report::CaseRecord record = run::planned_case(c);
            std::optional<capture::Capture> drawn = diagnosis::draw(fault, c);
            drawn = drawn ? drawn : diagnosis::draw(Hypothesis{}, c);
            record.drawn.not_judged = words;
            run::judge_delivered(record, c, diff::judged_planes(c, *drawn, words), {kBits},
                                 run.profile, run::KeepPictures::failed);
            run.cases.push_back(std::move(record));
        }
        const std::vector<report::Diagnosis> list = diagnose(run);
        ASSERT_FALSE(list.empty()) << words.size();
        EXPECT_THAT(list.front().names, testing::Contains("stencil-off"));
        EXPECT_EQ(list.front().unexplained.size(), 0U);
    }
}

// Of a case that a driver draws with its colour alone, a renderer elsewhere delivers hits and
// writers, too.
TEST(Diagnose, ComparesPlanesThatADriverWouldNotDraw) {
    const Hypothesis& fault = named("logic-operands-exchanged");
    report::Run run;
    run.device.subpixel_bits = kBits;
    const std::string root = test_support::source_dir() + "/cases/suite";
    const auto cases = cases::load_file(root + "/logic/operations.toml", root).value();
    for (const cases::Case& c : cases) {
        cases::Case whole = c;
        whole.target.has_instruments = true;
        const std::optional<capture::Capture> drawn = diagnosis::draw(fault, whole);
        ASSERT_TRUE(drawn);
        report::CaseRecord record = run::planned_case(c);
        run::judge_delivered(record, c, diff::judged_planes(c, *drawn, {"stencil"}), {kBits},
                             run.profile, run::KeepPictures::failed);
        run.cases.push_back(std::move(record));
    }
    const std::vector<report::Diagnosis> list =
        diagnosis::diagnose(run,
                            [&](const std::string& id) {
                                const auto found = std::ranges::find(cases, id, &cases::Case::id);
                                return found == cases.end() ? nullptr : &*found;
                            },
                            {});
    ASSERT_FALSE(list.empty());
    EXPECT_THAT(list.front().names, testing::Contains("logic-operands-exchanged"));
    EXPECT_EQ(list.front().unexplained.size(), 0U);
}

TEST(Diagnose, SizesAreFitted) {
    Hypothesis moved;
    moved.moved_x = -0.1875F;
    moved.moved_y = 0.3125F;
    std::vector<report::Diagnosis> list = diagnose(run_of(moved));
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list.front().what.front(),
              "Vertices lie 3/16 pixel too far left and 5/16 pixel too low");

    Hypothesis values;
    values.device.place_x = 0.25F;
    list = diagnose(run_of(values));
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list.front().what.front(),
              "Values are evaluated 1/4 pixel right of the place that is asked");
}

TEST(Diagnose, OfTwoErrorsBothAreTold) {
    report::Run run = run_of(named("scissor-closed"));
    const report::Run other = run_of(named("provoking-mode-ignored"));
    size_t exchanged = 0;
    for (size_t k = 0; k < run.cases.size(); ++k) {
        if (other.cases[k].status == report::Status::fail &&
            run.cases[k].status == report::Status::pass) {
            run.cases[k] = other.cases[k];
            ++exchanged;
        }
    }
    ASSERT_GT(exchanged, 0U);
    std::vector<std::string> names;
    for (const report::Diagnosis& d : diagnose(run)) {
        names.insert(names.end(), d.names.begin(), d.names.end());
    }
    EXPECT_THAT(names, testing::Contains("scissor-closed"));
    EXPECT_THAT(names, testing::Contains("provoking-mode-ignored"));
}

// For each hypothesis which cases it draws otherwise than a right device, and how, in short; no
// further than it takes to tell it from all others.
std::vector<std::string> pictures_of(const std::vector<Hypothesis>& all) {
    std::vector<std::string> pictures(all.size());
    std::vector<size_t> alike(all.size());  // those that no picture has told from another yet
    std::iota(alike.begin(), alike.end(), size_t{0});
    // Neighbours have much in common: a stride that shares no factor with their number comes to
    // other families at once.
    const size_t count = small_suite().size();
    size_t stride = count / 3 + 1;
    while (std::gcd(stride, count) != 1) {
        ++stride;
    }
    for (size_t step = 0; step < count; ++step) {
        const size_t k = step * stride % count;
        const cases::Case& c = small_suite()[k];
        const std::optional<capture::Capture> right = diagnosis::draw(Hypothesis{}, c);
        cases::for_each_index(alike.size(), [&](size_t n) {
            const auto drawn = diagnosis::draw(all[alike[n]], c);
            if (drawn && !software::same_bits(*drawn, *right)) {
                pictures[alike[n]] +=
                    std::to_string(k) + ' ' + cases::hex(capture::capture_bits(*drawn)) + ' ';
            }
        });
        std::map<std::string, size_t> sharing;
        for (const size_t n : alike) {
            ++sharing[pictures[n]];
        }
        std::erase_if(alike, [&](size_t n) { return sharing[pictures[n]] == 1; });
    }
    return pictures;
}

// Two that draw every case alike are two names of one thing, and 'one of: A; B' would tell both.
TEST(Hypotheses, NoTwoAreOneThing) {
    // These differ, though in none of the cases here: in vertices left of the first pixel, in
    // viewports of other numbers than their layers, in front faces that are counter-clockwise, in
    // stencil references beyond the mask, in increments that wrap, in depth bounds of the first
    // draw, in masked draws without a logical operation, in alpha to one with several samples, in
    // masks of the first draw where a later one has none, in triangles that a negated cull distance
    // culls, in viewports that begin elsewhere than scissors do, in pixels that an extra size adds
    // beyond a bounding box, in inputs that are evaluated at samples, in bits of the stencil that
    // no draw may write.
    const std::set<std::pair<std::string, std::string>> other = {
        {"alpha-to-one-ignored", "alpha-to-one-multisampled"},
        {"floor-snapping", "snaps-toward-zero"},
        {"bounds-ignored", "bounds-of-first-draw"},
        {"cull-distance-lost", "cull-distance-negated"},
        {"cull-distance-ignored", "cull-distance-negated"},
        {"extra-size-ignored", "extra-size-of-box"},
        {"fragment-grid-at-scissor", "fragment-grid-at-viewport"},
        {"layer-ignored", "layer-of-viewport"},
        {"logic-mask-ignored", "write-mask-ignored"},
        {"samples-at-centre", "samples-in-pixel-centres"},
        {"stencil-compare-unmasked", "stencil-masks-ignored"},
        {"stencil-faces-exchanged", "stencil-own-facing"},
        {"stencil-reference-unmasked", "stencil-stored-unmasked"},
        {"stencil-saturates", "stencil-wrap-stops-at-zero"},
        {"write-mask-ignored-blending", "write-mask-of-first-draw"}};
    const std::vector<Hypothesis> all = diagnosis::known_hypotheses(kBits);
    const std::vector<std::string> pictures = pictures_of(all);
    std::map<std::string, std::string> names;
    for (size_t k = 0; k < all.size(); ++k) {
        const auto [at, is_new] = names.emplace(pictures[k], all[k].name);
        if (!pictures[k].empty() && !is_new) {
            const std::pair<std::string, std::string> pair = std::minmax(at->second, all[k].name);
            EXPECT_TRUE(other.contains(pair))
                << pair.first << " and " << pair.second << ": " << all[k].what;
        }
    }
}

TEST(Diagnose, NothingIsToldOfARightDevice) {
    const report::Run run = run_of(Hypothesis{});
    for (const report::CaseRecord& record : run.cases) {
        EXPECT_EQ(record.status, report::Status::pass) << record.id << " " << record.reason;
    }
    EXPECT_TRUE(diagnose(run).empty());
}

// A device that is right but for what `spoil` does to its pictures; and leaves of the suite beside
// the small ones.
using Spoil = std::function<void(const cases::Case&, capture::Capture&)>;
using Takes = std::function<bool(const cases::Case&)>;
report::Run run_of_part(const Spoil& spoil, const std::vector<cases::Case>& more,
                        const Takes& takes, std::vector<const cases::Case*>& all) {
    report::Run run;
    run.profile = cases::Profile::direct3d;
    run.device.subpixel_bits = kBits;
    for (const auto* list : {&small_suite(), &more}) {
        for (const cases::Case& c : *list) {
            if (takes && !takes(c)) {
                continue;
            }
            all.push_back(&c);
            report::CaseRecord record = run::planned_case(c);
            capture::Capture drawn = *diagnosis::draw(Hypothesis{}, c);
            spoil(c, drawn);
            run::judge(record, c, drawn, {}, {kBits}, run.profile, run::KeepPictures::failed);
            run.cases.push_back(std::move(record));
        }
    }
    return run;
}

std::vector<cases::Case> leaves_of(const std::string& file) {
    std::vector<cases::Case> out;
    const auto suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
    std::ranges::copy_if(suite.cases, std::back_inserter(out),
                         [&](const cases::Case& c) { return c.id.starts_with(file); });
    return out;
}

// Quads of two triangles in perspective, one for each number; below 110 and above 99 with the same
// value everywhere.
std::vector<cases::Case> quads(int first = 1, int last = 8) {
    std::vector<cases::Case> out;
    for (int k = first; k <= last; ++k) {
        const std::string w = std::to_string(k + 1);
        const auto loaded = cases::load_text(
            "format = 1\ndescription = \"A quad.\"\nrules = [\"interp.perspective\"]\n[target]\n"
            "size = [8, 8]\n[[draw]]\nvertices = [[0,0,0,1], [8,0,0," +
                w + "], [0,8,0,3],  [8,0,0," + w + "], [8,8,0,2], [0,8,0,3]]\n" +
                (k > 99 && k < 110 ? "[[draw.attribute]]\nconstant = 1\n"
                                   : "[[draw.attribute]]\nvalues = [0, 1, 2, 1, 3, 2]\n"),
            "quad.toml", "quads/" + std::to_string(k));
        EXPECT_TRUE(loaded);
        out.push_back(loaded->front());
    }
    return out;
}

std::vector<report::Diagnosis> diagnose_part(const Spoil& spoil,
                                             const std::vector<cases::Case>& more = {},
                                             const Takes& takes = {}) {
    std::vector<const cases::Case*> all;
    const report::Run run = run_of_part(spoil, more, takes, all);
    return diagnosis::diagnose(run, [&](const std::string& id) -> const cases::Case* {
        for (const cases::Case* c : all) {
            if (c->id == id) {
                return c;
            }
        }
        return nullptr;
    });
}

void expect_part(const std::vector<report::Diagnosis>& list, const std::string& name) {
    ASSERT_FALSE(list.empty());
    EXPECT_THAT(list.front().names, testing::Contains(name));
    EXPECT_GE(list.front().cases, 2U);
    EXPECT_EQ(list.front().samples, list.front().same_samples);
    EXPECT_EQ(list.front().against + list.front().passed_against, 0U);
}

// Interpolates without perspective in the second triangle of each draw; false where that is none.
bool bend_second_triangle(const cases::Case& c, capture::Capture& drawn) {
    const auto wrong = diagnosis::draw(named("smooth-as-noperspective"), c);
    bool is_bent = false;
    for (size_t k = 0; wrong && k < drawn.writers.size(); ++k) {
        if (drawn.writers[k].primitive == 1) {
            for (size_t a = 0; a < drawn.attribute_count; ++a) {
                is_bent = is_bent || drawn.attributes[a][k] != wrong->attributes[a][k];
                drawn.attributes[a][k] = wrong->attributes[a][k];
            }
        }
    }
    return is_bent;
}

TEST(DiagnosePart, OneTriangleOfADraw) {
    expect_part(diagnose_part(bend_second_triangle), "smooth-as-noperspective@second-triangle");
}

bool is_quad(const cases::Case& c) {
    return c.id.starts_with("quads/");
}

// Where no draw has three triangles, the second one is also the last, every other and each but the
// first: the narrowest is told.
TEST(DiagnosePart, TheNarrowestPartIsTold) {
    const auto list = diagnose_part(bend_second_triangle, quads(), is_quad);
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list.front().cases, 8U);
    EXPECT_THAT(list.front().names, testing::Each(testing::EndsWith("@second-triangle")));
}

TEST(DiagnosePart, TargetsOfOddWidth) {
    const Hypothesis& low = named("scissor-low");
    expect_part(diagnose_part(
                    [&](const cases::Case& c, capture::Capture& drawn) {
                        if (c.target.width % 2 == 1) {
                            drawn = diagnosis::draw(low, c).value_or(drawn);
                        }
                    },
                    leaves_of("scissor/odd-target")),
                "scissor-low@odd-width");
}

// Leaves pixel (x, y) as if nothing were drawn.
void lose_pixel(const cases::Case& c, uint32_t x, uint32_t y, capture::Capture& drawn) {
    const std::optional<capture::Capture> nothing = diagnosis::draw(named("draw-nothing"), c);
    if (!nothing || c.target.width <= x || c.target.height <= y || c.blit) {
        return;
    }
    for (uint32_t n = 0; n < c.target.samples * c.target.layers; ++n) {
        const size_t k =
            cases::index_of(c.target, {x, y, n % c.target.samples, n / c.target.samples});
        capture::for_each_plane(
            [&](const capture::Plane& plane, const auto& from, auto& to) {
                const size_t at = plane.entries == drawn.sample_count() ? k : k / c.target.samples;
                if (!to.empty()) {
                    to[at] = from[at];
                }
            },
            *nothing, *nothing, drawn);
    }
}

TEST(DiagnosePart, OnePixel) {
    expect_part(diagnose_part([](const cases::Case& c, capture::Capture& drawn) {
                    lose_pixel(c, 5, 5, drawn);
                }),
                "draw-nothing@pixel-5-5");
}

TEST(DiagnosePart, DepthsOfSixteenBits) {
    const std::vector<report::Diagnosis> list =
        diagnose_part([](const cases::Case&, capture::Capture& drawn) {
            for (size_t k = 0; k < drawn.writers.size(); ++k) {
                if (drawn.writers[k].draw != capture::kClearId) {
                    float& z = drawn.frag_coord[k].z;
                    z = std::round(z * 65535.0F) / 65535.0F;
                    if (!drawn.depth.empty()) {
                        drawn.depth[k] = std::round(drawn.depth[k] * 65535.0F) / 65535.0F;
                    }
                }
            }
        });
    ASSERT_FALSE(list.empty());
    EXPECT_THAT(list.front().names, testing::Contains("depth-16-bits"));
}

// What holds in most cases and is contradicted by one that passed, or that fails otherwise, is not
// told, nor what a single case tells.
TEST(DiagnosePart, NothingIsToldThatACaseContradicts) {
    const auto told = [](const Spoil& spoil) { return diagnose_part(spoil, quads(), is_quad); };
    EXPECT_TRUE(told([](const cases::Case& c, capture::Capture& drawn) {
                    if (c.id != "quads/5") {
                        bend_second_triangle(c, drawn);
                    }
                }).empty());
    EXPECT_TRUE(told([](const cases::Case& c, capture::Capture& drawn) {
                    bend_second_triangle(c, drawn);
                    for (size_t k = 0; c.id == "quads/5" && k < drawn.writers.size(); ++k) {
                        drawn.attributes[0][k].x += drawn.writers[k].primitive == 1 ? 64.0F : 0.0F;
                    }
                }).empty());

    EXPECT_TRUE(diagnose_part(bend_second_triangle, quads(), [](const cases::Case& c) {
                    return c.id == "quads/1";
                }).empty());
}

bool is_of_odd_targets(const cases::Case& c) {
    return c.id.starts_with("scissor/odd-target");
}
std::vector<std::string> names_of(const std::vector<report::Diagnosis>& list) {
    std::vector<std::string> names;
    for (const report::Diagnosis& d : list) {
        names.insert(names.end(), d.names.begin(), d.names.end());
    }
    return names;
}

// Targets of odd width fail as the error has it, and those of even width in another way: nothing
// says that the error would spare these.
TEST(DiagnosePart, AConditionThatNothingAsksForIsNotTold) {
    const std::vector<report::Diagnosis> list = diagnose_part(
        [](const cases::Case& c, capture::Capture& drawn) {
            drawn =
                diagnosis::draw(named(c.target.width % 2 == 1 ? "scissor-low" : "draw-nothing"), c)
                    .value_or(drawn);
        },
        leaves_of("scissor/odd-target"), is_of_odd_targets);
    EXPECT_THAT(names_of(list), testing::Not(testing::Contains("scissor-low@odd-width")));
}

// In targets of even width the error is there, too, though in the left half alone.
TEST(DiagnosePart, AConditionOutsideOfWhichTheErrorIsSeenIsNotTold) {
    const std::vector<report::Diagnosis> list = diagnose_part(
        [](const cases::Case& c, capture::Capture& drawn) {
            const auto wrong = diagnosis::draw(named("scissor-low"), c);
            const capture::Capture right = drawn;
            drawn = wrong.value_or(drawn);
            if (c.target.width % 2 == 0) {
                const diagnosis::Condition right_half{
                    diagnosis::Condition::Kind::place, "", "",
                    [](const diagnosis::Spot& s) { return s.id.x < s.of.target.width / 2; }};
                diagnosis::restrict_to(right_half, c, right, drawn);
            }
        },
        leaves_of("scissor/odd-target"), is_of_odd_targets);
    EXPECT_THAT(names_of(list), testing::Not(testing::Contains("scissor-low@odd-width")));
}

// Two dozen quads of a family fail, and as many like them pass: those of the family are asked,
// though the cheapest of it have nothing to say.
TEST(Diagnose, NothingIsToldThatTheFamilyContradicts) {
    std::vector<cases::Case> cases = quads(100, 109);
    std::ranges::copy(quads(201, 248), std::back_inserter(cases));
    const auto number = [](const cases::Case& c) { return std::stoi(c.id.substr(6)); };
    const std::vector<report::Diagnosis> list = diagnose_part(
        [&](const cases::Case& c, capture::Capture& drawn) {
            if (is_quad(c) && number(c) > 224) {
                drawn = diagnosis::draw(named("smooth-as-noperspective"), c).value_or(drawn);
            }
        },
        cases,
        [](const cases::Case& c) {
            const auto wrong = diagnosis::draw(named("smooth-as-noperspective"), c);
            return is_quad(c) || !wrong ||
                   software::same_bits(*wrong, *diagnosis::draw(Hypothesis{}, c));
        });
    EXPECT_TRUE(list.empty()) << list.front().names.front();
}

// What fails as no error would have it is explained by none.
TEST(Diagnose, NothingIsToldOfWrongSamplesHereAndThere) {
    report::Run run = run_of(Hypothesis{});
    uint32_t seed = 7;
    size_t failed = 0;
    for (size_t k = 0; k < run.cases.size(); k += 5) {
        const cases::Case& c = small_suite()[k];
        if (!c.target.has_instruments || c.blit) {
            continue;
        }
        capture::Capture drawn = *diagnosis::draw(Hypothesis{}, c);
        for (int n = 0; n < 3; ++n) {
            seed = seed * 1664525U + 1013904223U;
            drawn.hits[(seed >> 8U) % drawn.hits.size()] += glm::vec4(1, 0, 0, 1);
        }
        run.cases[k] = run::planned_case(c);
        run::judge(run.cases[k], c, drawn, {}, {kBits}, run.profile, run::KeepPictures::failed);
        failed += run.cases[k].status == report::Status::fail ? 1U : 0U;
    }
    ASSERT_GT(failed, 20U);
    EXPECT_TRUE(diagnose(run).empty());
}

// A bound is counted in what is drawn, not in time: what is told is the same on every machine, and
// what was found before it.
TEST(Diagnose, EndsAtItsBound) {
    const report::Run run = run_of(named("cull-none"));
    const std::vector<report::Diagnosis> list = diagnose(run);
    size_t calls = 0;
    diagnosis::Bound bound;
    bound.progress = [&](size_t done, size_t total) {
        ++calls;
        EXPECT_GE(done, 1U);
        EXPECT_LE(done, total);
    };
    EXPECT_EQ(diagnose(run, bound), list);
    EXPECT_GT(calls, 0U);
    bound.most = 1;
    EXPECT_TRUE(diagnose(run, bound).empty());
    // One error that explains most needs less than the second that a run's end has.
    bound.most = diagnosis::kWorkPerSecond;
    ASSERT_FALSE(diagnose(run, bound).empty());
    EXPECT_EQ(diagnose(run, bound).front().what, list.front().what);
}

// The records alone decide: another order of the cases changes nothing.
TEST(Diagnose, OrderDoesNotMatter) {
    report::Run run = run_of(named("cull-none"));
    const std::vector<report::Diagnosis> list = diagnose(run);
    std::reverse(run.cases.begin(), run.cases.end());
    EXPECT_EQ(diagnose(run), list);
    EXPECT_FALSE(list.empty());
}

}  // namespace
