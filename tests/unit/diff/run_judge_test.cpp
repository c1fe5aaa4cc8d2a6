// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs of samples that are judged at once against the same samples judged one after another: right
// pictures, and pictures with wrong samples of every kind planted.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "capture/runs.hpp"
#include "diff/verdict.hpp"
#include "perfect_capture.hpp"
#include "ref/color/color.hpp"

namespace {

using cases::Profile;

using Random = std::mt19937_64;

double uniform(Random& rng, double low, double high) {
    return low + (high - low) * static_cast<double>(rng() >> 11U) * 0x1p-53;
}

// One to three triangles, on the grid or not, with equal or unequal w, with attributes of every
// interpolation, sometimes with several samples or layers, a colour, culling.
cases::Case random_case(Random& rng) {
    const uint32_t width = 1 + static_cast<uint32_t>(rng() % 40);
    const uint32_t height = 1 + static_cast<uint32_t>(rng() % 12);
    const bool is_on_grid = rng() % 2 == 0;
    const auto triangles = static_cast<uint32_t>(1 + rng() % 3);
    std::vector<std::array<double, 2>> vertices;
    for (uint32_t k = 0; k < 3 * triangles; ++k) {
        const auto at = [&](double size) {
            const double p = uniform(rng, -0.5 * size, 1.5 * size);
            return is_on_grid ? std::round(p * 4) / 4 : p;
        };
        vertices.push_back({at(width), at(height)});
    }
    cases::Case c = pixel_case(width, height, vertices);
    cases::Draw& draw = c.draws[0];
    for (glm::vec4& v : draw.positions) {
        const float w = rng() % 3 == 0 ? 1.0F : static_cast<float>(uniform(rng, 0.5, 3));
        v *= glm::vec4(w, w, w, w);
        v.z = static_cast<float>(uniform(rng, 0.1, 0.9)) * w;
    }
    for (const cases::Interpolation mode :
         {cases::Interpolation::smooth, cases::Interpolation::noperspective,
          cases::Interpolation::flat}) {
        std::vector<float> values;
        for (size_t k = 0; k < draw.positions.size(); ++k) {
            values.push_back(static_cast<float>(uniform(rng, -2, 2)));
        }
        if (rng() % 3 != 0) {
            add_attribute(c, mode, values);
        }
    }
    c.target.samples = rng() % 4 == 0 ? 4 : 1;
    if (rng() % 3 == 0) {
        c.target.layers = 2;
        draw.layer = 1;
    }
    if (rng() % 4 == 0) {
        draw.cull = cases::CullMode::back;
    }
    if (rng() % 3 == 0) {
        c.target.color = {cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
        draw.color.value = {0.25F, 1, 0, 0.5F};
    }
    return c;
}

// The reference's own picture, with its colours.
capture::Capture right_capture(const cases::Case& c, const ref::Expectation& e) {
    capture::Capture capture = perfect_capture(c, e);
    if (c.target.color) {
        ref::ColorReference reference(c, e);
        for (size_t index = 0; index < capture.sample_count(); ++index) {
            ref::ColorWitness witness;
            witness.paths.hits = {
                ref::path::SeenHits::Detail::total,
                static_cast<uint32_t>(capture.hits[index].x + capture.hits[index].y), 0};
            for (const ref::path::Fragment& f : e.fragments_of(e.samples[index])) {
                witness.paths.last.push_back(f.triangle == e.writers_of(e.samples[index]).back());
            }
            capture.color.push_back(
                reference.codes(index, cases::sample_at(c.target, index), witness));
        }
    }
    return capture;
}

float wrong(Random& rng, float v) {
    switch (rng() % 6) {
        case 0:
            return std::nextafter(v, 1e9F);
        case 1:
            return v * 1.000001F;
        case 2:
            return v + 0.25F;
        case 3:
            return std::numeric_limits<float>::quiet_NaN();
        case 4:
            return std::bit_cast<float>(capture::kPoison);
        default:
            return capture::kClearValue;
    }
}

// Makes one sample, or a run of them, wrong in one plane; some changes are within the budgets.
void plant(Random& rng, capture::Capture& capture) {
    const size_t count = capture.sample_count();
    const size_t first = rng() % count;
    const size_t last = std::min(count, first + (rng() % 3 == 0 ? 1 + rng() % 20 : 1));
    const uint64_t what = rng() % 9;
    const auto component = static_cast<glm::vec4::length_type>(rng() % 4);
    for (size_t k = first; k < last; ++k) {
        switch (what) {
            case 0:
                clear_sample(capture, k);
                break;
            case 1:
                set_hits(capture, k, static_cast<float>(rng() % 3), static_cast<float>(rng() % 2));
                break;
            case 2:
                capture.hits[k][component] = wrong(rng, capture.hits[k][component]);
                break;
            case 3:
                capture.writers[k].primitive ^= 1U;
                break;
            case 4:
                capture.writers[k].spare = rng() % 2 == 0 ? 0 : capture::kPoison;
                break;
            case 5:
                capture.frag_coord[k][component] = wrong(rng, capture.frag_coord[k][component]);
                break;
            case 6:
                capture.depth[k] = wrong(rng, capture.depth[k]);
                break;
            case 7:
                if (capture.attribute_count > 0) {
                    glm::vec4& v = capture.attributes[rng() % capture.attribute_count][k];
                    v[component] = wrong(rng, v[component]);
                }
                break;
            default:
                if (!capture.color.empty()) {
                    capture.color[k][static_cast<size_t>(component)] ^= 1U;
                }
                break;
        }
    }
}

std::string text_of(const diff::Verdict& v) {
    std::string out = v.error + "\n";
    for (const diff::Finding& f : v.findings) {
        out += std::to_string(static_cast<int>(f.kind)) + " " + f.rule + " " +
               std::string(cases::to_string(f.level)) + " (" + std::to_string(f.x) + ", " +
               std::to_string(f.y) + ") " + std::to_string(f.sample) + " " + f.quantity + " " +
               f.expected + " " + f.got + " " + f.why + " " + std::to_string(f.ratio) + "\n";
    }
    return out;
}

void expect_same(const diff::Verdict& runs, const diff::Verdict& samples, int n) {
    ASSERT_EQ(text_of(runs), text_of(samples)) << n;
    ASSERT_EQ(runs.counts, samples.counts) << n;
    ASSERT_EQ(runs.groups, samples.groups) << n;
    ASSERT_EQ(runs.compared_samples, samples.compared_samples) << n;
    ASSERT_EQ(runs.compared_values, samples.compared_values) << n;
    ASSERT_EQ(runs.worst_ratio, samples.worst_ratio) << n;
    ASSERT_EQ(runs.worst_quantity, samples.worst_quantity) << n;
    ASSERT_EQ(runs.expected_hits, samples.expected_hits) << n;
    ASSERT_EQ(runs.device_hits, samples.device_hits) << n;
    ASSERT_EQ(runs.marks, samples.marks) << n;
    ASSERT_EQ(runs.error_ratios, samples.error_ratios) << n;
}

// Kinds and rules, each with the loosest level.
std::map<std::pair<diff::FindingKind, std::string>, Profile> symptoms_of(const diff::Verdict& v) {
    std::map<std::pair<diff::FindingKind, std::string>, Profile> out;
    for (const diff::FindingGroup& g : v.groups) {
        const auto [at, is_new] = out.try_emplace({g.kind, g.rule}, g.level);
        at->second = std::min(at->second, g.level);
    }
    return out;
}

// What shorter comparisons leave out is the size of errors, or all behind the first finding.
void expect_same_of_shorter(const cases::Case& c, const ref::Expectation& e,
                            const capture::Capture& capture, diff::Verdict whole, int n) {
    for (diff::Finding& f : whole.findings) {
        f.ratio = 0;
    }
    diff::Verdict bare = diff::compare(c, e, capture, diff::Wanted::findings_without_ratios);
    for (diff::Finding& f : bare.findings) {
        f.ratio = 0;
    }
    ASSERT_EQ(text_of(bare), text_of(whole)) << n;
    ASSERT_EQ(bare.groups, whole.groups) << n;
    ASSERT_EQ(bare.marks, whole.marks) << n;
    ASSERT_EQ(symptoms_of(diff::compare(c, e, capture, diff::Wanted::symptoms)), symptoms_of(whole))
        << n;
    diff::Verdict first = diff::compare(c, e, capture, diff::Wanted::first_finding);
    ASSERT_EQ(first.findings.empty(), whole.findings.empty()) << n;
    whole.findings.resize(std::min(whole.findings.size(), size_t{1}));
    first.findings.resize(whole.findings.size());
    for (diff::Finding& f : first.findings) {
        f.ratio = 0;
    }
    ASSERT_EQ(text_of(first), text_of(whole)) << n;
}

// A picture that is wrong everywhere, by errors of all sizes.
TEST(ExhaustiveRunJudge, SymptomsAreThoseOfTheWholeComparison) {
    Random rng(43);
    size_t wrong = 0, shorter = 0;
    for (int n = 0; n < 200; ++n) {
        const cases::Case c = random_case(rng);
        const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
        if (e.must_samples == 0) {
            continue;
        }
        capture::Capture capture = right_capture(c, e);
        const float scale = 1 + std::ldexp(1.0F, -static_cast<int>(rng() % 20));
        for (size_t k = 0; k < capture.frag_coord.size(); ++k) {
            if (capture::sample_state(capture, k) == capture::SampleState::drawn) {
                capture.frag_coord[k].w *= scale;
                for (uint32_t a = 0; a < capture.attribute_count; ++a) {
                    capture.attributes[a][k].x *= scale;
                }
            }
        }
        const diff::Verdict whole = diff::compare(c, e, capture);
        const diff::Verdict symptoms = diff::compare(c, e, capture, diff::Wanted::symptoms);
        ASSERT_EQ(symptoms_of(symptoms), symptoms_of(whole)) << n;
        ASSERT_EQ(symptoms.marks, whole.marks) << n;
        wrong += whole.ok() ? 0U : 1U;
        shorter += symptoms.groups == whole.groups ? 0U : 1U;
    }
    EXPECT_GT(wrong, 60U);
    EXPECT_GT(shorter, 0U);  // where levels were not asked
}

TEST(ExhaustiveRunJudge, SaysWhatSamplesSayOneByOne) {
    Random rng(41);
    int right = 0, wrong_pictures = 0;
    for (int n = 0; n < 600; ++n) {
        const cases::Case c = random_case(rng);
        const Profile profile = cases::kProfiles[rng() % 3];
        const ref::Expectation e = ref::expect(c, ref::Limits{8}, profile);
        if (e.must_samples == 0) {
            continue;
        }
        capture::Capture capture = right_capture(c, e);
        for (uint64_t k = rng() % 4; k > 0; --k) {
            plant(rng, capture);
        }
        const diff::Verdict samples = diff::compare_by_sample(c, e, capture);
        expect_same(diff::compare(c, e, capture), samples, n);
        expect_same_of_shorter(c, e, capture, samples, n);
        ++(samples.ok() ? right : wrong_pictures);
        if (testing::Test::HasFatalFailure()) {
            return;
        }
    }
    EXPECT_GT(right, 100);
    EXPECT_GT(wrong_pictures, 100);
}

TEST(ExhaustiveRunJudge, SaysWhatColoursAloneSayOneByOne) {
    Random rng(43);
    int right = 0, wrong_pictures = 0;
    for (int n = 0; n < 300; ++n) {
        cases::Case c = random_case(rng);
        c.target.color = {cases::ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
        c.target.has_instruments = false;
        c.target.has_depth = false;
        c.draws[0].attributes.clear();
        c.draws[0].color.value = {0.25F, 1, 0, 0.5F};
        const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
        if (e.must_samples == 0) {
            continue;
        }
        ref::ColorReference reference(c, e);
        capture::Capture capture;
        capture.target = c.target;
        for (size_t index = 0; index < capture.sample_count(); ++index) {
            capture.color.push_back(reference.codes(index, cases::sample_at(c.target, index)));
        }
        for (uint64_t k = rng() % 3; k > 0; --k) {
            capture::ColorCodes& codes = capture.color[rng() % capture.sample_count()];
            codes = rng() % 4 == 0   ? capture::ColorCodes{capture::kPoison, capture::kPoison,
                                                         capture::kPoison, capture::kPoison}
                    : rng() % 2 == 0 ? capture::ColorCodes{0, 0, 0, 0}
                                     : capture::ColorCodes{64, 255, 0, 127};
        }
        const diff::Verdict samples = diff::compare_by_sample(c, e, capture);
        expect_same(diff::compare(c, e, capture), samples, n);
        ++(samples.ok() ? right : wrong_pictures);
        if (testing::Test::HasFatalFailure()) {
            return;
        }
    }
    EXPECT_GT(right, 30);
    EXPECT_GT(wrong_pictures, 30);
}

// The stretches of memory against the state of each sample; nearly all of a right picture is in
// them.
TEST(ExhaustiveRunJudge, StretchesHoldWhatTheirSamplesHold) {
    Random rng(47);
    size_t clear = 0, hit = 0, all = 0;
    for (int n = 0; n < 300; ++n) {
        const cases::Case c = random_case(rng);
        const ref::Expectation e = ref::expect(c, ref::Limits{8}, Profile::direct3d);
        capture::Capture capture = right_capture(c, e);
        for (uint64_t k = rng() % 6; k > 0; --k) {
            plant(rng, capture);
        }
        const capture::CaptureView view(capture);
        const size_t count = view.sample_count();
        for (size_t k = 0; k < count;) {
            const size_t clears = capture::count_clear(view, k, count - k);
            for (size_t j = k; j < k + clears; ++j) {
                ASSERT_EQ(capture::sample_state(view, j), capture::SampleState::clear);
            }
            const bool is_front = view.hits[k].x > 0;
            const capture::Writer writer = view.writers[k];
            const size_t hits =
                writer.draw == capture::kClearId || writer.spare != capture::kClearId
                    ? 0
                    : capture::count_hit_once(view, k, count - k, is_front, writer);
            for (size_t j = k; j < k + hits; ++j) {
                const capture::SampleState state = capture::sample_state(view, j);
                // FragCoord and depth are left to those who judge values.
                const glm::vec4& at = view.frag_coord[j];
                const bool is_value_open = !std::isfinite(at.x + at.y + at.z + at.w) ||
                                           !std::isfinite(view.depth[j]) || at.x < -1e30F;
                ASSERT_TRUE(state == capture::SampleState::drawn || is_value_open) << n;
                ASSERT_EQ(view.writers[j], writer);
                ASSERT_EQ(view.hits[j].x + view.hits[j].y, 1.0F);
            }
            clear += clears;
            hit += hits;
            const size_t step = std::max<size_t>({1, clears, hits});
            all += step;
            k += step;
        }
    }
    EXPECT_GT(clear + hit, all * 9 / 10);
    EXPECT_GT(hit, all / 20);
}

}  // namespace
