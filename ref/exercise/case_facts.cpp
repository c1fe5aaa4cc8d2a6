// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/case_facts.hpp"

#include <algorithm>
#include <cmath>

#include "ref/position/position.hpp"

namespace ref {

namespace {

bool is_bad(float number) {
    return !std::isfinite(number) || std::fpclassify(number) == FP_SUBNORMAL ||
           (std::fpclassify(number) == FP_ZERO && std::signbit(number));
}

bool is_bad_vector(const glm::vec4& v) {
    return is_bad(v.x) || is_bad(v.y) || is_bad(v.z) || is_bad(v.w);
}

bool has_bad_numbers(const cases::Case& c) {
    return std::ranges::any_of(c.draws, [](const cases::Draw& draw) {
        return std::ranges::any_of(draw.positions,
                                   [](const glm::vec4& v) {
                                       return is_bad_vector(v) ||
                                              !is_representable(v, cases::Profile::direct3d);
                                   }) ||
               std::ranges::any_of(draw.attributes, [](const cases::Attribute& attribute) {
                   return std::ranges::any_of(attribute.values, is_bad_vector);
               });
    });
}

}  // namespace

CaseFacts::CaseFacts(const cases::Case& c, const Limits& limits, Shown* shown)
    : case_(c),
      limits_(limits),
      shown_(shown),
      triangles_(cases::assemble(c)),
      quantities_(c.draws.size()) {}

const std::vector<value::Quantity>& CaseFacts::quantities(uint32_t draw) {
    if (quantities_[draw].empty()) {
        quantities_[draw] = value::quantities(case_.draws[draw], case_.target);
    }
    return quantities_[draw];
}

bool CaseFacts::has_bad_number() {
    if (!has_bad_number_) {
        has_bad_number_ = has_bad_numbers(case_);
    }
    return *has_bad_number_;
}

Decision CaseFacts::decide(uint32_t t, const JudgedSample& sample) {
    if (explainer_ == nullptr) {
        explainer_ = std::make_unique<Explainer>(case_, limits_, cases::Profile::direct3d);
    }
    return explainer_->decide(t, sample.p, sample.id);
}

// The depth that a triangle most likely has at the sample in a case, NaN if it has none.
double CaseFacts::depth_of(ValueReference& values, uint32_t t, const JudgedSample& sample) {
    for (const ExpectedValue& value : values.expected(t, sample.id)) {
        if (value.quantity.is_depth()) {
            return value.nearest;
        }
    }
    return std::nan("");
}

// Beyond the range without bias; or at its end, which is as far as any depth is told to be, with
// the bias alone. In binary32: fixed point may round to the end.
bool CaseFacts::is_beyond_range(uint32_t t, const JudgedSample& sample) {
    if (!biased_values_) {
        biased_ = std::make_unique<cases::Case>(case_);
        biased_->target.depth_format = cases::DepthFormat::d32_float;
        for (cases::Draw& draw : biased_->draws) {
            draw.depth.clip = draw.depth.clip.value_or(!draw.depth.clamp);
            draw.depth.clamp = false;
        }
        plain_ = std::make_unique<cases::Case>(*biased_);
        for (cases::Draw& draw : plain_->draws) {
            draw.depth.bias.reset();
        }
        biased_values_.emplace(*biased_, limits_, cases::Profile::direct3d);
        plain_values_.emplace(*plain_, limits_, cases::Profile::direct3d);
    }
    const cases::Viewport& viewport = draw_of(t).viewport;
    const double low = std::min(viewport.min_depth, viewport.max_depth);
    const double high = std::max(viewport.min_depth, viewport.max_depth);
    const double plain = depth_of(*plain_values_, t, sample);
    if (plain < low || plain > high) {
        return true;
    }
    const double biased = depth_of(*biased_values_, t, sample);
    return plain > low && plain < high && (!(biased > low) || !(biased < high));
}

}  // namespace ref
