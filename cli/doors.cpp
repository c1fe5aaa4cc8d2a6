// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cases/model/door.hpp"
#include "cases/model/way.hpp"
#include "cli/commands.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/renderers/renderers.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

int carry_out(const Program&) {
    for (const cases::DoorRow& row : cases::all_doors()) {
        const std::string_view needs = all_renderers().front().needs(row.door);
        say(fmt::format("{}\n", row.word));
        say_wrapped(fmt::format("    {}\n", row.does));
        say_wrapped(fmt::format("    group: {}; rule: {}; takes {}{}\n", to_string(row.group),
                                row.rule, row.takes,
                                needs.empty() ? "" : fmt::format("; needs {}", needs)));
    }
    for (const cases::WayRow& way : cases::all_ways()) {
        say(fmt::format("{}\n", way.word));
        say_wrapped(fmt::format("    {}\n", way.does));
        say_wrapped(fmt::format("    group: bare; --ways; takes {}\n", way.takes));
    }
    return report::kExitOk;
}

}  // namespace

Command doors_command() {
    return make_command(
        {"doors", kProgram,
         "list the doors that a run can take, other ways of the API, and the ways to draw as "
         "applications do",
         "  edgecase doors                            what each of them does, and takes\n"},
        carry_out);
}

}  // namespace cli
