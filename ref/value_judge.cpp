// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict on one fragment. Stages: binary64 against the unsnapped and the snapped basis
// (accepts only what is proven); all bases of the profile in Balls; the same in rationals.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>

#include "ref/fragment_coverage.hpp"
#include "ref/sample.hpp"
#include "ref/sample_values.hpp"
#include "ref/value.hpp"
#include "ref/value_describe.hpp"
#include "ref/value_filter.hpp"
#include "ref/value_places.hpp"
#include "ref/value_probe.hpp"
#include "ref/value_promise.hpp"
#include "ref/value_wide.hpp"

namespace ref {

namespace {

using cases::Profile;
using value::Answer;
using value::Ball;
using value::Kind;
using value::Quantity;

// Sets of candidates are large (up to 64 bases) and needed for few triangles: the last ones are
// kept.
template <class T>
class WideCache {
  public:
    explicit WideCache(size_t capacity) : capacity_(capacity) {}

    template <class Make>
    const value::WideSet<T>& get(uint32_t t, Profile profile, Make make) {
        for (const Entry& e : entries_) {
            if (e.triangle == t && e.profile == profile) {
                return e.set;
            }
        }
        if (entries_.size() == capacity_) {
            entries_.pop_front();
        }
        entries_.push_back({t, profile, make()});
        return entries_.back().set;
    }

  private:
    struct Entry {
        uint32_t triangle;
        Profile profile;
        value::WideSet<T> set;
    };
    size_t capacity_;
    std::deque<Entry> entries_;
};

struct Loaded {
    value::Primitive primitive;
    value::Filter unsnapped, snapped;
    bool has_snapped = false;                             // and it differs from the unsnapped one
    std::optional<std::vector<value::Promise>> promises;  // filled when first asked for
};

std::string bits_of(float f) {
    return fmt::format("{:.9g} (0x{:08x})", f, std::bit_cast<uint32_t>(f));
}

// Depth that is stored as it is interpolated: the filters know no other.
bool is_plain_depth(const value::Primitive& primitive) {
    const cases::DepthState& depth = primitive.draw->depth;
    return primitive.depth_format == cases::DepthFormat::d32_float && !depth.bias && !depth.clamp;
}

// The depth that a device most likely stores, from the exact one of its plane.
double nominal_depth(const value::Primitive& primitive, const value::Basis<mpq_class>& basis,
                     double z, Profile profile) {
    const auto path = value::make_depth_path<mpq_class>(primitive, profile);
    double out = z + value::nominal_bias(path, basis);
    out = std::clamp(out, path.viewport.low, path.viewport.high);
    const double steps = value::steps_of(path.format);
    return steps > 0 ? std::nearbyint(out * steps) / steps : out;
}

// What is broken if stored depth is not what the plane leads to.
std::string_view depth_rule(const value::Primitive& primitive, double z) {
    const cases::DepthState& depth = primitive.draw->depth;
    const cases::Viewport& v = primitive.draw->viewport;
    const auto near = static_cast<double>(v.min_depth);
    const auto far = static_cast<double>(v.max_depth);
    if (depth.clamp && (z < std::min(near, far) || z > std::max(near, far))) {
        return "depth.clamp";
    }
    if (depth.bias) {
        return "depth.bias";
    }
    return primitive.depth_format == cases::DepthFormat::d32_float ? "depth.linear" : "depth.store";
}

}  // namespace

struct ValueReference::Impl {
    const cases::Case& c;
    Limits limits;
    Profile profile;
    std::vector<Triangle> triangles;
    std::vector<std::vector<Quantity>> quantities;  // by draw
    std::vector<std::unique_ptr<Loaded>> loaded;    // by triangle
    std::deque<uint32_t> order;                     // of the loaded ones, oldest first
    static constexpr size_t kKeptTriangles = 16384;
    WideCache<Ball> balls{64};
    WideCache<mpq_class> rationals{4};
    std::array<std::unique_ptr<FragmentCoverage>, std::size(cases::kProfiles)>
        coverage;  // by profile
    uint32_t text_triangle = 0;
    std::optional<value::Basis<mpq_class>> text_basis;
    FragmentPart part = FragmentPart::all;  // of the fragment being judged
    bool is_brief = false;                  // judge_briefly
    ValueSelection selection;
    std::vector<std::vector<Quantity>> selected;  // the quantities of it, by draw

    Impl(const cases::Case& the_case, const Limits& the_limits, Profile the_profile)
        : c(the_case), limits(the_limits), profile(the_profile), triangles(assemble(the_case)) {
        for (const cases::Draw& draw : c.draws) {
            quantities.push_back(value::quantities(draw, c.target));
        }
        loaded.resize(triangles.size());
        selected = quantities;
    }

    const std::vector<Quantity>& quantities_of(uint32_t t) const {
        return quantities[triangles[t].draw];
    }

    Loaded& load(uint32_t t) {
        std::unique_ptr<Loaded>& slot = loaded[t];
        if (slot) {
            return *slot;
        }
        slot = std::make_unique<Loaded>();
        // Samples come row by row: what was not asked for longest is not asked for soon.
        order.push_back(t);
        if (order.size() > kKeptTriangles) {
            loaded[order.front()].reset();
            order.pop_front();
        }
        slot->primitive = value::make_primitive(c, triangles[t]);
        if (!slot->primitive.is_finite) {
            return *slot;
        }
        const auto inputs = value::plane_inputs<Ball>(slot->primitive, quantities_of(t));
        const auto ideal = value::ideal_vertices<Ball>(slot->primitive);
        slot->unsnapped = make_filter(make_basis(ideal, inputs, kBudgetFactor));
        const auto at = snapped_positions(slot->primitive, limits);
        if (at) {
            const auto moved = value::moved_vertices<Ball>(slot->primitive, *at);
            for (size_t i = 0; i < 3; ++i) {
                // Not provably the same position: a basis of its own.
                slot->has_snapped = slot->has_snapped || is_other(moved.hx[i], ideal.hx[i]) ||
                                    is_other(moved.hy[i], ideal.hy[i]);
            }
            if (slot->has_snapped) {
                slot->snapped = make_filter(make_basis(moved, inputs, kBudgetFactor));
            }
        }
        return *slot;
    }

    FragmentCoverage& coverage_at(Profile at) {
        auto& slot = coverage.at(static_cast<size_t>(at));
        if (!slot) {
            slot = std::make_unique<FragmentCoverage>(c, limits, at, triangles);
        }
        return *slot;
    }

    // Where the fragment is, and what a profile says of its coverage if anything depends on it.
    value::Fragment fragment(uint32_t t, SampleId id, Profile at, bool is_exact = false) {
        value::Fragment f = covered_fragment(t, id, at, is_exact);
        if (at != Profile::direct3d && c.target.samples > 1 && value::has_centroid(*f.draw)) {
            f.region = pixel_region(coverage_at(at).setup(t), id.x, id.y);
        }
        return f;
    }

    // The same without the part of the pixel that lies in the primitive, which takes rationals.
    value::Fragment covered_fragment(uint32_t t, SampleId id, Profile at, bool is_exact) {
        value::Fragment f;
        f.id = id;
        f.target = &c.target;
        f.draw = &c.draws[triangles[t].draw];
        const bool has_mask =
            std::any_of(quantities_of(t).begin(), quantities_of(t).end(),
                        [](const Quantity& q) { return q.kind == Kind::sample_mask; });
        const bool has_centroid = c.target.samples > 1 && value::has_centroid(*f.draw);
        if (has_mask || has_centroid) {
            FragmentCoverage& cover = coverage_at(at);
            f.coverage = is_exact ? cover.exact(t, id.x, id.y) : cover.of(t, id.x, id.y);
        }
        return f;
    }

    value::ProbePlace probe_place(uint32_t t, SampleId id, Profile at) const {
        return {id, &c.target, &c.draws[triangles[t].draw], limits, at};
    }

    // Whether one of the two nominal bases is proven to explain all numbers of the fragment.
    bool filter(uint32_t t, SampleId id, const FragmentValues& device, FragmentVerdict& out);

    // The unsnapped basis in rationals, for texts; the last one is kept.
    const value::Basis<mpq_class>& exact_basis(uint32_t t) {
        if (text_triangle != t || !text_basis) {
            const value::Primitive& primitive = load(t).primitive;
            text_basis = make_basis(value::ideal_vertices<mpq_class>(primitive),
                                    value::plane_inputs<mpq_class>(primitive, quantities_of(t)),
                                    kBudgetFactor);
            text_triangle = t;
        }
        return *text_basis;
    }

    // Whether the part of the fragment that is being judged has the quantity.
    bool is_part(const Quantity& q) const {
        return selection.has(q.attribute) &&
               (part == FragmentPart::all ||
                (q.attribute == kDepthAttribute) == (part == FragmentPart::depth));
    }

    static bool is_other(const Ball& a, const Ball& b) {
        return std::fabs(a.v - b.v) > 0 || a.e > std::fabs(a.v) * 0x1p-40;
    }

    const std::vector<value::Promise>& promises(uint32_t t) {
        Loaded& triangle = load(t);
        if (!triangle.promises) {
            triangle.promises = value::promises_of(triangle.primitive, quantities_of(t));
        }
        return *triangle.promises;
    }

    // The quantities that the profile asks for.
    std::vector<size_t> asked(uint32_t t, Profile at) {
        std::vector<size_t> out(quantities_of(t).size());
        std::iota(out.begin(), out.end(), size_t{0});
        std::erase_if(out, [&](size_t index) {
            return !is_part(quantities_of(t)[index]) || !promises(t)[index].is_number ||
                   (at == Profile::vulkan && !promises(t)[index].is_guaranteed);
        });
        return out;
    }

    value::WideVerdict wide(uint32_t t, SampleId id, const FragmentValues& device, Profile at) {
        const std::vector<size_t> only = asked(t, at);
        if (only.empty()) {
            return {true, true, ref::Basis::unsnapped, 0, {}, {}};
        }
        const value::Primitive& primitive = load(t).primitive;
        const std::vector<Quantity>& q = quantities_of(t);
        const value::WideSet<Ball>& set =
            balls.get(t, at, [&] { return value::make_wide_set<Ball>(primitive, q, limits, at); });
        if (set.is_known) {
            value::WideVerdict verdict =
                judge_wide(set, std::span<const Quantity>(q), primitive.is_projectable,
                           value::evaluations<Ball>(fragment(t, id, at), at),
                           probe_place(t, id, at), device, only);
            if (verdict.is_known) {
                return verdict;
            }
        }
        const value::WideSet<mpq_class>& exact = rationals.get(
            t, at, [&] { return value::make_wide_set<mpq_class>(primitive, q, limits, at); });
        return judge_wide(exact, std::span<const Quantity>(q), primitive.is_projectable,
                          value::evaluations<mpq_class>(fragment(t, id, at), at),
                          probe_place(t, id, at), device, only);
    }

    // The oracle: rationals only, no filter.
    value::WideVerdict wide_exact(uint32_t t, SampleId id, const FragmentValues& device,
                                  Profile at) {
        const std::vector<size_t> only = asked(t, at);
        if (only.empty()) {
            return {true, true, ref::Basis::unsnapped, 0, {}, {}};
        }
        const value::Primitive& primitive = load(t).primitive;
        const std::vector<Quantity>& q = quantities_of(t);
        const value::WideSet<mpq_class>& exact = rationals.get(
            t, at, [&] { return value::make_wide_set<mpq_class>(primitive, q, limits, at); });
        return judge_wide(exact, std::span<const Quantity>(q), primitive.is_projectable,
                          value::evaluations<mpq_class>(fragment(t, id, at, true), at),
                          probe_place(t, id, at), device, only);
    }

    void judge_flat(const value::Primitive& primitive, const Quantity& q, float got,
                    FragmentVerdict& out) const;
    void judge_samples(uint32_t t, SampleId id, const FragmentValues& device, bool exact_only,
                       FragmentVerdict& out);
    std::vector<Profile> levels_of(uint32_t t, SampleId id, const FragmentValues& device,
                                   const std::vector<size_t>& failing);
    void describe(uint32_t t, SampleId id, const FragmentValues& device,
                  const value::WideVerdict& verdict, FragmentVerdict& out);
    FragmentVerdict judge(uint32_t t, SampleId id, const FragmentValues& device, bool exact_only);
};

void ValueReference::Impl::judge_flat(const value::Primitive& primitive, const Quantity& q,
                                      float got, FragmentVerdict& out) const {
    const auto component = static_cast<glm::vec4::length_type>(q.component);
    const auto& values = primitive.draw->attributes[static_cast<size_t>(q.attribute)].values;
    const float want = values[primitive.triangle.provoking][component];
    const auto bits = [](float f) { return std::bit_cast<uint32_t>(f); };
    if (bits(got) == bits(want)) {
        return;
    }
    const bool zero = !(std::fabs(want) > 0) && !std::isnan(want);
    const bool got_zero = !(std::fabs(got) > 0) && !std::isnan(got);
    if (!std::isfinite(want)) {
        return;  // NaN and infinity need not arrive
    }
    if ((zero || std::fpclassify(want) == FP_SUBNORMAL) && got_zero) {
        return;  // denormals may be flushed, the sign of zero may be lost
    }
    ValueMismatch m;
    m.quantity = q.name;
    m.rule = "interp.flat";
    m.level = Profile::vulkan;
    for (const uint32_t v : primitive.triangle.vertex) {
        if (v != primitive.triangle.provoking && bits(values[v][component]) == bits(got)) {
            m.rule = primitive.draw->provoking == cases::ProvokingVertex::first ? "provoking.first"
                                                                                : "provoking.last";
        }
    }
    m.expected =
        bits_of(want) + " of the provoking vertex " + std::to_string(primitive.triangle.provoking);
    m.got = bits_of(got);
    m.ratio = std::numeric_limits<double>::infinity();
    out.mismatches.push_back(std::move(m));
}

void ValueReference::Impl::judge_samples(uint32_t t, SampleId id, const FragmentValues& device,
                                         bool exact_only, FragmentVerdict& out) {
    std::array<std::optional<value::Fragment>, std::size(cases::kProfiles)> fragments;
    for (const Quantity& q : quantities_of(t)) {
        if (!value::is_sample_kind(q.kind) || !selection.has(q.attribute)) {
            continue;
        }
        // What is allowed at a profile is allowed at every looser one.
        auto& strict = fragments.at(static_cast<size_t>(profile));
        if (!strict) {
            strict = covered_fragment(t, id, profile, exact_only);
        }
        if (may_be(*strict, q, device, profile)) {
            continue;
        }
        // The loosest profile that forbids it.
        for (const Profile at : cases::kProfiles) {
            auto& f = fragments.at(static_cast<size_t>(at));
            if (!f) {
                f = covered_fragment(t, id, at, exact_only);
            }
            if (at > profile || may_be(*f, q, device, at)) {
                continue;
            }
            ValueMismatch m;
            m.quantity = q.name;
            m.rule = q.rule;
            m.level = at;
            m.expected = allowed_text(*f, q);
            m.got = bits_of(q.get(device));
            m.ratio = std::numeric_limits<double>::infinity();
            out.mismatches.push_back(std::move(m));
            break;
        }
    }
}

// The loosest profile at which each failing value is wrong, given that one basis has to explain all
// values of the fragment. A looser profile may blame values that this one does not (they fit the
// basis that explains most); if it blames none of those that are left, they share its level.
std::vector<Profile> ValueReference::Impl::levels_of(uint32_t t, SampleId id,
                                                     const FragmentValues& device,
                                                     const std::vector<size_t>& failing) {
    std::vector<Profile> levels(failing.size(), profile);
    std::vector<size_t> blamed;  // by a looser profile
    for (const Profile p : cases::kProfiles) {
        if (p >= profile) {
            break;
        }
        const std::vector<size_t> wrong = wide(t, id, device, p).failing;
        const auto is_in = [](const std::vector<size_t>& set, size_t index) {
            return std::find(set.begin(), set.end(), index) != set.end();
        };
        const bool is_new = std::any_of(wrong.begin(), wrong.end(),
                                        [&](size_t index) { return !is_in(blamed, index); });
        const bool is_shared = std::any_of(failing.begin(), failing.end(), [&](size_t index) {
            return is_in(wrong, index) && !is_in(blamed, index);
        });
        for (size_t k = 0; k < failing.size() && is_new; ++k) {
            if (!is_in(blamed, failing[k]) && (!is_shared || is_in(wrong, failing[k]))) {
                levels[k] = std::min(levels[k], p);
            }
        }
        blamed.insert(blamed.end(), wrong.begin(), wrong.end());
    }
    return levels;
}

void ValueReference::Impl::describe(uint32_t t, SampleId id, const FragmentValues& device,
                                    const value::WideVerdict& verdict, FragmentVerdict& out) {
    const value::Primitive& primitive = load(t).primitive;
    const std::vector<Quantity>& all = quantities_of(t);
    const std::vector<Profile> levels = levels_of(t, id, device, verdict.failing);
    const auto place = value::evaluations<mpq_class>(fragment(t, id, profile), profile).front();
    const value::Basis<mpq_class>& basis = exact_basis(t);
    const value::WideSet<Ball>& set = balls.get(
        t, profile, [&] { return value::make_wide_set<Ball>(primitive, all, limits, profile); });
    for (size_t k = 0; k < verdict.failing.size(); ++k) {
        const size_t index = verdict.failing[k];
        const Quantity& q = all[index];
        const float got = q.get(device);
        ValueMismatch m;
        m.quantity = q.name;
        m.rule = q.rule;
        m.level = levels[k];
        m.got = bits_of(got);
        m.ratio = verdict.ratios[k];
        double reach = 0;
        if (q.kind == Kind::probe) {
            m.expected = value::probe_text(basis, q, probe_place(t, id, profile));
            out.mismatches.push_back(std::move(m));
            continue;
        }
        if (q.rule == "barycentric.value" &&
            value::is_other_vertex(basis, q, all, place, static_cast<double>(got))) {
            m.rule = "barycentric.order";
        }
        if (basis.orientation != 0) {
            const auto v = value::exact_value(basis, q, place);
            if (v.exists == Answer::yes) {
                const std::string text = value::exact_text(v.value);
                m.expected =
                    fmt::format("{:.9g}{} within {} x {:.3g}", v.value.get_d(),
                                text.empty() ? "" : " = " + text, kBudgetFactor, v.budget.get_d());
                reach = v.reach.get_d();
                if (q.attribute == -2 && !is_plain_depth(primitive)) {
                    m.rule = depth_rule(primitive, v.value.get_d());
                    m.expected =
                        fmt::format("{:.9g} or near it (plane {:.9g} within {} x {:.3g})",
                                    nominal_depth(primitive, basis, v.value.get_d(), profile),
                                    v.value.get_d(), kBudgetFactor, v.budget.get_d());
                }
            }
        }
        if (m.expected.empty()) {
            m.expected = "a value between the vertex values";
        }
        const value::Range<Ball>& hull = set.hulls[index];
        const double g = static_cast<double>(got);
        const double low = hull.low.v - hull.low.e - reach * (1 + 0x1p-30);
        const double high = hull.high.v + hull.high.e + reach * (1 + 0x1p-30);
        const bool is_moved =
            (q.attribute == -2 || q.plane == value::kPlaneDepth) && !is_plain_depth(primitive);
        if (q.rule != "barycentric.value" &&
            (!std::isfinite(got) || (!is_moved && (g < low || g > high)))) {
            m.rule = "interp.hull";
        }
        out.mismatches.push_back(std::move(m));
    }
}

bool ValueReference::Impl::filter(uint32_t t, SampleId id, const FragmentValues& device,
                                  FragmentVerdict& out) {
    const Loaded& triangle = load(t);
    const FixedPoint fixed = sample_position(id.x, id.y, id.sample, c.target);
    const value::Point<double> centre{id.x + 0.5, id.y + 0.5};
    const value::Point<double> sample{
        static_cast<double>(fixed.x) / static_cast<double>(kFixedOne),
        static_cast<double>(fixed.y) / static_cast<double>(kFixedOne)};
    value::Places places{centre, sample, centre};
    if (c.target.samples > 1) {
        // The likeliest alternative; the others are left to the next stage.
        const auto nominal =
            value::evaluations<Ball>(fragment(t, id, Profile::direct3d), Profile::direct3d).front();
        places = {{nominal.attributes[0].x.v, nominal.attributes[0].y.v},
                  sample,
                  {nominal.centroid[0].x.v, nominal.centroid[0].y.v}};
    }
    const std::span<const Quantity> all(selected.at(triangles[t].draw));
    const value::ProbePlace place = probe_place(t, id, profile);
    const auto accepts = [&](const value::Filter& filter, double& ratio) {
        return filter_accepts(filter, all, places, device, kBudgetFactor, ratio) &&
               filter_accepts_probes(filter, all, place, device, kBudgetFactor, ratio);
    };
    double ratio = 0;
    bool is_decided = accepts(triangle.unsnapped, ratio);
    out.worst_ratio = ratio;
    if (triangle.has_snapped && !(is_decided && ratio <= 1)) {
        double snapped_ratio = 0;
        if (accepts(triangle.snapped, snapped_ratio) && (!is_decided || snapped_ratio < ratio)) {
            is_decided = true;
            out.basis = Basis::snapped;
            out.worst_ratio = snapped_ratio;
        }
    }
    return is_decided;
}

FragmentVerdict ValueReference::Impl::judge(uint32_t t, SampleId id, const FragmentValues& device,
                                            bool exact_only) {
    FragmentVerdict out;
    const Loaded& triangle = load(t);
    if (!triangle.primitive.is_finite) {
        return out;  // nothing is promised of a triangle with NaN or infinite positions
    }
    const std::vector<Quantity>& all = quantities_of(t);
    for (const Quantity& q : all) {
        if (is_part(q) && q.kind == Kind::flat) {
            judge_flat(triangle.primitive, q, q.get(device), out);
        }
    }
    if (part != FragmentPart::depth) {
        judge_samples(t, id, device, exact_only, out);
    }
    const bool is_decided = !exact_only && part == FragmentPart::all &&
                            is_plain_depth(triangle.primitive) && filter(t, id, device, out);
    // Accepted, but above one budget: another basis may explain it better.
    if (!is_decided || out.worst_ratio > 1) {
        const value::WideVerdict verdict =
            exact_only ? wide_exact(t, id, device, profile) : wide(t, id, device, profile);
        out.basis = verdict.basis;
        out.worst_ratio = verdict.worst_ratio;
        if (!verdict.ok && is_brief) {
            for (size_t k = 0; k < verdict.failing.size(); ++k) {
                ValueMismatch m;
                m.quantity = all[verdict.failing[k]].name;
                m.level = profile;
                m.ratio = verdict.ratios[k];
                out.mismatches.push_back(std::move(m));
            }
        } else if (!verdict.ok) {
            describe(t, id, device, verdict, out);
        }
    }
    out.ok = out.mismatches.empty();
    for (const ValueMismatch& m : out.mismatches) {
        out.worst_ratio = std::max(out.worst_ratio, m.ratio);
    }
    return out;
}

ValueReference::ValueReference(const cases::Case& c, const Limits& limits, Profile profile)
    : impl_(std::make_unique<Impl>(c, limits, profile)) {}
ValueReference::~ValueReference() = default;
ValueReference::ValueReference(ValueReference&&) noexcept = default;

void ValueReference::judge_only(const ValueSelection& selection) {
    impl_->selection = selection;
    impl_->selected = impl_->quantities;
    for (std::vector<Quantity>& draw : impl_->selected) {
        std::erase_if(draw, [&](const Quantity& q) { return !selection.has(q.attribute); });
    }
}

void ValueReference::judge_briefly() {
    impl_->is_brief = true;
}

FragmentVerdict ValueReference::judge(uint32_t t, SampleId sample, const FragmentValues& device,
                                      FragmentPart part) {
    impl_->part = part;
    return impl_->judge(t, sample, device, false);
}

FragmentVerdict ValueReference::judge_exact(uint32_t t, SampleId sample,
                                            const FragmentValues& device, FragmentPart part) {
    impl_->part = part;
    return impl_->judge(t, sample, device, true);
}

ValueRange ValueReference::range(uint32_t t, SampleId sample, int32_t attribute,
                                 uint32_t component) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    if (!primitive.is_finite) {
        return {};
    }
    if (attribute >= 0) {
        const cases::Attribute& a = primitive.draw->attributes[static_cast<size_t>(attribute)];
        if (component >= a.components) {
            return {true, 0, 0};
        }
        if (a.interpolation == cases::Interpolation::flat) {
            const auto v =
                static_cast<double>(a.values[primitive.triangle.provoking]
                                            [static_cast<glm::vec4::length_type>(component)]);
            return {std::isfinite(v), v, v};
        }
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) {
        return q.attribute == attribute && q.component == component &&
               (q.kind == Kind::linear || q.kind == Kind::perspective);
    });
    const auto index = static_cast<size_t>(found - all.begin());
    const std::vector<size_t> asked = impl_->asked(t, impl_->profile);
    if (found == all.end() || std::find(asked.begin(), asked.end(), index) == asked.end()) {
        return {};
    }
    const std::span<const Quantity> span(all);
    const auto& balls = impl_->balls.get(t, impl_->profile, [&] {
        return value::make_wide_set<Ball>(primitive, span, impl_->limits, impl_->profile);
    });
    ValueRange out;
    value::WideRange<Ball> range;
    range.is_known = false;
    if (balls.is_known) {
        range = value::range_wide(
            balls, span, primitive.is_projectable,
            value::evaluations<Ball>(impl_->fragment(t, sample, impl_->profile), impl_->profile),
            index);
    }
    if (range.is_known) {
        out = {!range.is_free, range.range.low.v - range.range.low.e,
               range.range.high.v + range.range.high.e};
    } else {
        const auto& exact = impl_->rationals.get(t, impl_->profile, [&] {
            return value::make_wide_set<mpq_class>(primitive, span, impl_->limits, impl_->profile);
        });
        const auto wide =
            value::range_wide(exact, span, primitive.is_projectable,
                              value::evaluations<mpq_class>(
                                  impl_->fragment(t, sample, impl_->profile), impl_->profile),
                              index);
        out = {!wide.is_free, wide.range.low.get_d(), wide.range.high.get_d()};
    }
    // Outwards: a subtraction rounds by half an ulp, get_d truncates by less than one.
    out.low = std::nextafter(std::nextafter(out.low, -HUGE_VAL), -HUGE_VAL);
    out.high = std::nextafter(std::nextafter(out.high, HUGE_VAL), HUGE_VAL);
    out.is_promised = out.is_promised && std::isfinite(out.low) && std::isfinite(out.high);
    return out;
}

std::vector<ExpectedValue> ValueReference::expected(uint32_t t, SampleId sample) {
    const value::Primitive& primitive = impl_->load(t).primitive;
    std::vector<ExpectedValue> out;
    if (!primitive.is_finite) {
        return out;
    }
    const std::vector<Quantity>& all = impl_->quantities_of(t);
    const value::Fragment fragment = impl_->fragment(t, sample, impl_->profile);
    const auto place = value::evaluations<mpq_class>(fragment, impl_->profile).front();
    const value::Basis<mpq_class>& basis = impl_->exact_basis(t);
    for (const Quantity& q : all) {
        ExpectedValue e;
        e.quantity = q.name;
        if (value::is_sample_kind(q.kind) || q.kind == Kind::flat) {
            e.is_flat = true;
            float f = nominal_number(fragment, q);
            if (q.kind == Kind::flat) {
                f = primitive.draw->attributes[static_cast<size_t>(q.attribute)]
                        .values[primitive.triangle.provoking]
                               [static_cast<glm::vec4::length_type>(q.component)];
            }
            e.nearest = static_cast<double>(f);
            e.exact = std::isfinite(f) ? mpq_class(e.nearest).get_str() : fmt::format("{}", f);
        } else {
            const auto index = static_cast<size_t>(&q - all.data());
            if (basis.orientation == 0 || !impl_->promises(t)[index].is_number) {
                continue;
            }
            if (q.kind == Kind::probe) {
                value::add_expected_probe(primitive, basis, q,
                                          impl_->probe_place(t, sample, impl_->profile), out);
                continue;
            }
            const auto v = value::exact_value(basis, q, place);
            if (v.exists != Answer::yes) {
                continue;
            }
            e.exact = v.value.get_str();
            e.nearest = v.value.get_d();
            e.budget = v.budget.get_d();
            if (q.attribute == -2 && !is_plain_depth(primitive)) {
                e.nearest = nominal_depth(primitive, basis, e.nearest, impl_->profile);
            }
        }
        out.push_back(std::move(e));
    }
    return out;
}

}  // namespace ref
