// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/run_plan.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <map>
#include <set>
#include <string_view>

#include "cases/base/checksum.hpp"
#include "cases/base/counted.hpp"
#include "cases/model/device.hpp"
#include "cases/model/way.hpp"
#include "cli/prepare/command_lines.hpp"
#include "cli/prepare/ways.hpp"
#include "cli/renderers/renderers.hpp"
#include "report/journal/journal.hpp"
#include "run/order.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

// What ended unexpectedly in the run of --failed-in; what ways drew of selected cases is selected.
// Where no selector chooses, all of it is meant: a case of one's own that nobody names must not
// look as if it passed.
std::set<std::string> failed_ids(const RunOptions& options, LoadedSuite& suite) {
    const report::Run earlier = must_read(report::load_journal(options.failed_in), "--failed-in: ");
    std::set<std::string> failed, selected;
    for (const size_t k : suite.selected) {
        selected.insert(suite.cases[k].id);
    }
    add_drawn(suite, earlier);
    for (const auto& [id, drawn] : suite.by_ways) {
        if (selected.contains(std::string(cases::split_way(id).base)) &&
            selected.insert(id).second) {
            suite.selected.push_back(drawn.index);
        }
    }
    std::vector<const report::CaseRecord*> left_out;
    for (const report::CaseRecord& record : earlier.cases) {
        if (!report::is_expected(record.status)) {
            failed.insert(record.id);
            if (!selected.contains(record.id) && record.id != cases::kLimitsCase) {
                left_out.push_back(&record);
            }
        }
    }
    if (left_out.empty() || left_out.size() == failed.size()) {
        return failed;  // where none is left, that is told
    }
    const std::string what =
        fmt::format("{} that failed in '{}' {} not selected: '{}' of {}{}",
                    cases::counted(left_out.size(), "case"), options.failed_in,
                    left_out.size() == 1 ? "is" : "are", left_out.front()->id,
                    left_out.front()->file, left_out.size() == 1 ? "" : ", ...");
    if (!options.suite.selectors.empty()) {
        complain("warning: " + what);
        return failed;
    }
    throw stop_with(
        report::kExitNothingSelected,
        what + "; name files or folders of your own, too, and '**' for the suite's cases");
}

// The same for the same cases, whatever selected them in whichever order.
std::string selection_text(std::vector<std::string> ids) {
    std::ranges::sort(ids);
    uint64_t hash = 0;
    for (const std::string& id : ids) {
        hash = cases::stable_hash(id, hash);
    }
    return fmt::format("{}, {}", cases::counted(ids.size(), "case"), cases::hex(hash));
}

}  // namespace

Selection select_cases(const Program& program, const RunOptions& options) {
    Selection selection;
    SuiteOptions wanted = options.suite;
    selection.names_limits = std::erase(wanted.selectors, cases::kLimitsCase) > 0;
    const bool is_alone = selection.names_limits && wanted.selectors.empty();
    LoadedSuite suite = is_alone ? load_and_select(program, wanted, cases::Contents::ids)
                                 : load_with_ids(program, wanted);
    if (is_alone) {
        suite.selected.clear();
    }
    std::set<std::string> failed;
    if (!options.failed_in.empty()) {
        failed = failed_ids(options, suite);
        selection.names_limits = selection.names_limits || failed.contains(cases::kLimitsCase);
    }
    selection.root = suite.root;
    selection.known_ids = suite.ids();
    selection.suite_ids = suite.suite_ids();
    for (size_t k = suite.outside; k < suite.cases.size(); ++k) {
        if (!suite.is_suites(k)) {
            selection.own_files.insert(suite.cases[k].claim.where.file);
        }
    }
    if (!options.doors.empty() && options.doors != "none" &&
        renderer_of(options.device).needs == nullptr) {
        throw stop_with(report::kExitUsage,
                        "--doors needs a Vulkan driver, and --renderer names another; "
                        "leave one of them out");
    }
    std::map<std::string, size_t> left_out;  // leaves by file
    for (const cases::Case& c : suite.cases) {
        ++left_out[c.claim.where.file];
    }
    std::vector<std::string> ids;
    std::set<std::string> own;
    std::vector<cases::Case*> chosen;  // of all shards
    for (const size_t k :
         options.quick ? run::first_and_last(suite.cases, suite.selected) : suite.selected) {
        cases::Case& c = suite.cases[k];
        if (!options.failed_in.empty() && !failed.contains(c.id)) {
            continue;
        }
        ids.push_back(c.id);
        if (!suite.is_suites(k)) {
            own.insert(c.claim.where.file);
        }
        chosen.push_back(&c);
    }
    selection.left_out_doors = choose_doors(doors_of(options), chosen);
    std::vector<cases::Case> by_ways = choose_ways(ways_of(options), chosen);
    const auto is_here = [&](const cases::Case& c) {
        return run::shard_of(c.id, options.shard.count) == options.shard.index;
    };
    for (cases::Case* c : chosen) {
        if (is_here(*c)) {
            --left_out[c->claim.where.file];
            selection.cases.push_back(std::move(*c));
        }
    }
    const std::set<std::string> of_suite(selection.suite_ids.begin(), selection.suite_ids.end());
    std::set<std::string> known(selection.known_ids.begin(), selection.known_ids.end());
    for (cases::Case& c : by_ways) {
        if (!known.insert(c.id).second) {
            continue;  // a selector names it, too
        }
        ids.push_back(c.id);
        selection.known_ids.push_back(c.id);
        if (of_suite.contains(std::string(cases::split_way(c.id).base))) {
            selection.suite_ids.push_back(c.id);
        }
        if (is_here(c)) {
            selection.cases.push_back(std::move(c));
        }
    }
    selection.part_files = suite.parts;
    for (const auto& [file, leaves] : left_out) {
        if (leaves > 0) {
            selection.part_files.insert(file);
        }
    }
    selection.of_all_shards = selection_text(std::move(ids));
    selection.own_hash = hash_of_files(own);
    selection.whole_suite = selection.cases.size() == selection.known_ids.size();
    if (selection.cases.empty() && !selection.names_limits) {
        std::string why = "no case is selected";
        if (suite.cases.empty()) {
            why = "the suite '" + suite.root.string() + "' holds no case";
        } else if (!options.failed_in.empty()) {
            why += "; no case of this selection failed in '" + options.failed_in + "'";
        } else if (options.shard.count > 1) {
            why += "; the selection has none in shard " + std::to_string(options.shard.index) +
                   "/" + std::to_string(options.shard.count);
        }
        throw stop_with(report::kExitNothingSelected, why);
    }
    if (options.shuffle) {
        run::shuffle(selection.cases, options.seed);
    }
    return selection;
}

report::Run new_header(const Program& program, const RunOptions& options,
                       const Selection& selection) {
    report::Run header;
    header.tool_version = kVersion;
    header.arguments = program.arguments;
    header.environment = recorded_environment();
    header.started = utc_now(false);
    utsname name{};
    ::uname(&name);
    header.host = std::string(name.sysname) + " " + name.release + " " + name.machine;
    header.profile = options.profile;
    header.fail_at = own_fail_level(options);
    header.seed = options.seed;
    std::error_code ignored;
    header.suite_root = fs::absolute(selection.root, ignored).lexically_normal().string();
    header.suite_hash = cases::hex(suite_hash(selection.root));
    header.selection = selection.of_all_shards;
    header.own_hash = selection.own_hash;
    header.settings = settings_of(options);
    return header;
}

std::string utc_now(bool compact) {
    std::time_t now = std::time(nullptr);
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    const std::string_view digits = compact || epoch == nullptr ? "" : epoch;
    std::time_t given = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), given);
    if (read.ec == std::errc{} && read.ptr == digits.data() + digits.size()) {
        now = given;
    }
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), compact ? "%Y%m%dT%H%M%SZ" : "%Y-%m-%dT%H:%M:%SZ",
                  &utc);
    return text.data();
}

std::filesystem::path new_folder(const std::filesystem::path& parent, const std::string& name) {
    const std::filesystem::path first = parent / (utc_now(true) + "-" + name);
    std::filesystem::path out = first;
    std::error_code none;
    for (int n = 2; std::filesystem::exists(out, none); ++n) {
        out = first.string() + "-" + std::to_string(n);
    }
    return out;
}

}  // namespace cli
