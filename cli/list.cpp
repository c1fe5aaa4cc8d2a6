// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands that tell what case files say, and through which doors cases are drawn: "list",
// "explain" and "doors".
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cases/base/counted.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/door.hpp"
#include "cases/model/rule.hpp"
#include "cases/select/selector.hpp"
#include "cli/commands.hpp"
#include "cli/explain_text.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "ref/expectation/expectation.hpp"
#include "report/record/run.hpp"
#include "report/text/wrap.hpp"

namespace cli {

using cases::counted;

namespace {

// For people: on a terminal no word is broken at its last column; elsewhere a line stays whole, for
// programs that search.
void say_wrapped(const std::string& text) {
    const report::ConsoleStyle style = console_style(stdout, When::never, false);
    say(style.wrap ? report::wrapped(text, style.width) : text);
}

void print_long(const cases::Case& c) {
    say(c.id + "\n");
    say_wrapped("    " + c.description + "\n");
    if (!c.catches.empty()) {
        say_wrapped("    catches: " + c.catches + "\n");
    }
    std::string rules;
    for (const std::string& rule : c.rules) {
        rules += (rules.empty() ? "" : ", ") + rule;
    }
    const std::string layers =
        c.target.layers > 1 ? std::to_string(c.target.layers) + " layers, " : "";
    const std::string drawn = c.blit ? "a blit" : counted(c.draws.size(), "draw");
    say_wrapped("    rules: " + rules + "\n");
    say(fmt::format("    file: {}:{}\n    target: {} x {}, {}{}, {}\n", c.where.file, c.where.line,
                    c.target.width, c.target.height, layers, counted(c.target.samples, "sample"),
                    drawn));
    const uint64_t free = c.blit ? 0 : ref::expect(c, {}, cases::Profile::direct3d).either_samples;
    say(fmt::format("    free: {} of {} samples at profile direct3d\n", free,
                    uint64_t{c.target.width} * c.target.rows() * c.target.samples));
    for (const std::string& link : c.links) {
        say("    link: " + link + "\n");
    }
    for (const std::string& note : c.notes) {
        say_wrapped("    note: " + note + "\n");
    }
}

nlohmann::ordered_json to_json(const cases::Case& c) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
    for (const auto& [key, value] : c.parameters) {
        parameters[key] = value;
    }
    return {{"id", c.id},
            {"file", c.where.file},
            {"line", c.where.line},
            {"description", c.description},
            {"catches", c.catches},
            {"rules", c.rules},
            {"links", c.links},
            {"parameters", parameters},
            {"target",
             {{"width", c.target.width},
              {"height", c.target.height},
              {"samples", c.target.samples},
              {"layers", c.target.layers}}},
            {"notes", c.notes}};
}

}  // namespace

int list_command(const Program& program, const ListOptions& options) {
    // Names alone need no cases, unless something else than names is asked for: "@rule:...".
    const bool names_only = options.ids && !options.json && !options.long_form &&
                            std::none_of(options.suite.selectors.begin(),
                                         options.suite.selectors.end(), [](const std::string& s) {
                                             return s.find('@') != std::string::npos || s == "-";
                                         });
    const OrStop<LoadedSuite> suite =
        names_only ? load_and_select(program, options.suite, cases::Contents::ids)
                   : load_selected(program, options.suite);
    if (!suite) {
        return report_stop(suite.error());
    }
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const size_t k : suite->selected) {
        const cases::Case& c = suite->cases[k];
        if (options.json) {
            all.push_back(to_json(c));
        } else if (options.long_form) {
            print_long(c);
        } else if (options.ids) {
            say(c.id + "\n");
        } else {
            say_wrapped(c.id + "  " + c.description + "\n");
        }
    }
    if (options.json) {
        const std::string text =
            all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
        say(text + "\n");
    }
    return suite->selected.empty() ? report::kExitNothingSelected : report::kExitOk;
}

namespace {

int explain_rule(const Program& program, const ExplainOptions& options) {
    const cases::Rule* rule = cases::find_rule(options.rule);
    if (rule == nullptr) {
        return report_stop(
            {report::kExitNothingSelected,
             {"there is no rule '" + options.rule + "'; " + cases::rule_hint(options.rule, '\'')}});
    }
    const OrStop<LoadedSuite> suite = load_and_select(program, options.suite);
    if (!suite) {
        return report_stop(suite.error());
    }
    std::fputs(rule_text(*rule, suite->cases).c_str(), stdout);
    return report::kExitOk;
}

}  // namespace

int explain_command(const Program& program, const ExplainOptions& options) {
    if (!options.rule.empty()) {
        return explain_rule(program, options);
    }
    OrStop<cases::Case> c = load_one_case(program, options.suite, options.judged);
    if (!c) {
        return report_stop(c.error());
    }
    const cases::Target& target = c->target;
    if (options.x >= target.width || options.y >= target.height ||
        options.sample >= target.samples || options.layer >= target.layers) {
        const bool layered = target.layers > 1 || options.layer > 0;
        return report_stop(
            {report::kExitUsage,
             {"pixel " + std::to_string(options.x) + "," + std::to_string(options.y) + " sample " +
              std::to_string(options.sample) +
              (layered ? " layer " + std::to_string(options.layer) : "") +
              " is outside the target of " + std::to_string(target.width) + " x " +
              std::to_string(target.height) + " pixels with " + counted(target.samples, "sample") +
              (layered ? " and " + counted(target.layers, "layer") : "")}});
    }
    if (!options.has_pixel && c->blit) {
        return report_stop(
            {report::kExitUsage, {"'" + c->id + "' is a blit: name one of its texels by --pixel"}});
    }
    const ref::Limits limits = limits_of(options.judged);
    if (auto placed = ref::as_drawn(*c, limits)) {
        *c = std::move(*placed);
    }
    const std::string text =
        !options.has_pixel ? explain_text(*c, limits, options.profile)
                           : explain_text(*c, limits, options.profile,
                                          {options.x, options.y, options.sample, options.layer});
    say(text + (text.ends_with('\n') ? "" : "\n"));
    return report::kExitOk;
}

int doors_command() {
    const report::ConsoleStyle style = console_style(stdout, When::never, false);
    const auto say_wrapped = [&style](const std::string& text) {
        say(style.wrap ? report::wrapped(text, style.width) : text);
    };
    for (const cases::DoorRow& row : cases::all_doors()) {
        say(fmt::format("{}\n", row.word));
        say_wrapped(fmt::format("    {}\n", row.does));
        say_wrapped(fmt::format("    group: {}; rule: {}; takes {}{}\n", to_string(row.group),
                                row.rule, row.takes,
                                row.needs.empty() ? "" : fmt::format("; needs {}", row.needs)));
    }
    return report::kExitOk;
}

}  // namespace cli
