// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "diagnose": what the device of a run does wrong.
#include "cli/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "cases/base/checksum.hpp"
#include "cases/base/printable.hpp"
#include "cases/model/way.hpp"
#include "cli/commands.hpp"
#include "cli/options/run_options.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/prepare/ways.hpp"
#include "diagnosis/diagnose.hpp"
#include "report/text/diagnosis_text.hpp"

namespace cli {

namespace {

struct DiagnoseOptions {
    SuiteOptions suite;
    std::string directory;  // of a run
    bool known = false;     // expected failures, too
};

constexpr double kSecondsAtEnd = 1, kShareAtEnd = 0.1;  // the larger of both, of the run's time
constexpr double kSecondsOfCommand = 30;
constexpr size_t kSubjectsBetween = 16;

diagnosis::Bound bound_of(double seconds) {
    diagnosis::Bound bound;
    bound.most =
        static_cast<diagnosis::Work>(seconds * static_cast<double>(diagnosis::kWorkPerSecond));
    return bound;
}

std::vector<report::Diagnosis> diagnoses_of(const report::Run& run, const EachCase& each_case,
                                            const diagnosis::Bound& bound) {
    std::map<std::string_view, const cases::Case*> by_id;
    each_case([&](const cases::Case& c) { by_id.emplace(c.id, &c); });
    return diagnosis::diagnose(
        run,
        [&](const std::string& id) {
            const auto found = by_id.find(id);
            return found == by_id.end() ? nullptr : found->second;
        },
        bound);
}

EachCase each_of(const LoadedSuite& suite) {
    return [&suite](const auto& visit) { std::ranges::for_each(suite.cases, visit); };
}

// The cases that a run was about: those of its suite, or of `root` if that is not empty, and files
// of one's own.
LoadedSuite cases_of(const Program& program, const report::Run& run, const std::string& root) {
    SuiteOptions suite;
    suite.suite = root.empty() ? run.suite_root : root;
    try {
        suite.selectors = parse_run_arguments(run.arguments).suite.selectors;
        std::erase_if(suite.selectors, [](std::string& s) {
            s = cases::split_way(s).base;  // add_drawn() adds what ways drew
            return !s.ends_with(".toml");
        });
        std::ranges::sort(suite.selectors);
        suite.selectors.erase(std::ranges::unique(suite.selectors).begin(), suite.selectors.end());
    } catch (const Stop&) {
        // of another version: its own files are not known
    }
    LoadedSuite loaded = load_and_select(program, suite);
    add_drawn(loaded, run);
    return loaded;
}

}  // namespace

void diagnose(report::Run& run, const EachCase& each_case, bool goes_on) {
    // Times of years, as a clock that was set may give, shall not be counted in samples.
    const double share = std::clamp(kShareAtEnd * run.seconds, 0.0, 3600.0);
    diagnosis::Bound bound = bound_of(std::max(kSecondsAtEnd, share));
    bound.subjects = goes_on ? kSubjectsBetween : bound.subjects;
    run.diagnoses = diagnoses_of(run, each_case, bound);
}

void diagnose_again(const Program& program, report::Run& run) {
    run.diagnoses.clear();
    if (!has_failed(run)) {
        return;
    }
    try {
        const LoadedSuite loaded = cases_of(program, run, "");
        if (run.suite_hash == cases::hex(suite_hash(loaded.root))) {
            diagnose(run, each_of(loaded));
        }
    } catch (const Stop&) {
        // without the cases of the run there is nothing to say
    }
}

void keep_diagnoses(const report::Run& run, report::Journal& journal) {
    if (!run.diagnoses.empty()) {
        if (auto written = journal.write_stop(run); !written) {
            complain(written.error().message);
        }
    }
}

namespace {

int carry_out(const Program& program, const DiagnoseOptions& options) {
    report::Run run = must_read(report::load_journal(options.directory));
    const LoadedSuite loaded = cases_of(program, run, options.suite.suite);
    if (!run.suite_hash.empty() && run.suite_hash != cases::hex(suite_hash(loaded.root))) {
        complain("the suite has changed since that run; what is told of changed cases is wrong");
    }
    size_t failed = 0;
    for (report::CaseRecord& record : run.cases) {
        if (options.known && record.status == report::Status::xfail) {
            record.status = report::Status::fail;
        }
        failed += record.status == report::Status::fail ? 1U : 0U;
    }
    if (failed == 0) {
        say(fmt::format("no case failed unexpectedly{}\n",
                        options.known ? "" : "; --known diagnoses expected failures, too"));
        return report::kExitOk;
    }
    diagnosis::Bound bound = bound_of(kSecondsOfCommand);
    std::optional<Progress> progress;
    bound.progress = [&](size_t done, size_t total) {
        if (!progress) {
            progress.emplace(ProgressStyle::automatic, total, "failed cases looked at");
        }
        progress->show(done - 1, std::nullopt);
    };
    run.diagnoses = diagnoses_of(run, each_of(loaded), bound);
    if (progress) {
        progress->clear();
    }
    const std::vector<report::Diagnosis>& list = run.diagnoses;
    const report::Repeated repeated(run);
    for (const report::Diagnosis& d : list) {
        const bool is_partial = repeated.is_partial(static_cast<size_t>(&d - list.data()));
        say(fmt::format("{}{}\n  {}{}\n  in {}{}\n", is_partial ? "some cases look as if: " : "",
                        report::what_it_does(d), is_partial ? report::limits_of(d) + "; " : "",
                        report::evidence_for(d),
                        cases::printable(fmt::format("{}", fmt::join(d.examples, ", "))),
                        d.cases > d.examples.size() ? ", ..." : ""));
    }
    const auto has_picture = [](const report::CaseRecord& record) {
        return record.status == report::Status::fail && record.evidence.pictures.width > 0;
    };
    if (std::ranges::none_of(run.cases, has_picture)) {
        say("no diagnosis: the run kept no picture of a failure; draw it again without "
            "--capture none\n");
    } else if (list.empty()) {
        say("no diagnosis: no known error fails as the device did in the cases that were tried\n");
    }
    return report::kExitOk;
}

void declare(CLI::App& app, DiagnoseOptions& o) {
    app.add_option("DIR", o.directory, "the folder of a run")->required()->type_name("");
    app.add_flag("--known", o.known, "explain expected failures, too");
    add_value(&app, "--suite", o.suite.suite, "where the cases are [as in the run]", "DIR",
              "Selection");
}

}  // namespace

Command diagnose_command() {
    return make_command<DiagnoseOptions>(
        {"diagnose", kChecking, "say what the device of a run does wrong",
         "  edgecase diagnose out/mine                what does the device do wrong\n"
         "  edgecase diagnose out/mine --known        what do its expected failures come of\n"},
        declare, carry_out);
}

}  // namespace cli
