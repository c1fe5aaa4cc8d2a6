// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "diff/attribution.hpp"
#include "diff/color.hpp"
#include "diff/pixel_check.hpp"
#include "diff/resolve.hpp"
#include "diff/verdict.hpp"

namespace diff {

namespace {

// One comparison's state; the phases of a sample stand in judge_sample().
class Comparison {
  public:
    Comparison(const cases::Case& c, const ref::Expectation& expectation,
               const CaptureView& capture, const ref::ValueSelection& selection)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          attribution_(c, expectation),
          values_(c, expectation.limits, expectation.profile),
          selection_(selection),
          has_pixel_rules_(selection.is_all() && c.target.has_instruments && has_pixel_rules(c)) {
        values_.judge_only(selection);
        if (c.target.color) {
            color_.emplace(c, expectation, capture_, attribution_);
        }
        verdict_.profile = expectation.profile;
        verdict_.level = expectation.profile;
        verdict_.must_samples = expectation.must_samples;
        verdict_.either_samples = expectation.either_samples;
    }

    Verdict run() {
        if (const std::string error = unusable(); !error.empty()) {
            verdict_.error = error;
            return std::move(verdict_);
        }
        const size_t count = capture_.sample_count();
        verdict_.expected_hits.resize(count);
        verdict_.device_hits.resize(count);
        verdict_.marks.assign(count, SampleMark::ok);
        if (case_.target.has_instruments) {
            verdict_.error_ratios.assign(count, -1.0F);
        }
        const cases::Target& target = case_.target;
        size_t index = 0;
        for (uint32_t row = 0; row < target.rows(); ++row) {
            const uint32_t y = row % target.height;
            const uint32_t layer = row / target.height;
            for (uint32_t x = 0; x < target.width; ++x) {
                for (uint32_t s = 0; s < target.samples; ++s, ++index) {
                    judge_sample(index, {x, y, s, layer});
                    if (!verdict_.error.empty()) {
                        return std::move(verdict_);
                    }
                }
                if (has_pixel_rules_) {
                    for (Finding& finding :
                         check_pixel(case_, expectation_, capture_, {x, y, 0, layer})) {
                        const size_t at = index - target.samples + finding.sample;
                        add(std::move(finding), at);
                    }
                }
            }
        }
        verdict_.error =
            judge_dependent_planes(capture_, expectation_.profile, [this](Finding finding) {
                const size_t at = ref::index_of(case_.target, place_of(finding));
                add(std::move(finding), at);
            });
        return std::move(verdict_);
    }

  private:
    // Why there is nothing to judge; empty if there is.
    std::string unusable() const {
        if (capture_.target != case_.target || !has_all_planes(capture_)) {
            return fmt::format(
                "the capture has another size than the case's {}x{} target with {} sample(s){}",
                case_.target.width, case_.target.height, case_.target.samples,
                case_.target.layers > 1 ? fmt::format(" and {} layers", case_.target.layers) : "");
        }
        size_t attributes = 0;
        for (const cases::Draw& draw : case_.draws) {
            attributes = std::max(attributes, draw.attributes.size());
        }
        for (size_t a = 0; a < attributes; ++a) {
            if (case_.target.has_instruments && capture_.attribute_count <= a) {
                return fmt::format("the capture lacks attribute {} of the case", a);
            }
        }
        if (expectation_.must_samples == 0) {
            return "the case has no sample that must be covered, so a black picture would pass; "
                   "add a "
                   "control triangle";
        }
        return {};
    }

    void judge_sample(size_t index, ref::SampleId id) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        const ref::HitBounds& bounds = expected.hits;
        const SampleState state = sample_state(capture_, index);
        if (state == SampleState::clear && bounds == ref::HitBounds{} && !color_) {
            ++verdict_.compared_samples;  // marks and hits are zero already
            return;
        }
        verdict_.expected_hits[index] = bounds.total_min == bounds.total_max
                                            ? static_cast<uint8_t>(std::min(bounds.total_min, 254U))
                                            : uint8_t{255};
        if (!bounds.is_decided()) {
            verdict_.marks[index] = SampleMark::either;
        }
        ++verdict_.compared_samples;

        if (!case_.target.has_instruments && state == SampleState::drawn) {
            verdict_.device_hits[index] = color_->hits_for_pictures(index);
            judge_color(index, id, std::nullopt);
            return;
        }
        switch (state) {
            case SampleState::not_copied:
                verdict_.error = fmt::format(
                    "sample {} of {} was not copied from the device: it still holds the read-back "
                    "memory's fill pattern",
                    id.sample, pixel_text(case_.target, id));
                return;
            case SampleState::inconsistent: {
                Finding finding = at(FindingKind::value, id);
                finding.rule = "write.consistent";
                finding.level = cases::Profile::vulkan;
                finding.quantity = "attachments";
                finding.expected = "all attachments written by the same fragments";
                const glm::vec4& h = capture_.hits[index];
                const Writer& w = capture_.writers[index];
                finding.got = fmt::format(
                    "hit counter ({}, {}, {}, {}), draw {}, primitive {}, provoking vertex {}, "
                    "FragCoord.x {}, "
                    "depth {}",
                    h.x, h.y, h.z, h.w, w.draw, w.primitive, w.provoking_vertex,
                    capture_.frag_coord[index].x,
                    capture_.depth.empty() ? kClearDepth : capture_.depth[index]);
                finding.why = "the attachments of one sample contradict each other";
                verdict_.device_hits[index] = 255;
                add(std::move(finding), index);
                return;
            }
            case SampleState::clear:
            case SampleState::drawn:
                break;
        }

        const auto front = static_cast<uint32_t>(capture_.hits[index].x);
        const auto back = static_cast<uint32_t>(capture_.hits[index].y);
        verdict_.device_hits[index] = static_cast<uint8_t>(std::min(front + back, 255U));
        if (!bounds.allows(front, back)) {
            Finding finding = at(kind_of(bounds, front, back), id);
            if (verdict_.findings.size() < kMaxFindings) {
                attribution_.attribute_hits(finding, front, back);
            } else {
                attribution_.level_hits(finding, front, back);  // beyond the cap nothing is told
            }
            add(std::move(finding), index);
            return;
        }
        if (front + back > 0) {
            judge_writer(index, id, expected);
        } else {
            judge_color(index, id, std::nullopt);
        }
    }

    void judge_color(size_t index, ref::SampleId id, std::optional<uint32_t> writer) {
        if (!color_) {
            return;
        }
        ++verdict_.compared_values;
        if (std::optional<Finding> finding = color_->judge(index, id, writer)) {
            add(std::move(*finding), index);
        }
    }

    static FindingKind kind_of(const ref::HitBounds& bounds, uint32_t front, uint32_t back) {
        const uint32_t total = front + back;
        const int32_t sign = static_cast<int32_t>(front) - static_cast<int32_t>(back);
        if (total < bounds.total_min) {
            return FindingKind::missing;
        }
        if (total > bounds.total_max) {
            return bounds.total_max == 0 ? FindingKind::extra : FindingKind::double_hit;
        }
        const bool too_few_front = front < bounds.front_min, too_few_back = back < bounds.back_min;
        const bool too_many_front = front > bounds.front_max,
                   too_many_back = back > bounds.back_max;
        if ((too_few_front && too_many_back) || (too_few_back && too_many_front)) {
            return FindingKind::value;  // the right number of hits, by the wrong face
        }
        if (too_few_front || too_few_back) {
            return FindingKind::missing;
        }
        if (too_many_front || too_many_back) {
            return FindingKind::double_hit;
        }
        // Only the signed sum of a closed mesh is wrong: a gap pulls it towards zero.
        return std::abs(sign) < std::abs(bounds.signed_min) ? FindingKind::missing
                                                            : FindingKind::double_hit;
    }

    // Which triangle wrote last, and is what it wrote right?
    void judge_writer(size_t index, ref::SampleId id, const ref::SampleExpectation& expected) {
        const Writer& writer = capture_.writers[index];
        ref::FragmentValues device;
        device.frag_coord = capture_.frag_coord[index];
        device.depth = capture_.depth.empty() ? 0.0F : capture_.depth[index];
        for (uint32_t a = 0; a < capture_.attribute_count; ++a) {
            device.attributes[a] = capture_.attributes[a][index];
        }
        // Without gl_PrimitiveID several triangles may have the writer's provoking vertex: one that
        // explains the fragment is enough.
        std::optional<ref::FragmentVerdict> best;
        uint32_t best_triangle = 0;
        for (uint32_t k = 0; k < expected.writers_count; ++k) {
            const uint32_t t = expectation_.writers[expected.writers_begin + k];
            if (!wrote(writer, expectation_.triangles[t])) {
                continue;
            }
            ref::FragmentVerdict v = values_.judge(t, id, device, part_of(t));
            if (!best || (v.ok && !best->ok) ||
                (v.ok == best->ok && v.worst_ratio < best->worst_ratio)) {
                best = std::move(v);
                best_triangle = t;
            }
        }
        if (!best) {
            add(writer_finding(id, writer, expected), index);
            return;
        }
        if (part_of(best_triangle) != ref::FragmentPart::all && selection_.depth) {
            judge_older_depth(index, id, expected, device);
        }
        const auto& draw = case_.draws[expectation_.triangles[best_triangle].draw];
        // FragCoord.xy, z, w; depth
        verdict_.compared_values +=
            (selection_.frag_coord ? 3U : 0U) + (selection_.depth ? 1U : 0U);
        for (size_t a = 0; a < draw.attributes.size(); ++a) {
            verdict_.compared_values +=
                selection_.attributes.at(a) ? draw.attributes[a].components : 0U;
        }
        if (best->worst_ratio > verdict_.worst_ratio) {
            verdict_.worst_ratio = best->worst_ratio;
            verdict_.worst_quantity = pixel_text(case_.target, id);
        }
        raise_error(index, best->worst_ratio);
        judge_color(index, id, best_triangle);
        for (ref::ValueMismatch& m : best->mismatches) {
            Finding finding = at(FindingKind::value, id);
            finding.rule = m.rule;
            finding.level = m.level;
            finding.quantity = m.quantity;
            finding.expected = m.expected;
            finding.got = m.got;
            finding.ratio = m.ratio;
            finding.why = fmt::format(
                "triangle {} of draw {}: no set-up from snapped or unsnapped vertices "
                "explains the fragment",
                expectation_.triangles[best_triangle].primitive,
                expectation_.triangles[best_triangle].draw);
            add(std::move(finding), index);
        }
    }

    // A draw that does not write depth leaves an older fragment's depth.
    ref::FragmentPart part_of(uint32_t t) const {
        return case_.draws[expectation_.triangles[t].draw].depth.write
                   ? ref::FragmentPart::all
                   : ref::FragmentPart::all_but_depth;
    }

    // Depth where the last writer did not write it: some fragment's of those that may have been the
    // last to do so, or the clear value.
    void judge_older_depth(size_t index, ref::SampleId id, const ref::SampleExpectation& expected,
                           const ref::FragmentValues& device) {
        ++verdict_.compared_values;
        if (expected.depth_may_be_clear && is_clear_depth(case_.target, device.depth)) {
            return;
        }
        Finding finding = at(FindingKind::value, id);
        finding.rule = "depth.write";
        finding.level = cases::Profile::vulkan;
        finding.quantity = "depth";
        finding.expected = expected.depth_may_be_clear ? "the clear value" : "";
        for (uint32_t k = 0; k < expected.depth_count; ++k) {
            const uint32_t t = expectation_.depth_writers[expected.depth_begin + k];
            const ref::FragmentVerdict v = values_.judge(t, id, device, ref::FragmentPart::depth);
            if (v.ok) {
                return;
            }
            const ref::ValueMismatch& m = v.mismatches.front();
            finding.level =
                k == 0 && !expected.depth_may_be_clear ? m.level : std::max(finding.level, m.level);
            finding.expected += (finding.expected.empty() ? "" : ", or ") + m.expected;
            finding.ratio = m.ratio;
        }
        finding.got = fmt::format("{:.9g}", device.depth);
        finding.why = "the last fragment's draw does not write depth; no older one left this";
        add(std::move(finding), index);
    }

    bool wrote(const Writer& writer, const ref::Triangle& t) const {
        return writer.draw == t.draw && writer.provoking_vertex == t.provoking &&
               (!capture_.has_primitive || writer.primitive == t.primitive);
    }

    Finding writer_finding(ref::SampleId id, const Writer& writer,
                           const ref::SampleExpectation& expected) {
        Finding finding = at(FindingKind::order, id);
        finding.rule = "order.primitive";
        finding.why = "another triangle than the last one that may cover the sample wrote it";
        std::string allowed;
        for (uint32_t k = 0; k < std::min(expected.writers_count, 4U); ++k) {
            const ref::Triangle& t =
                expectation_.triangles[expectation_.writers[expected.writers_begin + k]];
            allowed += fmt::format("{}draw {} primitive {} (provoking vertex {})",
                                   k == 0 ? "" : ", or ", t.draw, t.primitive, t.provoking);
            const bool same_primitive =
                writer.draw == t.draw && capture_.has_primitive && writer.primitive == t.primitive;
            if (same_primitive && writer.provoking_vertex != t.provoking) {
                finding.rule = provoking_rule(writer.draw);
                finding.why = "the right triangle, but its flat inputs come from another vertex";
            }
        }
        if (!capture_.has_primitive && finding.rule == "order.primitive" && !is_provoking(writer)) {
            finding.rule = provoking_rule(writer.draw);
            finding.why = "no triangle of that draw has this provoking vertex";
        }
        if (expected.writers_count > 4) {
            allowed += fmt::format(", or {} others", expected.writers_count - 4);
        }
        finding.expected = allowed;
        if (finding.rule == "order.primitive") {
            attribution_.attribute_writer(finding,
                                          [&](const ref::Triangle& t) { return wrote(writer, t); });
        } else {
            finding.level = cases::Profile::vulkan;
        }
        finding.got = capture_.has_primitive
                          ? fmt::format("draw {} primitive {} (provoking vertex {})", writer.draw,
                                        writer.primitive, writer.provoking_vertex)
                          : fmt::format("draw {} (provoking vertex {})", writer.draw,
                                        writer.provoking_vertex);
        return finding;
    }

    const char* provoking_rule(uint32_t draw) const {
        const bool is_last = draw < case_.draws.size() &&
                             case_.draws[draw].provoking == cases::ProvokingVertex::last;
        return is_last ? "provoking.last" : "provoking.first";
    }

    bool is_provoking(const Writer& writer) const {
        return std::any_of(
            expectation_.triangles.begin(), expectation_.triangles.end(), [&](const auto& t) {
                return t.draw == writer.draw && t.provoking == writer.provoking_vertex;
            });
    }

    Finding at(FindingKind kind, ref::SampleId id) const {
        Finding finding;
        finding.kind = kind;
        place(finding, case_.target, id);
        return finding;
    }

    void raise_error(size_t index, double ratio) {
        if (index < verdict_.error_ratios.size()) {
            verdict_.error_ratios[index] =
                std::max(verdict_.error_ratios[index], static_cast<float>(ratio));
        }
    }

    void add(Finding finding, size_t index) {
        if (finding.kind == FindingKind::value && finding.ratio > 0) {
            raise_error(index, finding.ratio);
        }
        const bool first = verdict_.ok();
        const uint32_t row = place_of(finding).layer * case_.target.height + finding.y;
        verdict_.min_x = first ? finding.x : std::min(verdict_.min_x, finding.x);
        verdict_.min_y = first ? row : std::min(verdict_.min_y, row);
        verdict_.max_x = first ? finding.x : std::max(verdict_.max_x, finding.x);
        verdict_.max_y = first ? row : std::max(verdict_.max_y, row);
        verdict_.level = first ? finding.level : std::min(verdict_.level, finding.level);
        ++verdict_.counts[static_cast<size_t>(finding.kind)];
        switch (finding.kind) {
            case FindingKind::missing:
                verdict_.marks[index] = SampleMark::missing;
                break;
            case FindingKind::extra:
                verdict_.marks[index] = SampleMark::extra;
                break;
            case FindingKind::double_hit:
                verdict_.marks[index] = SampleMark::double_hit;
                break;
            case FindingKind::value:
                verdict_.marks[index] = SampleMark::value;
                break;
            case FindingKind::order:
                verdict_.marks[index] = SampleMark::order;
                break;
        }
        if (verdict_.findings.size() < kMaxFindings) {
            verdict_.findings.push_back(std::move(finding));
        } else if (verdict_.level == cases::Profile::vulkan) {
            // Nothing of what follows is told, and no level can be looser: it is counted.
            values_.judge_briefly();
        }
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const CaptureView& capture_;
    Attribution attribution_;
    ref::ValueReference values_;
    ref::ValueSelection selection_;
    bool has_pixel_rules_ = false;
    std::optional<ColorComparison> color_;
    Verdict verdict_;
};

}  // namespace

std::string pixel_text(const cases::Target& target, const ref::SampleId& id) {
    const std::string layer = target.layers > 1 ? fmt::format("layer {}, ", id.layer) : "";
    return fmt::format("{}pixel ({}, {})", layer, id.x, id.y);
}

std::string_view to_string(FindingKind kind) {
    switch (kind) {
        case FindingKind::missing:
            return "missing";
        case FindingKind::extra:
            return "extra";
        case FindingKind::double_hit:
            return "double";
        case FindingKind::value:
            return "value";
        case FindingKind::order:
            return "order";
    }
    return "";
}

Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const CaptureView& capture) {
    return Comparison(c, expectation, capture, {}).run();
}

Verdict compare_selected(const cases::Case& c, const ref::Expectation& expectation,
                         const CaptureView& capture, const ref::ValueSelection& selection) {
    return Comparison(c, expectation, capture, selection).run();
}

std::string check_expected_hits(const cases::Case& c) {
    if (!c.expected_hits) {
        return {};
    }
    const ref::Expectation e = ref::expect(c, ref::Limits{8}, cases::Profile::direct3d);
    // Row (layer * samples + s) * height + y is row y of sample s of a layer.
    const std::vector<std::string>& rows = c.expected_hits->rows;
    for (size_t row = 0; row < rows.size(); ++row) {
        const auto picture = static_cast<uint32_t>(row / c.target.height);
        ref::SampleId id{0, static_cast<uint32_t>(row % c.target.height),
                         picture % c.target.samples, picture / c.target.samples};
        for (size_t x = 0; x < c.target.width; ++x) {
            id.x = static_cast<uint32_t>(x);
            const ref::HitBounds& b = e.samples[ref::index_of(c.target, id)].hits;
            const char drawn = rows[row][x];
            const char reference = b.total_min != b.total_max ? '?'
                                   : b.total_min == 0         ? '.'
                                   : b.total_min <= 9         ? static_cast<char>('0' + b.total_min)
                                                              : '#';
            if (drawn != reference) {
                return fmt::format(
                    "the picture has '{}' at {}{}, the reference says {} hit(s)", drawn,
                    pixel_text(c.target, id),
                    c.target.samples > 1 ? fmt::format(", sample {}", id.sample) : "", to_text(b));
            }
        }
    }
    return {};
}

}  // namespace diff
