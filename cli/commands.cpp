// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.hpp"

#include <malloc.h>

#include <cstdio>
#include <cstdlib>

#include "cli/options/parse.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/renderers/renderers.hpp"
#include "run/process/pool.hpp"
#include "run/worker/worker.hpp"

namespace cli {

std::span<const Command> all_commands() {
    static const Command kCommands[] = {
        run_command(),      gtest_command(),   fuzz_command(),       reduce_command(),
        diagnose_command(), probe_command(),   list_command(),       doors_command(),
        lint_command(),     explain_command(), render_command(),     export_command(),
        diff_command(),     doctor_command(),  report_command(),     expect_command(),
        compare_command(),  bench_command(),   completion_command(), man_command(),
        version_command(),
    };
    return kCommands;
}

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
    const auto carry_out = [&] {
        try {
            return parse(all_commands(), program.arguments)(program);
        } catch (const Stop& stop) {
            return report_stop(stop);
        }
    };
    const int code = finish_output(carry_out());
    if (run::Pool::has_abandoned()) {
        // Threads that still judge use what the end of main() would destroy.
        std::fflush(nullptr);
        std::_Exit(code);
    }
    return code;
}

}  // namespace cli
