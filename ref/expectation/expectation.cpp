// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/expectation.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/narrowing.hpp"
#include "ref/expectation/on_demand.hpp"
#include "ref/expectation/onlooker.hpp"
#include "ref/expectation/scene.hpp"

namespace ref {

bool HitBounds::allows(uint32_t front, uint32_t back) const {
    const int64_t balance = int64_t{front} - int64_t{back};
    const uint64_t total = uint64_t{front} + back;
    return front >= front_min && front <= front_max && back >= back_min && back <= back_max &&
           balance >= signed_min && balance <= signed_max && total >= total_min &&
           total <= total_max;
}

bool HitBounds::allows(const path::SeenHits& seen) const {
    using enum path::SeenHits::Detail;
    const auto allows_total = [&](uint32_t total) {
        for (uint32_t front = 0; front <= total; ++front) {
            if (allows(front, total - front)) {
                return true;
            }
        }
        return false;
    };
    switch (seen.detail) {
        case none:
            return true;
        case faces:
            return allows(seen.front, seen.back);
        case total:
            return seen.front <= total_max && allows_total(seen.front);
        case any:
            break;
    }
    return seen.front == 0 ? allows(0, 0) : total_max > 0;
}

bool HitBounds::is_decided() const {
    if (front_min == front_max && back_min == back_max) {
        return allows(front_min, back_min);
    }
    int64_t pairs = 0;
    for (int64_t front = front_min; front <= front_max && pairs < 2; ++front) {
        const int64_t low =
            std::max({int64_t{back_min}, int64_t{total_min} - front, front - signed_max});
        const int64_t high =
            std::min({int64_t{back_max}, int64_t{total_max} - front, front - signed_min});
        pairs += std::max<int64_t>(0, high - low + 1);
    }
    return pairs == 1;
}

namespace {

// The spans of each row of pixels of the stacked layers.
class SpansByRow {
  public:
    SpansByRow(const cases::Target& target, const std::vector<fast::Span>& spans)
        : row_begin_(size_t{target.rows()} + 1), sorted_(spans.size()) {
        // A stable counting sort by row: the spans of a sample stay in drawing order.
        for (const fast::Span& s : spans) {
            ++row_begin_[s.y + 1];
        }
        std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
        std::vector<size_t> next = row_begin_;
        for (const fast::Span& s : spans) {
            sorted_[next[s.y]++] = s;
        }
    }
    std::span<const fast::Span> of(uint32_t row) const {
        return std::span(sorted_).subspan(row_begin_[row], row_begin_[row + 1] - row_begin_[row]);
    }

  private:
    std::vector<size_t> row_begin_;
    std::vector<fast::Span> sorted_;
};

// Splits a row into runs of pixels whose sample of one number is touched by the same triangles.
class RowRuns {
  public:
    struct Run {
        uint32_t x0 = 0, x1 = 0;
        size_t hits_begin = 0, hits_count = 0;
    };

    // Runs that something touches, from left to right.
    const std::vector<Run>& split(std::span<const fast::Span> row, uint32_t sample) {
        runs_.clear();
        hits_.clear();
        active_.clear();
        starts_.clear();
        for (uint32_t k = 0; k < row.size(); ++k) {
            if (row[k].sample == sample && row[k].x0 < row[k].x1) {
                starts_.push_back(k);
            }
        }
        std::stable_sort(starts_.begin(), starts_.end(),
                         [&](uint32_t a, uint32_t b) { return row[a].x0 < row[b].x0; });
        size_t next = 0;
        while (next < starts_.size() || !active_.empty()) {
            // Spans begin and end at x; `active_` are those that reach beyond it, in drawing order.
            const uint32_t x = active_.empty() ? row[starts_[next]].x0 : x_;
            for (; next < starts_.size() && row[starts_[next]].x0 == x; ++next) {
                active_.insert(std::upper_bound(active_.begin(), active_.end(), starts_[next]),
                               starts_[next]);
            }
            x_ = next < starts_.size() ? row[starts_[next]].x0 : row[active_.front()].x1;
            for (const uint32_t k : active_) {
                x_ = std::min(x_, row[k].x1);
            }
            runs_.push_back({x, x_, hits_.size(), active_.size()});
            for (const uint32_t k : active_) {
                hits_.push_back({row[k].triangle, row[k].coverage});
            }
            std::erase_if(active_, [&](uint32_t k) { return row[k].x1 == x_; });
        }
        return runs_;
    }
    const std::vector<Run>& runs() const { return runs_; }  // of the last split()
    std::span<const Hit> hits_of(const Run& run) const {
        return std::span(hits_).subspan(run.hits_begin, run.hits_count);
    }

  private:
    uint32_t x_ = 0;  // where the next run begins, if a span goes on there
    std::vector<uint32_t> starts_;
    std::vector<uint32_t> active_;
    std::vector<Run> runs_;
    std::vector<Hit> hits_;
};

}  // namespace

Expectation expect(const cases::Case& c, const Limits& limits, cases::Profile profile,
                   Onlooker* onlooker) {
    Scene scene(c, limits, profile, false);
    return expect(scene, onlooker);
}

stencil::Values stencils_at(const Expectation& e, const SampleExpectation& s,
                            std::optional<std::pair<uint32_t, uint32_t>> hits) {
    const bool is_unknown =
        s.stencils_count == 0 && e.target.stencil_load == cases::LoadOp::dont_care;
    return path::values_of(e.stencils_of(s), s.is_free || is_unknown, e.target.stencil_clear, hits);
}

std::vector<uint32_t> shown_at(const Expectation& e, const SampleExpectation& s) {
    std::vector<uint32_t> out;
    for (const path::Fragment& f : e.fragments_of(s)) {
        if (!f.is_discarded_front || f.is_clear) {
            out.push_back(f.triangle);
        }
    }
    return out;
}

path::Question question_of(const Expectation& e, const cases::Case& c, const SampleExpectation& s) {
    path::Question out;
    out.clear = c.target.stencil_clear;
    out.is_unknown = c.target.stencil_load == cases::LoadOp::dont_care;
    const auto fragments = e.fragments_of(s);
    out.fragments.assign(fragments.begin(), fragments.end());
    for (path::Fragment& f : out.fragments) {
        f.state = c.target.has_stencil ? &c.draws[e.triangles[f.triangle].draw].stencil
                                       : &path::kKeepStencil;
    }
    const auto sets = std::span(e.sets).subspan(s.sets_begin, s.sets_count);
    out.sets.assign(sets.begin(), sets.end());
    if (const std::span<const TestedDepth> tests = e.tests_of(s); !tests.empty()) {
        const auto tested = [tests](int stored, uint32_t fragment) {
            const std::pair key(fragment, stored);
            const auto at = std::ranges::lower_bound(tests, key, {}, [](const TestedDepth& t) {
                return std::pair(t.fragment, t.stored);
            });
            // What no path gets to is not kept.
            return at != tests.end() && std::pair(at->fragment, at->stored) == key
                       ? *at
                       : TestedDepth{fragment, stored, DepthOutcome::open, DepthOutcome::open};
        };
        if (tests_bounds(c)) {
            out.bounds = [tested](int stored, uint32_t m) { return tested(stored, m).bounds; };
        }
        out.depth = [tested](int stored, uint32_t m) { return tested(stored, m).depth; };
    }
    return out;
}

bool is_same(const Expectation& a, const Expectation& b, size_t index) {
    const SampleExpectation& one = a.samples[index];
    const SampleExpectation& other = b.samples[index];
    return one.hits == other.hits && one.depth_may_be_clear == other.depth_may_be_clear &&
           one.is_free == other.is_free &&
           std::ranges::equal(a.stencils_of(one), b.stencils_of(other)) &&
           std::ranges::equal(a.writers_of(one), b.writers_of(other)) &&
           std::ranges::equal(a.depth_writers_of(one), b.depth_writers_of(other));
}

namespace {

// The expectation of a scene, row by row or sample by sample.
class RowJudge {
  public:
    RowJudge(Scene& scene, Onlooker* onlooker)
        : scene_(scene),
          target_(scene.c.target),
          spans_(target_, scene.spans),
          onlooker_(onlooker) {
        out_.limits = scene.limits;
        out_.profile = scene.profile;
        out_.target = target_;
        out_.triangles = scene.triangles;
        out_.samples = SampleExpectations(size_t{target_.width} * target_.rows() * target_.samples);
        is_thinned_ = takes_away_pixels(scene.c);
        runs_.resize(target_.samples);
        alone_.resize(scene.triangles.size());
    }

    Expectation run() {
        for (uint32_t row = 0; row < target_.rows(); ++row) {
            const std::span<const fast::Span> spans = spans_.of(row);
            if (onlooker_ != nullptr) {
                judge_each(row, spans);
            } else if (!spans.empty()) {
                judge_runs(row, spans);
            }
        }
        return std::move(out_);
    }

    // The same with what is expected of one more sample.
    const Expectation& with(size_t index) {
        if (is_known_.empty()) {
            is_known_.resize(out_.samples.size());
            split_.assign(target_.samples, ~uint32_t{0});
        }
        if (is_known_[index]) {
            return out_;
        }
        is_known_[index] = true;
        const auto s = static_cast<uint32_t>(index % target_.samples);
        const auto x = static_cast<uint32_t>(index / target_.samples % target_.width);
        const auto row = static_cast<uint32_t>(index / target_.samples / target_.width);
        if (split_[s] != row) {
            runs_[s].split(spans_.of(row), s);
            split_[s] = row;
        }
        const std::vector<RowRuns::Run>& runs = runs_[s].runs();
        const auto run = std::partition_point(runs.begin(), runs.end(),
                                              [x](const RowRuns::Run& r) { return r.x1 <= x; });
        if (run != runs.end() && run->x0 <= x) {
            const std::span<const Hit> hits = left_of(runs_[s].hits_of(*run), {x, row, s});
            keep(index, 1, number_at({x, row, s}, hits));
        }
        return out_;
    }

  private:
    size_t index_of(uint32_t row, uint32_t x, uint32_t s) const {
        return (size_t{row} * target_.width + x) * target_.samples + s;
    }

    void judge_runs(uint32_t row, std::span<const fast::Span> spans) {
        for (uint32_t s = 0; s < target_.samples; ++s) {
            for (const RowRuns::Run& run : runs_[s].split(spans, s)) {
                const std::span<const Hit> hits = runs_[s].hits_of(run);
                if (!is_thinned_ && scene_.narrowing.is_anywhere(hits)) {
                    keep(index_of(row, run.x0, s), run.x1 - run.x0, number_of(hits));
                    continue;
                }
                for (uint32_t x = run.x0; x < run.x1; ++x) {
                    keep(index_of(row, x, s), 1,
                         number_at({x, row, s}, left_of(hits, {x, row, s})));
                }
            }
        }
    }

    // The same sample by sample, which an onlooker sees in their order.
    void judge_each(uint32_t row, std::span<const fast::Span> spans) {
        std::vector<size_t> next(target_.samples, 0);
        for (uint32_t s = 0; s < target_.samples; ++s) {
            runs_[s].split(spans, s);
        }
        for (uint32_t x = 0; x < target_.width; ++x) {
            for (uint32_t s = 0; s < target_.samples; ++s) {
                const std::vector<RowRuns::Run>& runs = runs_[s].runs();
                while (next[s] < runs.size() && runs[next[s]].x1 <= x) {
                    ++next[s];
                }
                const bool is_touched = next[s] < runs.size() && runs[next[s]].x0 <= x;
                const std::span<const Hit> hits =
                    is_touched ? left_of(runs_[s].hits_of(runs[next[s]]), {x, row, s})
                               : std::span<const Hit>();
                if (hits.empty() && onlooker_ == nullptr) {
                    continue;
                }
                JudgeReasons reasons;
                const uint32_t number = number_at({x, row, s}, hits, &reasons);
                keep(index_of(row, x, s), 1, number);
                show({x, row, s}, hits, number, reasons);
            }
        }
    }

    struct Place {
        uint32_t x, row, s;
    };

    FixedPoint position(const Place& at) const {
        return sample_position(at.x, at.row % target_.height, at.s, target_);
    }

    // The hits whose fragments are not taken away by their pixel or a value; until the next call.
    std::span<const Hit> left_of(std::span<const Hit> hits, const Place& at) {
        if (!is_thinned_) {
            return hits;
        }
        left_.clear();
        const cases::SampleId id{at.x, at.row % target_.height, at.s, at.row / target_.height};
        for (const Hit& hit : hits) {
            const cases::Draw& draw = scene_.c.draws[scene_.triangles[hit.triangle].draw];
            const Sign sign = takes_away_by_value(draw) ? scene_.discards.at(hit.triangle, id)
                                                        : Sign::not_negative;
            if (sign != Sign::negative && !takes_away_pixel(draw, id.x, id.y)) {
                left_.push_back(sign == Sign::open ? but_for_value(hit) : hit);
            }
        }
        return left_;
    }

    // The number of what the hits of a sample come to. What holds anywhere needs no reasons.
    uint32_t number_at(const Place& at, std::span<const Hit> hits,
                       JudgeReasons* reasons = nullptr) {
        return hits.empty() || scene_.narrowing.is_anywhere(hits) ? number_of(hits)
                                                                  : judge(at, hits, reasons);
    }

    uint32_t judge(const Place& at, std::span<const Hit> hits, JudgeReasons* reasons = nullptr) {
        SampleExpectation sample = scene_.narrowing.judge(position(at), at.s, hits, out_, reasons);
        return out_.samples.add(sample);
    }

    void show(const Place& at, std::span<const Hit> hits, uint32_t number,
              const JudgeReasons& reasons) {
        const SampleExpectation& sample = out_.samples.of_number(number);
        if (onlooker_ != nullptr &&
            !onlooker_->look({index_of(at.row, at.x, at.s),
                              {at.x, at.row % target_.height, at.s, at.row / target_.height},
                              position(at),
                              hits,
                              sample.hits,
                              out_.writers_of(sample),
                              reasons},
                             scene_.setups)) {
            onlooker_ = nullptr;
        }
    }

    // The number of what these triangles come to wherever the sample lies.
    uint32_t number_of(std::span<const Hit> hits) {
        if (hits.empty()) {
            return SampleExpectations::kNothing;
        }
        const bool is_alone = hits.size() == 1 && hits[0].coverage == Coverage::must;
        uint32_t& known = is_alone ? alone_[hits[0].triangle] : last_number_;
        const bool is_known =
            known != SampleExpectations::kNothing && (is_alone || std::ranges::equal(hits, last_));
        if (!is_known) {
            known = judge({0, 0, 0}, hits);
            if (!is_alone) {
                last_.assign(hits.begin(), hits.end());
            }
        }
        return known;
    }

    void keep(size_t first, size_t count, uint32_t number) {
        const HitBounds& bounds = out_.samples.of_number(number).hits;
        out_.samples.set(first, count, target_.samples, number);
        out_.must_samples += bounds.total_min > 0 ? count : 0U;
        out_.either_samples += bounds.is_decided() ? 0U : count;
    }

    Scene& scene_;
    const cases::Target& target_;
    SpansByRow spans_;
    Onlooker* onlooker_;
    bool is_thinned_ = false;      // some fragments are taken away by their pixel
    std::vector<Hit> left_;        // of left_of()
    std::vector<RowRuns> runs_;    // by sample of the pixel
    std::vector<uint32_t> alone_;  // numbers by triangle: it alone must cover the sample
    std::vector<Hit> last_;        // the last list of number_of() that is another one,
    uint32_t last_number_ = SampleExpectations::kNothing;  // and its number
    std::vector<bool> is_known_;   // by sample, of with(); empty until that is asked
    std::vector<uint32_t> split_;  // the row that runs_ have, by sample of the pixel
    Expectation out_;
};

}  // namespace

std::function<const Expectation&(size_t)> expect_on_demand(Scene& scene) {
    return [judge = std::make_shared<RowJudge>(scene, nullptr)](
               size_t index) -> const Expectation& { return judge->with(index); };
}

Expectation expect(Scene& scene, Onlooker* onlooker) {
    return RowJudge(scene, onlooker).run();
}

}  // namespace ref
