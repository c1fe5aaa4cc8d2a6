// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "reduce": a failing case as small as it can be.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "cases/base/counted.hpp"
#include "cases/write/to_toml.hpp"
#include "cli/commands.hpp"
#include "cli/fuzzing/captures_command.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/suite.hpp"
#include "fuzz/hunt.hpp"
#include "run/session.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;

namespace {

struct ReduceOptions {
    RunOptions run;                // its suite with exactly one case, device, judging and output
    std::string captures_command;  // of a renderer that no worker drives; empty: a device draws
    JudgedDevice judged;           // that renderer
};

constexpr size_t kMostRounds = 2000;

run::Session start_session(const Program& program, const RunOptions& options,
                           run::SignalFd& signals) {
    run::LoopConfig config = loop_config(program, options);
    config.judging.pictures = run::KeepPictures::symptoms;
    config.schedule.retries = 0;
    ReadyWorker first = ready_first_worker(config, signals);
    return run::Session(config, std::move(first.client), first.device, signals);
}

// What draws cases: workers on a device, or a command.
run::DrawAndJudge make_drawer(const Program& program, const ReduceOptions& options,
                              run::SignalFd& signals, const std::function<void()>& on_wait) {
    if (options.captures_command.empty()) {
        run::Session session = start_session(program, options.run, signals);
        return [all = std::make_shared<run::Session>(std::move(session)), on_wait](
                   std::vector<cases::Case> cases, const auto&) {
            return all->draw(std::move(cases), [&on_wait](size_t) {
                on_wait();
                return true;
            });
        };
    }
    CapturesCommand command =
        CapturesCommand::open({options.captures_command, options.run.device.timeout,
                               limits_of(options.judged), options.run.profile, on_wait},
                              signals);
    return [all = std::make_shared<CapturesCommand>(std::move(command))](
               std::vector<cases::Case> cases, const auto&) {
        run::Session::Results results;
        results.records = all->draw(cases);
        results.interrupted = all->is_interrupted();
        return results;
    };
}

// A case without a finding: it is right, or nobody could draw it.
Stop why_nothing(const cases::Case& c, const CaseRecord& record, bool is_command) {
    if (record.status == report::Status::error || record.status == report::Status::not_run) {
        return stop_with(report::kExitInternal,
                         is_command
                             ? "--captures-command: " + record.reason
                             : fmt::format("{} was not judged here, so there is nothing to reduce: "
                                           "{}",
                                           c.id, record.reason));
    }
    const std::string why = record.reason.empty() ? "" : ": " + record.reason;
    return stop_with(report::kExitAllSkipped,
                     fmt::format("{} does not fail here ({}{}), so there is nothing to reduce",
                                 c.id, report::to_string(record.status), why));
}

// Of a smaller case: nobody knows whether it fails as the first one did. (One that was drawn and is
// an error is no such case: nothing of it can be seen.)
bool is_unsure(const CaseRecord& record) {
    using enum report::Status;
    return record.status == crash || record.status == timeout || record.status == device_lost ||
           record.status == flake ||
           (record.status == error && record.drawn.bits.empty() && !record.drawn.is_delivered);
}

// What keeps the reduced case from being the smallest; empty if nothing is known to.
std::string size_doubt(const CaseRecord& first, bool is_minimal, size_t unsure) {
    const bool was_in_the_way = !is_unsure(first) && unsure > 0;
    return is_minimal && !was_in_the_way
               ? ""
               : "; it may be larger than it has to be" +
                     (was_in_the_way ? fmt::format(", since {} had no sure result",
                                                   cases::counted(unsure, "case"))
                                     : "");
}

// "2 draws, 14 triangles, 5 attributes, 64 x 64 with 4 samples".
std::string size_text(const cases::Case& c) {
    const cases::Target& t = c.target;
    return fmt::format("{}, {}, {} x {}{}", cases::counted(c.draws.size(), "draw"),
                       cases::counted(cases::assemble(c).size(), "triangle"), t.width, t.height,
                       t.samples > 1 ? fmt::format(" with {} samples", t.samples) : "");
}

int carry_out(const Program& program, const ReduceOptions& options) {
    const cases::Case loaded = load_one_case(program, options.run.suite);
    if (std::error_code none; !options.run.output.empty() && fs::exists(options.run.output, none)) {
        throw stop_with(
            report::kExitUsage,
            "'" + options.run.output + "' exists; name another file with -o, or remove it");
    }
    const std::string text =
        must(cases::to_toml(loaded), report::kExitUsage, "the case cannot be reduced: ");
    run::SignalFd signals;
    size_t drawn = 0;
    Progress progress(options.run.quiet ? ProgressStyle::none : ProgressStyle::automatic, 0);
    const run::DrawAndJudge drawer = make_drawer(program, options, signals, [&] {
        progress.show_words(fmt::format("reducing: {} drawn", cases::counted(drawn, "case")));
    });
    size_t unsure = 0;
    std::string failure;
    bool is_interrupted = false;
    const auto is_over = [&] {
        is_interrupted = is_interrupted || signals.has_come();
        return is_interrupted || !failure.empty();
    };
    const run::DrawAndJudge draw = [&](std::vector<cases::Case> cases, const auto& on_progress) {
        if (is_over()) {
            return run::Session::Results{std::vector<CaseRecord>(cases.size()), false, ""};
        }
        drawn += cases.size();
        run::Session::Results results = drawer(std::move(cases), on_progress);
        is_interrupted = results.interrupted;
        failure = results.failure;
        unsure += static_cast<size_t>(std::ranges::count_if(results.records, is_unsure));
        return results;
    };
    cases::Case one = loaded;
    const CaseRecord record = draw({one}, {}).records.front();
    const std::optional<fuzz::Symptom> symptom = fuzz::symptom_of(record);
    if (!failure.empty()) {
        throw stop_with(report::kExitInternal, failure);
    }
    if (!is_interrupted && !symptom) {
        throw why_nothing(loaded, record, !options.captures_command.empty());
    }
    std::optional<fuzz::Entry> entry;
    if (symptom) {
        entry = fuzz::reduce_case(text, *symptom, draw, kMostRounds, is_over);
    }
    progress.clear();
    if (is_interrupted && !entry) {
        complain("interrupted; nothing was written");
        return report::kExitInterrupted;
    }
    if (!failure.empty()) {
        throw stop_with(report::kExitInternal, failure);
    }
    if (!entry) {
        throw stop_with(
            report::kExitUnexpected,
            loaded.id + " did not fail the same way again, and cannot be reduced: " +
                (unsure > 0 ? cases::counted(unsure, "drawing") + " of it had no sure result"
                            : "it is a flake of the driver"));
    }
    std::string note = fmt::format("# {}, reduced from {}.\n", to_text(*symptom), loaded.id);
    note += fuzz::need_text(*entry);
    const std::string out = note + entry->text;
    if (options.run.output.empty()) {
        say(out);
    } else {
        must(write_text(options.run.output, out), report::kExitInternal);
    }
    if (is_interrupted) {
        complain(
            "interrupted; what it had come to is written, and may be larger than it has to be");
        return report::kExitInterrupted;
    }
    const auto reduced = cases::load_text(entry->text, "reduced", "reduced");
    if (!options.run.quiet && reduced) {
        std::fprintf(stderr, "%s\n",
                     fmt::format("from {} to {}, after drawing {}{}", size_text(loaded),
                                 size_text(reduced->front()), cases::counted(drawn, "case"),
                                 size_doubt(record, entry->is_minimal, unsure))
                         .c_str());
    }
    return report::kExitOk;
}

void declare(CLI::App& app, ReduceOptions& o) {
    add_case(&app, o.run.suite);
    add_device(&app, o.run.device);
    add_validation(&app, o.run.device);
    add_value(&app, "--captures-command", o.captures_command,
              "a renderer without Vulkan: words of a shell that draw the exported cases of the "
              "folder %in into the folder %out",
              "COMMAND", "Device");
    add_profile(&app, o.run.profile);
    add_judged_device(&app, o.judged);
    add_value(&app, "-o,--output", o.run.output, "the case file to write [standard output]", "FILE",
              "Output");
    app.add_flag("-q,--quiet", o.run.quiet, "say nothing else")->group("Output");
}

// A command takes the place of a device.
void check(const CLI::App& reduce, const ReduceOptions& o, const Words& words) {
    const auto refused = [](const std::string& sentence) { throw usage_error(sentence, "reduce"); };
    if (!is_given(reduce, "--captures-command", words)) {
        for (const std::string name : {"--subpixel-bits", "--sample-locations"}) {
            if (is_given(reduce, name.c_str(), words)) {
                refused(name +
                        " is for a renderer that --captures-command starts; devices tell it "
                        "themselves");
            }
        }
        return;
    }
    for (const char* name : {"--device", "--icd", "--renderer", "--validation"}) {
        if (is_given(reduce, name, words)) {
            refused(std::string(name) +
                    " chooses a device, and --captures-command draws without one; leave one "
                    "of them out");
        }
    }
    for (const char* word : {"%in", "%out"}) {
        if (o.captures_command.find(word) == std::string::npos) {
            refused(std::string("--captures-command has no ") + word + ", the folder of the " +
                    (word[1] == 'i' ? "exported cases" : "captures") +
                    "; write for example 'my-renderer %in %out'");
        }
    }
}

}  // namespace

Command reduce_command() {
    return make_command<ReduceOptions>(
        {"reduce", kChecking, "make a failing case as small as it can be, on the device",
         "  edgecase reduce multisample/scissor-tiled:samples=4 -o smaller.toml\n"
         "  edgecase reduce ties/apex-up --captures-command 'my-renderer %in %out'\n"},
        declare, carry_out, check);
}

}  // namespace cli
