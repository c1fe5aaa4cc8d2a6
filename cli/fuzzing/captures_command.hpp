// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A renderer that no worker drives: cases are exported to a folder, a command draws them, and what
// it has delivered is judged, as 'diff' does (docs/other-renderers.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cli/options/stop.hpp"
#include "report/record/run.hpp"
#include "run/process/signal_fd.hpp"

namespace cli {

struct CapturesOptions {
    std::string command;  // for a shell; %in and %out stand for folders
    double seconds = 30;  // for one start of the command
    ref::Limits limits = {};
    cases::Profile profile = cases::Profile::direct3d;
    std::function<void()> on_wait = {};  // called again and again while a command runs
};

class CapturesCommand {
  public:
    // Makes a folder of its own, which goes with the object.
    static CapturesCommand open(CapturesOptions options, run::SignalFd& signals);
    CapturesCommand(CapturesCommand&& other) noexcept;
    CapturesCommand(const CapturesCommand&) = delete;
    CapturesCommand& operator=(CapturesCommand&&) = delete;
    CapturesCommand& operator=(const CapturesCommand&) = delete;
    ~CapturesCommand();

    // Draws and judges cases, whose ids differ, in one start of the command. If that fails, in two
    // of half the cases each, and so on: a record then says of one case that the command crashed
    // (by a signal), took too long, or cannot be used (not_run, with the reason). After an
    // interruption all are not_run.
    std::vector<report::CaseRecord> draw(const std::vector<cases::Case>& cases);
    bool is_interrupted() const { return is_interrupted_; }

  private:
    struct End {
        enum class Kind : uint8_t { well, crash, timeout, error, interrupted } kind = Kind::well;
        std::string signal;  // of a crash
        std::string reason;  // of all but `well`
    };
    CapturesCommand(CapturesOptions options, run::SignalFd& signals, std::filesystem::path folder);
    End start(const std::filesystem::path& in, const std::filesystem::path& out);
    End draw_to(const std::filesystem::path& in, const std::filesystem::path& out,
                const std::vector<cases::Case>& cases);

    CapturesOptions options_;
    run::SignalFd* signals_;
    std::filesystem::path folder_;
    uint64_t starts_ = 0;
    bool is_interrupted_ = false;
};

}  // namespace cli
