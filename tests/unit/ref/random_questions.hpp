// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Random fragments of a sample, with stencil states, sets, twins and open comparisons.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "ref/path/path.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {

using cases::CompareOp;
using cases::StencilFace;
using cases::StencilOp;

class RandomQuestions : public value_test::Random {
  public:
    using Random::Random;

    StencilFace face() {
        StencilFace out;
        out.compare = static_cast<CompareOp>(below(8));
        for (StencilOp* op : {&out.fail, &out.depth_fail, &out.pass}) {
            *op = static_cast<StencilOp>(below(8));
        }
        out.compare_mask = mask();
        out.write_mask = mask();
        out.reference = value();
        return out;
    }
    cases::StencilState state() { return {face(), face()}; }

    // States outlive the question.
    path::Question question(std::vector<cases::StencilState>& states) {
        path::Question out;
        out.clear = value();
        out.is_unknown = one_in(24);
        const uint32_t count = 1 + below(7);
        states.resize(count);
        for (uint32_t m = 0; m < count; ++m) {
            states[m] = state();
            path::Fragment fragment{&states[m], one_in(2), !one_in(3), false, !one_in(3)};
            fragment.can_be_back = !fragment.can_be_front || one_in(3);
            fragment.is_discarded_front = one_in(6);
            fragment.is_discard_open = one_in(6);
            fragment.is_clear = fragment.is_discarded_front && one_in(2);
            if (m > 0 && one_in(5)) {
                fragment.twin = static_cast<int>(below(m));
                fragment.is_sure = out.fragments[static_cast<size_t>(fragment.twin)].is_sure;
            }
            out.fragments.push_back(fragment);
        }
        if (count > 2 && one_in(2)) {
            out.sets.push_back({below(2), 1 + below(2)});
            for (const uint32_t m : {0U, count - 2, count - 1}) {
                path::Fragment& fragment = out.fragments[m];
                fragment.is_sure = false;
                fragment.twin = -1;
                fragment.set = 0;
            }
            for (path::Fragment& fragment : out.fragments) {
                fragment.twin = -1;
            }
        }
        if (one_in(3)) {
            const uint64_t salt = bits();
            out.bounds = [salt](int stored, uint32_t m) {
                std::mt19937_64 of(salt + m * 64 + static_cast<uint64_t>(stored + 1));
                return static_cast<DepthOutcome>(of() % 3);
            };
        }
        if (!one_in(3)) {
            const uint64_t salt = bits();
            out.depth = [salt](int stored, uint32_t m) {
                std::mt19937_64 of(salt + m * 64 + static_cast<uint64_t>(stored + 1));
                return static_cast<DepthOutcome>(of() % 3);
            };
        }
        return out;
    }

  private:
    uint32_t value() {
        constexpr std::array<uint32_t, 8> kEnds = {0, 1, 254, 255, 0x7f, 0x80, 3, 0x5a};
        return one_in(4) ? below(256) : kEnds.at(below(8));
    }
    uint32_t mask() { return one_in(2) ? 0xffU : one_in(4) ? below(1U << 12U) : value(); }
};

}  // namespace ref::test
