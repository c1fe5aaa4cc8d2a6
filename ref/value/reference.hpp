// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What values a fragment may carry: attributes (smooth, noperspective, flat), FragCoord and depth.
//
// A smooth value is f = N/D with N = sum b_i f_i/w_i and D = sum b_i/w_i (Vulkan specification,
// "Polygon barycentrics"; Brown, "Barycentric Coordinates as Interpolants", eq. 4 and 5); a
// noperspective value, depth and 1/w are linear. The device may set the planes up from snapped or
// unsnapped positions, or from a clipped piece's vertices, but one basis has to explain all values
// of a fragment. Around each basis the binary32 budget of docs/precision.md, times K
// (exact_budget_factor), is accepted.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/number/plane_budget.hpp"
#include "ref/position/limits.hpp"
#include "ref/reason/reason.hpp"
#include "ref/value/fragment/fragment.hpp"

namespace ref {

// One value that no basis explains.
struct ValueMismatch {
    QuantityId quantity;
    ReasonKind reason = ReasonKind::value_set_up;
    std::string rule;                                 // the reason's, or else the quantity's
    cases::Profile level = cases::Profile::practice;  // loosest profile at which it is wrong
    std::string expected;                             // exact value, budget, as text
    std::string got;                                  // value and bits
    double ratio = 0;  // |got - expected| / budget of the best basis; may be infinite
};

struct FragmentVerdict {
    bool ok = true;
    BasisKind basis = BasisKind::unsnapped;  // the basis that explains the fragment best
    double worst_ratio = 0;  // largest |error| / budget over its values under that basis
    std::optional<QuantityId> worst_quantity;  // the value that has it; nothing without an error
    std::vector<ValueMismatch> mismatches;
};

// One value as the reference has it, for pictures and explanations.
struct ExpectedValue {
    QuantityId quantity;
    std::string_view part = {};  // "partial x of ": not the value, but what it is made of
    std::string exact;           // "p/q"
    double nearest = 0;          // the exact value rounded
    double budget = 0;           // one budget, absolute
    double factor = 0;      // so many budgets are accepted; 0: what is accepted is not told in them
    bool is_flat = false;   // compared bit for bit
    std::string also = {};  // "or 1.375": what else is right
};

// As reports show it: "attribute 1.x", "partial x of attribute 1.x".
inline std::string to_text(const ExpectedValue& value) {
    return std::string(value.part) + to_text(value.quantity);
}

// All that a value may be under a profile, rounded outwards to binary64.
struct ValueRange {
    bool is_promised = false;  // false: nothing is claimed of the value
    double low = 0, high = 0;
    // They are the ends of what several places have, and what lies between the places is wrong.
    bool is_of_places = false;
    // FragCoord.z of a draw with a bias may also be what it is with the bias, and nothing between
    // the two.
    bool has_biased = false;
    double biased_low = 0, biased_high = 0;
};

// Whether a value is below 0: surely, surely not, or as a device computes it. -0 is not.
enum class Sign : uint8_t { negative, not_negative, open };

// The values that somebody delivered; the others of a FragmentValues mean nothing then.
struct ValueSelection {
    bool frag_coord = true, depth = true;
    std::array<bool, cases::kMaxAttributes> attributes{true, true, true, true};
    bool is_all() const { return *this == ValueSelection{}; }
    bool has(const QuantityId& id) const {
        return id.is_depth() ? depth : id.is_attribute() ? attributes.at(id.attribute) : frag_coord;
    }
    friend bool operator==(const ValueSelection&, const ValueSelection&) = default;
};

// Which values of a fragment are judged: the depth plane may hold an older fragment than the
// others, if the last one does not write depth.
enum class FragmentPart : uint8_t { all, all_but_depth, depth };

// Fragments of one triangle with one sample a pixel: of `first` and of its neighbours to the right,
// as many as `frag_coord` has. Planes that nobody has are empty.
struct FragmentRun {
    cases::SampleId first;
    std::span<const glm::vec4> frag_coord;
    std::span<const float> depth;
    std::array<std::span<const glm::vec4>, cases::kMaxAttributes> attributes;
};

// Judges the fragments of one case. It sets a triangle up when first asked; it is not thread-safe.
class ValueReference {
  public:
    ValueReference(const cases::Case& c, const Limits& limits, cases::Profile profile);
    ~ValueReference();
    ValueReference(ValueReference&&) noexcept;

    // From now on only these values are judged; one basis has to explain those together.
    void judge_only(const ValueSelection& selection);

    // From now on a mismatch has its texts, `expected` and `got`, only if `is_told` says so, which
    // is asked when all the rest of it is known: a broken device has thousands of mismatches, and
    // nobody reads most of them.
    void tell_only(std::function<bool(const ValueMismatch&)> is_told);

    // Whether the next verdicts tell how large errors are (worst_ratio, worst_quantity and the
    // ratios of mismatches), which takes most of the time of values that are wrong at profile
    // vulkan; true until it is said.
    void tell_ratios(bool are_told);

    // From now on the level of a wrong value is only asked as long as it may be news: after 16
    // values of a quantity, one of which breaks vulkan, or after 256, others take the loosest of
    // them. That takes a fraction of the time where a picture is wrong everywhere; how often a rule
    // is broken at which level is not known then, and one that 256 values break more strictly may
    // be broken more loosely by a later one.
    void tell_loosest_levels();

    // Judges what triangle `t` (index into assemble(c)) wrote at a sample that it may cover.
    FragmentVerdict judge(uint32_t t, cases::SampleId sample, const FragmentValues& device,
                          FragmentPart part = FragmentPart::all);

    // How many leading fragments of a run are proven right by the first stage of judge() alone,
    // with at most one budget of error; `ratios`, one a fragment, then has their worst_ratio. The
    // next one may be right, too.
    size_t judge_run(uint32_t t, const FragmentRun& run, std::span<double> ratios);

    // The oracle answers the same question by rationals alone, without any filter. It is slow.
    FragmentVerdict judge_exact(uint32_t t, cases::SampleId sample, const FragmentValues& device,
                                FragmentPart part = FragmentPart::all);

    // The exact values of triangle t at a sample, unsnapped basis.
    std::vector<ExpectedValue> expected(uint32_t t, cases::SampleId sample);

    // What a quantity may be; a point if it is flat. Components beyond the attribute's are 0.
    ValueRange range(uint32_t t, cases::SampleId sample, const QuantityId& id);
    // The ranges of all components of an attribute, in less time than one after another.
    // `may_be_outer`: ranges that hold those, in much less time where a triangle has many set-ups.
    std::array<ValueRange, 4> ranges(uint32_t t, cases::SampleId sample, size_t attribute,
                                     bool may_be_outer = false);
    // The sign of what a draw's shader discards by (cases::Discard::negative). `exact_only`: for
    // the oracle, by rationals alone.
    Sign sign(uint32_t t, cases::SampleId sample, bool exact_only = false);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ref
