// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/base/number_text.hpp"
#include "ref/number/rational.hpp"
#include "ref/value/accept/reach.hpp"
#include "ref/value/fragment/partials.hpp"
#include "ref/value/sample_values.hpp"

namespace ref::value {

using cases::Profile;

namespace {

constexpr const char* kLodFreedom = "or up to half a level and the freedom of the quad away";

// Where a quantity is evaluated first.
template <class T>
const Point<T>& first_point(const Quantity& q, const Evaluation<T>& place) {
    return q.at_sample     ? place.sample
           : q.at_centroid ? place.centroid.front()
                           : place.attributes.front();
}

}  // namespace

template <class T>
Valued<T> nominal_value(const Basis<T>& basis, const Quantity& q, const Evaluation<T>& place,
                        Profile profile) {
    const T factor = from_exact<T>(exact_budget_factor(profile));
    const Site<T> site = make_site(basis, basis.planes[kPlaneInvW], first_point(q, place), factor);
    return value_at(site, basis.planes[q.plane], q.kind == Kind::perspective, factor);
}

template Valued<Ball> nominal_value(const Basis<Ball>&, const Quantity&, const Evaluation<Ball>&,
                                    cases::Profile);
template Valued<mpq_class> nominal_value(const Basis<mpq_class>&, const Quantity&,
                                         const Evaluation<mpq_class>&, cases::Profile);

template <class T>
Answer is_other_vertex(const Basis<T>& basis, const Quantity& q, std::span<const Quantity> all,
                       const Evaluation<T>& place, Profile profile, double device) {
    if (basis.orientation == 0 || !std::isfinite(device)) {
        return Answer::no;
    }
    Answer any = Answer::no;
    for (const Quantity& other : all) {
        if (other.id.of != q.id.of || other.id.attribute != q.id.attribute ||
            other.id.component == q.id.component) {
            continue;
        }
        const Valued<T> v = nominal_value(basis, other, place, profile);
        const Answer one = both(v.exists, is_at_most(magnitude(T(T(device) - v.value)), v.reach));
        if (one == Answer::yes) {
            return one;
        }
        any = one == Answer::unknown ? one : any;
    }
    return any;
}

template Answer is_other_vertex(const Basis<Ball>&, const Quantity&, std::span<const Quantity>,
                                const Evaluation<Ball>&, cases::Profile, double);
template Answer is_other_vertex(const Basis<mpq_class>&, const Quantity&, std::span<const Quantity>,
                                const Evaluation<mpq_class>&, cases::Profile, double);

namespace {

// The value alone, where it is known that there is one.
mpq_class exact_value(const Basis<mpq_class>& basis, const Quantity& q,
                      const Evaluation<mpq_class>& place) {
    const Point<mpq_class>& p = first_point(q, place);
    mpq_class value = basis.planes[q.plane].form.at(p);
    if (q.kind == Kind::perspective) {
        value /= basis.planes[kPlaneInvW].form.at(p);
    }
    return value;
}

// The depth of a plane with the bias of nominal_bias().
mpq_class biased_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                       const mpq_class& z, Profile profile) {
    return z + nominal_bias(make_depth_path<mpq_class>(primitive, profile), basis);
}

// The depth that a device most likely stores, from the exact one of its plane: with the bias of
// nominal_bias(), clamped, and in fixed point the nearest step.
mpq_class nominal_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                        const mpq_class& z, Profile profile) {
    const auto path = make_depth_path<mpq_class>(primitive, profile);
    const mpq_class out = std::clamp(biased_depth(primitive, basis, z, profile),
                                     mpq_class(path.viewport.low), mpq_class(path.viewport.high));
    const double steps = cases::depth_steps(path.format);
    const mpq_class half(1, 2);
    return steps > 0
               ? mpq_class(floor_of(mpq_class(out * mpq_class(steps) + half))) / mpq_class(steps)
               : out;
}

// What else FragCoord.z or w may be near, besides its value at the first place: its values at the
// other single places of a profile that has nothing between them, and z with the bias. Each ends
// with what it is: {0.4375, "with the bias"}, {0.375, "at a sample"}.
struct OtherCoord {
    double nearest = 0;
    std::string what;
};
std::vector<OtherCoord> other_coords(const Primitive& primitive, const Basis<mpq_class>& basis,
                                     const Quantity& q,
                                     std::span<const Evaluation<mpq_class>> places,
                                     Profile profile) {
    std::vector<OtherCoord> out;
    if (q.id.of != QuantityId::Of::frag_coord) {
        return out;
    }
    std::vector<Point<mpq_class>> points = {places.front().attributes.front()};
    for (const Evaluation<mpq_class>& place : places) {
        const bool is_single = place.frag_coord.size() == 1;
        if (is_single && std::ranges::none_of(points, [&](const Point<mpq_class>& p) {
                return p.x == place.frag_coord.front().x && p.y == place.frag_coord.front().y;
            })) {
            points.push_back(place.frag_coord.front());
        }
    }
    if (points.size() == 1 && !(is_frag_coord_z(q) && primitive.draw->depth.bias)) {
        return out;
    }
    std::vector<mpq_class> told;
    for (const Point<mpq_class>& point : points) {
        Evaluation<mpq_class> there = places.front();
        there.attributes = {point};
        const Valued<mpq_class> v = nominal_value(basis, q, there, profile);
        if (v.exists != Answer::yes) {
            continue;
        }
        const bool is_first = &point == &points.front();
        const mpq_class half(1, 2);
        const bool is_centre =
            point.x - floor_of(point.x) == half && point.y - floor_of(point.y) == half;
        const std::string where = is_centre ? "at the centre" : "at a sample";
        if (std::ranges::find(told, v.value) != told.end()) {
            continue;
        }
        told.push_back(v.value);
        if (!is_first) {
            out.push_back({v.value.get_d(), where});
        }
        if (is_frag_coord_z(q) && primitive.draw->depth.bias) {
            out.push_back({biased_depth(primitive, basis, v.value, profile).get_d(),
                           is_first ? "with the bias" : where + " with the bias"});
        }
    }
    return out;
}

// "0.333333333 = 1/3"; without the fraction if it says no more, or is too long to be read.
std::string number_text(double nearest, const std::optional<mpq_class>& exact) {
    const std::string text = cases::number_text(nearest);
    const std::string fraction = exact ? exact->get_str() : text;
    return fraction == text || fraction.size() > 40 ? text : text + " = " + fraction;
}

// The number of a probe's likeliest quad, and what it is made of.
std::string probe_text(const Basis<mpq_class>& basis, const Quantity& q, const ProbePlace& place) {
    const auto v = basis.orientation != 0 ? expected_probe(basis, q, place) : std::nullopt;
    if (!v) {
        return "a number that the values around the pixel explain";
    }
    if (q.probe == cases::Probe::lod) {
        return fmt::format("{}, {}", cases::number_text(v->nearest), kLodFreedom);
    }
    return fmt::format("{} within {:.4g} x {:.3g}{}", number_text(v->nearest, v->exact),
                       budget_factor(place.profile), v->budget,
                       derivative_of(q.probe) ? ", or the difference of another quad" : "");
}

// Partials of the input at the pixel centre from the ideal positions; nothing where they do not
// exist.
std::optional<Partials> partials_of(const Primitive& primitive, const Quantity& q,
                                    const ProbePlace& place) {
    const Vertices<mpq_class> v = ideal_vertices<mpq_class>(primitive);
    const auto values = attribute_values(primitive, q.id.attribute, q.id.component);
    std::array<PartialVertex, 3> vertices;
    for (size_t i = 0; i < 3; ++i) {
        if (!v.finite[i] || !std::isfinite(values[i])) {
            return std::nullopt;
        }
        vertices[i] = {v.hx[i] / v.w[i], v.hy[i] / v.w[i], q.is_perspective ? v.w[i] : mpq_class(1),
                       mpq_class(static_cast<double>(values[i]))};
    }
    return partials_at(vertices, mpq_class(place.id.x + 0.5), mpq_class(place.id.y + 0.5), 1);
}

// Appends the expected value of a probe; of a derivative also the partials.
void add_expected_probe(const Primitive& primitive, const Basis<mpq_class>& basis,
                        const Quantity& q, const ProbePlace& place,
                        std::vector<ExpectedValue>& out) {
    const auto v = expected_probe(basis, q, place);
    if (!v) {
        return;
    }
    ExpectedValue e;
    e.quantity = q.id;
    e.exact = v->exact ? v->exact->get_str() : fmt::format("{}", v->nearest);
    e.nearest = v->nearest;
    e.budget = v->budget;
    if (q.probe == cases::Probe::lod) {
        e.also = kLodFreedom;
    } else {
        e.factor = budget_factor(place.profile);
    }
    out.push_back(std::move(e));
    if (!derivative_of(q.probe)) {
        return;
    }
    const auto partials = partials_of(primitive, q, place);
    if (!partials) {
        return;
    }
    for (const auto& [name, value] :
         {std::pair{"partial x of ", partials->dx}, std::pair{"partial y of ", partials->dy},
          std::pair{"total differential of ", partials->total}}) {
        out.push_back({q.id, name, value.get_str(), value.get_d(), 0, 0, false});
    }
}

// The exact value of a linear or perspective quantity, and one budget. Rationals have the value;
// its budget, by which nobody is judged, is of Balls where these prove that there is a value.
struct Nominal {
    mpq_class value;
    double budget = 0;
};
std::optional<Nominal> nominal_of(const Basis<mpq_class>& basis, const Basis<Ball>& near,
                                  const Quantity& q, const Evaluation<mpq_class>& place,
                                  const Evaluation<Ball>& near_place, Profile profile) {
    if (near.orientation == 1 || near.orientation == -1) {
        const Valued<Ball> v = nominal_value(near, q, near_place, profile);
        if (v.exists == Answer::no) {
            return std::nullopt;
        }
        if (v.exists == Answer::yes) {
            return Nominal{exact_value(basis, q, place), nearest_double(v.budget)};
        }
    }
    const Valued<mpq_class> v = nominal_value(basis, q, place, profile);
    if (v.exists != Answer::yes) {
        return std::nullopt;
    }
    return Nominal{v.value, v.budget.get_d()};
}

// A quantity that is compared bit for bit.
ExpectedValue expected_number(const Primitive& primitive, const Fragment& fragment,
                              const Quantity& q, Profile profile) {
    const bool is_flat = q.kind == Kind::flat;
    const float f = is_flat ? provoking_value(primitive, q.id) : nominal_number(fragment, q);
    ExpectedValue e;
    e.quantity = q.id;
    e.is_flat = true;
    e.nearest = static_cast<double>(f);
    e.also = is_flat ? std::string() : also_allowed(fragment, q, profile);
    e.exact = std::isfinite(f) ? mpq_class(e.nearest).get_str() : fmt::format("{}", f);
    return e;
}

}  // namespace

std::string expected_text(SetUps& set_ups, uint32_t t, cases::SampleId id, const Quantity& q) {
    const Profile profile = set_ups.profile();
    const Primitive& primitive = set_ups.primitive(t);
    const Basis<mpq_class>& basis = set_ups.unsnapped_basis<mpq_class>(t);
    if (q.kind == Kind::probe) {
        return probe_text(basis, q, set_ups.probe_place(t, id, profile));
    }
    const auto places = set_ups.places<mpq_class>(t, id, profile);
    const auto& place = places.front();
    const bool has_area = basis.orientation != 0;
    const auto v = has_area ? nominal_value(basis, q, place, profile) : Valued<mpq_class>{};
    if (v.exists != Answer::yes) {
        const bool is_outside =
            has_area && (primitive.draw->conservative == cases::Conservative::overestimate ||
                         !is_same(place.attributes, place.sample));
        return is_outside ? "any finite value" : "a value between the vertex values";
    }
    const double factor = budget_factor(profile);
    if (q.id.is_depth() && !is_plain_depth(primitive)) {
        return fmt::format("{:.9g} or near it (plane {:.9g} within {:.4g} x {:.3g})",
                           nominal_depth(primitive, basis, v.value, profile).get_d(),
                           v.value.get_d(), factor, v.budget.get_d());
    }
    std::string text = fmt::format("{} within {:.4g} x {:.3g}",
                                   number_text(v.value.get_d(), v.value), factor, v.budget.get_d());
    for (const OtherCoord& other : other_coords(primitive, basis, q, places, profile)) {
        text += fmt::format(", or {:.9g} or near it {}", other.nearest, other.what);
    }
    return text;
}

std::vector<ExpectedValue> expected_values(SetUps& set_ups, uint32_t t, cases::SampleId sample) {
    const Profile profile = set_ups.profile();
    const Primitive& primitive = set_ups.primitive(t);
    std::vector<ExpectedValue> out;
    if (!primitive.is_finite) {
        return out;
    }
    const Fragment fragment = set_ups.fragment(t, sample, profile);
    const auto places = evaluations<mpq_class>(fragment, profile);
    const auto near_places = evaluations<Ball>(fragment, profile);
    const Basis<mpq_class>& basis = set_ups.unsnapped_basis<mpq_class>(t);
    const Basis<Ball>& near = set_ups.unsnapped_basis<Ball>(t);
    const std::vector<Quantity>& all = set_ups.quantities_of(t);
    for (size_t index = 0; index < all.size(); ++index) {
        const Quantity& q = all[index];
        if (is_sample_kind(q.kind) || q.kind == Kind::flat) {
            out.push_back(expected_number(primitive, fragment, q, profile));
            continue;
        }
        if (basis.orientation == 0 || !set_ups.promise(t, index).is_number) {
            continue;
        }
        if (q.kind == Kind::probe) {
            add_expected_probe(primitive, basis, q, set_ups.probe_place(t, sample, profile), out);
            continue;
        }
        const std::optional<Nominal> v =
            nominal_of(basis, near, q, places.front(), near_places.front(), profile);
        if (!v) {
            continue;
        }
        const bool is_stored = q.id.is_depth() && !is_plain_depth(primitive);
        const mpq_class value =
            is_stored ? nominal_depth(primitive, basis, v->value, profile) : v->value;
        ExpectedValue& e = out.emplace_back();
        e.quantity = q.id;
        e.exact = value.get_str();
        e.nearest = value.get_d();
        e.budget = v->budget;
        e.factor = budget_factor(profile);
        for (const OtherCoord& other : other_coords(primitive, basis, q, places, profile)) {
            e.also += fmt::format("{}or {:.9g} {}", e.also.empty() ? "" : ", ", other.nearest,
                                  other.what);
        }
    }
    return out;
}

}  // namespace ref::value
