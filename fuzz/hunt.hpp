// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The hunt of `edgecase fuzz`: draws generated cases, reduces what fails, and keeps one entry a
// cause.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cases/model/case.hpp"
#include "fuzz/cause.hpp"
#include "fuzz/generate/pose.hpp"
#include "run/session.hpp"

namespace fuzz {

struct HuntOptions {
    uint64_t seed = 1;
    uint64_t first_case = 0;  // numbers below are not made: a hunt that goes on
    uint64_t most_cases = 0;  // numbers from here on are not made; 0: no end
    std::optional<std::chrono::steady_clock::time_point> deadline;
    uint32_t shard = 1, shards = 1;  // poses are dealt out in turn
    size_t most_rounds = 400;        // of one reduction: batches of candidates
};

// One cause: the smallest case that shows it, and how often it was met.
struct Entry {
    Symptom symptom;
    std::set<std::string> essentials;  // of the reduced case
    // What else the reduced case breaks: in a case with the same essentials that is no news.
    std::set<std::pair<diff::FindingKind, std::string>> also;
    std::string text;                // of the reduced case
    std::vector<std::string> needs;  // "not with 1 sample": the nearest cases that pass
    bool is_minimal = false;
    bool is_known = false;    // from an earlier hunt
    std::string file;         // where it is kept; filled in by whoever keeps it
    uint64_t first_case = 0;  // the number of the case it was reduced from
    uint64_t count = 0;       // failing cases that it explains
};

struct HuntCounts {
    uint64_t next_case = 0;  // all below have been made
    uint64_t drawn = 0, triangles = 0, failed = 0;
    uint64_t unsupported = 0;
    uint64_t empty = 0;       // no sample must be covered: nothing to judge
    uint64_t unjudged = 0;    // errors of the judge
    uint64_t unrepeated = 0;  // failures that did not come again when they were to be reduced
    uint64_t poses = 0, pairs = 0;
    uint64_t reductions = 0, reduction_cases = 0;
    double drawing_seconds = 0, reducing_seconds = 0;
};

// Draws and judges cases, whose ids differ.
using Draw = std::function<std::vector<report::CaseRecord>(const std::vector<cases::Case>&)>;

// Makes a case file of one leaf as small as it can be while it shows a symptom. Nothing if it does
// not show it, or is no case.
std::optional<Entry> reduce_case(const std::string& text, const Symptom& symptom, const Draw& draw,
                                 size_t most_rounds);

// The text of a hunt's case.
std::string text_of_case(uint64_t seed, uint64_t number);

class Hunt {
  public:
    // Called at least five times a second.
    using OnProgress = std::function<void(const HuntCounts&, size_t entries)>;
    Hunt(HuntOptions options, run::Session& session, std::vector<Entry> known,
         OnProgress on_progress);

    enum class State { goes_on, done, interrupted, failed };
    // Draws some poses with their geometries, and reduces what is new. `failed`: failure() says
    // why.
    State step();
    const std::vector<Entry>& entries() const { return entries_; }
    std::vector<Entry>& entries() { return entries_; }
    const HuntCounts& counts() const { return counts_; }
    const std::string& failure() const { return failure_; }
    // Cases that could not be judged, with the reasons: each is an error of the judge.
    const std::vector<std::pair<std::string, std::string>>& unjudged() const { return unjudged_; }

  private:
    struct Made {
        std::string text;
        uint64_t number = 0;
    };
    struct Chunk {
        std::vector<Made> made;
        std::vector<cases::Case> cases;  // of made, in order
        uint64_t next_case = 0;
        size_t poses = 0, pairs = 0;
    };
    // A failing case that no entry explains.
    struct Open {
        Symptom symptom;
        std::string text;
        uint64_t number = 0;
    };

    Chunk make_chunk();
    bool is_over() const;
    std::optional<Symptom> unexplained(const report::CaseRecord& record,
                                       const std::set<std::string>& essentials);
    void reduce_open(std::vector<Open> open);
    std::optional<Entry> reduce_one(const Open& open);
    run::Session::Results draw(std::vector<cases::Case> cases);

    HuntOptions options_;
    run::Session& session_;
    OnProgress on_progress_;
    Poses poses_;
    uint64_t next_case_ = 0;  // of the generator, which is a chunk ahead
    std::future<Chunk> ahead_;
    std::vector<Entry> entries_;
    HuntCounts counts_;
    std::string failure_;
    bool is_interrupted_ = false;
    std::vector<std::pair<std::string, std::string>> unjudged_;
};

}  // namespace fuzz
