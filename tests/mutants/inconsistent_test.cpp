// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Devices that are right twice, but not in the same way: each of two renderings is legal, and only
// a relation between them (families repeat and tiled) shows that the device changed its mind.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "cases/model/derive.hpp"
#include "diff/consistency.hpp"
#include "folders.hpp"
#include "mutants/judge.hpp"
#include "mutants/matrix.hpp"
#include "share.hpp"

namespace mutants {
namespace {

using cases::Profile;

constexpr size_t kMostSamples = 1U << 14U;  // larger leaves are left out

// Leaves with relations, of a share by EDGECASE_RELATION_SHARE=I/N; besides, since few leaves hold
// each of their rules, those of doors all, and of repeated and tiled draws the first of each file.
const std::vector<cases::Case>& related() {
    static const std::vector<cases::Case> cases = [] {
        std::vector<cases::Case> out;
        const cases::Suite suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
        const auto share =
            test_support::share_of(16, suite.cases.size(), "EDGECASE_RELATION_SHARE");
        std::set<std::string> files;
        for (const cases::Case& c : suite.cases) {
            const std::string family = family_of(c);
            const bool is_first = files.insert(c.id.substr(0, c.id.find(':'))).second;
            const size_t samples = size_t{c.target.width} * c.target.rows() * c.target.samples;
            if (!c.relations.empty() && samples <= kMostSamples &&
                (family == "door" || share.has(c.id) ||
                 (is_first && (family == "repeat" || family == "tiled")))) {
                out.push_back(c);
            }
        }
        return out;
    }();
    return cases;
}

// The verdict on a device that draws the case as `base` does and all that is derived from it as
// `other` does; `alone`: on the case without its relations.
struct Judged {
    diff::Verdict alone, related;
};

Judged judged(const cases::Case& c, const Device& base, const Device& other, Profile profile) {
    ref::Limits limits{base.subpixel_bits};
    limits.overestimation = software::overestimation(base);
    limits.rasterizes_degenerates = base.rasterizes_degenerates;
    const ref::Expectation expectation = ref::expect(c, limits, profile);
    const capture::Capture own = captured(c, base);
    Judged out{compare(c, expectation, own), {}};
    out.related = out.alone;
    const std::vector<cases::Derivation> derivations = cases::derivations(c);
    std::vector<diff::Consistency> found;
    for (const cases::Derivation& d : derivations) {
        capture::Capture derived = captured(cases::derive(c, d), other);
        diff::vary(derived, d.variation);
        found.push_back(diff::compare_bits(c, own, derived, d));
    }
    diff::add_differences(c, derivations, found, out.related);
    return out;
}

// One choice all the time is no inconsistency, whatever it is.
TEST(Inconsistent, WhoKeepsToAChoiceIsRight) {
    const std::vector<LegalDevice> devices = legal_devices();
    ASSERT_GT(related().size(), 10U);
    std::mutex mutex;
    for_each_parallel(related().size(), [&](size_t k) {
        const cases::Case& c = related()[k];
        for (const LegalDevice& legal : devices) {
            const Judged j = judged(c, legal.device, legal.device, legal.profile);
            const std::lock_guard lock(mutex);
            EXPECT_TRUE(j.related.ok()) << legal.name << ": " << describe(c, j.related);
        }
    });
}

// A plain device that draws again, under scissors, with other clear values, masks or attributes as
// one of the legal devices.
TEST(Inconsistent, WhoChangesItsMindIsSeenByRelationsAlone) {
    std::map<std::string, std::set<std::string>> families;  // of cases that saw it, by device
    std::set<std::string> rules;
    std::mutex mutex;
    const std::vector<LegalDevice> devices = legal_devices();
    for_each_parallel(related().size(), [&](size_t k) {
        const cases::Case& c = related()[k];
        for (const LegalDevice& legal : devices) {
            if (legal.device.subpixel_bits != Device{}.subpixel_bits) {
                continue;  // another device's expectation
            }
            const Judged j = judged(c, Device{}, legal.device, legal.profile);
            const std::lock_guard lock(mutex);
            EXPECT_TRUE(j.alone.ok()) << describe(c, j.alone);
            if (!j.related.ok()) {
                families[legal.name].insert(family_of(c));
            }
            for (const diff::Finding& f : j.related.findings) {
                EXPECT_TRUE(f.rule.starts_with("repeat.") || f.rule.starts_with("door.")) << f.rule;
                rules.insert(f.rule);
            }
        }
    });
    for (const char* name : {"fused", "snapped_planes", "barycentric", "ties_bottom_right"}) {
        EXPECT_TRUE(families[name].contains("repeat")) << name;
        EXPECT_TRUE(families[name].contains("tiled")) << name;
    }
    EXPECT_EQ(rules, (std::set<std::string>{
                         "door.buffer", "door.first", "door.index", "door.indirect",
                         "door.instance", "door.layout", "door.recording", "door.restart",
                         "door.stage", "door.state", "door.target", "repeat.attachments",
                         "repeat.clears", "repeat.same", "repeat.scissor", "repeat.write-masks"}));
    for (const LegalDevice& legal : devices) {
        // What has no choice of its own cannot change it.
        EXPECT_TRUE(!legal.name.starts_with("plain_at_") || families[legal.name].empty());
    }
}

}  // namespace
}  // namespace mutants
