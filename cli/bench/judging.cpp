// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bench/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "cases/load/loader.hpp"
#include "cases/model/derive.hpp"
#include "cli/bench/clock.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/expectation/expectation.hpp"
#include "run/judge.hpp"

namespace cli {

namespace {

using cases::operator""_fault;

constexpr double kLeastSeconds = 0.2;  // a figure is the mean of so long

// Mean seconds of one call.
template <class Work>
double timed(Work work) {
    work();  // touches its memory
    size_t calls = 0;
    const Clock::time_point begin = Clock::now();
    double seconds = 0;
    do {
        work();
        ++calls;
        seconds = seconds_since(begin);
    } while (seconds < kLeastSeconds);
    return seconds / static_cast<double>(calls);
}

ref::Expectation expect(const cases::Case& c) {
    return ref::expect(c, ref::Limits{}, cases::Profile::direct3d);
}

std::vector<cases::Case> load(const std::string& toml) {
    auto loaded = cases::load_text(toml, "bench.toml", "bench");
    if (!loaded) {
        throw std::logic_error(cases::to_string(loaded.error().front()));
    }
    return std::move(*loaded);
}

// One triangle over two fifths of a square target. `target` and `draw` are further lines.
cases::Case large_case(uint32_t side, std::string_view target, std::string_view draw) {
    const double all = side;
    return load(fmt::format("format = 1\ndescription = \"Large.\"\nrules = [\"cover.inside\"]\n"
                            "[target]\nsize = [{0}, {0}]\n{1}\n[[draw]]\nvertices = [[0.3, 0.2], "
                            "[{2}, {3}], [{4}, {5}]]\n{6}\n",
                            side, target, all * 0.9, all * 0.1, all * 0.2, all * 0.95, draw))
        .front();
}

// Cases of so many plain triangles in a square target.
std::vector<cases::Case> small_cases(uint32_t side, uint32_t triangles) {
    std::vector<cases::Case> cases =
        load(fmt::format("format = 1\ndescription = \"Small.\"\nrules = [\"cover.inside\"]\n"
                         "[matrix]\nseed = [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16]\n"
                         "[target]\nsize = [{0}, {0}]\n[[draw]]\n"
                         "generate = {{ kind = \"triangles\", seed = \"seed\", count = {1} }}\n",
                         side, triangles));
    std::erase_if(cases, [](const cases::Case& c) { return expect(c).must_samples == 0; });
    return cases;
}

void note(const cases::Case& c, std::string_view what) {
    fmt::print(stderr, "edgecase: note: a right picture of {} is not accepted: {}\n", c.id, what);
}

void time_suite(std::span<const cases::Case> cases, JudgingFigures& figures) {
    for (const cases::Case& c : cases) {
        if (c.blit) {
            continue;  // texels, not triangles
        }
        const capture::Capture capture = software::captured(c, software::Device{});
        Clock::time_point begin = Clock::now();
        const ref::Expectation expectation = expect(c);
        figures.reference += seconds_since(begin);
        begin = Clock::now();
        const diff::Verdict verdict = diff::compare(c, expectation, capture);
        figures.compare += seconds_since(begin);
        if (!verdict.ok()) {
            note(c, verdict.error.empty() ? "it has findings" : verdict.error);
        }
    }
}

// Judges a picture as `run` does, into a record; whether it is accepted.
bool judged(const cases::Case& c, const capture::Capture& capture, double& seconds) {
    const std::vector<diff::Consistency> same(cases::derivations(c).size());
    const Clock::time_point begin = Clock::now();
    report::CaseRecord record = run::planned_case(c);
    run::judge(record, c, capture, {same, {}}, ref::Limits{}, cases::Profile::direct3d,
               run::KeepPictures::failed);
    seconds += seconds_since(begin);
    return record.status == report::Status::pass;
}

void time_broken(std::span<const cases::Case> cases, std::span<const size_t> quick,
                 JudgingFigures& figures) {
    software::Device broken;
    broken.fault = "half-pixel-shift"_fault;
    for (size_t nth = 0; nth < quick.size(); nth += 2) {
        const cases::Case& c = cases[quick[nth]];
        ++figures.quick_cases;
        judged(c, software::captured(c, software::Device{}), figures.right);
        const bool is_right = judged(c, software::captured(c, broken), figures.broken);
        figures.broken_cases += is_right ? 0 : 1;
    }
}

// A right picture, which has to be accepted.
capture::Capture right_capture(const cases::Case& c) {
    capture::Capture capture = software::captured(c, software::Device{});
    if (!diff::compare(c, expect(c), capture).ok()) {
        note(c, "it has findings");
    }
    return capture;
}

// Mean seconds of judging a right picture; `reference`: of the expectation alone.
double judging_seconds(const cases::Case& c, double* reference) {
    const capture::Capture capture = right_capture(c);
    if (reference != nullptr) {
        *reference = timed([&] { return expect(c); });
    }
    return timed([&] { return diff::compare(c, expect(c), capture); });
}

void time_sizes(JudgingFigures& figures) {
    for (const uint32_t side : {64U, 256U, 1024U, 4096U}) {
        double reference = 0;
        const double all = judging_seconds(large_case(side, "", ""), &reference);
        const double samples = static_cast<double>(side) * side;
        figures.sizes.push_back({side, samples / reference, samples / all});
    }
}

void time_small(JudgingFigures& figures) {
    for (const auto& [side, triangles] : {std::pair(16U, 1U), {64U, 1U}, {64U, 4U}}) {
        const std::vector<cases::Case> cases = small_cases(side, triangles);
        std::vector<capture::Capture> captures;
        for (const cases::Case& c : cases) {
            captures.push_back(right_capture(c));
        }
        const double seconds = timed([&] {
            for (size_t k = 0; k < cases.size(); ++k) {
                diff::compare(cases[k], expect(cases[k]), captures[k]);
            }
        });
        figures.small.push_back({side, triangles, static_cast<double>(cases.size()) / seconds});
    }
}

void time_megapixels(JudgingFigures& figures) {
    constexpr uint32_t kSide = 1024;
    constexpr std::string_view kColour =
        "attachments = \"color\"\n[target.color]\nformat = \"rgba8-unorm\"\nclear = [0, 0, 0, 0]";
    constexpr std::string_view kBarycentrics =
        "[[draw.attribute]]\nfrom = \"barycentric\"\n[[draw.attribute]]\nfrom = \"barycentric\"\n";
    const auto add = [&](std::string what, std::string_view target, std::string_view draw) {
        figures.megapixels.push_back(
            {std::move(what), judging_seconds(large_case(kSide, target, draw), nullptr)});
    };
    add("colour alone", kColour, "color = { value = [1, 1, 1, 1] }");
    add("all planes", "", "");
    add("all planes and barycentrics", "", kBarycentrics);
}

}  // namespace

JudgingFigures time_judging(std::span<const cases::Case> cases, std::span<const size_t> quick) {
    JudgingFigures figures;
    time_suite(cases, figures);
    time_broken(cases, quick, figures);
    time_sizes(figures);
    time_small(figures);
    time_megapixels(figures);
    return figures;
}

double spread_of(std::span<const JudgingFigures::Size> sizes) {
    const auto [slowest, fastest] = std::ranges::minmax_element(
        sizes, [](const auto& a, const auto& b) { return a.all < b.all; });
    return fastest->all / slowest->all;
}

}  // namespace cli
