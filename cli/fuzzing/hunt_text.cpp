// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/hunt_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "cli/options/stop.hpp"

namespace cli {

namespace fs = std::filesystem;
using cases::counted;
using fuzz::Entry;

namespace {

std::string variety_of(const fuzz::HuntCounts& c, size_t starts) {
    if (starts == 0) {
        return fmt::format("{}, {} of features", counted(c.poses, "pose"),
                           counted(c.pairs, "pair"));
    }
    return counted(c.refused, "change") + " that made no case" +
           (c.missing == 0 ? "" : ", " + counted(c.missing, "number") + " without a case");
}

}  // namespace

void tell_cause(const Entry& entry, const fs::path& folder) {
    if (!entry.is_reduced) {
        say(fmt::format("FOUND {}, not reduced\n      {}\n      in {}\n", to_text(entry.symptom),
                        (folder / entry.file).string(), counted(entry.count, "case")));
        return;
    }
    std::string with;
    for (const std::string& word : to_texts(entry.essentials)) {
        with += (with.empty() ? "" : ", ") + word;
    }
    say(fmt::format("{} {}\n      {}{}\n      with {}\n",
                    entry.stale_file.empty() ? "FOUND" : "GRAVER", to_text(entry.symptom),
                    (folder / entry.file).string(),
                    entry.stale_file.empty() ? "" : " instead of " + entry.stale_file,
                    with.empty() ? "nothing special" : with));
    if (!entry.seen.empty()) {
        say("      seen: " + cases::printable(entry.seen) + "\n");
    }
    for (size_t k = 0; k < std::min<size_t>(entry.needs.size(), 6); ++k) {
        say("      " + entry.needs[k] + "\n");
    }
    for (size_t k = 0; k < std::min<size_t>(entry.undrawn.size(), 3); ++k) {
        say("      the device draws nothing " + entry.undrawn[k] + "\n");
    }
    for (size_t k = 0; k < std::min<size_t>(entry.passes.size(), 3); ++k) {
        say("      passes " + entry.passes[k] + "\n");
    }
    std::fflush(stdout);
}

void tell_counts(const fuzz::Ledger& ledger, size_t starts) {
    size_t fresh = 0, known = 0, met = 0;
    for (const Entry& entry : ledger.entries) {
        if (entry.is_reduced) {
            ++(entry.is_known ? known : fresh);
            met += entry.is_known && entry.count > 0 ? 1U : 0U;
        }
    }
    const fuzz::HuntCounts& c = ledger.counts;
    const double drawing = std::max(c.drawing_seconds, 1e-9);
    say(fmt::format(
        "{} and {} judged in {:.1f} s ({:.0f} cases/s, {:.0f} triangles/s while drawing); {} "
        "unsupported, {} with nothing to judge{}; {}\n",
        counted(c.drawn, "case"), counted(c.triangles, "triangle"), ledger.seconds,
        static_cast<double>(c.drawn) / drawing, static_cast<double>(c.triangles) / drawing,
        c.unsupported, c.empty,
        c.through_broken_doors == 0
            ? ""
            : fmt::format(", {} through doors that expectation files leave out",
                          c.through_broken_doors),
        variety_of(c, starts)));
    say(fmt::format("{} failed, by {}{}; {} took {:.1f} s and {}\n", counted(c.failed, "case"),
                    counted(fresh, "cause"),
                    known > 0 ? fmt::format(" and {} of {} known ones", met, known) : "",
                    counted(c.reductions, "reduction"), c.reducing_seconds,
                    counted(c.reduction_cases, "more case")));
}

}  // namespace cli
