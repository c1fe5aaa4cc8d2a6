// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The hunt of `edgecase fuzz`: draws generated cases, reduces what fails, and keeps one entry a
// cause.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cases/base/fields.hpp"
#include "cases/model/case.hpp"
#include "fuzz/entry.hpp"
#include "fuzz/generate/source.hpp"
#include "run/session.hpp"

namespace fuzz {

// Failures that are known, and whose causes are not reduced yet.
class KnownFailures {
  public:
    using Tell = std::function<void(const std::string& what)>;  // what is done now
    KnownFailures() = default;
    KnownFailures(const KnownFailures&) = delete;
    KnownFailures& operator=(const KnownFailures&) = delete;
    virtual ~KnownFailures() = default;
    // The next cause that none of the entries explains. Nothing if there is none, or if `is_over`
    // has come true.
    virtual std::optional<Entry> next(const std::vector<Entry>& entries,
                                      const run::DrawAndJudge& draw,
                                      const std::function<bool()>& is_over, const Tell& tell) = 0;
    virtual bool is_empty() const = 0;  // all are reduced or explained
};

struct HuntOptions {
    using Clock = std::chrono::steady_clock;
    MakeSource source;           // of the cases
    uint64_t first_case = 0;     // numbers below are not made: a hunt that goes on
    uint64_t most_cases = 0;     // numbers from here on are not made; 0: no end
    std::vector<uint64_t> left;  // numbers below first_case that are drawn first
    std::optional<Clock::time_point> deadline;
    std::function<Clock::time_point()> now = Clock::now;
    std::function<bool()> is_interrupted = run::SignalFd::has_come;
    uint32_t shard = 1, shards = 1;      // groups of numbers are dealt out in turn
    size_t most_rounds = 400;            // of one reduction: batches of candidates
    std::set<cases::Door> broken_doors;  // cases through them are counted, not drawn
    // Reduced when a case fails that no entry explains, and before any case of the hunt.
    KnownFailures* known_failures = nullptr;
};

// A failing case of a hunt that waits for its reduction, and what no entry explains of it, the
// gravest first.
struct Waiting {
    uint64_t number = 0;
    std::vector<Symptom> symptoms;
};

struct HuntCounts {
    uint64_t next_case = 0;  // all below have been made
    uint64_t drawn = 0, triangles = 0, failed = 0;
    uint64_t unsupported = 0;
    uint64_t through_broken_doors = 0;  // and so not drawn
    uint64_t empty = 0;                 // no sample must be covered: nothing to judge
    uint64_t unjudged = 0;              // errors of the judge
    uint64_t unrepeated = 0;  // failures that did not come again when they were to be reduced
    uint64_t refused = 0;     // changes of other cases that made no case
    uint64_t missing = 0;     // numbers that have no case, or one that takes minutes to judge
    uint64_t poses = 0, pairs = 0;
    uint64_t reductions = 0, reduction_cases = 0;
    double drawing_seconds = 0, reducing_seconds = 0;
    static void fields(auto&& visit, auto&... c) {
        visit("next_case", c.next_case...);
        visit("judged_cases", c.drawn...);
        visit("triangles", c.triangles...);
        visit("failed_cases", c.failed...);
        visit("unsupported_cases", c.unsupported...);
        visit({"cases_through_broken_doors", cases::kOlderLackIt}, c.through_broken_doors...);
        visit("empty_cases", c.empty...);
        visit("unjudged_cases", c.unjudged...);
        visit("unrepeated_failures", c.unrepeated...);
        visit({"refused_changes", cases::kOlderLackIt}, c.refused...);
        visit({"numbers_without_case", cases::kOlderLackIt}, c.missing...);
        visit("poses", c.poses...);
        visit("pairs_of_features", c.pairs...);
        visit("reductions", c.reductions...);
        visit("reduction_cases", c.reduction_cases...);
        visit("drawing_seconds", c.drawing_seconds...);
        visit("reducing_seconds", c.reducing_seconds...);
    }
};

// The text of the case with that number, which must not be of a group below one that was entered;
// empty if it has none.
std::string text_of_case(Source& source, uint64_t number);

class Hunt {
  public:
    // Called at least five times a second. `doing`: "drawing, 5 of 960", "reducing case 77".
    using OnProgress = std::function<void(const HuntCounts&, const std::vector<Entry>& entries,
                                          const std::string& doing)>;
    // `known`: entries of earlier hunts, and of this one if it goes on, as is what waits.
    Hunt(HuntOptions options, run::DrawAndJudge draw, std::vector<Entry> known,
         const std::vector<Waiting>& waiting, OnProgress on_progress);

    enum class State { goes_on, done, interrupted, failed };
    // Draws some poses with their geometries, and reduces what is new; draws none while too much
    // waits for its reduction. Done when the time is over, or, by number, when nothing waits. Ends
    // at once when the time is over, or by a signal: what has no result by then is left().
    // `failed`: failure() says why.
    State step();
    // What is reduced. With waiting() and counts().unrepeated each failing case counts once.
    const std::vector<Entry>& entries() const { return entries_; }
    std::vector<Entry>& entries() { return entries_; }
    // The failing cases that no entry explains: a hunt that goes on reduces them first.
    std::vector<Waiting> waiting() const;
    // Numbers of cases that were made and are neither judged nor counted: a hunt that goes on draws
    // them first.
    std::vector<uint64_t> left() const;
    // Of what waits the smallest of each gravest symptom, as it was drawn, and how many have it.
    std::vector<Entry> not_reduced() const;
    const HuntCounts& counts() const { return counts_; }
    const std::string& failure() const { return failure_; }
    // Cases that could not be judged, with the reasons: each is an error of the judge, or of the
    // generator, if the validation layer finds fault with it.
    const std::vector<std::pair<std::string, std::string>>& unjudged() const { return unjudged_; }
    // The texts of cases whose failure did not come again, some of many.
    const std::vector<std::string>& unrepeated() const { return unrepeated_; }

  private:
    struct Made {
        std::string text;
        uint64_t number = 0;
    };
    struct Chunk {
        std::vector<Made> made;
        std::vector<cases::Case> cases;  // of made, in order
        uint64_t next_case = 0;
        uint64_t poses = 0, pairs = 0, refused = 0, missing = 0;
    };
    // A failing case with symptoms that no entry explains.
    struct Open {
        Waiting waiting;
        std::string text;
        Facts facts;
        std::optional<size_t> entry;  // that explains the gravest symptom of those explained
        bool is_unrepeated = false;
    };

    void take_up(const std::vector<Waiting>& waiting);
    Chunk make_chunk();
    bool is_over() const;
    bool is_through_broken_door(const cases::Case& c) const;
    void leave_out_broken_doors(Chunk& chunk);
    void draw_chunk(Chunk chunk);
    void keep_unjudged(const std::string& text, const std::string& reason);
    void explain(Open& open) const;
    void count(const Open& open);
    void reduce_open();
    void reduce_one(Open& open);
    bool has_known_left() const;
    void meet_known();
    void tell_progress() const { on_progress_(counts_, entries_, doing_); }
    run::Session::Results draw(std::vector<cases::Case> cases);
    // Of a reduction, which the end of the time cuts.
    run::Session::Results draw_candidates(std::vector<cases::Case> cases, bool& is_cut);
    bool is_at_end(bool is_cut);

    HuntOptions options_;
    run::DrawAndJudge draw_;
    OnProgress on_progress_;
    std::unique_ptr<Source> source_;
    uint64_t next_case_ = 0;  // of the source, which is a chunk ahead
    std::future<Chunk> ahead_;
    std::optional<Chunk> again_;  // of what an earlier hunt has left
    std::vector<uint64_t> left_;
    std::vector<Entry> entries_;
    std::vector<Open> open_;
    bool is_behind_ = false;  // what is open is reduced before another case is drawn
    HuntCounts counts_;
    std::string doing_;
    std::string failure_;
    bool is_interrupted_ = false;
    std::vector<std::pair<std::string, std::string>> unjudged_;
    std::vector<std::string> unrepeated_;
};

}  // namespace fuzz
