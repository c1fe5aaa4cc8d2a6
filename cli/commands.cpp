// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.hpp"

#include <malloc.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>

#include "cli/options/parse.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/renderers/renderers.hpp"
#include "run/process/pool.hpp"
#include "run/worker/worker.hpp"

namespace cli {

int edgecase_main(int argc, const char* const* argv) {
    // Captures and expectations are megabytes that come and go with every case; taking them from
    // the system each time costs more than filling them.
    constexpr int kKeep = 1 << 30;  // bytes
    ::mallopt(M_MMAP_THRESHOLD, kKeep);
    ::mallopt(M_TRIM_THRESHOLD, kKeep);
    const Program program = make_program(argc, argv);
    if (program.arguments.size() == 2 && program.arguments[1] == "worker") {
        return run::run_worker(all_renderers());
    }
    CLI::App app(
        "Edgecase: checks triangle rasterization of Vulkan drivers against an exact reference.",
        "edgecase");
    AllOptions all;
    const OrStop<std::string> parsed = parse(app, all, program.arguments);
    if (!parsed) {
        return report_stop(parsed.error());
    }
    const std::map<std::string, std::function<int()>> table = {
        {"run", [&] { return run_command(program, all.run); }},
        {"gtest", [&] { return gtest_command(program, all.gtest); }},
        {"fuzz", [&] { return fuzz_command(program, all.fuzz); }},
        {"reduce", [&] { return reduce_command(program, all.reduce); }},
        {"diagnose", [&] { return diagnose_command(program, all.diagnose); }},
        {"probe", [&] { return probe_command(program, all.probe); }},
        {"list", [&] { return list_command(program, all.list); }},
        {"doors", [] { return doors_command(); }},
        {"lint", [&] { return lint_command(program, all.lint); }},
        {"explain", [&] { return explain_command(program, all.explain); }},
        {"render", [&] { return render_command(program, all.render); }},
        {"export", [&] { return export_command(program, all.export_cases); }},
        {"diff", [&] { return diff_command(program, all.diff); }},
        {"doctor", [&] { return doctor_command(program, all.doctor); }},
        {"bench", [&] { return bench_command(program, all.bench); }},
        {"report", [&] { return report_command(program, all.report); }},
        {"expect", [&] { return expect_command(program, all.expect); }},
        {"compare", [&] { return compare_command(program, all.compare); }},
        {"completion", [&] { return completion_command(all.shell); }},
        {"man", [] { return man_command(); }},
        {"version", [] { return version_command(); }},
        {"help", [] { return 0; }},
    };
    const int code = finish_output(table.at(*parsed)());
    if (run::Pool::has_abandoned()) {
        // Threads that still judge use what the end of main() would destroy.
        std::fflush(nullptr);
        std::_Exit(code);
    }
    return code;
}

}  // namespace cli
