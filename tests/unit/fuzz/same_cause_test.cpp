// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which failures are told as one cause (fuzz/same_cause.cpp).
#include "fuzz/same_cause.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "fuzz/entry.hpp"
#include "fuzz/ledger.hpp"

namespace fuzz {
namespace {

using diff::FindingKind;

Entry entry(const std::string& symptom, const std::set<std::string>& essentials) {
    Entry entry;
    entry.symptom = *parse_symptom(symptom);
    entry.essentials = parse_essentials(essentials);
    entry.also = {{entry.symptom.kind, entry.symptom.rule}};
    entry.text = symptom;
    entry.count = 1;
    return entry;
}

TEST(SameCause, NeedsTheSameToFailInALikeWay) {
    const Entry clamped = entry("value of depth.clamp [practice]", {"several samples"});
    EXPECT_TRUE(is_same_cause(clamped, entry("value of depth.bias [vulkan]", {"several samples"})));
    EXPECT_FALSE(is_same_cause(clamped, entry("value of depth.bias [vulkan]", {"draw.cull=back"})));
    EXPECT_FALSE(is_same_cause(
        clamped, entry("value of depth.bias [vulkan]", {"several samples", "draw.cull=back"})));
    // Values, and who is hit, are two things.
    const Entry hits = entry("extra of cover.outside [practice]", {"several samples"});
    EXPECT_FALSE(is_same_cause(clamped, hits));
    EXPECT_TRUE(is_same_cause(hits, entry("order of tie.top-left [vulkan]", {"several samples"})));
}

TEST(SameCause, NothingSpecialIsNoLikeness) {
    const Entry plain = entry("value of depth.linear [practice]", {});
    EXPECT_FALSE(is_same_cause(plain, entry("value of fragcoord.w [practice]", {})));
    Entry both = entry("value of fragcoord.w [practice]", {});
    both.also.insert({FindingKind::value, "depth.linear"});
    EXPECT_TRUE(is_same_cause(plain, both));
}

std::string colored(const std::string& format) {
    return "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\nsize = [4, 4]\n"
           "[target.color]\nformat = \"" +
           format +
           "\"\n[[draw]]\ncolor = { value = [1, 0, 0, 0] }\nvertices = [[0, 0], [4, 0], [0, 4]]\n";
}

TEST(SameCause, WhatIsStoredWronglyRoundedIsHandedOn) {
    Entry stored = entry("value of store.unorm [direct3d]", {"color", "draw.color.value"});
    stored.set_text(colored("r5g6b5-unorm"));
    const std::set<std::string> through = {"attachments=color", "color", "draw.attribute",
                                           "draw.color.attribute", "draw.color.logic=equivalent"};
    for (const char* symptom :
         {"value of logic.operation [direct3d]", "order of order.primitive [direct3d]",
          "value of blend.write-mask [direct3d]", "value of color.location [direct3d]",
          "missing of cover.inside [direct3d]"}) {
        Entry fresh = entry(symptom, through);
        fresh.set_text(colored("r5g6b5-unorm"));
        EXPECT_TRUE(is_same_cause(stored, fresh)) << symptom;
        fresh.set_text(colored("rgb10a2-unorm"));
        EXPECT_FALSE(is_same_cause(stored, fresh)) << symptom;
    }
    // A failing case need not be reduced for it.
    const Facts facts{parse_essentials({"attachments=color", "draw.cull=back"}),
                      cases::ColorFormat::r5g6b5_unorm};
    EXPECT_TRUE(explains(stored, *parse_symptom("value of logic.operation [direct3d]"), facts));
    EXPECT_TRUE(explains(stored, *parse_symptom("order of order.primitive [direct3d]"), facts));
    EXPECT_FALSE(explains(stored, *parse_symptom("value of logic.operation [practice]"), facts));
    EXPECT_FALSE(explains(stored, *parse_symptom("missing of cover.inside [direct3d]"), facts));
    EXPECT_TRUE(explains(stored, *parse_symptom("missing of cover.inside [direct3d]"),
                         {parse_essentials({"attachments=color", "draw.color.logic=equivalent"}),
                          cases::ColorFormat::r5g6b5_unorm}));
    EXPECT_FALSE(explains(
        stored, *parse_symptom("missing of cover.inside [direct3d]"),
        {parse_essentials({"draw.color.logic=equivalent"}), cases::ColorFormat::r5g6b5_unorm}));
    EXPECT_FALSE(explains(stored, *parse_symptom("value of depth.linear [direct3d]"), facts));
    EXPECT_FALSE(
        explains(stored, *parse_symptom("value of logic.operation [direct3d]"),
                 {parse_essentials({"attachments=color"}), cases::ColorFormat::rgb10a2_unorm}));
    // Where an input is evaluated decides no hit.
    Entry shaded = entry("double of snap.nearest [direct3d]", through);
    shaded.essentials.merge(parse_essentials({"draw.min_sample_shading", "several samples"}));
    shaded.set_text(colored("r5g6b5-unorm"));
    EXPECT_TRUE(is_same_cause(stored, shaded));
    // Hits that are counted do not come of a colour, nor does what a looser profile forbids.
    for (const auto& [symptom, needs] :
         {std::pair("value of logic.operation [practice]", through),
          std::pair("missing of cover.inside [direct3d]",
                    std::set<std::string>{"color", "draw.attribute", "draw.color.attribute"})}) {
        Entry fresh = entry(symptom, needs);
        fresh.set_text(colored("r5g6b5-unorm"));
        EXPECT_FALSE(is_same_cause(stored, fresh)) << symptom;
    }
    // Where more than colours is delivered it is another thing.
    Entry depth = entry("value of depth.linear [direct3d]", {"draw.cull=back"});
    depth.set_text(colored("r5g6b5-unorm"));
    EXPECT_FALSE(is_same_cause(stored, depth));
    // What is stored wrongly by something special is that, by any rule of a colour.
    Entry clipped = entry("value of store.unorm [practice]",
                          {"draw.attribute", "draw.attribute.interpolation=noperspective"});
    std::set<std::string> also = through;
    also.insert("draw.attribute.interpolation=noperspective");
    EXPECT_TRUE(is_same_cause(clipped, entry("value of stencil.compare [practice]", also)));
    EXPECT_FALSE(is_same_cause(clipped, entry("value of stencil.compare [vulkan]", also)));
    EXPECT_FALSE(is_same_cause(clipped, entry("value of stencil.compare [practice]", through)));
    Entry special = entry("value of store.unorm [direct3d]", {"color", "draw.cull=back"});
    special.set_text(colored("r5g6b5-unorm"));
    Entry fresh = entry("value of logic.operation [direct3d]", through);
    fresh.set_text(colored("r5g6b5-unorm"));
    EXPECT_FALSE(is_same_cause(special, fresh));
    // Of another format, or a hit, it is another cause, however alike they are.
    Entry other = entry("value of store.unorm [direct3d]", {"color", "draw.color.value"});
    other.set_text(colored("rgb10a2-unorm"));
    EXPECT_FALSE(is_same_cause(stored, other));
    Entry samples = entry("value of store.unorm [vulkan]",
                          {"color", "draw.attribute", "draw.color.attribute", "several samples"});
    samples.set_text(colored("r5g6b5-unorm"));
    EXPECT_FALSE(is_same_cause(samples, entry("missing of cover.inside [vulkan]",
                                              {"attachments=color", "color", "several samples"})));
    // Of other cases it explains those with its format.
    const Symptom again = *parse_symptom("value of store.unorm [direct3d]");
    EXPECT_TRUE(explains(stored, again, facts_of(colored("r5g6b5-unorm"))));
    EXPECT_FALSE(explains(stored, again, facts_of(colored("rgb10a2-unorm"))));
}

TEST(SameCause, WhatIsStoredWronglyIsSoInEachFormatOfItsSort) {
    const Entry known = entry("value of store.half [vulkan]", {"color", "draw.color.value"});
    const std::set<std::string> attribute = {"color", "draw.attribute", "draw.color.attribute"};
    EXPECT_FALSE(is_same_cause(known, entry("value of store.half [vulkan]", attribute)));
    EXPECT_TRUE(is_same_cause(
        entry("value of store.half [vulkan]", attribute),
        entry("value of store.half [vulkan]", {"draw.attribute", "draw.color.attribute"})));
    EXPECT_TRUE(is_same_cause(known, entry("value of store.half [vulkan]", {"draw.color.value"})));
    EXPECT_FALSE(is_same_cause(known, entry("value of store.half [practice]", attribute)));
    EXPECT_FALSE(is_same_cause(known, entry("value of store.float [vulkan]", attribute)));
    EXPECT_FALSE(is_same_cause(known, entry("value of store.half [vulkan]",
                                            {"color", "draw.attribute", "draw.cull=back"})));
}

// Where a case counts no hits, or discards by an input, a wrong input looks like wrong hits.
TEST(SameCause, AWrongInputMayLookLikeWrongHits) {
    const Entry input =
        entry("value of interp.hull [vulkan]",
              {"draw.attribute", "draw.attribute.interpolation=noperspective", "unequal w"});
    const std::set<std::string> words = {"draw.attribute", "draw.color.attribute",
                                         "draw.attribute.interpolation=noperspective"};
    const auto also = [&](const char* word) {
        std::set<std::string> all = words;
        all.insert(word);
        return all;
    };
    for (const char* symptom :
         {"missing of cover.inside [vulkan]", "double of cover.outside [vulkan]",
          "extra of discard.value [direct3d]"}) {
        EXPECT_TRUE(is_same_cause(
            input, entry("value of write.consistent [practice]", also("draw.discard=negative"))));
        EXPECT_TRUE(is_same_cause(input, entry(symptom, also("attachments=color")))) << symptom;
        EXPECT_TRUE(is_same_cause(input, entry(symptom, also("attachments=color+depth"))));
        EXPECT_TRUE(is_same_cause(input, entry(symptom, also("draw.discard=negative"))));
        // Hits that are counted, and a discard by the pixel, know no input.
        EXPECT_FALSE(is_same_cause(input, entry(symptom, words))) << symptom;
        EXPECT_FALSE(is_same_cause(input, entry(symptom, also("draw.discard=odd-rows"))));
        // Another state may have lost the hit.
        std::set<std::string> culled = also("attachments=color");
        culled.insert("draw.cull=back");
        EXPECT_FALSE(is_same_cause(input, entry(symptom, culled)));
        EXPECT_FALSE(is_same_cause(input, entry(symptom, {"attachments=color", "draw.attribute"})));
    }
    EXPECT_FALSE(
        is_same_cause(input, entry("value of blend.equation [vulkan]", also("draw.color.blend"))));
    const Entry plain = entry("value of interp.hull [vulkan]", {"draw.attribute", "unequal w"});
    EXPECT_FALSE(
        is_same_cause(plain, entry("missing of cover.inside [vulkan]", also("attachments=color"))));
    const Entry looser = entry("value of interp.hull [direct3d]", to_texts(input.essentials));
    EXPECT_FALSE(is_same_cause(
        looser, entry("missing of cover.inside [vulkan]", also("attachments=color"))));
}

TEST(SameCause, AWrongColorMayLookLikeWrongHits) {
    const Entry known = entry("value of sample.alpha-to-one [vulkan]",
                              {"attachments=color+depth", "color", "draw.color.alpha_to_one=true",
                               "draw.color.value", "draw.frag_depth.value"});
    const std::set<std::string> words = {"attachments=color+depth", "color",
                                         "draw.color.alpha_to_one=true", "draw.color.value",
                                         "draw.frag_depth.value"};
    EXPECT_TRUE(is_same_cause(known, entry("missing of cover.inside [vulkan]", words)));
    std::set<std::string> more = words;
    more.insert("draw.cull=back");
    EXPECT_FALSE(is_same_cause(known, entry("missing of cover.inside [vulkan]", more)));
    std::set<std::string> from = words;
    from.erase("draw.frag_depth.value");
    from.insert("draw.frag_depth.from=frag-coord");  // another way to write a depth
    EXPECT_TRUE(is_same_cause(known, entry("missing of stencil.compare [vulkan]", from)));
    EXPECT_TRUE(is_same_cause(known, entry("value of sample.alpha-to-one [vulkan]", from)));
    std::set<std::string> less = words;
    less.erase("draw.color.alpha_to_one=true");
    EXPECT_FALSE(is_same_cause(known, entry("missing of cover.inside [vulkan]", less)));
    std::set<std::string> counted = words;
    counted.erase("attachments=color+depth");
    EXPECT_FALSE(is_same_cause(known, entry("missing of cover.inside [vulkan]", counted)));
}

// A stencil that differs because of a depth that is biased otherwise: the reduced case shows both.
TEST(SameCause, WhatAReducedCaseTellsFirstIsItsCause) {
    const Entry known =
        entry("value of depth.linear [practice]", {"draw.depth.bias.constant", "sloping depth"});
    Entry fresh = entry("value of stencil.operation [direct3d]",
                        {"draw.depth.bias.constant", "draw.stencil.front.pass=increment-wrap"});
    fresh.set_text(
        "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\nsize = [4, 4]\n"
        "stencil = true\n[[draw]]\nstencil = { front = { pass = \"increment-wrap\" } }\n"
        "depth = { bias = { constant = -65536 } }\nvertices = [[0, 0, 0.25], [4, 0], [0, 4]]\n");
    EXPECT_FALSE(is_same_cause(known, fresh));
    fresh.shown_first = parse_symptom("value of depth.linear [practice]");
    EXPECT_TRUE(is_same_cause(known, fresh));
    fresh.shown_first = parse_symptom("value of interp.perspective [practice]");
    EXPECT_FALSE(is_same_cause(known, fresh));
}

TEST(SameCause, WhichFactorTakesASecondSourceIsChance) {
    const char* const symptom = "value of sample.alpha-to-one [vulkan]";
    const Entry known =
        entry(symptom, {"attachments=color", "color", "color.clear", "draw.color.alpha_to_one=true",
                        "draw.color.blend.destination", "draw.color.second", "draw.color.value"});
    EXPECT_TRUE(is_same_cause(
        known, entry(symptom, {"attachments=color", "color", "draw.color.alpha_to_one=true",
                               "draw.color.blend.source", "draw.color.second"})));
    // Without a second source factors are no chance.
    EXPECT_FALSE(is_same_cause(
        known, entry(symptom, {"attachments=color", "color", "draw.color.alpha_to_one=true",
                               "draw.color.blend.source"})));
}

TEST(SameCause, WhatNeedsMoreOfTheSameIsTheSame) {
    const Entry known = entry("value of sample.alpha-to-one [vulkan]",
                              {"attachments=color+depth", "color", "draw.color.alpha_to_one=true",
                               "draw.color.value", "draw.frag_depth.value"});
    const std::set<std::string> more = {"attachments=color+depth", "color",
                                        "draw.attribute",          "draw.color.alpha_to_one=true",
                                        "draw.color.attribute",    "draw.frag_depth.value",
                                        "several samples"};
    EXPECT_TRUE(is_same_cause(known, entry("value of sample.alpha-to-one [vulkan]", more)));
    EXPECT_FALSE(is_same_cause(known, entry("value of sample.alpha-to-one [practice]", more)));
    EXPECT_FALSE(is_same_cause(known, entry("value of store.unorm [vulkan]", more)));
    std::set<std::string> less = more;
    less.erase("draw.frag_depth.value");
    less.insert("draw.cull=back");
    EXPECT_FALSE(is_same_cause(known, entry("value of sample.alpha-to-one [vulkan]", less)));
    // Of several keys the words may be others.
    const Entry query = entry("value of query.occlusion [practice]",
                              {"draw.discard=odd-columns", "draw.early_tests=true",
                               "draw.query=occlusion", "several draws"});
    EXPECT_TRUE(is_same_cause(query, entry("value of query.occlusion [practice]",
                                           {"draw.discard=odd-rows", "draw.early_tests=true",
                                            "draw.query=occlusion-precise", "several samples"})));
    EXPECT_FALSE(is_same_cause(query, entry("value of query.occlusion [practice]",
                                            {"draw.discard=odd-rows",
                                             "draw.query=occlusion-precise", "several samples"})));
    // But not where the known one is of its format.
    Entry of_format = known;
    of_format.needs_format = true;
    of_format.set_text(colored("r5g6b5-unorm"));
    Entry other = entry("value of sample.alpha-to-one [vulkan]", more);
    other.set_text(colored("rgba16-float"));
    EXPECT_FALSE(is_same_cause(of_format, other));
    other.set_text(colored("r5g6b5-unorm"));
    EXPECT_TRUE(is_same_cause(of_format, other));
    // A failing case need not write its colour as the known one does.
    EXPECT_TRUE(explains(known, *parse_symptom("value of sample.alpha-to-one [vulkan]"),
                         {parse_essentials(more), std::nullopt}));
}

TEST(SameCause, WhatNeedsAFormatExplainsThatFormat) {
    Entry integers = entry("value of sample.alpha-to-one [vulkan]", {"color"});
    integers.set_text(colored("rgba8-uint"));
    integers.needs_format = true;
    const Symptom again = *parse_symptom("value of sample.alpha-to-one [vulkan]");
    EXPECT_TRUE(explains(integers, again, facts_of(colored("rgba8-uint"))));
    EXPECT_FALSE(explains(integers, again, facts_of(colored("rgba8-unorm"))));
    // What was reduced of another one, and is the same, is explained from then on.
    Entry other = entry("value of sample.alpha-to-one [vulkan]", {"color"});
    other.set_text(colored("r32-uint"));
    EXPECT_FALSE(explains(integers, again, facts_of(colored("r32-uint"))));
    merge(integers, other);
    EXPECT_TRUE(explains(integers, again, facts_of(colored("r32-uint"))));
    EXPECT_FALSE(explains(integers, again, facts_of(colored("rgba8-unorm"))));
    integers.needs_format = false;
    EXPECT_TRUE(explains(integers, again, facts_of(colored("rgba8-unorm"))));
}

TEST(SameCause, AlphaToCoverageDecidesWhoIsHit) {
    const Entry integers = entry(
        "missing of sample.alpha-to-coverage [vulkan]",
        {"attachments=color", "color", "draw.color.alpha_to_coverage=true", "draw.color.value"});
    const std::set<std::string> beside = {"attachments=color+depth", "color",
                                          "draw.color.attribute",
                                          "draw.color.alpha_to_coverage=true", "several samples"};
    EXPECT_TRUE(is_same_cause(integers, entry("order of order.primitive [vulkan]", beside)));
    EXPECT_TRUE(is_same_cause(integers, entry("missing of cover.inside [vulkan]", beside)));
    EXPECT_FALSE(is_same_cause(
        integers, entry("missing of cover.inside [vulkan]", {"attachments=color+depth", "color"})));
}

TEST(SameCause, AConstantAndAnAttributeAreTwoWaysToWriteAColor) {
    const Entry constant =
        entry("value of sample.alpha-to-one [vulkan]",
              {"attachments=color+depth", "color", "draw.color.alpha_to_one=true",
               "draw.color.value", "draw.shader_mask"});
    std::set<std::string> words = {"attachments=color",    "color",
                                   "draw.attribute",       "draw.color.alpha_to_one=true",
                                   "draw.color.attribute", "draw.shader_mask"};
    EXPECT_TRUE(is_same_cause(constant, entry("value of sample.alpha-to-one [vulkan]", words)));
    // Where nothing else is needed an attribute may be interpolated wrongly.
    EXPECT_FALSE(
        is_same_cause(entry("value of store.unorm [vulkan]", {"color", "draw.color.value"}),
                      entry("value of store.unorm [vulkan]",
                            {"color", "draw.attribute", "draw.color.attribute"})));
    words.erase("draw.shader_mask");
    words.insert("draw.cull=back");
    EXPECT_FALSE(is_same_cause(constant, entry("value of sample.alpha-to-one [vulkan]", words)));
}

TEST(SameCause, WhatElseAThinTriangleNeedsIsChance) {
    const Entry thin = entry("value of interp.hull [vulkan]", {"thin triangle"});
    const Entry more = entry("value of depth.linear [vulkan]", {"thin triangle", "unequal w"});
    EXPECT_TRUE(is_same_cause(thin, more));
    EXPECT_TRUE(is_same_cause(more, thin));
    EXPECT_FALSE(is_same_cause(more, entry("value of depth.linear [vulkan]", {"unequal w"})));
}

TEST(SameCause, TwoThinTrianglesMayNeedWhateverNumbers) {
    const Entry samples =
        entry("value of interp.hull [vulkan]", {"thin triangle", "several samples"});
    const Entry slope =
        entry("value of depth.linear [practice]", {"thin triangle", "sloping depth"});
    EXPECT_TRUE(is_same_cause(samples, slope));
    EXPECT_FALSE(
        is_same_cause(entry("value of interp.hull [vulkan]", {"thin triangle", "color"}),
                      entry("value of interp.hull [vulkan]", {"thin triangle", "draw.cull=back"})));
}

TEST(SameCause, NumbersAreChanceBesideAKey) {
    const Entry linear = entry("value of interp.linear [practice]", {"draw.attribute"});
    EXPECT_TRUE(is_same_cause(
        linear, entry("value of interp.hull [vulkan]", {"draw.attribute", "unequal w"})));
    // Less grave by far, it is another thing.
    EXPECT_FALSE(is_same_cause(
        linear, entry("value of interp.hull [direct3d]", {"draw.attribute", "unequal w"})));
    // Several samples alone are no key.
    EXPECT_FALSE(
        is_same_cause(entry("value of depth.linear [vulkan]", {"several samples", "sloping depth"}),
                      entry("value of fragcoord.w [vulkan]", {"several samples", "unequal w"})));
}

TEST(SameCause, WhatFollowsFromWrongHitsIsNoNews) {
    const Entry scissor =
        entry("extra of scissor.half-open [vulkan]", {"draw.scissor", "several samples"});
    const std::set<std::string> needs = {"draw.scissor", "draw.stencil.pass", "several samples"};
    EXPECT_TRUE(is_same_cause(scissor, entry("value of stencil.operation [vulkan]", needs)));
    EXPECT_TRUE(is_same_cause(scissor, entry("value of discard.fragment [direct3d]", needs)));
    // Without the scissor, or with one sample, it is another thing.
    EXPECT_FALSE(is_same_cause(scissor, entry("value of stencil.operation [vulkan]",
                                              {"draw.stencil.pass", "several samples"})));
    EXPECT_FALSE(is_same_cause(scissor, entry("value of stencil.operation [vulkan]",
                                              {"draw.scissor", "draw.stencil.pass"})));
    // Of wrong values, and of hits with nothing to blame, nothing follows.
    EXPECT_FALSE(is_same_cause(entry("value of depth.linear [vulkan]", {"draw.scissor"}),
                               entry("value of stencil.operation [vulkan]", needs)));
    EXPECT_FALSE(is_same_cause(entry("extra of cover.outside [vulkan]", {"several samples"}),
                               entry("value of stencil.operation [vulkan]", needs)));
    EXPECT_FALSE(is_same_cause(
        entry("missing of cover.inside [vulkan]", {"draw.color.value", "draw.attribute"}),
        entry("value of blend.equation [vulkan]",
              {"draw.color.value", "draw.attribute", "color"})));
}

TEST(SameCause, OtherWordsOfTheSameKeysAreTheSame) {
    const Entry back =
        entry("value of query.occlusion [practice]",
              {"draw.discard=back", "draw.early_tests=true", "draw.query=occlusion"});
    std::set<std::string> odd = {"draw.discard=odd-rows", "draw.early_tests=true",
                                 "draw.query=occlusion-precise"};
    EXPECT_TRUE(is_same_cause(back, entry("value of query.occlusion [practice]", odd)));
    EXPECT_FALSE(is_same_cause(back, entry("value of query.occlusion [vulkan]", odd)));
    odd.erase("draw.early_tests=true");
    EXPECT_FALSE(is_same_cause(back, entry("value of query.occlusion [practice]", odd)));
}

TEST(SameCause, OneKeyLessOfSeveralIsTheSame) {
    const std::set<std::string> keys = {"draw.attribute", "draw.attribute.auxiliary=centroid",
                                        "draw.depth.compare", "draw.sample_mask"};
    const Entry masked = entry("value of interp.centroid [direct3d]", keys);
    std::set<std::string> fewer = keys;
    fewer.erase("draw.sample_mask");
    fewer.insert("sloping depth");
    EXPECT_TRUE(is_same_cause(masked, entry("value of interp.centroid [direct3d]", fewer)));
    EXPECT_FALSE(is_same_cause(masked, entry("value of interp.centroid [practice]", fewer)));
    EXPECT_FALSE(is_same_cause(masked, entry("value of interp.sample [direct3d]", fewer)));
    fewer.erase("draw.depth.compare");
    EXPECT_FALSE(is_same_cause(masked, entry("value of interp.centroid [direct3d]", fewer)));
}

// A test that leaves two of four samples: the centroid goes to one of them, in whatever way it is
// asked for and whichever test it is.
TEST(SameCause, WhichTestMovesACentroidIsChance) {
    const Entry moved =
        entry("value of interp.centroid [direct3d]",
              {"draw.attribute", "draw.attribute.auxiliary=centroid", "draw.depth.compare",
               "draw.sample_mask", "several draws", "several samples"});
    const std::set<std::string> needs = {"draw.attribute", "draw.attribute.probe=at-centroid",
                                         "draw.stencil.front.compare", "several samples",
                                         "stencil=true"};
    EXPECT_TRUE(is_same_cause(moved, entry("value of interp.at-centroid [direct3d]", needs)));
    std::set<std::string> conservative = needs;
    conservative.insert("draw.conservative=overestimate");
    EXPECT_FALSE(
        is_same_cause(moved, entry("value of interp.at-centroid [direct3d]", conservative)));
    EXPECT_FALSE(is_same_cause(moved, entry("value of interp.at-centroid [direct3d]",
                                            {"draw.attribute", "draw.attribute.probe=at-centroid",
                                             "draw.viewport", "several samples"})));
    // Graver, at another place, or where nothing takes samples away, it is another thing.
    EXPECT_FALSE(is_same_cause(moved, entry("value of interp.at-centroid [practice]", needs)));
    EXPECT_FALSE(is_same_cause(moved, entry("value of interp.at-sample [direct3d]", needs)));
    EXPECT_FALSE(is_same_cause(moved, entry("value of interp.at-centroid [direct3d]",
                                            {"draw.attribute", "draw.attribute.probe=at-centroid",
                                             "several samples", "unequal w"})));
    EXPECT_FALSE(is_same_cause(entry("value of interp.centroid [direct3d]",
                                     {"draw.attribute", "draw.attribute.auxiliary=centroid",
                                      "several samples", "unequal w"}),
                               entry("value of interp.at-centroid [direct3d]", needs)));
}

TEST(SameCause, InputsAtAWrongPlaceDiscardOthers) {
    const Entry sample = entry("value of interp.sample [vulkan]", {"several samples"});
    const std::set<std::string> by_sample = {"draw.attribute", "draw.attribute.auxiliary=sample",
                                             "draw.discard=negative", "several samples",
                                             "unequal w"};
    const std::string symptom = "order of discard.value [vulkan]";
    EXPECT_TRUE(is_same_cause(sample, entry(symptom, by_sample)));
    const auto but = [&](const std::string& word, const std::string& other) {
        std::set<std::string> words = by_sample;
        words.erase(word);
        words.insert(other);
        return words;
    };
    const std::string auxiliary = "draw.attribute.auxiliary=sample";
    EXPECT_FALSE(
        is_same_cause(sample, entry(symptom, but(auxiliary, "draw.attribute.auxiliary=centroid"))));
    EXPECT_FALSE(is_same_cause(sample, entry(symptom, but("several samples", "sloping depth"))));
    EXPECT_FALSE(is_same_cause(sample, entry(symptom, but("draw.discard=negative", "color"))));
    EXPECT_FALSE(is_same_cause(sample, entry("order of order.draws [vulkan]", by_sample)));
    const Entry lesser = entry("value of interp.sample [practice]", {"several samples"});
    EXPECT_FALSE(is_same_cause(lesser, entry(symptom, by_sample)));
    const Entry centroid = entry("value of interp.centroid [vulkan]", {"several samples"});
    EXPECT_TRUE(is_same_cause(centroid,
                              entry(symptom, but(auxiliary, "draw.attribute.auxiliary=centroid"))));
}

TEST(SameCause, ByWhichRuleAStencilShowsAStateIsChance) {
    const Entry outside = entry(
        "value of stencil.operation [vulkan]",
        {"draw.depth.bounds", "draw.stencil.depth_fail=invert", "several draws", "stencil=true"});
    EXPECT_TRUE(
        is_same_cause(outside, entry("value of stencil.operation [vulkan]",
                                     {"depth_clear", "draw.depth.bounds", "stencil=true"})));
    for (const auto& [symptom, word] :
         {std::pair("value of depth.bounds [vulkan]", "draw.stencil.depth_fail=increment-clamp"),
          std::pair("value of stencil.compare [vulkan]", "draw.stencil.depth_fail=increment-wrap"),
          std::pair("value of depth.bounds [practice]", "draw.stencil.fail=increment-clamp")}) {
        EXPECT_TRUE(is_same_cause(
            outside,
            entry(symptom, {"draw.depth.bounds", word, "draw.stencil.compare", "stencil=true"})))
            << symptom;
    }
    // A later draw compares it; the operations are of one face; a shader has written the depth.
    for (const auto& [symptom, essentials] :
         {std::pair("extra of stencil.compare [vulkan]",
                    std::set<std::string>{"draw.depth.bounds", "draw.stencil.compare",
                                          "draw.stencil.depth_fail=invert", "several draws",
                                          "stencil=true"}),
          std::pair("value of stencil.operation [vulkan]",
                    std::set<std::string>{"draw.depth.bounds", "draw.front_face=clockwise",
                                          "several draws", "stencil=true"}),
          std::pair(
              "value of depth.bounds [vulkan]",
              std::set<std::string>{"draw.depth.bounds", "draw.frag_depth.value",
                                    "draw.stencil.back.depth_fail=invert", "stencil=true"})}) {
        EXPECT_TRUE(is_same_cause(outside, entry(symptom, essentials))) << symptom;
    }
    EXPECT_FALSE(is_same_cause(outside, entry("extra of stencil.compare [vulkan]",
                                              {"draw.depth.bounds", "draw.stencil.compare",
                                               "draw.stencil.depth_fail=invert", "stencil=true"})));
    EXPECT_FALSE(
        is_same_cause(entry("value of stencil.operation [vulkan]",
                            {"draw.frag_depth.value", "draw.early_tests=true", "stencil=true"}),
                      entry("value of stencil.operation [vulkan]",
                            {"draw.depth.bounds", "draw.frag_depth.value", "stencil=true"})));
    // Other state, hits, depths, or a stencil alone are other things.
    const std::set<std::string> bounds = {"draw.depth.bounds", "draw.stencil.pass=invert",
                                          "stencil=true"};
    EXPECT_FALSE(is_same_cause(
        outside, entry("value of stencil.compare [vulkan]",
                       {"draw.discard=front", "draw.stencil.pass=invert", "stencil=true"})));
    EXPECT_FALSE(is_same_cause(outside, entry("missing of cover.inside [vulkan]", bounds)));
    EXPECT_FALSE(is_same_cause(outside, entry("value of frag-depth.value [vulkan]",
                                              {"draw.depth.bounds", "draw.frag_depth.value"})));
    EXPECT_FALSE(is_same_cause(
        entry("value of stencil.operation [vulkan]", {"draw.stencil.fail=invert", "stencil=true"}),
        entry("value of stencil.compare [vulkan]", {"draw.stencil.compare", "stencil=true"})));
    const Entry lesser = entry("value of stencil.operation [practice]", bounds);
    EXPECT_FALSE(is_same_cause(
        lesser, entry("value of stencil.compare [vulkan]",
                      {"draw.depth.bounds", "draw.stencil.compare", "stencil=true"})));
}

// Which colours overflow is ref/color's (color_overflow_test.cpp).
TEST(SameCause, AColorBeyondTheRangeMayBeDrawnMaskedOrClearedTo) {
    Entry known = entry("value of store.half [vulkan]", {"color", "draw.color.value"});
    Entry fresh = entry("extra of cover.outside [vulkan]",
                        {"attachments=color", "color", "color.clear", "draw.color.value"});
    for (const bool is_earlier : {false, true}) {
        for (const bool is_fresh : {false, true}) {
            known.overflows = is_earlier;
            fresh.overflows = is_fresh;
            EXPECT_EQ(is_same_cause(known, fresh), is_earlier && is_fresh);
        }
    }
    fresh.essentials = parse_essentials({"attachments=depth", "draw.cull=back"});
    EXPECT_FALSE(is_same_cause(known, fresh));
}

TEST(SameCause, AKnownOneThatIsGraverIsNews) {
    Entry known = entry("value of depth.linear [practice]", {"several samples"});
    known.is_known = true;
    EXPECT_FALSE(
        is_same_cause(known, entry("value of depth.linear [vulkan]", {"several samples"})));
    EXPECT_TRUE(is_same_cause(known, entry("value of depth.bias [direct3d]", {"several samples"})));
}

TEST(SameCause, DeathsAreOfTheSameSignal) {
    const Entry crash = entry("crash by SIGSEGV", {"draw.scissor"});
    EXPECT_TRUE(is_same_cause(crash, entry("crash by SIGSEGV", {"draw.scissor"})));
    EXPECT_FALSE(is_same_cause(crash, entry("crash by SIGABRT", {"draw.scissor"})));
    EXPECT_FALSE(is_same_cause(crash, entry("crash by SIGSEGV", {})));
    EXPECT_FALSE(is_same_cause(crash, entry("extra of cover.outside [vulkan]", {"draw.scissor"})));
}

TEST(SameCause, WhatADeadDriverWasAboutToDrawIsChance) {
    const Entry crash = entry("crash by SIGSEGV", {"color", "draw.color.value", "draw.scissor"});
    const Entry fresh = entry("crash by SIGSEGV", {"draw.scissor", "several draws"});
    EXPECT_TRUE(is_same_cause(crash, fresh));
    EXPECT_FALSE(is_same_cause(crash, entry("crash by SIGSEGV", {"color", "draw.color.value"})));
}

TEST(SameCause, TestsShowAWrongDepth) {
    const Entry depth = entry("value of depth.linear [vulkan]",
                              {"draw.depth.bias.representation=float", "several draws"});
    const auto shown = [](const char* symptom) {
        return entry(symptom, {"draw.depth.bias.representation=float", "draw.depth.compare"});
    };
    EXPECT_TRUE(is_same_cause(depth, shown("extra of depth.compare [practice]")));
    EXPECT_TRUE(is_same_cause(depth, shown("value of write.consistent [vulkan]")));
    EXPECT_FALSE(is_same_cause(depth, shown("extra of cover.outside [vulkan]")));
    EXPECT_FALSE(
        is_same_cause(depth, entry("extra of depth.compare [vulkan]", {"draw.depth.compare"})));
}

TEST(SameCause, WhatWritesAColorDecidesNoHit) {
    const Entry known = entry("missing of cover.inside [vulkan]",
                              {"attachments=color", "color", "draw.color.value"});
    EXPECT_TRUE(is_same_cause(
        known, entry("missing of cover.shared-edge [vulkan]", {"attachments=color", "color"})));
    EXPECT_FALSE(is_same_cause(known, entry("missing of cover.shared-edge [vulkan]",
                                            {"attachments=color", "color", "draw.cull=back"})));
}

TEST(Merge, KeepsTheGraverCase) {
    Entry earlier = entry("value of depth.linear [practice]", {"thin triangle"});
    earlier.file = "found/001-depth.linear.toml";
    earlier.count = 7;
    merge(earlier, entry("value of interp.hull [practice]", {"thin triangle", "unequal w"}));
    EXPECT_EQ(earlier.text, "value of depth.linear [practice]");
    EXPECT_EQ(earlier.file, "found/001-depth.linear.toml");
    EXPECT_THAT(earlier.also, testing::SizeIs(2));
    merge(earlier, entry("value of interp.hull [vulkan]", {"thin triangle", "unequal w"}));
    EXPECT_EQ(earlier.text, "value of interp.hull [vulkan]");
    EXPECT_EQ(to_text(earlier.symptom), earlier.text);
    EXPECT_EQ(earlier.file, "");
    EXPECT_EQ(earlier.stale_file, "found/001-depth.linear.toml");
    EXPECT_THAT(to_texts(earlier.essentials), testing::ElementsAre("thin triangle"));
    EXPECT_THAT(earlier.also, testing::SizeIs(2));
    EXPECT_EQ(earlier.count, 7U);
    // A second one before it was kept: the file that is there is still the one to go.
    merge(earlier, entry("value of depth.linear [vulkan]", {"thin triangle"}));
    EXPECT_EQ(earlier.stale_file, "found/001-depth.linear.toml");
}

TEST(Merge, LeavesAKnownCauseAsItIs) {
    Entry known = entry("value of depth.linear [practice]", {"thin triangle", "color"});
    known.is_known = true;
    known.file = "known/001.toml";
    merge(known, entry("value of depth.bias [practice]", {"thin triangle"}));
    EXPECT_EQ(known.file, "known/001.toml");
    EXPECT_THAT(known.essentials, testing::SizeIs(2));
    EXPECT_THAT(known.also, testing::SizeIs(2));
}

}  // namespace
}  // namespace fuzz
