// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "gtest": cases as the tests of a GoogleTest program, so that deqp-runner, which
// Mesa's continuous integration uses, can list, draw and judge them without a patch.
// docs/ci/README.md tells what of that program's habits the names and the order of the lines follow
// from.
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "report/record/levels.hpp"
#include "report/text/sentences.hpp"

namespace cli {

namespace {

namespace fs = std::filesystem;

// Cases as a GoogleTest program: what deqp-runner and others start.
struct GtestOptions {
    RunOptions run;
    bool list = false;
    std::string filter = "*";
};
using report::CaseRecord;
using report::Status;

constexpr const char* kGroup = "edgecase.";

// "a/b:x=0.5,y=1" -> "edgecase.a/b@x=0~5&y=1". A filter separates names by ':', a baseline ends
// them at ',', and in a list of tests what ends with '.' is a group; no id has the signs that stand
// for these.
std::string test_of(const std::string& id) {
    std::string name = id;
    std::ranges::replace(name, ':', '@');
    std::ranges::replace(name, ',', '&');
    std::ranges::replace(name, '.', '~');
    return name;
}
std::string name_of(const std::string& id) {
    return kGroup + test_of(id);
}

// --gtest_filter: names and globs separated by ':'; a pattern that begins with '-' and those after
// it exclude. As in GoogleTest such a pattern may follow another one without the ':', if it names
// the group: there are '-' in ids, but none that "edgecase." follows.
class Filter {
  public:
    explicit Filter(const std::string& given) {
        bool excludes = false;
        std::string text = given;
        const std::string joined = std::string("-") + kGroup;
        for (size_t at = text.find(joined, 1); at != text.npos; at = text.find(joined, at + 2)) {
            if (text[at - 1] != ':') {
                text.insert(at, ":");
            }
        }
        for (size_t begin = 0; begin <= text.size();) {
            const size_t end = std::min(text.find(':', begin), text.size());
            std::string pattern = text.substr(begin, end - begin);
            if (pattern.starts_with('-')) {
                excludes = true;
                pattern.erase(0, 1);
            }
            (excludes ? without_ : with_).add(pattern);
            begin = end + 1;
        }
        if (text.starts_with('-')) {
            with_.add("*");
        }
    }
    // The names, not globs, that none of the ids has.
    std::vector<std::string> unknown(const std::set<std::string>& ids) const {
        std::set<std::string> left = with_.names;
        for (const std::string& id : ids) {
            left.erase(name_of(id));
        }
        return {left.begin(), left.end()};
    }
    bool takes(const std::string& id) const {
        const std::string name = name_of(id);
        return with_.has(name) && !without_.has(name);
    }

  private:
    struct Patterns {
        std::set<std::string> names;
        std::vector<std::string> globs;
        void add(const std::string& pattern) {
            if (pattern.find_first_of("*?") == std::string::npos) {
                names.insert(pattern);
            } else {
                globs.push_back(pattern);
            }
        }
        bool has(const std::string& name) const {
            return names.contains(name) || std::ranges::any_of(globs, [&](const std::string& glob) {
                       return ::fnmatch(glob.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
                   });
        }
    };
    Patterns with_, without_;
};

int list_tests(const Program& program, const GtestOptions& options, const Filter& filter) {
    const LoadedSuite suite = load_and_select(program, options.run.suite);
    say(std::string(kGroup) + "\n");
    for (const size_t k : suite.selected) {
        if (filter.takes(suite.cases[k].id)) {
            say("  " + test_of(suite.cases[k].id) + "\n");
        }
    }
    return report::kExitOk;
}

// Writes the lines of a GoogleTest program, in the order of the selection. A test's "RUN" comes as
// soon as the one before it has ended: a runner's time limit then blames the right one.
class Teller {
  public:
    explicit Teller(cases::Profile fail_level) : fail_level_(fail_level) {}
    void begin(const std::vector<std::string>& ids) {
        ids_ = ids;
        say(fmt::format("[==========] Running {} tests from 1 test suite.\n", ids_.size()));
        say_next();
    }
    // False: the case killed its worker, so that this program ends as if the driver were part of
    // it: with a test that began and never ended, which runners call a crash. They draw the rest.
    bool end(const CaseRecord& record) {
        waiting_.emplace(record.id, record);
        while (!is_dead_ && next_ < ids_.size()) {
            const auto found = waiting_.find(ids_[next_]);
            if (found == waiting_.end()) {
                break;
            }
            tell(found->second);
            waiting_.erase(found);
        }
        return !is_dead_;
    }

  private:
    void say_next() const {
        if (next_ < ids_.size()) {
            say("[ RUN      ] " + name_of(ids_[next_]) + "\n");
        }
        std::fflush(stdout);
    }
    void tell(const CaseRecord& record) {
        const std::string why =
            "    " + report::what_happened(record) + "\n    " + report::why_it_happened(record) +
            "\n    rerun: " + record.rerun + "\n" +
            (record.commands.explain.empty() ? ""
                                             : "    explain: " + record.commands.explain + "\n");
        if (record.status == Status::crash || record.status == Status::timeout ||
            record.status == Status::device_lost) {
            is_dead_ = true;  // a line on standard output might be read as the test's end
            std::fputs((name_of(record.id) + ":\n" + why).c_str(), stderr);
            return;
        }
        const bool is_fine = !report::makes_fail(record, fail_level_);
        const bool is_skipped =
            record.status == Status::unsupported || record.status == Status::skip;
        say(fmt::format("{} {} ({:.0f} ms)\n",
                        !is_fine     ? "[  FAILED  ]"
                        : is_skipped ? "[  SKIPPED ]"
                                     : "[       OK ]",
                        name_of(record.id), record.drawn.seconds * 1000));
        if (!report::is_expected(record.status)) {
            say(why);
        }
        ++next_;
        say_next();
    }

    cases::Profile fail_level_;
    std::vector<std::string> ids_;
    std::map<std::string, CaseRecord> waiting_;
    size_t next_ = 0;
    bool is_dead_ = false;
};

int carry_out(const Program& program, const GtestOptions& options) {
    const Filter filter(options.filter);
    if (options.list) {
        return list_tests(program, options, filter);
    }
    RunOptions run = options.run;
    run.no_expect = run.expect.empty();
    run.jobs = 1;          // a runner starts as many of these processes as it wants
    run.retries = 0;       // it also draws again what fails
    run.fail_fast = true;  // a death is settled before others make the runner wait
    run.quiet = true;
    run.progress = ProgressStyle::none;
    run.ci = Ci::none;
    const bool keeps = !run.output.empty();
    std::error_code error;
    const fs::path parent = keeps ? fs::path(run.output) : fs::temp_directory_path(error);
    fs::create_directories(parent, error);
    std::string folder = (parent / "edgecase-gtest-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) {
        throw stop_with(report::kExitUsage, "no folder can be made in '" + parent.string() +
                                                "'; choose another with -o or TMPDIR");
    }
    run.output = folder;
    run.capture = keeps ? run.capture : run::KeepPictures::none;
    Teller teller(run.fail_at.value_or(run.profile));
    std::set<std::string> selected;
    const auto begin = [&](const std::vector<std::string>& ids) {
        for (const std::string& name : filter.unknown(selected)) {
            complain("warning: --gtest_filter: no selected case is the test '" + name + "'");
        }
        teller.begin(ids);
    };
    const int code =
        run_with(program, run,
                 {[&](const std::string& id) {
                      selected.insert(id);
                      return filter.takes(id);
                  },
                  begin, [&](const CaseRecord& record) { return teller.end(record); }});
    if (!keeps) {
        fs::remove_all(folder, error);
    }
    // To a runner of tests, one that cannot be drawn here is no failure.
    return code == report::kExitAllSkipped ? int{report::kExitOk} : code;
}

void declare(CLI::App& app, GtestOptions& o) {
    add_suite(&app, o.run.suite);
    app.add_flag("--gtest_list_tests", o.list, "list the tests, draw nothing")->group("Selection");
    add_value(&app, "--gtest_filter", o.filter,
              "tests to draw, separated by ':', '*' and '?' as in GoogleTest [*]", "NAMES",
              "Selection");
    // A hang costs it twice, with others and alone: less than the 60 s after which deqp-runner
    // would end this process, and blame another case.
    o.run.device.timeout = 20;
    add_device(&app, o.run.device);
    add_validation(&app, o.run.device);
    add_profile(&app, o.run.profile);
    add_fail_at(&app, o.run.fail_at);
    add_expect(&app, o.run, "an expectation file: what ends as it says is OK [none]");
    add_value(&app, "-o,--output", o.run.output,
              "keep the reports, in a new folder below DIR for each process [not kept]", "DIR",
              "Output");
}

void check(const CLI::App& app, const GtestOptions& o, const Words&) {
    check_fail_at(app, o.run);
}

}  // namespace

Command gtest_command() {
    return make_command<GtestOptions>(
        {"gtest", kChecking, "draw cases as a GoogleTest program does, for deqp-runner",
         "  edgecase gtest --gtest_list_tests\n"
         "  edgecase gtest --gtest_filter='edgecase.ties/apex-up'\n"},
        declare, carry_out, check);
}

}  // namespace cli
