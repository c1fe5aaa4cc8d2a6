// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// "edgecase lint": what is wrong with case files, and what they test.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cases/base/counted.hpp"
#include "cases/base/limits.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/way.hpp"
#include "cases/select/selector.hpp"
#include "cli/commands.hpp"
#include "cli/fuzzing/start_cases.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/claims.hpp"
#include "cli/prepare/on_threads.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/strength.hpp"
#include "diff/color.hpp"
#include "diff/verdict.hpp"
#include "ref/exercise/exercise.hpp"
#include "ref/expectation/expectation.hpp"
#include "report/record/run.hpp"
#include "run/expected/expectation_file.hpp"
#include "run/expected/seen_pictures.hpp"

namespace cli {

using cases::counted;

namespace {

struct LintOptions {
    SuiteOptions suite;
    bool strength = false;
    bool quiet = false, verbose = false;
};

// So many cases are told one by one without being asked.
constexpr size_t kFew = 16;

// So many selected cases are looked at for claims that others of their files have samples for.
constexpr size_t kMostLookedAt = 1024;

// What was found of one case.
struct Checked {
    cases::Errors errors;
    ref::Exercise exercise;
    ref::Exercise with_fewest;  // subpixel bits: of the claims that no sample exercises
};

std::vector<std::string> without_samples(const ref::Exercise& exercise) {
    std::vector<std::string> rules;
    for (const ref::RuleShare& share : exercise.rules) {
        if (share.samples == 0) {
            rules.emplace_back(share.rule);
        }
    }
    return rules;
}

// How much is looked for: whether a file's claims have a sample in some case, whether each case's
// have, or how many.
enum class Depth : uint8_t { file, cases, samples };

Checked exercised(const cases::Case& c, ClaimedFile& file, Depth depth) {
    Checked out;
    const ref::Count count = depth == Depth::samples ? ref::Count::all : ref::Count::some;
    const std::vector<std::string> rules = depth == Depth::file ? file.open_rules() : c.claim.rules;
    out.exercise = ref::exercise(c, ref::Limits{}, rules, count);
    file.note(out.exercise);
    const std::vector<std::string> open =
        depth == Depth::file ? std::vector<std::string>{} : without_samples(out.exercise);
    if (!open.empty()) {
        out.with_fewest = ref::exercise(c, ref::Limits{kFewestSubpixelBits}, open, count);
        file.note(out.with_fewest);
    }
    return out;
}

// Whether each fragment that must be drawn fails a depth test: without the tests some sample must
// be covered.
bool fails_every_depth_test(cases::Case c, cases::Profile profile) {
    for (cases::Draw& draw : c.draws) {
        draw.depth.compare = cases::CompareOp::always;
        draw.depth.bounds.reset();
    }
    return ref::expect(c, ref::Limits{}, profile).must_samples > 0;
}

// What is wrong with one case beyond its file's form: its picture, its rules, its control samples.
cases::Errors check_case(const cases::Case& c, const ref::Exercise& exercise) {
    cases::Errors errors;
    if (const auto wrong = diff::check_expected_hits(c)) {
        errors.push_back({wrong->where, c.id + ": " + wrong->message});
    }
    for (const std::string& rule : c.claim.rules) {
        if (cases::find_rule(rule) == nullptr) {
            errors.push_back({c.claim.where, c.id + ": there is no rule '" + rule + "'"});
        }
    }
    if (c.blit) {
        return errors;  // the loader refuses empty regions
    }
    for (const cases::Profile profile : cases::kProfiles) {
        if (exercise.must_samples.at(static_cast<size_t>(profile)) == 0 &&
            fails_every_depth_test(c, profile)) {
            const bool has_bounds = cases::tests_bounds(c);
            errors.push_back(
                {c.claim.where,
                 fmt::format(
                     "{}: at profile {} every fragment fails the depth test{}, so a device "
                     "that draws nothing would pass; depth is cleared to {}: choose another "
                     "depth_clear{} or compare",
                     c.id, cases::to_string(profile), has_bounds ? " or that of its bounds" : "",
                     c.target.depth_clear, has_bounds ? ", bounds" : "")});
            return errors;
        }
        if (exercise.must_samples.at(static_cast<size_t>(profile)) == 0) {
            errors.push_back(
                {c.claim.where,
                 c.id + ": at profile " + std::string(cases::to_string(profile)) +
                     " no sample must be covered, so a device that draws nothing "
                     "would pass; add a triangle that must be seen" +
                     (c.claim.notes.empty() ? "" : " (" + c.claim.notes.front() + ")")});
            return errors;
        }
        if (!c.target.has_instruments && !diff::fails_if_empty(c, profile)) {
            errors.push_back({c.claim.where,
                              c.id + ": at profile " + std::string(cases::to_string(profile)) +
                                  " every sample may hold what it was cleared to, so a device that "
                                  "draws nothing would pass; choose another colour, depth or clear "
                                  "value"});
            return errors;
        }
    }
    return errors;
}

// A file of pictures: its form, and that every line is about a case, or a way of one.
cases::Errors check_pictures(const std::filesystem::path& path,
                             const std::vector<std::string>& ids) {
    const auto file = run::load_pictures(path);
    if (!file) {
        return file.error();
    }
    cases::Errors errors;
    const std::set<std::string> known(ids.begin(), ids.end());
    for (const auto& [id, bits] : file->bits) {
        if (!known.contains(std::string(cases::split_way(id).base))) {
            errors.push_back(
                {{path.string(), 0, 0},
                 "'" + id + "' is no case" + cases::did_you_mean(id, ids, "; remove its line")});
        }
    }
    return errors;
}

// Expectation files beside the suite: their form, and that every line matches a case.
cases::Errors check_expectation_files(const LoadedSuite& suite, size_t& count) {
    cases::Errors errors;
    const std::vector<std::string> ids = suite.ids();
    std::error_code none;
    const auto folder =
        std::filesystem::absolute(suite.root).lexically_normal().parent_path() / "expectations";
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        if (entry.path().extension() == run::kPicturesEnd) {
            const cases::Errors wrong = check_pictures(entry.path(), ids);
            errors.insert(errors.end(), wrong.begin(), wrong.end());
        }
        if (entry.path().extension() != ".txt") {
            continue;
        }
        ++count;
        const auto file = run::load_expectations(entry.path());
        if (!file) {
            errors.insert(errors.end(), file.error().begin(), file.error().end());
            continue;
        }
        if (const auto resolved = run::resolve_expectations({*file}, ids, true); !resolved) {
            errors.insert(errors.end(), resolved.error().begin(), resolved.error().end());
        }
        const cases::Errors past = run::past_lines(*file);
        errors.insert(errors.end(), past.begin(), past.end());
    }
    return errors;
}

void tell_no_strength(const std::string& what) {
    complain(what + ": its strength cannot be told before its errors are mended");
}

// The selected cases of files without an error; the other files are told.
std::vector<size_t> without_errors(const LoadedSuite& suite, const cases::Errors& errors) {
    std::set<std::string> wrong;
    for (const cases::Error& error : errors) {
        wrong.insert(error.where.file);
    }
    std::set<std::string> left_out;
    std::vector<size_t> selected;
    for (const size_t k : suite.selected) {
        const std::string& file = suite.cases[k].claim.where.file;
        if (!wrong.contains(file)) {
            selected.push_back(k);
        } else if (left_out.insert(file).second) {
            tell_no_strength(file);
        }
    }
    return selected;
}

int carry_out(const Program& program, const LintOptions& options);

// What can be said of the files that can be read where others cannot.
void lint_readable(const Program& program, const LintOptions& options) {
    LintOptions readable = options;
    std::erase_if(readable.suite.selectors, [&](const std::string& selector) {
        SuiteOptions alone = options.suite;
        alone.selectors = {selector};
        try {
            load_and_select(program, alone);
            return false;
        } catch (const Stop&) {
            tell_no_strength(selector);
            return true;
        }
    });
    if (!readable.suite.selectors.empty() &&
        readable.suite.selectors.size() < options.suite.selectors.size()) {
        carry_out(program, readable);
    }
}

std::string at_least(const ref::RuleShare& share) {
    return fmt::format("{}{}", share.is_least ? "at least " : "", share.samples);
}

// The claim's share with the fewest subpixel bits, where only with these some sample exercises it.
const ref::RuleShare* share_with_fewest(std::string_view rule, const Checked& checked) {
    const auto at = std::ranges::find_if(checked.with_fewest.rules, [&](const ref::RuleShare& s) {
        return s.rule == rule && s.samples > 0;
    });
    return at == checked.with_fewest.rules.end() ? nullptr : &*at;
}

// What is to be said beside "0 samples": the case may yet do what it claims.
std::string why_none(std::string_view rule, const Checked& checked, const ClaimedFile& file) {
    if (const ref::RuleShare* const share = share_with_fewest(rule, checked)) {
        return fmt::format("; {} with {} subpixel bits", at_least(*share), kFewestSubpixelBits);
    }
    if (file.has(rule)) {
        return "; other cases of its file have some";
    }
    return file.is_whole ? "" : "; the rest of its file was not looked at";
}

void tell(const cases::Case& c, const Checked& checked, const ClaimedFile& file) {
    const ref::Exercise& exercise = checked.exercise;
    const char* const unit = c.blit ? "texels" : "samples";
    std::string text = c.id + "\n";
    for (const ref::RuleShare& share : exercise.rules) {
        text +=
            fmt::format("    {}: {} of {} {}{}\n", share.rule, at_least(share), exercise.samples,
                        unit, share.samples == 0 ? why_none(share.rule, checked, file) : "");
    }
    if (exercise.free_samples > 0) {
        text +=
            fmt::format("    free: {} of {} samples\n", exercise.free_samples, exercise.samples);
    }
    say(text);
}

// Of files whose cases are not told one by one: the claims for which only some cases have samples.
void tell_in_short(const LoadedSuite& suite, const std::map<std::string, ClaimedFile>& files,
                   const std::vector<Checked>& checked) {
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> cases;
    for (size_t k = 0; k < checked.size(); ++k) {
        const cases::Case& c = suite.cases[suite.selected[k]];
        for (const std::string& rule : without_samples(checked[k].exercise)) {
            const ClaimedFile& file = files.at(c.claim.where.file);
            if (file.has(rule) && share_with_fewest(rule, checked[k]) == nullptr) {
                cases[{c.claim.where.file, rule}].push_back(c.id);
            }
        }
    }
    for (const auto& [key, ids] : cases) {
        const auto& [file, rule] = key;
        say(fmt::format("{}: {} of {} {} no sample for {}: {}{}\n", file, ids.size(),
                        counted(files.at(file).cases.size(), "case"),
                        ids.size() == 1 ? "has" : "have", rule, ids.front(),
                        ids.size() == 1 ? "" : ", ..."));
    }
}

int carry_out(const Program& program, const LintOptions& options) {
    if (options.strength && options.suite.selectors.empty()) {
        throw Stop{report::kExitUsage,
                   {"--strength draws each case with each fault, which takes long for a "
                    "whole suite; name the cases"}};
    }
    find_suite_root(program,
                    options.suite.suite);  // without it nothing is said of what is selected
    LoadedSuite suite;
    try {
        suite = load_selected(program, options.suite);
    } catch (const Stop& stop) {
        const int code = report_stop(stop);
        if (!options.quiet && code == report::kExitInvalidFile) {
            std::printf("%s cannot be read, %s\n",
                        options.suite.selectors.empty() ? "the suite" : "what is selected",
                        counted(stop.lines.size(), "error").c_str());
        }
        if (options.strength && code == report::kExitInvalidFile) {
            lint_readable(program, options);
        }
        return code;
    }
    std::map<std::string, ClaimedFile> files =
        claimed_files(suite.cases, suite.selected, suite.parts);
    const size_t count = suite.selected.size();
    const bool is_told = !options.quiet && (options.verbose || count <= kFew);
    const bool is_short = !options.quiet && !options.suite.selectors.empty() && !is_told;
    const Depth depth = is_told                              ? Depth::samples
                        : is_short && count <= kMostLookedAt ? Depth::cases
                                                             : Depth::file;
    std::vector<Checked> checked(count);
    for_each_on_threads(count, [&](size_t k) {
        const cases::Case& c = suite.cases[suite.selected[k]];
        ClaimedFile& file = files.at(c.claim.where.file);
        Checked& out = checked[k];
        try {
            out = exercised(c, file, depth);
            out.errors = check_case(c, out.exercise);
        } catch (const std::exception& e) {
            out.errors = {{c.claim.where, c.id + ": the reference failed: " + cases::reason_of(e)}};
        }
    });
    cases::Errors errors;
    const auto add = [&](const cases::Errors& more) {
        errors.insert(errors.end(), more.begin(), more.end());
    };
    for (size_t k = 0; k < count; ++k) {
        if (is_told) {
            const cases::Case& c = suite.cases[suite.selected[k]];
            tell(c, checked[k], files.at(c.claim.where.file));
        }
        add(checked[k].errors);
    }
    if (depth == Depth::cases) {
        tell_in_short(suite, files, checked);
    }
    add(check_claims(suite.cases, files));
    add(check_open_values(suite));
    // Expectation files are about the suite, so they are none of a selection's business.
    size_t expectation_files = 0;
    if (options.suite.selectors.empty()) {
        add(check_expectation_files(suite, expectation_files));
    }
    if (options.strength) {
        add(tell_strength(suite, without_errors(suite, errors), options.quiet));
    }
    for (const cases::Error& error : errors) {
        complain(cases::to_string(error));
    }
    if (!options.quiet && !options.suite.selectors.empty()) {
        warn_of_left_over(suite.cases, suite.selected);
    }
    if (!options.quiet) {
        const std::string beside =
            expectation_files == 0 ? "" : " and " + counted(expectation_files, "expectation file");
        std::printf("%s%s checked, %s\n", counted(count, "case").c_str(), beside.c_str(),
                    counted(errors.size(), "error").c_str());
    }
    if (!errors.empty()) {
        return report::kExitInvalidFile;
    }
    return suite.selected.empty() ? report::kExitNothingSelected : report::kExitOk;
}

void declare(CLI::App& app, LintOptions& o) {
    add_suite(&app, o.suite);
    app.add_flag("--strength", o.strength,
                 "tell which faults of the software device the cases catch");
    app.add_flag("-q,--quiet", o.quiet, "print errors only");
    app.add_flag("-v,--verbose", o.verbose, "tell which samples of each case exercise its rules");
}

}  // namespace

Command lint_command() {
    return make_command<LintOptions>(
        {"lint", kCases, "check case and expectation files; needs no Vulkan",
         "  edgecase lint my-case.toml                is a file of your own well formed\n"
         "  edgecase lint --strength my-case.toml     which known faults does it catch\n"},
        declare, carry_out);
}

}  // namespace cli
