// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdio>
#include <exception>

#include "cli/commands.hpp"
#include "report/record/run.hpp"

int main(int argc, char** argv) {
    ::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of the write, and told
    try {
        return cli::edgecase_main(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "edgecase: internal error: %s; please report it\n", e.what());
        return report::kExitInternal;
    }
}
