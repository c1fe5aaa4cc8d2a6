// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/fragment_check.hpp"

#include <fmt/format.h>

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "cases/base/float_bits.hpp"
#include "cases/base/number_text.hpp"
#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "diff/last_fragment.hpp"
#include "diff/pixel_check.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace diff {

namespace {

// The numbers of a fragment that all of its pixels have in common.
std::vector<ref::QuantityId> shared_numbers(const cases::Draw& draw) {
    std::vector<ref::QuantityId> out;
    for (size_t k = 0; k < 4; ++k) {
        out.push_back(ref::QuantityId::of_frag_coord(k));
    }
    for (size_t a = 0; a < draw.attributes.size(); ++a) {
        for (size_t k = 0; k < draw.attributes[a].components; ++k) {
            out.push_back(ref::QuantityId::of_attribute(a, k));
        }
    }
    return out;
}

// What is kept of a fragment while its rows are read.
struct Seen {
    size_t first = 0;         // sample
    bool may_differ = false;  // the triangle is clipped, or nothing is promised of it
    std::vector<bool> is_told;
};

class FragmentCheck {
  public:
    FragmentCheck(const cases::Case& c, const ref::Expectation& expectation,
                  const capture::CaptureView& capture, const std::function<void(Finding)>& add)
        : case_(c), expectation_(expectation), capture_(capture), add_(add) {}

    void run() {
        const cases::Target& target = case_.target;
        for (size_t index = 0; index < capture_.sample_count(); ++index) {
            const cases::SampleId id = cases::sample_at(target, index);
            // The height of a fragment divides the largest one.
            if (id.x == 0 && id.sample == 0 && id.y % cases::kMaxFragmentSide == 0) {
                seen_.clear();
            }
            if (capture::sample_state(capture_, index) == capture::SampleState::drawn) {
                check(index, id);
            }
        }
    }

  private:
    void check(size_t index, const cases::SampleId& id) {
        const cases::Triangle* t = written_triangle(expectation_, capture_, index);
        if (t == nullptr || !cases::has_large_fragments(case_.draws[t->draw])) {
            return;
        }
        const cases::Draw& draw = case_.draws[t->draw];
        const cases::PixelBlock block = cases::fragment_block(draw, id.x, id.y);
        const auto [found, is_new] = seen_.try_emplace({t, block.x, block.y});
        Seen& seen = found->second;
        const std::vector<ref::QuantityId> numbers = shared_numbers(draw);
        if (is_new) {
            const ref::value::Primitive primitive = ref::value::make_primitive(case_, *t);
            seen = {index, primitive.needs_clipping || !primitive.is_finite,
                    std::vector<bool>(numbers.size(), false)};
            return;
        }
        if (seen.may_differ) {
            return;
        }
        const ref::FragmentValues first = values_at(capture_, seen.first);
        const ref::FragmentValues now = values_at(capture_, index);
        for (size_t k = 0; k < numbers.size(); ++k) {
            const float expected = number_of(first, numbers[k]);
            const float got = number_of(now, numbers[k]);
            if (!seen.is_told[k] && !cases::same_bits(expected, got)) {
                seen.is_told[k] = true;
                add_(finding_of(*t, id, cases::sample_at(case_.target, seen.first), numbers[k],
                                {expected, got}));
            }
        }
    }

    Finding finding_of(const cases::Triangle& t, const cases::SampleId& id,
                       const cases::SampleId& first, const ref::QuantityId& number,
                       std::pair<float, float> values) const {
        Finding finding = finding_at(FindingKind::value, case_.target, id);
        finding.rule = cases::rule::fragment_size_shared;
        finding.level = cases::Profile::practice;
        finding.quantity = to_text(number);
        finding.expected =
            fmt::format("{} as at {}", cases::number_text(static_cast<double>(values.first)),
                        cases::sample_text(case_.target, first));
        finding.got = cases::number_text(static_cast<double>(values.second));
        const auto& size = case_.draws[t.draw].fragment_size;
        finding.why = fmt::format(
            "triangle {} of draw {}: one invocation serves the {} x {} pixels of its "
            "fragment",
            t.primitive, t.draw, size[0], size[1]);
        return finding;
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    const std::function<void(Finding)>& add_;
    // By triangle and the first pixel of the block; of four rows.
    std::map<std::tuple<const cases::Triangle*, uint32_t, uint32_t>, Seen> seen_;
};

}  // namespace

bool has_fragment_rules(const cases::Case& c, const ref::Expectation& expectation) {
    return c.target.has_instruments && cases::has_large_fragments(c) &&
           expectation.profile >= cases::Profile::practice;
}

void check_fragments(const cases::Case& c, const ref::Expectation& expectation,
                     const capture::CaptureView& capture, const std::function<void(Finding)>& add) {
    FragmentCheck(c, expectation, capture, add).run();
}

}  // namespace diff
