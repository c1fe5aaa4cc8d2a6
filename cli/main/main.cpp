// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include "cli/commands.hpp"
#include "report/record/run.hpp"

int main(int argc, char** argv) {
    try {
        return cli::edgecase_main(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "edgecase: internal error: %s; please report it\n", e.what());
        return report::kExitInternal;
    }
}
