// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The causes that expectation files explain, as a hunt knows causes: each reduced once, so that it
// is told apart by what it needs and not by the ids of cases.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "cli/prepare/suite.hpp"
#include "fuzz/hunt.hpp"
#include "report/record/run.hpp"
#include "run/expected/expectation_file.hpp"
#include "run/session.hpp"

namespace cli {

// Cases of the suite that are expected to fail here, and how.
struct ExpectedFailures {
    struct Failing {
        cases::Case data;
        run::ExpectationLine line;
    };
    std::vector<Failing> cases;
    std::set<cases::Door> broken_doors;  // "door=NAME skip"
    size_t files = 0;                    // expectation files that speak of them
    std::string checksum;                // of what they say of which cases; empty if nothing
};

// By --expect or the files beside the suite that fit the device; nothing with --no-expect, and
// where there is no suite. Errors: invalid files (3), an --expect that does not fit (5).
ExpectedFailures expected_failures(const Program& program, const RunOptions& options,
                                   const capture::DeviceInfo& device);

// What they come of. They are drawn when the first cause is asked for.
class KnownCauses : public fuzz::KnownFailures {
  public:
    explicit KnownCauses(ExpectedFailures expected) : expected_(std::move(expected)) {}
    std::optional<fuzz::Entry> next(const std::vector<fuzz::Entry>& entries,
                                    const run::DrawAndJudge& draw,
                                    const std::function<bool()>& is_over,
                                    const Tell& tell) override;
    bool is_empty() const override { return is_drawn_ && open_.empty(); }
    const ExpectedFailures& expected() const { return expected_; }
    size_t failing() const { return failing_; }  // cases that fail as expected
    size_t causes() const { return causes_; }
    size_t left() const { return left_; }  // symptoms that were not reduced: too many causes
    double seconds() const { return seconds_; }

  private:
    // A case that fails as an expectation file says, and what no entry explains of it.
    struct Open {
        std::string id, text, bug;
        fuzz::Facts facts;
        std::vector<fuzz::Symptom> symptoms;
    };
    void draw_all(const run::DrawAndJudge& draw, const std::function<bool()>& is_over);
    void explain(const std::vector<fuzz::Entry>& entries);

    ExpectedFailures expected_;
    std::vector<Open> open_;
    bool is_drawn_ = false;
    size_t failing_ = 0, causes_ = 0, left_ = 0;
    double seconds_ = 0;
};

}  // namespace cli
