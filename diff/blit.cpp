// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/blit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/format/color_format.hpp"
#include "cases/model/rule_ids.hpp"
#include "ref/blit/blit.hpp"

namespace diff {

namespace {

using cases::Profile;
using cases::TexelCodes;

// The codes of the components that the format has.
std::string show(const TexelCodes& codes, cases::ColorFormat format) {
    std::string text;
    for (uint32_t k = 0; k < 4; ++k) {
        const cases::ComponentFormat component = cases::component_of(format, k);
        if (component.bits == 0) {
            continue;
        }
        const bool is_float = is_floating(component.kind);
        text += text.empty() ? "codes (" : ", ";
        text += is_float ? fmt::format("{:#x}", codes[k]) : fmt::format("{}", codes[k]);
    }
    return text + ")";
}

class BlitComparison {
  public:
    BlitComparison(const cases::Case& c, Profile profile, const capture::CaptureView& capture)
        : case_(c), reference_(c), capture_(capture) {
        verdict_.profile = profile;
        verdict_.level = profile;
    }

    Verdict run() {
        const size_t count = capture_.sample_count();
        if (capture_.target != case_.target || capture_.color.size() != count) {
            verdict_.error = fmt::format(
                "the capture has another size than the case's {}x{} target, or no colour",
                case_.target.width, case_.target.height);
            return std::move(verdict_);
        }
        verdict_.expected_hits.resize(count);
        verdict_.device_hits.resize(count);
        verdict_.marks.assign(count, SampleMark::ok);
        for (uint32_t y = 0; y < case_.target.height; ++y) {
            for (uint32_t x = 0; x < case_.target.width; ++x) {
                judge(x, y);
            }
        }
        if (verdict_.error.empty() && verdict_.must_samples == 0) {
            verdict_.error = "the blit writes no texel, so an empty picture would pass";
        }
        return std::move(verdict_);
    }

  private:
    void judge(uint32_t x, uint32_t y) {
        const size_t index = size_t{y} * case_.target.width + x;
        const TexelCodes& got = capture_.color[index];
        if (capture::sample_state(capture_, index) == capture::SampleState::not_copied) {
            verdict_.error = fmt::format(
                "texel ({}, {}) was not copied from the device: it still holds the read-back "
                "memory's fill pattern",
                x, y);
            return;
        }
        const bool inside = reference_.is_inside(x, y);
        const bool is_clear = reference_.is_clear(got, verdict_.profile);
        verdict_.expected_hits[index] = inside ? 1 : 0;
        verdict_.device_hits[index] = is_clear ? 0 : 1;
        verdict_.must_samples += inside ? 1 : 0;
        ++verdict_.compared_samples;
        if (reference_.has_freedom(x, y, verdict_.profile)) {
            verdict_.marks[index] = SampleMark::either;
            ++verdict_.either_samples;
        }
        if (reference_.allows(x, y, got, verdict_.profile)) {
            return;
        }
        Finding finding;
        finding.x = x;
        finding.y = y;
        finding.level = loosest_wrong(verdict_.profile, [&](Profile profile) {
            return !reference_.allows(x, y, got, profile);
        });
        finding.kind = !inside    ? FindingKind::extra
                       : is_clear ? FindingKind::missing
                                  : FindingKind::value;
        finding.rule = !inside ? cases::rule::blit_outside
                       : case_.blit->filter == cases::BlitFilter::linear
                           ? cases::rule::blit_linear
                           : cases::rule::blit_nearest;
        finding.quantity = finding.kind == FindingKind::value ? "texel" : "";
        finding.expected = show(reference_.nominal(x, y), case_.target.color->format);
        finding.got = show(got, case_.target.color->format);
        finding.why = reference_.explain(x, y);
        verdict_.add(std::move(finding), case_.target);
    }

    const cases::Case& case_;
    ref::BlitReference reference_;
    const capture::CaptureView& capture_;
    Verdict verdict_;
};

}  // namespace

Verdict compare_blit(const cases::Case& c, Profile profile, const capture::CaptureView& capture) {
    return BlitComparison(c, profile, capture).run();
}

}  // namespace diff
