// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "cases/base/checksum.hpp"
#include "cases/base/counted.hpp"
#include "cases/base/input_file.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/way.hpp"
#include "cases/select/selector.hpp"
#include "cli/prepare/loop_config.hpp"
#include "ref/position/limits.hpp"
#include "report/record/run.hpp"
#include "report/text/sentences.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool is_path(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

bool is_below(const fs::path& file, const fs::path& root) {
    std::error_code ignored;
    const fs::path relative = fs::relative(file, root, ignored);
    return !relative.empty() && *relative.begin() != "..";
}

// Whether a selector is a case file outside the suite, or a folder with some that has nothing to do
// with the suite's.
bool is_outside_file(const fs::path& selector, const fs::path& root) {
    std::error_code ignored;
    return selector.extension() == ".toml" && fs::is_regular_file(selector, ignored) &&
           !is_below(selector, root);
}
bool is_outside_folder(const fs::path& selector, const fs::path& root) {
    if (!is_folder(selector) || is_below(selector, root) || is_below(root, selector)) {
        return false;
    }
    const auto files = cases::case_files(selector);
    return !files || !files->empty();  // what cannot be read is told by whoever loads it
}

// What is wrong with a folder that holds the suite and case files beside it: they would be left
// out.
std::string left_out_files(const fs::path& selector, const fs::path& root) {
    if (!is_folder(selector) || !is_below(root, selector)) {
        return {};
    }
    const auto files = cases::case_files(selector);
    std::vector<fs::path> own = files ? *files : std::vector<fs::path>();
    std::erase_if(own, [&](const fs::path& file) { return is_below(file, root); });
    return own.empty() ? std::string()
                       : "'" + selector.string() + "' holds the suite and " +
                             cases::counted(own.size(), "case file") + " beside it (" +
                             own.front().string() +
                             "), which would be left out; name their folder, and the suite by no "
                             "selector or by selectors of its cases";
}

// The suite's folder that an option or variable names. The folder above it has the same cases by
// other ids, which no expectation file knows.
fs::path named_root(const fs::path& folder, const std::string& by) {
    const auto refuse = [&](const std::string& why) {
        throw stop_with(report::kExitInvalidFile,
                        "no suite in '" + folder.string() + "' (" + by + "): " + why);
    };
    if (!is_folder(folder)) {
        refuse("it is not a folder");
    }
    if (is_folder(folder / "suite") && is_folder(folder / "expectations")) {
        refuse("it holds the suite's folder and its expectation files; name '" +
               (folder / "suite").string() + "'");
    }
    return folder;
}

// A leaf of a case file: "FILE.toml:seed=1". The leaf is empty where a selector names none.
struct LeafOfFile {
    std::string file, leaf;
};
LeafOfFile leaf_of_file(const std::string& selector) {
    constexpr std::string_view kEnd = ".toml:";
    const size_t at = selector.find(kEnd);
    if (at == std::string::npos) {
        return {selector, ""};
    }
    return {selector.substr(0, at + kEnd.size() - 1), selector.substr(at + kEnd.size())};
}

// The id without its matrix part, which all leaves of a file have in common.
std::string id_of_file(const cases::Case& c) {
    return c.id.substr(0, c.id.find(':'));
}

// The files of the loaded cases by their ids. Two files never share one: the id of a file, as a
// selector and in an expectation file, means all its leaves.
class FileIds {
  public:
    explicit FileIds(const LoadedSuite& suite) : root_(suite.root), reads_(suite.cases.empty()) {
        for (const cases::Case& c : suite.cases) {
            files_.emplace(id_of_file(c), c.claim.where.file);
        }
    }
    // Adds the file of a case, unless another one has its id: that one is returned, else "". Where
    // the suite was not loaded, its folder is asked.
    std::string add(const cases::Case& c) {
        const std::string id = id_of_file(c);
        const auto [at, fresh] = files_.emplace(id, c.claim.where.file);
        std::error_code none;
        if (!fresh) {
            const bool is_same = at->second == c.claim.where.file ||
                                 fs::equivalent(at->second, c.claim.where.file, none);
            return is_same ? "" : at->second;
        }
        const fs::path file = root_ / (id + ".toml");
        return reads_ && fs::exists(file, none) ? file.string() : "";
    }

  private:
    fs::path root_;
    bool reads_;
    std::map<std::string, std::string> files_;
};

// All cases of the files below a folder.
std::vector<cases::Case> cases_below(const fs::path& folder,
                                     cases::Contents contents = cases::Contents::all) {
    cases::Suite loaded = cases::load_suite(folder, contents);
    if (!loaded.errors.empty()) {
        throw invalid_files(loaded.errors);
    }
    return std::move(loaded.cases);
}

// Puts all of their contents into the place of selected cases of which the id is known.
LoadedSuite load_contents(LoadedSuite suite) {
    std::map<std::string, std::vector<cases::Case>> files;
    for (const size_t k : suite.selected) {
        if (k >= suite.outside) {
            continue;  // read already
        }
        cases::Case& c = suite.cases[k];
        const auto [file, fresh] = files.try_emplace(c.claim.where.file);
        if (fresh) {
            file->second = must(cases::load_file(c.claim.where.file, suite.root));
        }
        const auto full = std::ranges::find(file->second, c.id, &cases::Case::id);
        if (full == file->second.end()) {
            throw stop_with(report::kExitInvalidFile,
                            c.claim.where.file + " changed while it was read");
        }
        c = std::move(*full);
        full->id.clear();
    }
    return suite;
}

// Loads the case files outside the suite that selectors name, themselves or by their folder, and
// returns the other selectors. Below a folder ids are paths, as in a suite.
std::vector<std::string> load_outside_files(const std::vector<std::string>& wanted,
                                            LoadedSuite& suite) {
    std::vector<std::string> selectors;
    FileIds files(suite);
    std::set<std::string> named;
    for (const std::string& selector : wanted) {
        std::vector<cases::Case> loaded;
        const auto [file, leaf] = leaf_of_file(selector);
        if (is_outside_file(file, suite.root)) {
            loaded = must(cases::load_file(file, suite.root));
        } else if (is_outside_folder(selector, suite.root)) {
            loaded = cases_below(selector);
        } else {
            if (std::string wrong = left_out_files(selector, suite.root); !wrong.empty()) {
                throw stop_with(report::kExitUsage, wrong);
            }
            selectors.push_back(selector);
            continue;
        }
        if (!leaf.empty()) {
            suite.parts.insert(loaded.front().claim.where.file);
            std::erase_if(loaded, [&ending = leaf](const cases::Case& c) {
                return c.id.substr(c.id.find(':') + 1) != ending;
            });
            if (loaded.empty()) {
                throw stop_with(report::kExitNothingSelected,
                                "the file " + file + " has no leaf '" + leaf +
                                    "'; 'edgecase list " + file + "' lists them");
            }
        }
        for (cases::Case& c : loaded) {
            if (const std::string known = files.add(c); !known.empty()) {
                throw stop_with(report::kExitInvalidFile,
                                c.claim.where.file + ": error: its id '" + id_of_file(c) +
                                    "' is already that of " + known + "; rename the file");
            }
            if (!named.insert(c.id).second) {
                throw stop_with(report::kExitUsage,
                                "the file " + c.claim.where.file + " is named twice; name it once");
            }
            suite.cases.push_back(std::move(c));
        }
    }
    return selectors;
}

// The first link below a folder of an export that leads out of the export, which a stranger may
// have made; empty: none does.
fs::path link_out_of(const fs::path& folder) {
    const fs::path exported = folder.parent_path();
    const auto leads_out = [&](const fs::path& link) {
        std::error_code none;  // of a link that leads nowhere, reading the file tells
        return fs::is_symlink(link, none) && fs::exists(link, none) &&
               !cases::place_inside(exported.empty() ? "." : exported, link);
    };
    if (leads_out(folder)) {
        return folder;
    }
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
         it.increment(error)) {
        if (leads_out(it->path())) {
            return it->path();
        }
    }
    return {};
}

// Adds the cases that an export carries, but for those that selectors have named already.
void load_carried(const std::string& folder, LoadedSuite& suite) {
    if (folder.empty() || !is_folder(folder)) {
        return;
    }
    if (const fs::path link = link_out_of(folder); !link.empty()) {
        throw invalid_files(
            {{{link.string(), 0, 0},
              "the link leads out of the export; put a copy of what it names in its place"}});
    }
    std::set<std::string> known;
    for (const cases::Case& c : suite.cases) {
        known.insert(c.id);
    }
    for (cases::Case& c : cases_below(folder)) {
        if (!known.contains(c.id)) {
            suite.cases.push_back(std::move(c));
        }
    }
}

std::vector<size_t> selected_of(const LoadedSuite& suite, const std::vector<std::string>& selectors,
                                const std::vector<size_t>& named = {}) {
    auto selected = cases::select(suite.cases, selectors, std::cin, named);
    if (!selected) {
        throw stop_with(report::kExitNothingSelected, cases::to_string(selected.error()));
    }
    return std::move(*selected);
}

// Adds what ways make of cases: "ties/**@bare-*", "mine.toml:k=1@prepass". They stand behind the
// suite's cases, as those of other files do, whose cases themselves are not selected.
void select_ways(const std::string& selector, LoadedSuite& suite) {
    const auto [base, glob] = cases::split_way(selector);
    LoadedSuite own{suite.root, {}, {}, 0, {}};
    const std::vector<std::string> left = load_outside_files({std::string(base)}, own);
    std::vector<size_t> chosen;
    if (!left.empty()) {
        chosen = selected_of(suite, left);
    }
    for (cases::Case& c : own.cases) {
        const auto known = std::ranges::find(suite.cases, c.id, &cases::Case::id);
        chosen.push_back(static_cast<size_t>(known - suite.cases.begin()));
        if (known == suite.cases.end()) {
            suite.cases.push_back(std::move(c));
        }
    }
    suite.parts.merge(own.parts);
    size_t made = 0;
    for (const size_t k : chosen) {
        for (const cases::WayRow& way : cases::all_ways()) {
            std::optional<cases::Case> c = cases::glob_matches(glob, way.word)
                                               ? cases::by_way(way, suite.cases[k])
                                               : std::nullopt;
            if (!c) {
                continue;
            }
            ++made;
            if (const size_t end = suite.cases.size(); suite.add(std::move(*c), k) == end) {
                suite.selected.push_back(end);
            }
        }
    }
    if (made == 0) {
        throw stop_with(report::kExitNothingSelected,
                        fmt::format("'{}' is drawn by no way '{}'{}", base, glob,
                                    cases::did_you_mean(glob, cases::way_words(),
                                                        "; 'edgecase doors' lists them, and what "
                                                        "they take")));
    }
}

LoadedSuite select_of(LoadedSuite suite, const SuiteOptions& options) {
    suite.outside = suite.cases.size();
    std::vector<std::string> selectors, of_ways;
    for (const std::string& selector : options.selectors) {
        const bool has_way = !cases::split_way(selector).way.empty() && !is_path(selector);
        (has_way ? of_ways : selectors).push_back(selector);
    }
    selectors = load_outside_files(selectors, suite);
    std::vector<size_t> named(suite.cases.size() - suite.outside);
    std::iota(named.begin(), named.end(), suite.outside);
    load_carried(options.carried, suite);
    if (!selectors.empty() || of_ways.empty()) {
        suite.selected = selected_of(suite, selectors, named);
    }
    for (const std::string& selector : of_ways) {
        select_ways(selector, suite);
    }
    return suite;
}

}  // namespace

bool is_outside(const std::string& words, const fs::path& root) {
    const std::string selector(is_path(words) ? words : cases::split_way(words).base);
    return is_outside_file(leaf_of_file(selector).file, root) || is_outside_folder(selector, root);
}

bool LoadedSuite::is_suites(size_t k) const {
    const auto drawn = k < outside ? by_ways.end() : by_ways.find(cases[k].id);
    return k < outside || (drawn != by_ways.end() && drawn->second.is_suites);
}

size_t LoadedSuite::add(cases::Case made, size_t k) {
    const auto [at, is_new] = by_ways.try_emplace(made.id, Drawn{cases.size(), is_suites(k)});
    if (is_new) {
        cases.push_back(std::move(made));
    }
    return at->second.index;
}

std::vector<std::string> LoadedSuite::ids() const {
    std::vector<std::string> all;
    for (const cases::Case& c : cases) {
        all.push_back(c.id);
    }
    return all;
}

std::vector<std::string> LoadedSuite::suite_ids() const {
    std::vector<std::string> all;
    for (size_t k = 0; k < cases.size(); ++k) {
        if (is_suites(k)) {
            all.push_back(cases[k].id);
        }
    }
    return all;
}

fs::path find_suite_root(const Program& program, const std::string& option) {
    if (!option.empty()) {
        return named_root(option, "--suite");
    }
    if (const char* value = std::getenv("EDGECASE_SUITE"); value != nullptr && *value != '\0') {
        return named_root(value, "EDGECASE_SUITE");
    }
    fs::path folder = fs::path(program.path).parent_path();
    for (int up = 0; up < 5 && folder.has_relative_path(); ++up, folder = folder.parent_path()) {
        for (const fs::path& candidate :
             {folder / "cases" / "suite", folder / "share" / "edgecase" / "cases" / "suite"}) {
            if (is_folder(candidate)) {
                return candidate;
            }
        }
    }
    throw stop_with(
        report::kExitInvalidFile,
        "no suite found: neither cases/suite nor share/edgecase/cases/suite is in a folder "
        "above '" +
            program.path + "'; name it with --suite DIR");
}

LoadedSuite load_and_select(const Program& program, const SuiteOptions& options,
                            cases::Contents contents) {
    const fs::path root = find_suite_root(program, options.suite);
    return select_of({root, cases_below(root, contents), {}, 0, {}}, options);
}

LoadedSuite load_with_ids(const Program& program, const SuiteOptions& options) {
    // What is no name is asked of the cases themselves.
    const auto is_asked = [](const std::string& s) { return s == "-" || s.find('@') != s.npos; };
    const std::vector<std::string>& all = options.selectors;
    if (all.empty() || std::ranges::any_of(all, is_asked)) {
        return load_and_select(program, options);
    }
    return load_contents(load_and_select(program, options, cases::Contents::ids));
}

LoadedSuite load_selected(const Program& program, const SuiteOptions& options) {
    const fs::path root = find_suite_root(program, options.suite);
    const std::vector<std::string>& all = options.selectors;
    const auto is_own = [&](const std::string& s) { return is_outside(s, root); };
    return !all.empty() && std::ranges::all_of(all, is_own)
               ? select_of({root, {}, {}, 0, {}}, options)
               : load_with_ids(program, options);
}

cases::Case load_one_case(const Program& program, const SuiteOptions& options) {
    LoadedSuite suite = load_selected(program, options);
    if (suite.selected.empty()) {
        throw stop_with(report::kExitNothingSelected, "the selection is empty");
    }
    if (suite.selected.size() != 1) {
        std::string some;
        for (size_t k = 0; k < suite.selected.size() && k < 3; ++k) {
            some += (k == 0 ? "'" : ", '") + suite.cases[suite.selected[k]].id + "'";
        }
        throw stop_with(
            report::kExitUsage,
            "this command works on one case, and " +
                (options.selectors.empty()
                     ? "none is named; give its id, as 'edgecase list' has it, or a file of your "
                       "own"
                     : std::to_string(suite.selected.size()) + " are selected: " + some +
                           (suite.selected.size() > 3 ? ", ..." : "") + "; give the id of one"));
    }
    return std::move(suite.cases[suite.selected.front()]);
}

cases::Case load_one_case(const Program& program, const SuiteOptions& options,
                          const JudgedDevice& device) {
    cases::Case c = load_one_case(program, options);
    const ref::Limits limits = limits_of(device);
    if (c.target.samples > 1 && c.target.sample_locations.empty() &&
        !limits.sample_locations.empty() &&
        ref::as_drawn(c, limits).value_or(c).target.sample_locations.empty()) {
        throw stop_with(report::kExitUsage,
                        fmt::format("--sample-locations has no list of {} locations, and '{}' has "
                                    "{} samples a pixel; give one, or leave the option out",
                                    c.target.samples, c.id, c.target.samples));
    }
    return c;
}

namespace {

std::string text_of(const std::filesystem::path& file) {
    return cases::read_file(file).value_or("");  // a journal may name anything
}

}  // namespace

std::vector<std::pair<std::string, std::string>> sources_of(
    const std::vector<report::CaseRecord>& cases) {
    constexpr size_t kMostOfFile = size_t{1} << 16;
    std::set<std::string> files;
    for (const report::CaseRecord& record : cases) {
        files.insert(record.file);
    }
    std::vector<std::pair<std::string, std::string>> sources;
    for (const std::string& file : files) {
        if (std::string text = text_of(file); !text.empty()) {
            sources.emplace_back(file, report::head_and_tail(text, kMostOfFile));
        }
    }
    return sources;
}

std::string hash_of_files(const std::set<std::string>& files) {
    // The jobs of one run may have their files in different folders.
    std::map<std::string, std::vector<std::string>> texts;
    for (const std::string& file : files) {
        texts[fs::path(file).filename().string()].push_back(text_of(file));
    }
    uint64_t hash = 0;
    for (auto& [name, all] : texts) {
        std::ranges::sort(all);
        for (const std::string& text : all) {
            hash = cases::stable_hash(text, cases::stable_hash(name, hash));
        }
    }
    return files.empty() ? std::string() : cases::hex(hash);
}

uint64_t suite_hash(const std::filesystem::path& root) {
    uint64_t hash = 0;
    for (const std::filesystem::path& file :
         cases::case_files(root).value_or(std::vector<std::filesystem::path>())) {
        hash = cases::stable_hash(file.lexically_relative(root).string(), hash);
        hash = cases::stable_hash(text_of(file), hash);
    }
    return hash;
}

}  // namespace cli
