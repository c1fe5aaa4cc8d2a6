// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "ref/exercise/exercise_table.hpp"
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

CaseFacts::CaseFacts(const cases::Case& c, const Limits& limits)
    : case_(c), limits_(limits), triangles_(cases::assemble(c)), quantities_(c.draws.size()) {}

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

bool CaseFacts::is_beyond_range(uint32_t t, const JudgedSample& sample) {
    if (unclamped_ == nullptr) {
        unclamped_ = std::make_unique<cases::Case>(case_);
        for (cases::Draw& draw : unclamped_->draws) {
            draw.depth.clip = draw.depth.clip.value_or(!draw.depth.clamp);
            draw.depth.clamp = false;
        }
        unclamped_values_ =
            std::make_unique<ValueReference>(*unclamped_, limits_, cases::Profile::direct3d);
    }
    const cases::Viewport& viewport = draw_of(t).viewport;
    const double low = std::min(viewport.min_depth, viewport.max_depth);
    const double high = std::max(viewport.min_depth, viewport.max_depth);
    const std::vector<ExpectedValue> values = unclamped_values_->expected(t, sample.id);
    return std::ranges::any_of(values, [&](const ExpectedValue& value) {
        return value.quantity.is_depth() && (value.nearest < low || value.nearest > high);
    });
}

}  // namespace ref
