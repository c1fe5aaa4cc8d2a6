// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation.hpp"

#include <algorithm>

#include "ref/coverage_fast.hpp"
#include "ref/coverage_setup.hpp"
#include "ref/narrowing.hpp"

namespace ref {

bool HitBounds::allows(uint32_t front, uint32_t back) const {
    const int64_t balance = int64_t{front} - int64_t{back};
    const uint64_t total = uint64_t{front} + back;
    return front >= front_min && front <= front_max && back >= back_min && back <= back_max &&
           balance >= signed_min && balance <= signed_max && total >= total_min &&
           total <= total_max;
}

bool HitBounds::is_decided() const {
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

// Which triangles touch each sample: the spans, turned into one list a sample.
class HitTable {
  public:
    HitTable(const cases::Target& target, const std::vector<fast::Span>& spans) {
        const size_t row = size_t{target.width} * target.samples;
        begin_.assign(row * target.height + 1, 0);
        const auto first = [&](const fast::Span& s) {
            return s.y * row + size_t{s.x0} * target.samples + s.sample;
        };
        for (const fast::Span& s : spans) {
            size_t at = first(s);
            for (uint32_t x = s.x0; x < s.x1; ++x, at += target.samples) {
                ++begin_[at];
            }
        }
        uint64_t sum = 0;
        for (uint64_t& b : begin_) {
            sum += b;
            b = sum;  // end of the list for now; filling from behind makes it the begin
        }
        hits_.resize(sum);
        for (auto s = spans.rbegin(); s != spans.rend(); ++s) {
            size_t at = first(*s);
            for (uint32_t x = s->x0; x < s->x1; ++x, at += target.samples) {
                hits_[--begin_[at]] = {s->triangle, s->coverage};
            }
        }
    }
    std::span<const Hit> of(size_t sample) const {
        return {hits_.data() + begin_[sample], begin_[sample + 1] - begin_[sample]};
    }
    size_t size() const { return hits_.size(); }

  private:
    std::vector<uint64_t> begin_;
    std::vector<Hit> hits_;
};

}  // namespace

Expectation expect(const cases::Case& c, const Limits& limits, cases::Profile profile) {
    Expectation out;
    out.limits = limits;
    out.profile = profile;
    out.target = c.target;
    out.triangles = assemble(c);
    VertexBoxes boxes(c, limits, profile);
    std::vector<Window> windows;
    for (const cases::Draw& d : c.draws) {
        windows.push_back(window_of(c, d, profile));
    }
    std::vector<TriangleSetup> setups;
    setups.reserve(out.triangles.size());
    std::vector<fast::Span> spans;
    for (uint32_t t = 0; t < out.triangles.size(); ++t) {
        const Triangle& triangle = out.triangles[t];
        setups.push_back(set_up(c, triangle, limits, profile, boxes, windows[triangle.draw]));
        fast::scan(setups.back(), t, c.target, spans);
    }
    const HitTable table(c.target, spans);
    Narrowing narrowing(c, profile, out.triangles, setups, {fast::is_in_hull, fast::winding});
    out.samples.resize(size_t{c.target.width} * c.target.height * c.target.samples);
    out.writers.reserve(table.size());
    size_t at = 0;
    for (uint32_t j = 0; j < c.target.height; ++j) {
        for (uint32_t i = 0; i < c.target.width; ++i) {
            for (uint32_t s = 0; s < c.target.samples; ++s, ++at) {
                const std::span<const Hit> hits = table.of(at);
                if (hits.empty()) {
                    out.samples[at].writers_begin = static_cast<uint32_t>(out.writers.size());
                    continue;
                }
                const FixedPoint p = sample_position(i, j, s, c.target.samples);
                out.samples[at] = narrowing.judge(p, hits, out.writers);
                const HitBounds& b = out.samples[at].hits;
                out.must_samples += b.total_min > 0 ? 1U : 0U;
                out.either_samples += b.is_decided() ? 0U : 1U;
            }
        }
    }
    return out;
}

}  // namespace ref
