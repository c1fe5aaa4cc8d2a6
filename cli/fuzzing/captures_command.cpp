// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/captures_command.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "capture/exchange/export_case.hpp"
#include "capture/exchange/plane_files.hpp"
#include "cases/base/printable.hpp"
#include "cli/options/program.hpp"
#include "cli/prepare/outputs.hpp"
#include "run/judge.hpp"
#include "run/process/process.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;
using report::Status;
using Clock = std::chrono::steady_clock;

namespace {

// "my-renderer %in %out" as a script in which $1 and $2 are the folders: a shell never reads their
// names as anything but words, whatever is in them. Each stands in double quotes of its own unless
// it is in some already, and ends single ones for its length.
std::string with_parameters(const std::string& command) {
    std::string text;
    char quote = 0;
    for (size_t k = 0; k < command.size(); ++k) {
        const bool is_in = command.compare(k, 3, "%in") == 0;
        if (is_in || command.compare(k, 4, "%out") == 0) {
            const char* parameter = is_in ? "${1}" : "${2}";
            text += quote == '"'    ? parameter
                    : quote == '\'' ? fmt::format("'\"{}\"'", parameter)
                                    : fmt::format("\"{}\"", parameter);
            k += is_in ? 2 : 3;
            continue;
        }
        const char c = command[k];
        text += c;
        if (c == '\\' && quote != '\'' && k + 1 < command.size()) {
            text += command[++k];
        } else if (c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '"' || c == '\'')) {
            quote = c;
        }
    }
    return text;
}

// What a command said last, for the sentence about its end.
std::string last_line(const std::string& output) {
    constexpr size_t kMost = 200;
    std::string text = output;
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ' || text.back() == '\r')) {
        text.pop_back();
    }
    const size_t begin = text.rfind('\n');
    text = cases::printable(begin == std::string::npos ? text : text.substr(begin + 1));
    return text.empty() ? "it said nothing" : "it said '" + text.substr(0, kMost) + "'";
}

void read_all(int fd, run::HeadAndTail& to) {
    std::array<char, 4096> buffer;
    for (ssize_t n = 0; (n = ::read(fd, buffer.data(), buffer.size())) > 0;) {
        to.add({buffer.data(), static_cast<size_t>(n)});
    }
}

}  // namespace

CapturesCommand CapturesCommand::open(CapturesOptions options, run::SignalFd& signals) {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    std::string name = ((error ? fs::path("/tmp") : parent) / "edgecase-reduce-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw stop_with(report::kExitInternal, "no folder for exported cases can be made in '" +
                                                   parent.string() + "': " + std::strerror(errno));
    }
    return CapturesCommand(std::move(options), signals, name);
}

CapturesCommand::CapturesCommand(CapturesOptions options, run::SignalFd& signals, fs::path folder)
    : options_(std::move(options)), signals_(&signals), folder_(std::move(folder)) {}

CapturesCommand::CapturesCommand(CapturesCommand&& other) noexcept
    : options_(std::move(other.options_)),
      signals_(other.signals_),
      folder_(std::exchange(other.folder_, {})),
      starts_(other.starts_),
      is_interrupted_(other.is_interrupted_) {}

CapturesCommand::~CapturesCommand() {
    if (!folder_.empty()) {
        std::error_code none;
        fs::remove_all(folder_, none);
    }
}

CapturesCommand::End CapturesCommand::start(const fs::path& in, const fs::path& out) {
    using Kind = End::Kind;
    auto child = run::spawn({{"/bin/sh", "-c", with_parameters(options_.command), "edgecase",
                              in.string(), out.string()},
                             false});
    if (!child) {
        return {Kind::error, "", child.error().message};
    }
    const Clock::time_point begin = Clock::now();
    run::HeadAndTail said;
    bool is_late = false;
    while (!run::has_ended(*child)) {
        // Its output is not waited for: programs that it leaves behind may hold it open.
        std::array<pollfd, 2> fds{{{signals_->fd(), POLLIN, 0}, {child->output.get(), POLLIN, 0}}};
        ::poll(fds.data(), fds.size(), 5);
        read_all(child->output.get(), said);
        if (options_.on_wait) {
            options_.on_wait();
        }
        is_interrupted_ = is_interrupted_ || signals_->has_come();
        is_late = std::chrono::duration<double>(Clock::now() - begin).count() > options_.seconds;
        if (is_interrupted_ || is_late) {
            break;
        }
    }
    const run::ExitStatus status = run::kill_and_reap(*child, 0);
    read_all(child->output.get(), said);
    if (is_interrupted_) {
        return {Kind::interrupted, "", "interrupted"};
    }
    if (is_late) {
        return {Kind::timeout, "",
                fmt::format("the command did not end within {} s and was killed; --timeout gives "
                            "it longer",
                            options_.seconds)};
    }
    // A shell tells of its child's death as 128 and the signal.
    constexpr int kSignalled = 128, kNotFound = 127, kNotExecutable = 126;
    if (status.signalled || (status.code > kSignalled && status.code < kSignalled + 65)) {
        const std::string signal =
            run::signal_name(status.signalled ? status.code : status.code - kSignalled);
        return {Kind::crash, signal, "the command was ended by " + signal};
    }
    if (status.code == kNotFound || status.code == kNotExecutable) {
        return {
            Kind::error, "",
            fmt::format("the shell could not start the command '{}' (exit code {}): {}",
                        cases::printable(options_.command), status.code, last_line(said.text()))};
    }
    if (status.code != 0) {
        return {Kind::error, "",
                fmt::format("the command ended with exit code {}: {}", status.code,
                            last_line(said.text()))};
    }
    return {};
}

CapturesCommand::End CapturesCommand::draw_to(const fs::path& in, const fs::path& out,
                                              const std::vector<cases::Case>& cases) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::error_code error;
    fs::create_directories(in, error);
    fs::create_directories(out, error);
    for (const cases::Case& c : cases) {
        const std::string name = capture::folder_of(c.id);
        fs::create_directories((in / name).parent_path(), error);
        if (auto written = write_text((in / (name + ".json")).string(), capture::export_case(c));
            !written) {
            return {End::Kind::error, "", written.error().message};
        }
        list.push_back({{"id", c.id},
                        {"file", name + ".json"},
                        {"folder", name},
                        {"needs", capture::needs_of(c)}});
    }
    const nlohmann::ordered_json index = {{"schema", "edgecase-export-1"},
                                          {"tool", {{"name", "edgecase"}, {"version", kVersion}}},
                                          {"cases", std::move(list)}};
    if (auto written = write_text((in / "index.json").string(), index.dump(1) + "\n"); !written) {
        return {End::Kind::error, "", written.error().message};
    }
    return start(in, out);
}

std::vector<CaseRecord> CapturesCommand::draw(const std::vector<cases::Case>& cases) {
    std::vector<CaseRecord> records;
    for (const cases::Case& c : cases) {
        records.push_back(run::planned_case(c));
        records.back().status = Status::not_run;
    }
    if (is_interrupted_ || cases.empty()) {
        return records;
    }
    const fs::path folder = folder_ / std::to_string(++starts_);
    const fs::path out = folder / "captures";
    const End end = draw_to(folder / "cases", out, cases);
    std::error_code none;
    if (end.kind != End::Kind::well && cases.size() > 1 && !is_interrupted_) {
        // Which of them was it?
        fs::remove_all(folder, none);
        const auto middle = cases.begin() + static_cast<ptrdiff_t>(cases.size() / 2);
        records = draw({cases.begin(), middle});
        for (CaseRecord& record : draw({middle, cases.end()})) {
            records.push_back(std::move(record));
        }
        return records;
    }
    for (size_t k = 0; k < cases.size(); ++k) {
        CaseRecord& record = records[k];
        record.reason = end.reason;
        if (end.kind == End::Kind::crash || end.kind == End::Kind::timeout) {
            record.status = end.kind == End::Kind::crash ? Status::crash : Status::timeout;
            record.death.signal = end.signal;
        }
        if (end.kind != End::Kind::well) {
            continue;
        }
        const auto read = capture::read_planes(out / capture::folder_of(cases[k].id), cases[k]);
        record.drawn.attempts = 1;
        if (!read) {
            record.status = Status::error;
            record.reason = read.error().message;
        } else if (!read->unsupported.empty()) {
            record.status = Status::unsupported;
            record.reason = "the renderer says: " + cases::printable(read->unsupported);
        } else if (read->planes.is_empty()) {
            record.reason = "the command ended well and delivered no plane of the case in '%out/" +
                            capture::folder_of(cases[k].id) + "'";
        } else {
            run::judge_delivered(record, cases[k], read->planes, options_.limits, options_.profile,
                                 run::KeepPictures::none);
        }
    }
    fs::remove_all(folder, none);
    return records;
}

}  // namespace cli
