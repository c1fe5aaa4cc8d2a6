// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cases/base/counted.hpp"
#include "cases/model/rule.hpp"
#include "cases/select/selector.hpp"
#include "cli/commands.hpp"
#include "cli/explain_text.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/suite.hpp"
#include "report/record/run.hpp"

namespace cli {

using cases::counted;

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
    say(rule_text(*rule, suite->cases));
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

}  // namespace cli
