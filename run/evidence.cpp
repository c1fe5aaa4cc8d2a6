// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <set>

#include "diff/last_fragment.hpp"
#include "ref/color/color.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/path/path.hpp"
#include "ref/stencil/values.hpp"
#include "ref/value/reference.hpp"
#include "run/picture.hpp"
#include "run/plane_pictures.hpp"

namespace run {

namespace {

using report::SampleEvidence;
using report::SampleValue;

// Wrong samples, the first of each rule before the rest; then their neighbours.
std::vector<size_t> chosen_samples(const PictureWindow& window, const cases::Target& target,
                                   const diff::Verdict& verdict) {
    std::vector<size_t> chosen;
    std::set<size_t> seen;
    const auto choose = [&](size_t index, size_t most) {
        if (chosen.size() < most && seen.insert(index).second) {
            chosen.push_back(index);
        }
    };
    std::set<std::string> rules;
    for (const diff::Finding& f : verdict.findings) {
        if (!f.of_case && rules.insert(f.rule).second) {
            choose(cases::index_of(target, diff::sample_of(f)), report::kMaxEvidence);
        }
    }
    for (const diff::Finding& f : verdict.findings) {
        if (!f.of_case) {
            choose(cases::index_of(target, diff::sample_of(f)), report::kMaxEvidence * 3 / 4);
        }
    }
    const std::vector<size_t> wrong = chosen;
    for (const size_t index : wrong) {
        cases::SampleId id = cases::sample_at(target, index);
        const uint32_t y0 = std::max(id.y, 1U) - 1;
        const uint32_t y1 = std::min(id.y + 1, target.height - 1);
        const uint32_t x0 = std::max(id.x, 1U) - 1;
        const uint32_t x1 = std::min(id.x + 1, target.width - 1);
        for (id.y = y0; id.y <= y1; ++id.y) {
            for (id.x = x0; id.x <= x1; ++id.x) {
                choose(cases::index_of(target, id), report::kMaxEvidence);
            }
        }
    }
    if (chosen.empty()) {  // a passing case that was asked for: the first samples drawn
        window.for_each([&](uint32_t, uint32_t, uint32_t, size_t index) {
            if (verdict.device_hits[index] > 0) {
                choose(index, report::kMaxEvidence / 4);
            }
        });
    }
    return chosen;
}

std::string range_text(uint32_t low, uint32_t high) {
    return low == high ? fmt::format("{}", low) : fmt::format("{} to {}", low, high);
}

std::string hits_text(const ref::HitBounds& b) {
    std::string text = range_text(b.total_min, b.total_max);
    if (b.front_max > 0 || b.back_max > 0) {
        text += fmt::format(" ({} front, {} back)", range_text(b.front_min, b.front_max),
                            range_text(b.back_min, b.back_max));
    }
    return text;
}

class EvidenceMaker {
  public:
    EvidenceMaker(const cases::Case& c, const ref::Expectation& expectation,
                  const capture::CaptureView& capture, const ref::Limits& limits)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          values_(c, limits, expectation.profile) {
        if (has_tests(c) && expectation.triangles.size() <= kMostExplained) {
            explainer_.emplace(c, limits, expectation.profile);
        }
        if (c.target.color && !c.blit) {
            colors_.emplace(c, expectation);
        }
    }

    SampleEvidence at(size_t index) {
        const cases::SampleId id = cases::sample_at(case_.target, index);
        const ref::SampleExpectation& expected = expectation_.samples[index];
        SampleEvidence e;
        e.at = {id.x, id.layer * case_.target.height + id.y, id.sample};
        e.allowed = hits_text(expected.hits);
        if (explainer_) {
            add_courses(e, index, id);
        }
        if (colors_) {
            add_colors(e, index, id);
        }
        if (!case_.target.has_instruments || capture_.hits.empty()) {  // of a renderer elsewhere
            return e;
        }
        const glm::vec4& hits = capture_.hits[index];
        e.hits = fmt::format("{} front, {} back", hits.x, hits.y);
        const capture::Writer& writer = capture_.writers[index];
        const bool drawn = capture::sample_state(capture_, index) == capture::SampleState::drawn;
        if (drawn) {
            e.writer = capture_.has_primitive
                           ? fmt::format("triangle {} of draw {}", writer.primitive, writer.draw)
                           : fmt::format("draw {}, provoking vertex {}", writer.draw,
                                         writer.provoking_vertex);
        }
        // What the device's triangle ought to have written, or else the last one that may be here.
        std::optional<uint32_t> triangle;
        bool is_writer = false;
        for (uint32_t k = 0; k < expected.writers_count && !is_writer; ++k) {
            triangle = expectation_.writers[expected.writers_begin + k];
            const cases::Triangle& t = expectation_.triangles[*triangle];
            is_writer = drawn && writer.draw == t.draw && writer.provoking_vertex == t.provoking &&
                        (!capture_.has_primitive || writer.primitive == t.primitive);
        }
        // A fragment that is discarded after its tests leaves its depth and nothing else.
        const bool is_depth_alone = !triangle && expected.depth_count > 0;
        if (is_depth_alone) {
            triangle = expectation_.depth_writers_of(expected).back();
        }
        const bool has_depth =
            is_writer || capture::sample_state(capture_, index) == capture::SampleState::depth_only;
        for (const ref::ExpectedValue& v :
             triangle ? values_.expected(*triangle, id) : std::vector<ref::ExpectedValue>{}) {
            const bool is_depth = v.quantity.is_depth();
            const bool is_written = case_.draws[expectation_.triangles[*triangle].draw].depth.write;
            if (is_depth ? is_written : !is_depth_alone) {
                const bool is_there = is_depth ? has_depth : is_writer;
                add(e, v, *triangle, id, is_there ? std::optional(index) : std::nullopt);
            }
        }
        return e;
    }

  private:
    static constexpr size_t kMostExplained = 1024;  // triangles of a case

    static bool has_tests(const cases::Case& c) {
        return ref::stencil::is_needed(c) ||
               std::ranges::any_of(c.draws, [&](const cases::Draw& draw) {
                   const cases::DepthState& depth = draw.depth;
                   const bool tests_depth =
                       depth.bounds || depth.compare != cases::CompareOp::always || !depth.write;
                   return draw.discard != cases::Discard::none ||
                          (c.target.has_depth && tests_depth);
               });
    }

    void add_courses(SampleEvidence& e, size_t index, cases::SampleId id) {
        const ref::SampleExplanation all = explainer_->explain(id);
        for (const ref::TriangleExplanation& t : all.triangles) {
            const bool may_hit = t.decision.coverage != ref::Coverage::must_not;
            const bool is_discarded = t.why() == ref::ReasonKind::discarded ||
                                      t.why() == ref::ReasonKind::fragment_discarded ||
                                      t.why() == ref::ReasonKind::discarded_late;
            const std::string name =
                fmt::format("triangle {} of draw {}", t.triangle.primitive, t.triangle.draw);
            const auto say = [&](const std::string& sentence) {
                if (!sentence.empty()) {
                    e.courses.emplace_back(name, sentence);
                }
            };
            say(is_discarded ? t.sentence : "");
            say(t.bounds_text);
            say(t.stencil_text);
            say(t.depth ? t.depth_text : "");
            say(may_hit && case_.target.has_depth && !case_.draws[t.triangle.draw].depth.write
                    ? "does not write its depth"
                    : "");
        }
        if (all.stencils) {
            e.stencil =
                all.stencils->all() ? "anything" : ref::stencil::to_text(*all.stencils, " or ", 8);
            e.device_stencil = index < capture_.stencil.size()
                                   ? fmt::format("{}", capture_.stencil[index])
                                   : std::string();
        }
    }

    void add_colors(SampleEvidence& e, size_t index, cases::SampleId id) {
        for (ref::ColorStep& step : colors_->steps(index, id)) {
            std::string name;
            if (step.triangle) {
                const cases::Triangle& t = expectation_.triangles[*step.triangle];
                name = fmt::format("triangle {} of draw {}", t.primitive, t.draw);
            }
            e.colors.emplace_back(std::move(name), std::move(step.sentence));
        }
    }

    void add(SampleEvidence& e, const ref::ExpectedValue& v, uint32_t triangle, cases::SampleId id,
             std::optional<size_t> drawn) {
        if (!v.part.empty()) {
            return;  // what a derivative is made of: no plane holds it
        }
        SampleValue value;
        value.quantity = to_text(v.quantity);
        value.exact = v.exact.size() <= 48 ? v.exact : std::string();
        value.nearest = v.nearest;
        value.also = v.also;
        value.budget = v.is_flat ? 0 : v.budget;
        const double reach = v.factor * value.budget;
        value.low = v.nearest - reach;
        value.high = v.nearest + reach;
        if (v.quantity.of != ref::QuantityId::Of::frag_coord && !v.is_flat) {
            const ref::ValueRange range = values_.range(triangle, id, v.quantity);
            if (range.is_promised) {
                value.low = range.low;
                value.high = range.high;
            }
        }
        if (drawn) {
            const bool is_read = v.quantity.is_depth() ? *drawn < capture_.depth.size()
                                 : v.quantity.is_attribute()
                                     ? v.quantity.attribute < capture_.attribute_count
                                     : true;
            value.has_device = is_read;
            value.bits = is_read ? std::bit_cast<uint32_t>(
                                       number_of(diff::values_at(capture_, *drawn), v.quantity))
                                 : 0;
        }
        e.values.push_back(std::move(value));
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    ref::ValueReference values_;
    std::optional<ref::Explainer> explainer_;  // of a case that discards or tests
    std::optional<ref::ColorReference> colors_;
};

void keep_pictures(report::CaseRecord& record, const cases::Case& c, const diff::Verdict& verdict,
                   const ref::Expectation& expectation, const capture::CaptureView& capture,
                   const ref::Limits& limits) {
    const PictureWindow window(verdict, c.target);
    record.evidence.pictures = cut_pictures(window, c, verdict, capture);
    add_depths(record.evidence.pictures, window, c, verdict, expectation, capture);
    add_stencils(record.evidence.pictures, window, c, verdict, expectation, capture);
    record.evidence.geometry = geometry_of(window, c, limits, expectation, report::kMaxShapes);
}

}  // namespace

void keep_reference(report::CaseRecord& record, const cases::Case& c, const diff::Verdict& verdict,
                    const ref::Expectation& expectation, const ref::Limits& limits) {
    if (verdict.expected_hits.empty()) {
        return;
    }
    const PictureWindow window(verdict, c.target);
    record.evidence.reference = cut_reference(window, verdict);
    record.evidence.geometry =
        geometry_of(window, c, limits, expectation, report::kMaxReferenceShapes);
}

void keep_evidence(report::CaseRecord& record, const cases::Case& c, const diff::Verdict& verdict,
                   const ref::Expectation& expectation, const capture::CaptureView& capture,
                   const ref::Limits& limits) {
    keep_pictures(record, c, verdict, expectation, capture, limits);
    const PictureWindow window(verdict, c.target);
    if (c.blit || !verdict.error.empty()) {
        return;
    }
    EvidenceMaker maker(c, expectation, capture, limits);
    for (const size_t index : chosen_samples(window, c.target, verdict)) {
        record.evidence.samples.push_back(maker.at(index));
    }
}

}  // namespace run
