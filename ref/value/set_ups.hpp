// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is set up of the triangles of a case when it is first asked for, and kept: bases and
// filters, sets of candidates and their bounds, coverage by profile.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "ref/value/accept/filter.hpp"
#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/accept/probe.hpp"
#include "ref/value/accept/set_bounds.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/fragment/promise.hpp"
#include "ref/value/places.hpp"

namespace ref::value {

// Keeps the answers that were asked for last.
template <class Key, class Answer>
class Recent {
  public:
    explicit Recent(size_t capacity) : capacity_(capacity) {}

    template <class Make>
    const Answer& get(const Key& key, Make make) {
        for (const auto& [known, answer] : entries_) {
            if (known == key) {
                return answer;
            }
        }
        if (entries_.size() == capacity_) {
            entries_.pop_front();
        }
        return entries_.emplace_back(key, make()).second;
    }

    void forget(const Key& key) {
        std::erase_if(entries_, [&](const auto& entry) { return entry.first == key; });
    }

  private:
    size_t capacity_;
    std::deque<std::pair<Key, Answer>> entries_;
};

// The two nominal bases, for the first stage.
struct Filters {
    Filter unsnapped;
    std::optional<Filter> snapped;  // where it differs
};

// Depth that is stored as it is interpolated: the filters know no other.
bool is_plain_depth(const Primitive& primitive);

// What a flat component is: the provoking vertex's.
float provoking_value(const Primitive& primitive, const QuantityId& id);

// Triangles are named by their index into assemble(c). What an answer refers to is kept for the
// last 16,384 triangles, sets of candidates and places for fewer.
class SetUps {
  public:
    SetUps(const cases::Case& c, const Limits& limits, cases::Profile profile);

    cases::Profile profile() const { return profile_; }
    const cases::Target& target() const { return case_.target; }
    uint32_t draw_of(uint32_t t) const { return triangles_[t].draw; }
    const std::vector<Quantity>& quantities_of(uint32_t t) const { return quantities_[draw_of(t)]; }
    const std::vector<std::vector<Quantity>>& quantities() const { return quantities_; }  // by draw

    const Primitive& primitive(uint32_t t) { return load(t).primitive; }
    const Filters& filters(uint32_t t);
    const Promise& promise(uint32_t t, size_t index);
    // Whether a profile asks for a quantity.
    bool is_asked(uint32_t t, size_t index, cases::Profile at);
    // The index of a quantity that has a plane which the profile asks for.
    std::optional<size_t> asked_plane(uint32_t t, const QuantityId& id);

    // Where the fragment is, and what a profile says of its coverage if anything depends on it.
    Fragment fragment(uint32_t t, cases::SampleId id, cases::Profile at, bool is_exact = false);
    // Leaves out the part of the pixel that lies in the primitive, which takes rationals.
    Fragment covered_fragment(uint32_t t, cases::SampleId id, cases::Profile at, bool is_exact);
    // Where the fragment's inputs may be evaluated at a profile.
    template <class T>
    std::vector<Evaluation<T>> places(uint32_t t, cases::SampleId id, cases::Profile at,
                                      bool is_exact = false) {
        return evaluations<T>(fragment(t, id, at, is_exact), at);
    }
    // The places at the profile; the last answer is kept.
    const std::vector<Evaluation<Ball>>& kept_places(uint32_t t, cases::SampleId id);
    ProbePlace probe_place(uint32_t t, cases::SampleId id, cases::Profile at) const;

    template <class T>
    const CandidateSet<T>& candidates(uint32_t t, cases::Profile at) {
        return std::get<Sets<T>>(candidates_).get({t, at}, [&] {
            return make_candidates<T>(primitive(t), quantities_of(t), limits_, at);
        });
    }
    // What the Balls of the triangle's set tell or, if they cannot, those of the exact set, which
    // are kept from then on; the last answer if neither can.
    template <class Ask>
    auto ask_balls(uint32_t t, cases::Profile at, Ask ask) {
        auto answer = ask(candidates<Ball>(t, at));
        if (answer || candidates<Ball>(t, at).exact) {
            return answer;
        }
        auto& sets = std::get<Sets<Ball>>(candidates_);
        sets.forget({t, at});
        return ask(sets.get({t, at}, [&] { return rounded(candidates<mpq_class>(t, at)); }));
    }
    // Bounds on all that a profile admits for the triangle.
    const SetBounds& bounds(uint32_t t, cases::Profile at);
    // The unsnapped basis; that of the last triangle is kept.
    template <class T>
    const Basis<T>& unsnapped_basis(uint32_t t) {
        return std::get<Recent<uint32_t, Basis<T>>>(told_bases_).get(t, [&] {
            const Primitive& of = primitive(t);
            return make_basis(ideal_vertices<T>(of), plane_inputs<T>(of, quantities_of(t)),
                              kBudgetFactor);
        });
    }

  private:
    struct Loaded {
        Primitive primitive;
        std::optional<Filters> filters;
        std::optional<std::vector<Promise>> promises;
        std::array<std::optional<SetBounds>, std::size(cases::kProfiles)> bounds;
    };
    Loaded& load(uint32_t t);
    FragmentCoverage& coverage_at(cases::Profile at);

    const cases::Case& case_;
    Limits limits_;
    cases::Profile profile_;
    std::vector<cases::Triangle> triangles_;
    std::vector<std::vector<Quantity>> quantities_;
    std::vector<std::unique_ptr<Loaded>> loaded_;  // by triangle
    std::deque<uint32_t> order_;                   // of the loaded ones, oldest first
    // Sets are large (up to 64 bases) and needed for few triangles.
    template <class T>
    using Sets = Recent<std::pair<uint32_t, cases::Profile>, CandidateSet<T>>;
    std::tuple<Sets<Ball>, Sets<mpq_class>> candidates_{128, 32};
    std::array<std::unique_ptr<FragmentCoverage>, std::size(cases::kProfiles)> coverage_;
    std::tuple<Recent<uint32_t, Basis<Ball>>, Recent<uint32_t, Basis<mpq_class>>> told_bases_{1, 1};
    Recent<std::pair<uint32_t, cases::SampleId>, std::vector<Evaluation<Ball>>> places_{1};
};

}  // namespace ref::value
