// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "export": cases as plain JSON, for renderers that know nothing of this project, or
// one case as a C program for a bug report.
#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <variant>

#include "capture/exchange/export_case.hpp"
#include "capture/exchange/plane_files.hpp"
#include "cases/base/input_file.hpp"
#include "cases/base/output_file.hpp"
#include "cases/base/printable.hpp"
#include "cli/commands.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/reproducer/reproducer.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

// Writes into a folder that is made if it is not there.
OrStop<std::monostate> write_below(const fs::path& folder, const fs::path& name,
                                   const std::string& text) {
    if (auto made = cases::make_folders(folder, folder / name); !made) {
        return tl::unexpected(
            stop_with(report::kExitUsage, made.error().message + "; choose another with -o"));
    }
    if (auto written = replace_text(folder / name, text); !written) {
        return tl::unexpected(stop_with(report::kExitInternal, written.error().message));
    }
    return std::monostate{};
}

int export_reproducer(const Program& program, const ExportOptions& options) {
    if (!options.output.ends_with(".c")) {
        return report_stop({report::kExitUsage,
                            {"-o '" + cases::printable(options.output) +
                             "' is no name of a C file; write one that ends in .c"}});
    }
    const OrStop<cases::Case> c = load_one_case(program, options.suite, options.judged);
    if (!c) {
        return report_stop(c.error());
    }
    const auto text = reproducer(*c, limits_of(options.judged), options.profile, kVersion);
    if (!text) {
        return report_stop({report::kExitUsage, {text.error().message}});
    }
    if (auto written = write_text(options.output, *text); !written) {
        return report_stop({report::kExitInternal, {written.error().message}});
    }
    say(fmt::format("{}: build it with 'cc -std=c99 {} -lvulkan -lm'\n",
                    cases::printable(options.output), cases::printable(options.output)));
    return report::kExitOk;
}

}  // namespace

int export_command(const Program& program, const ExportOptions& options) {
    if (options.reproducer) {
        return export_reproducer(program, options);
    }
    const OrStop<LoadedSuite> suite = load_selected(program, options.suite);
    if (!suite) {
        return report_stop(suite.error());
    }
    const fs::path folder = options.output;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::map<std::string, std::string> carried;  // files outside the suite, by their place
    for (const size_t k : suite->selected) {
        const cases::Case& c = suite->cases[k];
        const std::string name = capture::folder_of(c.id);
        if (auto written = write_below(folder, name + ".json", capture::export_case(c)); !written) {
            return report_stop(written.error());
        }
        if (k >= suite->outside) {
            carried[c.id.substr(0, c.id.find(':')) + ".toml"] = c.claim.where.file;
        }
        list.push_back({{"id", c.id},
                        {"file", name + ".json"},
                        {"folder", name},
                        {"needs", capture::needs_of(c)}});
    }
    for (const auto& [place, file] : carried) {
        const cases::Expected<std::string> text = cases::read_file(file);
        if (!text) {
            return report_stop({report::kExitInvalidFile,
                                {"'" + file + "' cannot be read: " + text.error().message}});
        }
        if (auto written = write_below(folder, fs::path(kCarried) / place, *text); !written) {
            return report_stop(written.error());
        }
    }
    const nlohmann::ordered_json index = {{"schema", "edgecase-export-1"},
                                          {"tool", {{"name", "edgecase"}, {"version", kVersion}}},
                                          {"cases", std::move(list)}};
    if (auto written = write_below(folder, "index.json", index.dump(1) + "\n"); !written) {
        return report_stop(written.error());
    }
    say(fmt::format("{} case{} in {}\n", suite->selected.size(),
                    suite->selected.size() == 1 ? "" : "s", folder.string()));
    return report::kExitOk;
}

}  // namespace cli
