// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "doctor": the Vulkan loader, the drivers' manifests and every device, as a worker
// sees them, and what to install where something is missing.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/device_answer.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/renderers/renderers.hpp"
#include "report/journal/json_codec.hpp"
#include "report/text/sentences.hpp"
#include "run/process/library.hpp"
#include "run/worker/lacking.hpp"

namespace cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct DoctorOptions {
    DeviceOptions device;
    bool json = false;
};

// Something that a command needs beside a driver.
struct Part {
    std::string name, use, found, advice;  // found: where it is, empty if missing
};

// The first of the folders that holds the file.
std::string find_file(const std::vector<fs::path>& folders, const std::string& name) {
    std::error_code none;
    for (const fs::path& folder : folders) {
        if (fs::exists(folder / name, none)) {
            return (folder / name).string();
        }
    }
    return {};
}

std::vector<Part> find_parts(const Program& program, const capture::Installed& installed) {
    const fs::path folder = fs::path(program.path).parent_path();
    std::vector<Part> parts = {
        {"validation layer", "'--validation'", installed.validation_layer,
         "sudo apt install vulkan-validationlayers"},
        {"image files", "EXR and PNG files",
         find_file({folder / "../lib/edgecase", folder / "../lib", folder}, "edgecase-image-io.so"),
         "sudo apt install libopenimageio-dev && scripts/build release"}};
    parts.push_back({"suite", "'edgecase run' without a selector", "",
                     "name its folder with --suite or EDGECASE_SUITE"});
    try {
        parts.back().found = find_suite_root(program, "").string();
    } catch (const Stop&) {
        // it is missing
    }
    return parts;
}

struct Diagnosis {
    std::vector<Part> parts;

    capture::Installed installed;
    std::vector<capture::DeviceInfo> devices;
    std::vector<std::optional<run::SuiteShare>> shares;  // of the devices, as far as known
    std::vector<std::string> problems;
    std::vector<std::string> advice;
    bool usable = false;  // what the options choose can run the suite
};

void add_failure(Diagnosis& d, const capture::Failure& failure) {
    d.problems.push_back(failure.message);
    d.problems.insert(d.problems.end(), failure.reasons.begin(), failure.reasons.end());
    if (!d.devices.empty() ||
        (!d.installed.chosen_by.empty() && failure.stage != capture::Stage::loader)) {
        return;  // the driver works, but is not what was asked for; or another one was chosen
    }
    d.advice.emplace_back(failure.stage == capture::Stage::loader
                              ? "sudo apt install libvulkan1 mesa-vulkan-drivers"
                              : "sudo apt install mesa-vulkan-drivers");
}

bool is_usable(const capture::DeviceInfo& device) {
    return device.missing.empty();
}

// Lists the devices, or starts the one that the options choose.
cases::Expected<void> ask_worker(const Program& program, const DeviceOptions& options,
                                 run::FrameType question, Diagnosis& d) {
    run::SignalFd signals;
    cases::Expected<run::WorkerClient> client = run::WorkerClient::start(
        worker_command(program), run::WorkerOptions{options},
        std::chrono::milliseconds(static_cast<int64_t>(options.timeout * 1000)), question);
    const std::optional<run::WorkerEvent> answer = run::wait_for_answer(*client, signals);
    if (!answer) {
        return cases::failure("interrupted");
    }
    if (const auto* list = std::get_if<std::vector<capture::DeviceInfo>>(&*answer);
        list != nullptr) {
        d.devices = *list;
        if (list->empty()) {
            d.problems.emplace_back("the loader finds no device");
            if (d.installed.chosen_by.empty()) {
                d.advice.emplace_back("sudo apt install mesa-vulkan-drivers");
            }
        }
        d.usable = std::any_of(list->begin(), list->end(), is_usable);
    } else if (const auto* device = std::get_if<capture::DeviceInfo>(&*answer); device != nullptr) {
        d.usable = true;
        if (d.devices.empty()) {  // no driver's
            d.devices.push_back(*device);
        }
    } else if (const auto* failure = std::get_if<capture::Failure>(&*answer); failure != nullptr) {
        d.usable = false;
        add_failure(d, *failure);
        for (const std::string& line : printed_lines(client->output_since_batch())) {
            d.problems.push_back("printed: " + line);
        }
    } else if (const auto* death = std::get_if<run::Death>(&*answer); death != nullptr) {
        d.usable = false;
        const Stop stop = explain_death(*death);
        d.problems.insert(d.problems.end(), stop.lines.begin(), stop.lines.end());
    }
    return {};
}

// Every device of the drivers, and whether the chosen one, or the first usable, can run the suite.
cases::Expected<void> ask(const Program& program, const DeviceOptions& options, Diagnosis& d) {
    const bool is_driver = renderer_of(options).list != nullptr;
    if (is_driver) {
        for (const capture::Driver& m : d.installed.drivers) {
            if (!m.problem.empty()) {
                d.problems.push_back("the driver manifest " + m.file + " " + m.problem);
            }
        }
        const auto listed = ask_worker(program, options, run::FrameType::list_devices, d);
        for (const capture::Driver& m : d.installed.drivers) {
            if (std::string why = d.devices.empty() ? run::load_problem(m) : ""; !why.empty()) {
                d.problems.push_back(std::move(why));
            }
        }
        if (!listed || d.devices.empty() || options.device.empty()) {
            return listed;
        }
    }
    return ask_worker(program, options, run::FrameType::hello, d);
}

// Asks each usable device what of the suite it can draw. Without a suite nothing is asked.
void ask_shares(const Program& program, const DeviceOptions& options, Diagnosis& d) {
    d.shares.resize(d.devices.size());
    LoadedSuite suite;
    try {
        suite = load_and_select(program, {});
    } catch (const Stop&) {
        return;
    }
    std::vector<const cases::Case*> asked;
    for (const size_t k : suite.selected) {
        asked.push_back(&suite.cases[k]);
    }
    run::SignalFd signals;
    for (size_t k = 0; k < d.devices.size(); ++k) {
        if (!is_usable(d.devices[k])) {
            continue;
        }
        run::WorkerOptions worker{options};
        worker.device.device.clear();
        worker.device.pinned = d.devices[k].key;
        const auto reasons = run::ask_what_is_lacking(
            worker_command(program), worker,
            std::chrono::milliseconds(static_cast<int64_t>(options.timeout * 1000)), asked,
            signals);
        if (reasons) {
            d.shares[k] = run::share_of(*reasons);
        } else {
            d.problems.push_back(d.devices[k].name + ": " + reasons.error().message);
        }
    }
}

Json share_json(const std::optional<run::SuiteShare>& share) {
    if (!share) {
        return nullptr;
    }
    Json lacking = Json::array();
    for (const auto& [reason, count] : share->lacking) {
        lacking.push_back({{"reason", reason}, {"cases", count}});
    }
    return {{"cases", share->cases}, {"drawn", share->drawn}, {"lacking", lacking}};
}

// "draws 3174 of 3731 cases of the suite (85.1 %)", and what the others lack.
std::vector<std::string> share_lines(const run::SuiteShare& share) {
    constexpr size_t kTold = 8;
    const double percent = share.cases == 0 ? 0
                                            : 100.0 * static_cast<double>(share.drawn) /
                                                  static_cast<double>(share.cases);
    std::vector<std::string> lines = {fmt::format("draws {} of {} of the suite ({:.1f} %){}",
                                                  share.drawn, cases::counted(share.cases, "case"),
                                                  percent, share.lacking.empty() ? "" : "; not")};
    for (size_t k = 0; k < std::min(share.lacking.size(), kTold); ++k) {
        const auto& [reason, count] = share.lacking[k];
        lines.push_back(fmt::format("  {}: {}", cases::counted(count, "case"), reason));
    }
    if (share.lacking.size() > kTold) {
        size_t rest = 0;
        for (size_t k = kTold; k < share.lacking.size(); ++k) {
            rest += share.lacking[k].second;
        }
        lines.push_back(fmt::format("  {} for {} other reasons: --json has all",
                                    cases::counted(rest, "case"), share.lacking.size() - kTold));
    }
    return lines;
}

Json to_json(const Diagnosis& d) {
    Json devices = Json::array();
    for (size_t k = 0; k < d.devices.size(); ++k) {
        const capture::DeviceInfo& device = d.devices[k];
        devices.push_back({{"index", device.index},
                           {"name", device.name},
                           {"type", device.type},
                           {"driver_name", device.driver_name},
                           {"driver_info", device.driver_info},
                           {"uuid", device.uuid},
                           {"api_version", device.api_version},
                           {"subpixel_bits", device.subpixel_bits},
                           {"viewport_subpixel_bits", device.viewport_subpixel_bits},
                           {"max_target_size", device.max_target_size},
                           {"max_color_attachments", device.max_color_attachments},
                           {"has_primitive_id", device.has_primitive_id},
                           {"hit_counting", device.hit_counting},
                           {"depth_beside_stencil", device.depth_beside_stencil},
                           {"has_dynamic_rendering", device.has_dynamic_rendering},
                           {"has_dynamic_state", device.has_dynamic_state},
                           {"wrong_limits", report::encode(device.wrong_limits)},
                           {"suite", share_json(d.shares[k])},
                           {"missing", device.missing}});
    }
    Json parts = Json::array();
    for (const Part& part : d.parts) {
        parts.push_back({{"name", part.name},
                         {"use", part.use},
                         {"found", part.found},
                         {"advice", part.found.empty() ? part.advice : ""}});
    }
    return {{"parts", parts},
            {"usable", d.usable},
            {"manifests_chosen_by", d.installed.chosen_by},
            {"manifests", report::encode(d.installed.drivers)},
            {"devices", devices},
            {"problems", d.problems},
            {"advice", d.advice}};
}

void print(const Diagnosis& d, const DeviceOptions& options) {
    const auto line = [](const std::string& text) {
        std::printf("%s\n", cases::printable(text).c_str());
    };
    line("Driver manifests" + (d.installed.chosen_by.empty()
                                   ? std::string()
                                   : " (chosen by " + d.installed.chosen_by + ")"));
    for (const capture::Driver& m : d.installed.drivers) {
        line("  " + m.file + (m.library.empty() ? "" : " -> " + m.library) +
             (m.problem.empty() ? "" : ": " + m.problem));
    }
    if (d.installed.drivers.empty()) {
        line("  none");
    }
    line("Devices");
    for (size_t k = 0; k < d.devices.size(); ++k) {
        const capture::DeviceInfo& device = d.devices[k];
        line(fmt::format("  {}  {} ({}), {} {}, Vulkan {}", device.index, device.name, device.type,
                         device.driver_name, device.driver_info, device.api_version));
        line(fmt::format(
            "     {} subpixel bits{}, targets up to {}, {} colour attachments, gl_PrimitiveID: {}, "
            "hits counted in {}, depth beside a stencil {}{}{}, UUID {}",
            device.subpixel_bits, report::judged_bits_note(device), device.max_target_size,
            device.max_color_attachments, device.has_primitive_id ? "yes" : "no",
            device.hit_counting, device.depth_beside_stencil,
            device.has_dynamic_rendering ? "" : ", rendered by render pass objects",
            device.has_dynamic_state ? "" : ", state held by pipelines", device.uuid));
        for (const capture::WrongLimit& limit : device.wrong_limits) {
            line("     wrong limit: " + limit.name + " is " + limit.claimed +
                 ", and Vulkan requires " + limit.required + " " + limit.of);
        }
        for (const std::string& missing : device.missing) {
            line("     missing: " + missing);
        }
        if (d.shares[k]) {
            for (const std::string& text : share_lines(*d.shares[k])) {
                line("     " + text);
            }
        }
    }
    if (d.devices.empty()) {
        line("  none");
    }
    line("Parts");
    for (const Part& part : d.parts) {
        line("  " + part.name + ", for " + part.use + ": " +
             (part.found.empty() ? "missing" : part.found));
        if (part.found.empty()) {
            line("     try: " + part.advice);
        }
    }
    for (const std::string& problem : d.problems) {
        line("problem: " + problem);
    }
    for (const std::string& advice : d.advice) {
        line("try:     " + advice);
    }
    const std::string chosen = !options.renderer.empty() ? "renderer " + options.renderer
                               : !options.device.empty() ? "device '" + options.device + "'"
                                                         : std::string();
    const std::string on = chosen.empty() ? "" : " on the " + chosen;
    line(d.usable         ? "ready: 'edgecase run' works here" + on
         : chosen.empty() ? "not ready: no device can run the suite"
                          : "not ready: no " + chosen + " can run the suite");
}

int carry_out(const Program& program, const DoctorOptions& options) {
    Diagnosis d;
    d.installed = all_renderers().front().find_drivers(options.device);
    d.parts = find_parts(program, d.installed);
    must(ask(program, options.device, d), report::kExitInternal);
    ask_shares(program, options.device, d);
    if (!d.devices.empty() && std::ranges::none_of(d.devices, is_usable)) {
        d.advice.emplace_back("sudo apt install mesa-vulkan-drivers");
    }
    if (options.json) {
        const std::string text = to_json(d).dump(2, ' ', false, Json::error_handler_t::replace);
        std::printf("%s\n", text.c_str());
    } else {
        print(d, options.device);
    }
    return d.usable ? report::kExitOk : report::kExitDevice;
}

void declare(CLI::App& app, DoctorOptions& o) {
    add_device(&app, o.device);
    app.add_flag("--json", o.json, "as JSON");
}

}  // namespace

Command doctor_command() {
    return make_command<DoctorOptions>(
        {"doctor", kProgram, "what is installed, which devices there are, what is missing",
         "  edgecase doctor --icd my_icd.json         is my driver found and usable\n"},
        declare, carry_out);
}

}  // namespace cli
