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
#include "ref/value/set_ups.hpp"

namespace ref::value {

constexpr const char* kLodFreedom = "or up to half a level and the freedom of the quad away";

// Where a quantity is evaluated first.
template <class T>
const Point<T>& first_point(const Quantity& q, const Evaluation<T>& place) {
    return q.at_sample     ? place.sample
           : q.at_centroid ? place.centroid.front()
                           : place.attributes.front();
}

template <class T>
Valued<T> nominal_value(const Basis<T>& basis, const Quantity& q, const Evaluation<T>& place,
                        cases::Profile profile) {
    const T factor = from_exact<T>(exact_budget_factor(profile));
    const Site<T> site = make_site(basis, basis.planes[kPlaneInvW], first_point(q, place), factor);
    return value_at(site, basis.planes[q.plane], q.kind == Kind::perspective, factor);
}

template Valued<Ball> nominal_value(const Basis<Ball>&, const Quantity&, const Evaluation<Ball>&,
                                    cases::Profile);
template Valued<mpq_class> nominal_value(const Basis<mpq_class>&, const Quantity&,
                                         const Evaluation<mpq_class>&, cases::Profile);

mpq_class exact_value(const Basis<mpq_class>& basis, const Quantity& q,
                      const Evaluation<mpq_class>& place) {
    const Point<mpq_class>& p = first_point(q, place);
    mpq_class value = basis.planes[q.plane].form.at(p);
    if (q.kind == Kind::perspective) {
        value /= basis.planes[kPlaneInvW].form.at(p);
    }
    return value;
}

std::vector<OtherCoord> other_coords(const Primitive& primitive, const Basis<mpq_class>& basis,
                                     const Quantity& q,
                                     std::span<const Evaluation<mpq_class>> places,
                                     cases::Profile profile) {
    std::vector<OtherCoord> out;
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

std::string number_text(double nearest, const std::optional<mpq_class>& exact) {
    const std::string text = cases::number_text(nearest);
    const std::string fraction = exact ? exact->get_str() : text;
    return fraction == text || fraction.size() > 40 ? text : text + " = " + fraction;
}

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

template <class T>
Answer is_other_vertex(const Basis<T>& basis, const Quantity& q, std::span<const Quantity> all,
                       const Evaluation<T>& place, cases::Profile profile, double device) {
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

}  // namespace

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

}  // namespace ref::value
