// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What judging costs: the expectation of a case, and its comparison with a right picture. One
// iteration of Small is 32 cases; items are cases there and samples elsewhere.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "cases/load/loader.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/strength/strength.hpp"
#include "ref/expectation/expectation.hpp"

namespace {

std::vector<cases::Case> load(const std::string& toml) {
    auto loaded = cases::load_text(toml, "benchmark.toml", "benchmark");
    if (!loaded) {
        fmt::print(stderr, "{}\n", cases::to_string(loaded.error().front()));
        std::abort();
    }
    return std::move(*loaded);
}

// So many cases of one to four plain triangles in a target of `side` pixels. `extra` are lines of
// the draw.
std::vector<cases::Case> small_cases(uint32_t side, uint32_t triangles, bool is_on_grid,
                                     std::string_view extra) {
    return load(fmt::format(
        "format = 1\ndescription = \"Small.\"\nrules = [\"cover.inside\"]\n"
        "[matrix]\nseed = [{}]\n[target]\nsize = [{}, {}]\n[[draw]]\n"
        "generate = {{ kind = \"triangles\", seed = \"seed\", count = {}{} }}\n{}\n",
        "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31,32",
        side, side, triangles, is_on_grid ? "" : ", class = \"off-grid\"", extra));
}

// One triangle over two fifths of a square target.
cases::Case large_case(int64_t side, std::string_view target, std::string_view draw) {
    return load(fmt::format("format = 1\ndescription = \"Large.\"\nrules = [\"cover.inside\"]\n"
                            "[target]\nsize = [{0}, {0}]\n{1}\n[[draw]]\nvertices = [[0.3, 0.2], "
                            "[{2}, {3}], [{4}, {5}]]\n{6}\n",
                            side, target, static_cast<double>(side) * 0.9,
                            static_cast<double>(side) * 0.1, static_cast<double>(side) * 0.2,
                            static_cast<double>(side) * 0.95, draw))
        .front();
}

constexpr std::string_view kAttributes =
    "[[draw.attribute]]\nfrom = \"barycentric\"\n[[draw.attribute]]\nfrom = \"barycentric\"\n";

uint64_t samples_of(const cases::Case& c) {
    return uint64_t{c.target.width} * c.target.height * c.target.samples;
}

void judge_small(benchmark::State& state, const std::vector<cases::Case>& cases) {
    std::vector<capture::Capture> captures;
    for (const cases::Case& c : cases) {
        captures.push_back(rasterizers::draw_by_reference(c));
    }
    for (auto _ : state) {
        for (size_t k = 0; k < cases.size(); ++k) {
            const ref::Expectation expectation =
                ref::expect(cases[k], ref::Limits{}, cases::Profile::direct3d);
            if (expectation.must_samples > 0 &&
                !diff::compare(cases[k], expectation, captures[k]).ok()) {
                state.SkipWithError("the reference's own picture is not accepted");
            }
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(cases.size()));
}

void expect_large(benchmark::State& state, const cases::Case& c) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(ref::expect(c, ref::Limits{}, cases::Profile::direct3d));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(samples_of(c)));
}

void compare_large(benchmark::State& state, const cases::Case& c) {
    const ref::Expectation expectation = ref::expect(c, ref::Limits{}, cases::Profile::direct3d);
    const capture::Capture capture = software::captured(c, software::Device{});
    for (auto _ : state) {
        if (!diff::compare(c, expectation, capture).ok()) {
            state.SkipWithError("the reference's own picture is not accepted");
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(samples_of(c)));
}

void JudgeSmall(benchmark::State& state) {
    judge_small(state, small_cases(static_cast<uint32_t>(state.range(0)),
                                   static_cast<uint32_t>(state.range(1)), true, ""));
}
BENCHMARK(JudgeSmall)->Args({16, 1})->Args({64, 1})->Args({64, 4})->Unit(benchmark::kMillisecond);

void JudgeSmallOffGrid(benchmark::State& state) {
    judge_small(state, small_cases(64, 4, false, ""));
}
BENCHMARK(JudgeSmallOffGrid)->Unit(benchmark::kMillisecond);

void JudgeSmallAttributes(benchmark::State& state) {
    judge_small(state, small_cases(64, 1, true, kAttributes));
}
BENCHMARK(JudgeSmallAttributes)->Unit(benchmark::kMillisecond);

void ExpectLarge(benchmark::State& state) {
    expect_large(state, large_case(state.range(0), "", ""));
}
BENCHMARK(ExpectLarge)->Arg(64)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void CompareLarge(benchmark::State& state) {
    compare_large(state, large_case(state.range(0), "", ""));
}
BENCHMARK(CompareLarge)->Arg(64)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void CompareLargeBarycentric(benchmark::State& state) {
    compare_large(state, large_case(state.range(0), "", kAttributes));
}
BENCHMARK(CompareLargeBarycentric)->Arg(64)->Arg(1024)->Unit(benchmark::kMillisecond);

void CompareLargeColour(benchmark::State& state) {
    compare_large(state, large_case(state.range(0),
                                    "attachments = \"color\"\n[target.color]\nformat = "
                                    "\"rgba8-unorm\"\nclear = [0, 0, 0, 0]",
                                    "color = { value = [1, 1, 1, 1] }"));
}
BENCHMARK(CompareLargeColour)->Arg(64)->Arg(1024)->Unit(benchmark::kMillisecond);

}  // namespace
