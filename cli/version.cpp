// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/program.hpp"
#include "cli/options/stop.hpp"

namespace cli {

namespace {

int carry_out(const Program&) {
    say(fmt::format("edgecase {}\ncase format 1, results schema 1, expectation format 2\n",
                    kVersion));
    return report::kExitOk;
}

}  // namespace

Command version_command() {
    return make_command({"version", kProgram, "print the version", ""}, carry_out);
}

}  // namespace cli
