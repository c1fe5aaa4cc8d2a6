// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/expectation.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/narrowing.hpp"
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

// The spans of each row of pixels of the stacked layers, and, one row at a time, the triangles that
// touch each sample.
class HitTable {
  public:
    HitTable(const cases::Target& target, const std::vector<fast::Span>& spans)
        : samples_(target.samples), row_begin_(size_t{target.rows()} + 1), sorted_(spans.size()) {
        // A stable counting sort by row: the spans of a sample stay in drawing order.
        for (const fast::Span& s : spans) {
            ++row_begin_[s.y + 1];
        }
        std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
        std::vector<size_t> next = row_begin_;
        for (const fast::Span& s : spans) {
            sorted_[next[s.y]++] = s;
        }
        begin_.resize(size_t{target.width} * target.samples + 1);
    }
    // How many hits all samples have together.
    size_t size() const {
        return std::accumulate(sorted_.begin(), sorted_.end(), size_t{0},
                               [](size_t n, const fast::Span& s) { return n + s.x1 - s.x0; });
    }
    // Makes row j the current one; false if nothing touches it.
    bool select_row(uint32_t j) {
        const std::span<const fast::Span> row(sorted_.data() + row_begin_[j],
                                              row_begin_[j + 1] - row_begin_[j]);
        if (row.empty()) {
            return false;
        }
        std::fill(begin_.begin(), begin_.end(), 0U);
        for (const fast::Span& s : row) {
            size_t at = size_t{s.x0} * samples_ + s.sample;
            for (uint32_t x = s.x0; x < s.x1; ++x, at += samples_) {
                ++begin_[at];
            }
        }
        // Ends of the lists; filling from behind makes them the begins.
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        hits_.resize(begin_.back());
        for (auto s = row.rbegin(); s != row.rend(); ++s) {
            size_t at = size_t{s->x0} * samples_ + s->sample;
            for (uint32_t x = s->x0; x < s->x1; ++x, at += samples_) {
                hits_[--begin_[at]] = {s->triangle, s->coverage};
            }
        }
        return true;
    }
    // Sample k of the current row: pixel k / samples, sample k % samples.
    std::span<const Hit> of(size_t k) const {
        return {hits_.data() + begin_[k], begin_[k + 1] - begin_[k]};
    }

  private:
    uint32_t samples_;
    std::vector<size_t> row_begin_;
    std::vector<fast::Span> sorted_;
    std::vector<uint32_t> begin_;
    std::vector<Hit> hits_;
};

// Sets up the triangles that may touch a sample, and keeps those that do.
std::vector<fast::Span> scan_all(const cases::Case& c,
                                 const std::vector<cases::Triangle>& triangles,
                                 TriangleSetups& setups) {
    std::vector<fast::Span> spans;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (!setups.may_touch_a_sample(t)) {
            continue;
        }
        const size_t first = spans.size();
        fast::scan(setups[t], t, c.target, spans);
        const uint32_t down = c.draws[triangles[t].draw].layer * c.target.height;
        for (size_t k = first; down > 0 && k < spans.size(); ++k) {
            spans[k].y += down;
        }
        // What has no sample is asked for again only where an open sample is near one of its edges
        // (Narrowing::triangles_at).
        if (spans.size() == first) {
            setups.forget_last(t);
        }
    }
    return spans;
}

}  // namespace

Scene::Scene(const cases::Case& the_case, const Limits& the_limits, cases::Profile the_profile,
             bool is_told)
    : c(the_case),
      limits(the_limits),
      profile(the_profile),
      triangles(assemble(c)),
      setups(c, triangles, limits, profile, is_told),
      spans(scan_all(c, triangles, setups)),
      depth(DepthTest::is_needed(c)
                ? std::make_optional<DepthTest>(c, triangles, limits, profile, false)
                : std::nullopt),
      narrowing(c, profile, triangles, setups,
                {fast::is_in_hull, fast::winding, fast::is_inside_whole},
                depth ? &*depth : nullptr) {}

Expectation expect(const cases::Case& c, const Limits& limits, cases::Profile profile,
                   Onlooker* onlooker) {
    Scene scene(c, limits, profile, false);
    return expect(scene, onlooker);
}

Expectation expect(Scene& scene, Onlooker* onlooker) {
    const cases::Case& c = scene.c;
    Expectation out;
    out.limits = scene.limits;
    out.profile = scene.profile;
    out.target = c.target;
    out.triangles = scene.triangles;
    HitTable table(c.target, scene.spans);
    out.samples.resize(size_t{c.target.width} * c.target.rows() * c.target.samples);
    out.writers.reserve(table.size());
    size_t at = 0;
    for (uint32_t row = 0; row < c.target.rows(); ++row) {
        const uint32_t j = row % c.target.height;
        const bool is_touched = table.select_row(row);
        size_t k = 0;
        for (uint32_t i = 0; i < c.target.width; ++i) {
            for (uint32_t s = 0; s < c.target.samples; ++s, ++at, ++k) {
                SampleExpectation& sample = out.samples[at];
                const std::span<const Hit> hits = is_touched ? table.of(k) : std::span<const Hit>();
                add_fragments(out, c, hits);
                if (hits.empty() && onlooker == nullptr) {
                    sample.writers_begin = static_cast<uint32_t>(out.writers.size());
                    continue;
                }
                const FixedPoint p = sample_position(i, j, s, c.target);
                JudgeReasons reasons;
                sample = scene.narrowing.judge(p, s, hits, out.writers, out.depth_writers,
                                               onlooker != nullptr ? &reasons : nullptr);
                if (onlooker != nullptr &&
                    !onlooker->look({at,
                                     {i, j, s, row / c.target.height},
                                     p,
                                     hits,
                                     sample.hits,
                                     std::span(out.writers).subspan(sample.writers_begin),
                                     reasons},
                                    scene.setups)) {
                    onlooker = nullptr;
                }
                out.must_samples += sample.hits.total_min > 0 ? 1U : 0U;
                out.either_samples += sample.hits.is_decided() ? 0U : 1U;
            }
        }
    }
    return out;
}

}  // namespace ref
