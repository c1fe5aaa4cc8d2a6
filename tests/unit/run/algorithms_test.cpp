// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The algorithms draw the suite and are judged like any device.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>

#include "cases/load/loader.hpp"
#include "diff/verdict.hpp"
#include "folders.hpp"
#include "rasterizers/captures.hpp"

namespace rasterizers {

// How ctest names a parameter.
void PrintTo(const Device& device, std::ostream* out) {
    *out << device.name;
}

}  // namespace rasterizers

namespace run {
namespace {

const std::vector<cases::Case>& supported_cases() {
    static const std::vector<cases::Case> kCases = [] {
        std::vector<cases::Case> out;
        for (cases::Case& c :
             cases::load_suite(test_support::source_dir() + "/cases/suite").cases) {
            uint64_t triangles = 0;
            for (const cases::Draw& d : c.draws) {
                triangles += (d.indices ? d.indices->size() : d.positions.size()) / 3;
            }
            const uint64_t samples = uint64_t{c.target.width} * c.target.height * c.target.samples;
            // Large targets and meshes are left to `edgecase run --renderer`.
            if (samples <= 1U << 17U && triangles <= 1U << 13U &&
                rasterizers::unsupported_reason(c).empty()) {
                out.push_back(std::move(c));
            }
        }
        return out;
    }();
    return kCases;
}

diff::Verdict judge(const cases::Case& c, const rasterizers::Device& device) {
    const ref::Expectation expectation = ref::expect(c, {}, cases::Profile::direct3d);
    return diff::compare(c, expectation, draw_by_algorithm(c, device));
}

class Algorithms : public ::testing::TestWithParam<rasterizers::Device> {};

TEST_P(Algorithms, PassTheSuite) {
    EXPECT_GT(supported_cases().size(), 400U);
    std::set<std::string> failed_rules;
    std::set<std::string_view> failed_kinds;
    uint64_t compared = 0;
    for (const cases::Case& c : supported_cases()) {
        const diff::Verdict verdict = judge(c, GetParam());
        ASSERT_TRUE(verdict.error.empty()) << c.id << ": " << verdict.error;
        compared += verdict.compared_samples;
        for (const diff::Finding& f : verdict.findings) {
            failed_rules.insert(f.rule);
            failed_kinds.insert(diff::to_string(f.kind));
            if (GetParam().w_bits == 0) {
                ADD_FAILURE() << c.id << " " << f.rule << " at " << f.x << "," << f.y << " "
                              << f.quantity << ": expected " << f.expected << ", got " << f.got;
            }
        }
    }
    EXPECT_GT(compared, 1000000U);
    if (GetParam().w_bits != 0) {
        // 15 bits are too few for values in perspective; coverage knows nothing of w.
        EXPECT_TRUE(failed_rules.contains("interp.perspective"));
        EXPECT_EQ(failed_kinds, (std::set<std::string_view>{"value"}));
    }
}

INSTANTIATE_TEST_SUITE_P(All, Algorithms,
                         ::testing::ValuesIn(rasterizers::all_devices().begin(),
                                             rasterizers::all_devices().end()),
                         [](const auto& test) {
                             std::string name(test.param.name);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace run
