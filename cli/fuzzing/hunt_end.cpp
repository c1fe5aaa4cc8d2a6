// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/hunt_end.hpp"

#include <fmt/format.h>

#include <set>
#include <string>

#include "cases/base/counted.hpp"
#include "cases/base/limits.hpp"
#include "cli/fuzzing/hunt_text.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/outputs.hpp"

namespace cli {

namespace fs = std::filesystem;
using cases::counted;
using fuzz::Hunt;

int end_hunt(Hunt& hunter, Hunt::State state, const fuzz::Ledger& ledger, const fs::path& folder,
             size_t starts) {
    size_t fresh = 0;
    for (const fuzz::Entry& entry : ledger.entries) {
        if (!entry.is_reduced) {
            tell_cause(entry, folder);
        }
        fresh += entry.is_reduced && !entry.is_known ? 1U : 0U;
    }
    tell_counts(ledger, starts);
    const fuzz::HuntCounts& c = ledger.counts;
    if (!ledger.waiting.empty()) {
        say(
            fmt::format("not reduced, and explained by no cause: {}; go on with 'edgecase fuzz "
                        "--resume {}'\n",
                        counted(ledger.waiting.size(), "failing case"), folder.string()));
    }
    if (!ledger.left.empty()) {
        say(fmt::format("not judged, as the hunt ended before: {}, which --resume draws first\n",
                        counted(ledger.left.size(), "case")));
    }
    size_t number = 0;
    for (const std::string& text : hunter.unrepeated()) {
        const fs::path file = folder / fmt::format("unrepeated-{}.toml", ++number);
        must(replace_text(file, text), report::kExitInternal);
    }
    if (c.unrepeated > 0) {
        say(fmt::format("did not come again when drawn alone: {}; see {}\n",
                        counted(c.unrepeated, "failing case"),
                        (folder / "unrepeated-1.toml").string()));
    }
    std::set<std::string> told;
    for (const auto& [text, reason] : hunter.unjudged()) {
        if (!told.insert(reason).second) {
            continue;
        }
        const fs::path file = folder / fmt::format("unjudged-{}.toml", told.size());
        const auto written = replace_text(file, text);
        const bool is_limited = !cases::tight_limits().empty();
        complain(
            "a case could not be judged: " + reason +
            (written ? "; it is kept as " + file.string() + (is_limited ? "" : ", please report it")
                     : ""));
    }
    if (fresh > 0 || !ledger.waiting.empty()) {
        say(fmt::format("look at them: edgecase run {} --no-expect\n",
                        (folder / "found").string()));
    }
    if (state == Hunt::State::interrupted) {
        say("interrupted; go on with 'edgecase fuzz --resume " + folder.string() + "'\n");
        std::fflush(stdout);  // while threads end that make cases
        return report::kExitInterrupted;
    }
    if (state == Hunt::State::failed) {
        throw stop_with(report::kExitInternal, hunter.failure());
    }
    if (c.unjudged > 0) {
        return report::kExitInternal;
    }
    if (c.drawn == 0) {
        complain(fmt::format("no case was judged, so nothing was proven: {}",
                             c.unsupported > 0
                                 ? fmt::format("{} supports none of the {} that were made",
                                               ledger.device, counted(c.unsupported, "case"))
                                 : "none was drawn"));
        return report::kExitAllSkipped;
    }
    // Nothing new may be said only of a hunt whose failures are all explained.
    const bool is_explained = ledger.waiting.empty() && c.unrepeated == 0;
    return fresh > 0 || !is_explained ? report::kExitUnexpected : report::kExitOk;
}

}  // namespace cli
