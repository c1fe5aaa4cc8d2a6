// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/depth/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>

#include "cases/base/float_bits.hpp"
#include "cases/model/sample.hpp"
#include "ref/depth/compare.hpp"
#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/fragment/promise.hpp"

namespace ref {

namespace {

using cases::CompareOp;
using cases::same_bits;
using value::Answer;
using value::Ball;
using value::both;
using value::compare;
using value::compare_sign;
using value::DepthRange;
using value::is_positive;
using value::Outcome;
using value::with_neighbours;

constexpr int kClear = -1;  // instead of a candidate's number

// How two triangles are related whose vertices are the same.
struct Relation {
    bool is_same = false;
    int sign = 0;  // of the second one's depth minus the first one's; 0: not known
};

bool has_equal_bits(const glm::vec4& a, const glm::vec4& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

bool has_equal_modes(const cases::Draw& a, const cases::Draw& b) {
    return std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(),
                      b.attributes.end(), [](const cases::Attribute& p, const cases::Attribute& q) {
                          return p.interpolation == q.interpolation &&
                                 p.components == q.components && p.auxiliary == q.auxiliary &&
                                 p.source == q.source && p.probe == q.probe;
                      });
}

}  // namespace

struct DepthTest::Impl {
    // What is known of a triangle in one kind of number.
    template <class T>
    struct Known {
        std::optional<value::CandidateSet<T>> set;
        uint64_t stamp = 0;  // of the sample that `span` belongs to
        std::optional<DepthRange<T>> span;
    };
    struct Loaded {
        value::Primitive primitive;
        bool has_depth = false;  // something is promised of it
        std::tuple<Known<Ball>, Known<mpq_class>> known;
    };

    const cases::Case& c;
    const std::vector<cases::Triangle>& triangles;
    Limits limits;
    cases::Profile profile;
    bool exact_only;
    value::Quantity depth;
    std::vector<std::unique_ptr<Loaded>> loaded;
    double steps;
    std::tuple<DepthRange<Ball>, DepthRange<mpq_class>> clear;
    FixedPoint at;       // the sample whose spans are kept
    uint64_t stamp = 1;  // counts samples

    Impl(const cases::Case& the_case, const std::vector<cases::Triangle>& the_triangles,
         const Limits& the_limits, cases::Profile the_profile, bool exact)
        : c(the_case),
          triangles(the_triangles),
          limits(the_limits),
          profile(the_profile),
          exact_only(exact),
          loaded(the_triangles.size()),
          steps(cases::depth_steps(the_case.target.depth_format)) {
        depth.kind = value::Kind::linear;
        depth.at_sample = true;
        depth.plane = value::kPlaneDepth;
        depth.id = {};
        clear = {range_at<Ball>(c.target.depth_clear), range_at<mpq_class>(c.target.depth_clear)};
        if (c.target.depth_load == cases::LoadOp::dont_care) {
            clear = {DepthRange<Ball>{true, {}, {}}, DepthRange<mpq_class>{true, {}, {}}};
        }
    }

    // What may stand for a number.
    template <class T>
    DepthRange<T> range_at(float number) const {
        const mpq_class value(static_cast<double>(number));
        const auto exact = *with_neighbours<mpq_class>({value, value}, steps);
        return {false, value::from_exact<T>(exact.low), value::from_exact<T>(exact.high)};
    }

    // By Balls, and by rationals where these do not tell.
    template <class Ask>
    auto by_balls_first(const Ask& ask) {
        auto answer = exact_only ? decltype(ask(Ball()))() : ask(Ball());
        return answer ? answer : ask(mpq_class());
    }

    Loaded& load(uint32_t t) {
        if (!loaded[t]) {
            loaded[t] = std::make_unique<Loaded>();
            const value::Primitive& made = loaded[t]->primitive =
                value::make_primitive(c, triangles[t], limits);
            if (made.is_finite) {
                const value::Promise of = value::promises_of(made, {&depth, 1}).front();
                loaded[t]->has_depth =
                    of.is_number && (of.is_guaranteed || profile != cases::Profile::vulkan);
            }
        }
        return *loaded[t];
    }

    template <class T>
    Known<T>& known(uint32_t t) {
        return std::get<Known<T>>(load(t).known);
    }

    // Where the depth of a fragment at p is evaluated: in p, or, if it is gl_FragCoord.z, somewhere
    // in the pixel. A linear function is largest at a corner.
    template <class T>
    std::vector<value::Point<T>> points_of(uint32_t t, const FixedPoint& p) const {
        if (c.target.samples == 1 || !replaces_depth_by_coord(draw_of(t))) {
            return {{T(pixels(p.x)), T(pixels(p.y))}};
        }
        const auto x = static_cast<double>(p.x >> kFixedBits);
        const auto y = static_cast<double>(p.y >> kFixedBits);
        return {{T(x), T(y)}, {T(x + 1), T(y)}, {T(x), T(y + 1)}, {T(x + 1), T(y + 1)}};
    }

    // The depths of triangle t at p; nothing if T cannot tell.
    template <class T>
    std::optional<DepthRange<T>> make_span(uint32_t t, const FixedPoint& p) {
        const value::Primitive& primitive = load(t).primitive;
        if (const auto z =
                cases::written_depth(draw_of(t), static_cast<uint32_t>(p.x >> kFixedBits),
                                     static_cast<uint32_t>(p.y >> kFixedBits))) {
            return range_at<T>(*z);
        }
        if (!load(t).has_depth) {
            return DepthRange<T>{true, {}, {}};
        }
        std::optional<value::CandidateSet<T>>& set = known<T>(t).set;
        if (!set) {
            set = value::make_candidates<T>(primitive, {&depth, 1}, limits, profile);
        }
        std::optional<value::Range<T>> range;
        for (const value::Point<T>& at_p : points_of<T>(t, p)) {
            const auto reach = value::reach_of_depth(*set, depth, primitive.is_projectable, at_p);
            if (!reach.is_known) {
                return std::nullopt;
            }
            if (reach.is_free) {
                return DepthRange<T>{true, {}, {}};
            }
            range = range ? value::Range<T>{value::smaller(range->low, reach.range.low),
                                            value::larger(range->high, reach.range.high)}
                          : reach.range;
        }
        return with_neighbours<T>(*range, steps);
    }

    // The same, or what depth was cleared to; the last sample's answers are kept.
    template <class T>
    std::optional<DepthRange<T>> span_of(int t, const FixedPoint& p) {
        if (t == kClear) {
            return std::get<DepthRange<T>>(clear);
        }
        if (!(p == at)) {
            at = p;
            ++stamp;
        }
        Known<T>& k = known<T>(static_cast<uint32_t>(t));
        if (k.stamp != stamp) {
            k.span = make_span<T>(static_cast<uint32_t>(t), p);
            k.stamp = stamp;
        }
        return k.span;
    }

    const cases::Draw& draw_of(uint32_t t) const { return c.draws[triangles[t].draw]; }

    // Whether fragments of a triangle may not be there though it covers their samples.
    bool may_vanish(uint32_t t) const {
        return takes_away_by_value(draw_of(t)) ||
               cases::alpha_coverage(draw_of(t), c.target, profile) == cases::AlphaCoverage::any;
    }

    // Of triangle `next`, drawn after `first`.
    Relation relation(uint32_t first, uint32_t next) {
        if (first == next) {
            return {};  // two pieces of one triangle, each with planes of its own
        }
        const cases::Triangle& a = triangles[first];
        const cases::Triangle& b = triangles[next];
        const cases::Draw& da = c.draws[a.draw];
        const cases::Draw& db = c.draws[b.draw];
        if (da.clear || db.clear) {
            return {};
        }
        for (size_t k = 0; k < 3; ++k) {
            if (!has_equal_bits(da.positions[a.vertex[k]], db.positions[b.vertex[k]])) {
                return {};
            }
        }
        const bool in_practice = profile >= cases::Profile::practice;
        // Other attributes are other shaders. A depth that they write is gl_FragCoord.z, which may
        // be that of another place in the pixel, by what they interpolate.
        const bool has_any_modes =
            in_practice && (c.target.samples == 1 || !replaces_depth_by_coord(da));
        const bool is_same_state =
            da.topology == db.topology && da.viewport == db.viewport && da.cull == db.cull &&
            da.front_face == db.front_face && da.scissor == db.scissor &&
            da.distances == db.distances && da.multisample == db.multisample &&
            da.fragment_size == db.fragment_size && (in_practice || da.stencil == db.stencil) &&
            da.discard == db.discard && da.discard_by == db.discard_by &&
            da.early_tests == db.early_tests && da.frag_depth == db.frag_depth &&
            da.conservative == db.conservative &&
            same_bits(da.conservative_extra, db.conservative_extra) &&
            (has_any_modes || has_equal_modes(da, db));
        if (!is_same_state || !load(first).primitive.is_finite) {
            return {};
        }
        cases::DepthState x = da.depth;
        cases::DepthState y = db.depth;
        y.write = x.write;
        if (in_practice) {
            y.compare = x.compare;
            y.bounds = x.bounds;
        }
        if (x == y) {
            return {steps <= 0 || in_practice, 0};
        }
        const cases::DepthBias p = x.bias.value_or(cases::DepthBias{});
        const cases::DepthBias q = y.bias.value_or(cases::DepthBias{});
        x.bias = y.bias = std::nullopt;
        y.compare = x.compare;
        // "the smallest difference ... guaranteed to remain distinct" is said of r as the format
        // has it, without depthBiasExact.
        // No bias is added to a depth that the shader writes.
        const bool is_shifted = x == y && !replaces_depth(da) && !p.is_controlled() &&
                                !q.is_controlled() && !(p.slope < q.slope) &&
                                !(p.slope > q.slope) && !(std::fabs(p.clamp) > 0) &&
                                !(std::fabs(q.clamp) > 0);
        const float apart = q.constant - p.constant;
        const float least = steps > 0 ? 2.0F : 1.0F;
        if (!is_shifted || !(std::fabs(apart) >= least)) {
            return {};
        }
        return {false, apart > 0 ? 1 : -1};
    }

    // Whether nothing is cut off at the ends of the viewport's range or undefined there: the bias
    // sets two depths apart only as long as they are not clamped.
    bool is_inside(uint32_t t, const FixedPoint& p) {
        const cases::Viewport& v = draw_of(t).viewport;
        const auto low = static_cast<double>(std::min(v.min_depth, v.max_depth));
        const auto high = static_cast<double>(std::max(v.min_depth, v.max_depth));
        const auto by = [&]<class T>(T) -> std::optional<bool> {
            const auto span = span_of<T>(static_cast<int>(t), p);
            const Answer answer = !span           ? Answer::unknown
                                  : span->is_free ? Answer::no
                                                  : both(is_positive(T(span->low - T(low))),
                                                         is_positive(T(T(high) - span->high)));
            return answer == Answer::unknown ? std::nullopt : std::optional(answer == Answer::yes);
        };
        return by_balls_first(by).value_or(false);
    }

    // Whether a triangle has a depth there at all.
    bool has_depth(uint32_t t, const FixedPoint& p) {
        const auto by = [&]<class T>(T) -> std::optional<bool> {
            const auto span = span_of<T>(static_cast<int>(t), p);
            return span ? std::optional(!span->is_free) : std::nullopt;
        };
        return by_balls_first(by).value_or(false);
    }

    // Of what is stored.
    DepthOutcome bounds(int stored, uint32_t fragment, const FixedPoint& p) {
        const std::optional<cases::DepthBounds>& asked = draw_of(fragment).depth.bounds;
        if (!asked) {
            return DepthOutcome::passes;
        }
        const auto by = [&]<class T>(T) {
            const auto span = span_of<T>(stored, p);
            return span ? value::within(*span, range_at<T>(asked->min), range_at<T>(asked->max))
                        : Outcome();
        };
        return by_balls_first(by).value_or(DepthOutcome::open);
    }

    DepthOutcome outcome(int stored, uint32_t fragment, const FixedPoint& p, ReasonKind& reason) {
        const CompareOp op = draw_of(fragment).depth.compare;
        if (op == CompareOp::always || op == CompareOp::never) {
            return op == CompareOp::always ? DepthOutcome::passes : DepthOutcome::fails;
        }
        const auto by = [&]<class T>(T) {
            const auto a = span_of<T>(static_cast<int>(fragment), p);
            const auto b = span_of<T>(stored, p);
            return a && b ? compare(op, *a, *b) : Outcome();
        };
        const DepthOutcome known = by_balls_first(by).value_or(DepthOutcome::open);
        if (known != DepthOutcome::open || stored == kClear) {
            return known;
        }
        const auto first = static_cast<uint32_t>(stored);
        const Relation r = relation(first, fragment);
        if (r.is_same) {
            if (!has_depth(first, p)) {
                return DepthOutcome::open;
            }
            reason = ReasonKind::depth_same;
            return compare_sign(op, 0);
        }
        if (r.sign != 0 && is_inside(first, p) && is_inside(fragment, p)) {
            reason = ReasonKind::depth_apart;
            return compare_sign(op, r.sign);
        }
        return DepthOutcome::open;
    }
};

DepthTest::DepthTest(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                     const Limits& limits, cases::Profile profile, bool exact_only)
    : impl_(std::make_unique<Impl>(c, triangles, limits, profile, exact_only)) {}
DepthTest::~DepthTest() = default;
DepthTest::DepthTest(DepthTest&&) noexcept = default;

bool DepthTest::is_needed(const cases::Case& c) {
    // "If there is no depth attachment then the depth test is skipped" (Vulkan specification,
    // "Depth Test").
    return c.target.has_depth &&
           std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& draw) {
               return draw.depth.compare != CompareOp::always || !draw.depth.write ||
                      draw.depth.bounds ||
                      stores_discarded(draw);  // the last fragment is not the last that shows
           });
}

DepthOutcome DepthTest::outcome(std::optional<uint32_t> stored, uint32_t fragment,
                                const FixedPoint& p, ReasonKind& reason) {
    return impl_->outcome(stored ? static_cast<int>(*stored) : kClear, fragment, p, reason);
}

DepthOutcome DepthTest::bounds(std::optional<uint32_t> stored, uint32_t fragment,
                               const FixedPoint& p) {
    return impl_->bounds(stored ? static_cast<int>(*stored) : kClear, fragment, p);
}

bool DepthTest::is_together(uint32_t first, uint32_t next) {
    return !impl_->may_vanish(first) && !impl_->may_vanish(next) &&
           impl_->relation(first, next).is_same;
}

std::string DepthTest::range_text(uint32_t triangle, const FixedPoint& p) {
    const auto span = impl_->span_of<mpq_class>(static_cast<int>(triangle), p);
    if (!span || span->is_free) {
        return "any depth";
    }
    return fmt::format("depth {:.9g} to {:.9g}", span->low.get_d(), span->high.get_d());
}

}  // namespace ref
