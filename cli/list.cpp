// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cases/base/counted.hpp"
#include "cases/load/loader.hpp"
#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "ref/expectation/expectation.hpp"
#include "report/record/run.hpp"

namespace cli {

using cases::counted;

namespace {

struct ListOptions {
    SuiteOptions suite;
    bool long_form = false, ids = false, json = false;
};

void print_long(const cases::Case& c) {
    say(c.id + "\n");
    say_wrapped("    " + c.claim.description + "\n");
    if (!c.claim.catches.empty()) {
        say_wrapped("    catches: " + c.claim.catches + "\n");
    }
    std::string rules;
    for (const std::string& rule : c.claim.rules) {
        rules += (rules.empty() ? "" : ", ") + rule;
    }
    const std::string layers =
        c.target.layers > 1 ? std::to_string(c.target.layers) + " layers, " : "";
    const std::string drawn = c.blit ? "a blit" : counted(c.draws.size(), "draw");
    say_wrapped("    rules: " + rules + "\n");
    say(fmt::format("    file: {}:{}\n    target: {} x {}, {}{}, {}\n", c.claim.where.file,
                    c.claim.where.line, c.target.width, c.target.height, layers,
                    counted(c.target.samples, "sample"), drawn));
    const uint64_t free = c.blit ? 0 : ref::expect(c, {}, cases::Profile::direct3d).either_samples;
    say(fmt::format("    free: {} of {} samples at profile direct3d\n", free,
                    uint64_t{c.target.width} * c.target.rows() * c.target.samples));
    for (const std::string& link : c.claim.links) {
        say("    link: " + link + "\n");
    }
    for (const std::string& note : c.claim.notes) {
        say_wrapped("    note: " + note + "\n");
    }
}

nlohmann::ordered_json to_json(const cases::Case& c) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
    for (const auto& [key, value] : c.claim.parameters) {
        parameters[key] = value;
    }
    return {{"id", c.id},
            {"file", c.claim.where.file},
            {"line", c.claim.where.line},
            {"description", c.claim.description},
            {"catches", c.claim.catches},
            {"rules", c.claim.rules},
            {"links", c.claim.links},
            {"parameters", parameters},
            {"target",
             {{"width", c.target.width},
              {"height", c.target.height},
              {"samples", c.target.samples},
              {"layers", c.target.layers}}},
            {"notes", c.claim.notes}};
}

int carry_out(const Program& program, const ListOptions& options) {
    // Names alone need no cases, unless something else than names is asked for: "@rule:...".
    const bool names_only = options.ids && !options.json && !options.long_form &&
                            std::ranges::none_of(options.suite.selectors, [](const std::string& s) {
                                return s.find('@') != std::string::npos || s == "-";
                            });
    const LoadedSuite suite = names_only
                                  ? load_and_select(program, options.suite, cases::Contents::ids)
                                  : load_selected(program, options.suite);
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const size_t k : suite.selected) {
        const cases::Case& c = suite.cases[k];
        if (options.json) {
            all.push_back(to_json(c));
        } else if (options.long_form) {
            print_long(c);
        } else if (options.ids) {
            say(c.id + "\n");
        } else {
            say_wrapped(c.id + "  " + c.claim.description + "\n");
        }
    }
    if (options.json) {
        const std::string text =
            all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
        say(text + "\n");
    }
    return suite.selected.empty() ? report::kExitNothingSelected : report::kExitOk;
}

void declare(CLI::App& app, ListOptions& o) {
    add_suite(&app, o.suite);
    app.add_flag("--long", o.long_form, "with file, rules, description and notes");
    app.add_flag("--ids", o.ids, "ids only, one a line");
    app.add_flag("--json", o.json, "as JSON");
}

void check(const CLI::App& app, const ListOptions&, const Words&) {
    check_alternatives(app, "--long", {"--ids", "--json"});
    check_alternatives(app, "--ids", {"--json"});
}

}  // namespace

Command list_command() {
    return make_command<ListOptions>(
        {"list", kCases, "list case ids",
         "  edgecase list --long 'ties/**'            one family with descriptions and rules\n"
         "  edgecase list --ids '@rule:tie.*'         the cases of some rules\n"},
        declare, carry_out, check);
}

}  // namespace cli
