// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "export": cases as plain JSON, for renderers that know nothing of this project, or
// one case as a C program for a bug report.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "capture/exchange/export_case.hpp"
#include "capture/exchange/plane_files.hpp"
#include "cases/base/input_file.hpp"
#include "cases/base/output_file.hpp"
#include "cases/base/printable.hpp"
#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/reproducer/reproducer.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

struct ExportOptions {
    SuiteOptions suite;
    std::string output;                                 // folder; of a reproducer the file
    bool reproducer = false;                            // one case as a C program
    cases::Profile profile = cases::Profile::direct3d;  // that a reproducer judges at
    JudgedDevice judged;                                // that it is for
};

// Writes into a folder that is made if it is not there.
void write_below(const fs::path& folder, const fs::path& name, const std::string& text) {
    if (auto made = cases::make_folders(folder, folder / name); !made) {
        throw stop_with(report::kExitUsage, made.error().message + "; choose another with -o");
    }
    must(replace_text(folder / name, text), report::kExitInternal);
}

int export_reproducer(const Program& program, const ExportOptions& options) {
    if (!options.output.ends_with(".c")) {
        throw Stop{report::kExitUsage,
                   {"-o '" + cases::printable(options.output) +
                    "' is no name of a C file; write one that ends in .c"}};
    }
    const cases::Case c = load_one_case(program, options.suite, options.judged);
    const auto text = must(reproducer(c, limits_of(options.judged), options.profile, kVersion),
                           report::kExitUsage);
    must(write_text(options.output, text), report::kExitInternal);
    say(fmt::format("{}: build it with 'cc -std=c99 {} -lvulkan -lm'\n",
                    cases::printable(options.output), cases::printable(options.output)));
    return report::kExitOk;
}

int carry_out(const Program& program, const ExportOptions& options) {
    if (options.reproducer) {
        return export_reproducer(program, options);
    }
    const LoadedSuite suite = load_selected(program, options.suite);
    const fs::path folder = options.output;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::map<std::string, std::string> carried;  // files outside the suite, by their place
    for (const size_t k : suite.selected) {
        const cases::Case& c = suite.cases[k];
        const std::string name = capture::folder_of(c.id);
        write_below(folder, name + ".json", capture::export_case(c));
        if (k >= suite.outside) {
            carried[c.id.substr(0, c.id.find(':')) + ".toml"] = c.claim.where.file;
        }
        list.push_back({{"id", c.id},
                        {"file", name + ".json"},
                        {"folder", name},
                        {"needs", capture::needs_of(c)}});
    }
    for (const auto& [place, file] : carried) {
        const std::string text = must(cases::read_file(file), report::kExitInvalidFile,
                                      "'" + file + "' cannot be read: ");
        write_below(folder, fs::path(kCarried) / place, text);
    }
    const nlohmann::ordered_json index = {{"schema", "edgecase-export-1"},
                                          {"tool", {{"name", "edgecase"}, {"version", kVersion}}},
                                          {"cases", std::move(list)}};
    write_below(folder, "index.json", index.dump(1) + "\n");
    say(fmt::format("{} case{} in {}\n", suite.selected.size(),
                    suite.selected.size() == 1 ? "" : "s", folder.string()));
    return report::kExitOk;
}

void declare(CLI::App& app, ExportOptions& o) {
    add_suite(&app, o.suite);
    app.add_option("-o,--output", o.output, "where the files go; with --reproducer the C file")
        ->type_name("PATH")
        ->required();
    app.add_flag("--reproducer", o.reproducer,
                 "one case as a C program for a bug report, needs the Vulkan loader alone");
    add_profile(&app, o.profile);
    add_judged_device(&app, o.judged);
    for (const char* judging : {"--profile", "--subpixel-bits", "--sample-locations"}) {
        // The environment says how runs are judged, which is no reason to refuse an export.
        app.get_option(judging)->needs("--reproducer")->envname("");
    }
}

}  // namespace

Command export_command() {
    return make_command<ExportOptions>(
        {"export", kElsewhere, "write cases as JSON that any program can draw",
         "  edgecase export 'ties/**' -o cases               what a renderer elsewhere has to "
         "draw\n"
         "  my-renderer cases captures                       yours: draws them, writes planes\n"
         "  edgecase diff 'ties/**' --captures captures      judges what it has drawn\n"
         "  edgecase export --reproducer ties/apex-up -o bug.c   for a bug report: one C file\n"
         "\n"
         "docs/bug-reports.md tells what a reproducer draws and how it is compiled;\n"
         "docs/other-renderers.md tells it step by step; docs/schema/case-1.json is the format.\n"},
        declare, carry_out);
}

}  // namespace cli
