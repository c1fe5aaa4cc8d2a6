// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "probe": what a rasterizer does where it may choose.
#include "probe/probe.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cases/base/input_file.hpp"
#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "probe/tell/compare.hpp"
#include "probe/tell/json.hpp"
#include "probe/tell/page.hpp"
#include "probe/tell/text.hpp"
#include "run/session.hpp"

namespace cli {

namespace {

namespace fs = std::filesystem;

struct ProbeOptions {
    DeviceOptions device;
    std::vector<std::string> compared;  // none, or two: files of an earlier probe, or devices
    std::string json, html;
    bool verbose = false;
};

std::vector<std::pair<std::string, std::string>> device_lines(const capture::DeviceInfo& device) {
    return {{"device", device.name},
            {"driver",
             device.driver_name + (device.driver_info.empty() ? "" : " ") + device.driver_info},
            {"promised subpixel bits", std::to_string(device.subpixel_bits)},
            {"promised bits of viewports", std::to_string(device.viewport_subpixel_bits)},
            {"promised bits of interpolation offsets",
             std::to_string(device.interpolation_offset_bits)},
            {"promised bits of levels of detail", std::to_string(device.mipmap_bits)},
            {"edgecase", kVersion}};
}

probe::Datasheet measure(const Program& program, const ProbeOptions& options,
                         run::SignalFd& signals) {
    RunOptions how;
    how.device = options.device;
    how.jobs = 1;
    how.retries = 0;
    run::LoopConfig config = loop_config(program, how);
    ReadyWorker first = ready_first_worker(config, signals);
    const capture::DeviceInfo device = first.device;
    run::Session session(config, std::move(first.client), device, signals);
    bool is_interrupted = false;
    std::string failure;
    Progress progress(ProgressStyle::automatic, 0);
    const capture::Draw draw = [&](std::vector<cases::Case> cases) {
        if (is_interrupted || !failure.empty()) {
            return std::vector<capture::Drawn>(cases.size(), {{}, "it was not drawn"});
        }
        run::Session::Pictures pictures = session.pictures(std::move(cases));
        is_interrupted = pictures.interrupted;
        failure = pictures.failure;
        return std::move(pictures.pictures);
    };
    probe::Datasheet sheet = probe::measure(
        draw, {config.judging.limits, device.max_target_size, device.has_primitive_id},
        [&](std::string_view what) {
            progress.show_words(fmt::format("measuring {}", what));
            return !is_interrupted && failure.empty();
        });
    progress.clear();
    if (is_interrupted) {
        throw stop_with(report::kExitInterrupted, "interrupted; nothing was written");
    }
    if (!failure.empty()) {
        throw stop_with(report::kExitInternal, failure);
    }
    sheet.device = device_lines(device);
    if (!options.device.renderer.empty()) {
        sheet.device.emplace_back("renderer", options.device.renderer);
    }
    return sheet;
}

// A file of 'probe --json', or else the name of a device.
probe::Datasheet sheet_of(const Program& program, const ProbeOptions& options,
                          const std::string& name, run::SignalFd& signals) {
    std::error_code none;
    if (fs::exists(name, none)) {
        const cases::Expected<std::string> text = cases::read_file(name, cases::Pipes::read);
        const cases::Expected<probe::Datasheet> sheet =
            text ? probe::from_json(*text)
                 : cases::Expected<probe::Datasheet>(tl::unexpected(text.error()));
        if (!sheet) {
            throw stop_with(
                report::kExitInvalidFile,
                fmt::format("'{}' cannot be compared: {}; write one with 'edgecase probe "
                            "--json FILE'",
                            name, sheet.error().message));
        }
        return *sheet;
    }
    if (name.ends_with(".json")) {
        throw stop_with(report::kExitInvalidFile,
                        fmt::format("there is no file '{}'; --compare takes two files of 'edgecase "
                                    "probe --json', or names of devices",
                                    name));
    }
    ProbeOptions one = options;
    one.device.device = name;
    return measure(program, one, signals);
}

int compare(const Program& program, const ProbeOptions& options, run::SignalFd& signals) {
    const probe::Datasheet a = sheet_of(program, options, options.compared[0], signals);
    const probe::Datasheet b = sheet_of(program, options, options.compared[1], signals);
    say(probe::comparison_text(a, b, options.compared[0], options.compared[1]));
    return probe::differences(a, b).empty() ? report::kExitOk : report::kExitUnexpected;
}

int carry_out(const Program& program, const ProbeOptions& options) {
    run::SignalFd signals;
    if (options.compared.size() == 1) {
        throw stop_with(report::kExitUsage, "--compare takes two files or devices, and '" +
                                                options.compared.front() +
                                                "' is one; see 'edgecase probe --help'");
    }
    if (!options.compared.empty()) {
        return compare(program, options, signals);
    }
    const probe::Datasheet sheet = measure(program, options, signals);
    cases::Errors errors;
    write_asked(options.json, errors, [&] { return probe::to_json(sheet); });
    write_asked(options.html, errors, [&] { return probe::to_html(sheet); });
    std::FILE* console = console_beside(options.json, {}, options.html);
    std::fputs(probe::to_text(sheet, options.verbose).c_str(), console);
    std::fflush(console);
    for (const cases::Error& error : errors) {
        complain(error.message);
    }
    return errors.empty() ? report::kExitOk : report::kExitInternal;
}

void declare(CLI::App& app, ProbeOptions& o) {
    add_device(&app, o.device);
    app.add_option("--compare", o.compared,
                   "two files of 'probe --json', or names of devices: say what differs")
        ->type_name("A B")
        ->expected(2)
        ->allow_extra_args(false)
        ->group("Selection");
    app.add_option("--json", o.json, "write the datasheet also to FILE ('-': standard output)")
        ->type_name("FILE")
        ->group("Output");
    app.add_option("--html", o.html, "write it as a page with pictures to FILE")
        ->type_name("FILE")
        ->group("Output");
    app.add_flag("-v,--verbose", o.verbose, "tell each experiment, too")->group("Output");
}

void check(const CLI::App& app, const ProbeOptions&, const Words&) {
    check_alternatives(app, "--compare", {"--json", "--html"});
}

}  // namespace

Command probe_command() {
    return make_command<ProbeOptions>(
        {"probe", kChecking, "measure what a rasterizer does where it may choose",
         "  edgecase probe --json before.json               what does my driver do\n"
         "  edgecase probe --json after.json                and the next version of it\n"
         "  edgecase probe --compare before.json after.json\n"
         "  edgecase probe --renderer software:ties=top-right\n"},
        declare, carry_out, check);
}

}  // namespace cli
