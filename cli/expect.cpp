// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "expect": shows and checks an expectation file or one of pictures, or brings it up to
// date with a run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <set>

#include "cases/base/counted.hpp"
#include "cases/base/input_file.hpp"
#include "cases/base/printable.hpp"
#include "cases/model/device.hpp"
#include "cases/model/way.hpp"
#include "cli/commands.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/prepare/ways.hpp"
#include "report/journal/journal.hpp"
#include "run/expected/date.hpp"
#include "run/expected/expectation_update.hpp"
#include "run/expected/seen_pictures.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

struct ExpectOptions {
    SuiteOptions suite;
    std::string file;
    std::string update;  // the folder of a run
    std::string bug, reason, until;
    bool bits = false, dry_run = false;
};

// What lines can speak of: the cases, and the device's limits.
std::vector<std::string> known_ids(const LoadedSuite& suite) {
    std::vector<std::string> ids = suite.ids();
    ids.emplace_back(cases::kLimitsCase);
    return ids;
}

// Form, statuses and dates of a file, and that its lines fit the suite and each other.
int show(const Program& program, const ExpectOptions& options) {
    const std::string& name = options.file;
    const auto file = must(run::load_expectations(name));
    const LoadedSuite suite = load_and_select(program, options.suite, cases::Contents::ids);
    must(run::resolve_expectations({file}, known_ids(suite), true));
    std::array<size_t, report::kStatuses> count{};
    for (const run::ExpectationLine& line : file.lines) {
        ++count.at(static_cast<size_t>(line.status));
    }
    say(fmt::format("{}: {} expectation{}", name, file.lines.size(),
                    file.lines.size() == 1 ? "" : "s"));
    for (size_t k = 0; k < count.size(); ++k) {
        if (count.at(k) > 0) {
            const auto status = report::to_string(static_cast<report::Status>(k));
            std::printf(", %zu %.*s", count.at(k), static_cast<int>(status.size()), status.data());
        }
    }
    std::string driver = file.driver_regex.empty() ? "" : ", " + file.driver_regex;
    for (const run::VersionBound& bound : file.versions) {
        driver += " " + bound.text;
    }
    say(fmt::format("; for {}{}\n", file.device_glob, driver));
    const cases::Errors past = run::past_lines(file);
    for (const cases::Error& error : past) {
        std::fprintf(stderr, "%s\n", cases::printable(cases::to_string(error)).c_str());
    }
    return past.empty() ? report::kExitOk : report::kExitUnexpected;
}

run::UpdateWords check_words(const ExpectOptions& options) {
    if (options.bug.find_first_of(" \t\n") != std::string::npos || options.bug == "-" ||
        options.bug.starts_with('#')) {
        throw stop_with(report::kExitUsage,
                        "--bug: '" + options.bug +
                            "' is no reference; give one word that does not begin with "
                            "'#', like mesa#1234 or a link");
    }
    if (options.reason.find('\n') != std::string::npos) {
        throw stop_with(report::kExitUsage, "--reason must be one line");
    }
    if (!options.until.empty() &&
        (!run::is_date(options.until) || options.until < run::today_utc())) {
        throw stop_with(report::kExitUsage,
                        "--until: '" + options.until + "' is no day to come; write YYYY-MM-DD");
    }
    return run::UpdateWords{options.bug, options.reason, options.until, options.bits};
}

std::string sentence(const std::vector<std::string>& ids) {
    std::string text;
    for (size_t k = 0; k < std::min<size_t>(ids.size(), 3); ++k) {
        text += (k == 0 ? "'" : ", '") + ids[k] + "'";
    }
    return text + (ids.size() > 3 ? " and " + std::to_string(ids.size() - 3) + " more" : "");
}

// Whether a run takes the file by itself, with the suite.
bool is_beside(const fs::path& file, const fs::path& suite) {
    std::error_code none;
    return fs::weakly_canonical(fs::absolute(file).parent_path(), none) ==
           fs::weakly_canonical(
               fs::absolute(suite).lexically_normal().parent_path() / "expectations", none);
}

// Of the cases of one's own that the run drew, a file beside the suite does not speak: they are
// left out of the run. To any other file they are cases like the suite's: they join its ids.
std::string settle_own_cases(report::Run& run, std::vector<std::string>& ids, bool beside) {
    const std::set<std::string> known(ids.begin(), ids.end());
    const auto is_own = [&](const report::CaseRecord& r) { return !known.contains(r.id); };
    if (beside) {
        const size_t own = std::erase_if(run.cases, is_own);
        return own == 0 ? ""
                        : cases::counted(own, "case") +
                              " of the run left out: a file beside the suite speaks of its cases "
                              "alone; bring another FILE up to date, and name it with --expect";
    }
    for (const report::CaseRecord& record : run.cases) {
        if (is_own(record)) {
            ids.push_back(record.id);
        }
    }
    return "";
}

run::Update make_update(const Program& program, const ExpectOptions& options,
                        const run::UpdateWords& words, std::string& before) {
    report::Run run = must_read(report::load_journal(options.update), "--update: ");
    std::error_code none;
    std::string text = run::new_expectation_file(run);
    if (fs::exists(options.file, none)) {
        const std::string all = must(cases::read_file(options.file), report::kExitInvalidFile,
                                     "'" + options.file + "' cannot be read: ");
        before = text = all;
    }
    const auto file = must(run::parse_expectations(text, options.file, run::today_utc(), true));
    if (const std::string why = mismatch(file, run.device, run.profile); !why.empty()) {
        throw stop_with(report::kExitDevice,
                        "the expectation file '" + options.file + "' does not fit the run: " + why);
    }
    if (const auto brief = std::ranges::count_if(
            run.cases, [](const report::CaseRecord& record) { return record.drawn.is_brief; });
        brief > 0) {
        throw stop_with(
            report::kExitInvalidFile,
            fmt::format("the run knows of {} no more than their symptoms, and a line says how "
                        "often a case breaks each rule; run again with --tell all",
                        cases::counted(static_cast<uint64_t>(brief), "failure")));
    }
    SuiteOptions suite = options.suite;
    if (suite.suite.empty()) {
        suite.suite = run.suite_root;
    }
    LoadedSuite loaded = load_and_select(program, suite);
    add_drawn(loaded, run);
    std::vector<std::string> ids = known_ids(loaded);
    const std::string left_out = settle_own_cases(run, ids, is_beside(options.file, loaded.root));
    run::Update update = run::update_expectations(text, file, run, ids, words);
    if (!left_out.empty()) {
        update.notes.push_back(left_out);
    }
    return update;
}

using Ids = std::set<std::string>;

Ids ids_of_suite(const Program& program, const SuiteOptions& options) {
    const LoadedSuite suite = load_and_select(program, options, cases::Contents::ids);
    const std::vector<std::string> ids = suite.ids();
    return Ids(ids.begin(), ids.end());
}

size_t count_pictures(const run::SeenPictures& seen) {
    size_t count = 0;
    for (const auto& [id, bits] : seen.bits) {
        count += bits.size();
    }
    return count;
}

// Checks a file of pictures.
void show_pictures(const Program& program, const ExpectOptions& options) {
    const auto file = must(run::load_pictures(options.file));
    const Ids ids = ids_of_suite(program, options.suite);
    for (const auto& [id, bits] : file.bits) {
        if (!ids.contains(std::string(cases::split_way(id).base))) {
            throw stop_with(report::kExitInvalidFile,
                            options.file + ": error: '" + id + "' is no case; remove its line");
        }
    }
    say(fmt::format("{}: {} of {}; for {}\n", options.file,
                    cases::counted(count_pictures(file), "picture"),
                    cases::counted(file.bits.size(), "case"), file.device_glob));
}

// Adds the pictures of a run's failures to a file of pictures, or makes one.
void update_pictures(const Program& program, const ExpectOptions& options) {
    if (options.bits || !options.bug.empty() || !options.reason.empty() || !options.until.empty()) {
        throw stop_with(
            report::kExitUsage,
            "a file of pictures says how failures look and not why; leave out --bits, --bug, "
            "--reason and --until, or name an expectation file (*.txt)");
    }
    const report::Run run = must_read(report::load_journal(options.update), "--update: ");
    std::error_code none;
    run::SeenPictures file =
        must(fs::exists(options.file, none) ? run::load_pictures(options.file)
                                            : run::new_pictures(run, options.file));
    if (!run::fits(file, run.device)) {
        throw stop_with(report::kExitDevice, "the file of pictures '" + options.file +
                                                 "' does not fit the run: it is for the device '" +
                                                 file.device_glob + "', that was on '" +
                                                 run.device.name + "'");
    }
    SuiteOptions suite = options.suite;
    if (suite.suite.empty()) {
        suite.suite = run.suite_root;
    }
    const Ids ids = ids_of_suite(program, suite);
    const std::string before = to_text(file);
    const size_t kept = count_pictures(file);
    run::add_pictures(file, run);
    const size_t added = count_pictures(file) - kept;
    std::erase_if(file.bits, [&](const auto& entry) {
        return !ids.contains(std::string(cases::split_way(entry.first).base));
    });
    const size_t removed = kept + added - count_pictures(file);
    const std::string text = to_text(file);
    const bool same = text == before && fs::exists(options.file, none);
    std::printf("%s: %zu removed, %zu added, %zu kept%s\n", options.file.c_str(), removed, added,
                kept - std::min(kept, removed),
                same              ? "; nothing to write"
                : options.dry_run ? "; not written (--dry-run)"
                                  : "");
    if (!same && !options.dry_run) {
        must(write_text(options.file, text), report::kExitInternal);
    }
}

int carry_out(const Program& program, const ExpectOptions& options) {
    if (fs::path(options.file).extension() == run::kPicturesEnd) {
        (options.update.empty() ? show_pictures : update_pictures)(program, options);
        return report::kExitOk;
    }
    if (options.update.empty()) {
        return show(program, options);
    }
    const run::UpdateWords words = check_words(options);
    std::string before;
    const run::Update update = make_update(program, options, words, before);
    if (!update.without_bug.empty()) {
        throw stop_with(report::kExitUsage,
                        std::to_string(update.without_bug.size()) +
                            " unexpected results need a line (" + sentence(update.without_bug) +
                            "); give --bug REFERENCE, so that each says where it is followed up");
    }
    for (const std::string& change : update.changes) {
        std::printf("%s\n", cases::printable(change).c_str());
    }
    for (const std::string& note : update.notes) {
        std::printf("note: %s\n", cases::printable(note).c_str());
    }
    const bool same = update.text == before;
    std::printf("%s: %zu removed, %zu changed, %zu added, %zu kept%s\n", options.file.c_str(),
                update.removed, update.changed, update.added, update.kept,
                same              ? "; nothing to write"
                : options.dry_run ? "; not written (--dry-run)"
                                  : "");
    if (same || options.dry_run) {
        return report::kExitOk;
    }
    must(write_text(options.file, update.text), report::kExitInternal);
    return report::kExitOk;
}

void declare(CLI::App& app, ExpectOptions& o) {
    app.add_option("FILE", o.file, "the expectation file")->required()->type_name("");
    app.add_option("--update", o.update, "write what a run has seen into the file")
        ->type_name("DIR");
    app.add_option("--bug", o.bug, "reference to a bug, for new lines")->type_name("WORD");
    app.add_option("--reason", o.reason, "reason of new lines [what the run says]")
        ->type_name("TEXT");
    app.add_option("--until", o.until,
                   "last day of new lines and of lines that ended and are still true")
        ->type_name("DATE");
    app.add_flag("--bits", o.bits, "a line a case that excuses this picture only, bit for bit");
    app.add_flag("--dry-run", o.dry_run, "show what would change, write nothing");
    app.add_option("--suite", o.suite.suite, "the folder of the suite [that of the run]")
        ->type_name("DIR");
}

void check(const CLI::App& expect, const ExpectOptions& o, const Words& words) {
    for (const char* name : {"--bits", "--bug", "--reason", "--until", "--dry-run"}) {
        if (o.update.empty() && is_given(expect, name, words)) {
            throw usage_error(
                std::string(name) + " says how a file is brought up to date; give --update too",
                "expect");
        }
    }
}

}  // namespace

Command expect_command() {
    return make_command<ExpectOptions>(
        {"expect", kChecking, "check an expectation file, or bring it up to date",
         "  edgecase expect cases/expectations/llvmpipe.txt\n"
         "  edgecase expect --update out/mine my-driver.txt --bug mesa#1234\n"},
        declare, carry_out, check);
}

}  // namespace cli
