// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cases/base/counted.hpp"
#include "cases/model/rule.hpp"
#include "cases/select/selector.hpp"
#include "cli/commands.hpp"
#include "cli/explain_text.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/suite.hpp"
#include "report/record/run.hpp"

namespace cli {

using cases::counted;

namespace {

struct ExplainOptions {
    SuiteOptions suite;  // exactly one selector, one case
    std::string rule;    // or a rule, and no case
    bool has_pixel = false;
    uint32_t x = 0, y = 0, sample = 0, layer = 0;
    cases::Profile profile = cases::Profile::direct3d;
    JudgedDevice judged;
};

int explain_rule(const Program& program, const ExplainOptions& options) {
    const cases::Rule* rule = cases::find_rule(options.rule);
    if (rule == nullptr) {
        throw Stop{
            report::kExitNothingSelected,
            {"there is no rule '" + options.rule + "'; " + cases::rule_hint(options.rule, '\'')}};
    }
    const LoadedSuite suite = load_and_select(program, options.suite);
    say(rule_text(*rule, suite.cases));
    return report::kExitOk;
}

int carry_out(const Program& program, const ExplainOptions& options) {
    if (!options.rule.empty()) {
        return explain_rule(program, options);
    }
    cases::Case c = load_one_case(program, options.suite, options.judged);
    const cases::Target& target = c.target;
    if (options.x >= target.width || options.y >= target.height ||
        options.sample >= target.samples || options.layer >= target.layers) {
        const bool layered = target.layers > 1 || options.layer > 0;
        throw Stop{
            report::kExitUsage,
            {"pixel " + std::to_string(options.x) + "," + std::to_string(options.y) + " sample " +
             std::to_string(options.sample) +
             (layered ? " layer " + std::to_string(options.layer) : "") +
             " is outside the target of " + std::to_string(target.width) + " x " +
             std::to_string(target.height) + " pixels with " + counted(target.samples, "sample") +
             (layered ? " and " + counted(target.layers, "layer") : "")}};
    }
    if (!options.has_pixel && c.blit) {
        throw Stop{report::kExitUsage,
                   {"'" + c.id + "' is a blit: name one of its texels by --pixel"}};
    }
    const ref::Limits limits = limits_of(options.judged);
    if (auto placed = ref::as_drawn(c, limits)) {
        c = std::move(*placed);
    }
    const std::string text =
        !options.has_pixel ? explain_text(c, limits, options.profile)
                           : explain_text(c, limits, options.profile,
                                          {options.x, options.y, options.sample, options.layer});
    say(text + (text.ends_with('\n') ? "" : "\n"));
    return report::kExitOk;
}

void declare(CLI::App& app, ExplainOptions& o) {
    add_case(&app, o.suite);
    app.add_option(
           "--pixel",
           [&o](const CLI::results_t& results) {
               o.has_pixel = true;
               return parse_pair(results.back(), ',', o.x, o.y);
           },
           "the pixel; without it the case as a whole is told")
        ->type_name("X,Y");
    app.add_option("--rule", o.rule, "explain a rule instead")->type_name("ID");
    app.add_option("--sample", o.sample, "the sample in it [0]")->type_name("S");
    app.add_option("--layer", o.layer, "the layer of the target [0]")->type_name("L");
    add_profile(&app, o.profile);
    add_judged_device(&app, o.judged);
}

void check(const CLI::App&, const ExplainOptions& o, const Words&) {
    if (o.rule.empty() && !o.has_pixel && (o.sample > 0 || o.layer > 0)) {
        throw usage_error("--sample and --layer name a sample of a pixel; add --pixel", "explain");
    }
    if (!o.rule.empty() && (o.has_pixel || !o.suite.selectors.empty())) {
        throw usage_error("--rule explains a rule, not a case; leave out the selector and --pixel",
                          "explain");
    }
}

}  // namespace

Command explain_command() {
    return make_command<ExplainOptions>(
        {"explain", kCases, "why a sample must, must not or may be covered",
         "  edgecase explain 'ties/diagonal-edge:rotation=0' --pixel 3,3\n"
         "  edgecase explain --rule tie.top-left      what a rule demands\n"},
        declare, carry_out, check);
}

}  // namespace cli
