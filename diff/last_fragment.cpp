// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/last_fragment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "cases/base/number_text.hpp"
#include "cases/model/rule_ids.hpp"
#include "ref/expectation/stored_depths.hpp"

namespace diff {

ref::FragmentValues values_at(const capture::CaptureView& capture, size_t index) {
    ref::FragmentValues values;
    values.frag_coord = capture.frag_coord.empty() ? glm::vec4(0) : capture.frag_coord[index];
    values.depth = capture.depth.empty() ? 0.0F : capture.depth[index];
    for (uint32_t a = 0; a < capture.attribute_count; ++a) {
        values.attributes[a] =
            capture.attributes[a].empty() ? glm::vec4(0) : capture.attributes[a][index];
    }
    return values;
}

LastHit LastFragment::last_hit(size_t index) const {
    if (!has_writers_) {
        return {};
    }
    const capture::Writer writer = capture_.writers[index];
    return {[this, writer](const cases::Triangle& t) { return wrote(writer, t); }, writer.draw};
}

LastFragment::Outcome LastFragment::judge(size_t index, cases::SampleId id) {
    const ref::SampleExpectation& expected = expectation_.samples[index];
    const capture::Writer& writer = capture_.writers[index];
    const ref::FragmentValues device = values_at(capture_, index);
    Outcome out;
    // Without gl_PrimitiveID several triangles may have the writer's provoking vertex, and without
    // writers any triangle may be the one: one that explains the fragment is enough.
    ref::FragmentVerdict best;
    const std::span<const uint32_t> writers = expectation_.writers_of(expected);
    const auto is_it = [&](uint32_t t) { return wrote(index, t); };
    values_.tell_ratios(needs_ratios_ || std::ranges::count_if(writers, is_it) > 1);
    for (const uint32_t t : writers) {
        if (!is_it(t)) {
            continue;
        }
        ref::FragmentVerdict v = values_.judge(t, id, device, part_of(case_, expectation_, t));
        if (!out.triangle || (v.ok && !best.ok) ||
            (v.ok == best.ok && v.worst_ratio < best.worst_ratio)) {
            best = std::move(v);
            out.triangle = t;
        }
    }
    if (!out.triangle) {
        out.finding = writer_finding(id, writer, expected);
        return out;
    }
    const uint32_t t = *out.triangle;
    if (part_of(case_, expectation_, t) != ref::FragmentPart::all && selection_.depth) {
        ++out.compared_values;
        out.finding = judge_older_depth(id, expected, device);
    }
    out.compared_values += values_of(t);
    out.worst_ratio = best.worst_ratio;
    out.worst_quantity = best.worst_quantity;
    for (ref::ValueMismatch& m : best.mismatches) {
        (m.quantity.is_depth() ? out.is_depth_wrong : out.are_others_wrong) = true;
        out.values.push_back(value_finding(id, std::move(m), t));
    }
    return out;
}

std::optional<Finding> LastFragment::judge_depth_alone(size_t index, cases::SampleId id) {
    return judge_older_depth(id, expectation_.samples[index], values_at(capture_, index));
}

uint64_t LastFragment::values_of(uint32_t t) const {
    // FragCoord.xy, z, w; depth
    uint64_t count = (selection_.frag_coord ? 3U : 0U) + (selection_.depth ? 1U : 0U);
    const auto& draw = case_.draws[expectation_.triangles[t].draw];
    for (size_t a = 0; a < draw.attributes.size(); ++a) {
        count += selection_.attributes.at(a) ? draw.attributes[a].components : 0U;
    }
    return count;
}

Finding LastFragment::value_finding(cases::SampleId id, ref::ValueMismatch mismatch,
                                    uint32_t t) const {
    Finding finding = finding_at(FindingKind::value, case_.target, id);
    finding.rule = std::move(mismatch.rule);
    finding.level = mismatch.level;
    finding.ratio = mismatch.ratio;
    if (mismatch.got.empty()) {
        return finding;  // is counted only (is_told)
    }
    finding.quantity = to_text(mismatch.quantity);
    finding.expected = std::move(mismatch.expected);
    finding.got = std::move(mismatch.got);
    finding.why = fmt::format("triangle {} of draw {}: {}", expectation_.triangles[t].primitive,
                              expectation_.triangles[t].draw, ref::text_of(mismatch.reason));
    return finding;
}

// Depth where the last writer did not write it: some fragment's of those that may have been the
// last to do so, or the clear value.
std::optional<Finding> LastFragment::judge_older_depth(cases::SampleId id,
                                                       const ref::SampleExpectation& expected,
                                                       const ref::FragmentValues& device) {
    const ref::StoredDepths depths(expectation_, values_);
    const bool may_be_clear = ref::StoredDepths::may_be_clear(expected);
    if (may_be_clear && capture::is_clear_depth(case_.target, device.depth)) {
        return std::nullopt;
    }
    Finding finding = finding_at(FindingKind::value, case_.target, id);
    finding.level = cases::Profile::vulkan;
    finding.quantity = "depth";
    std::vector<std::string> allowed;  // each once, though two planes may have it
    if (may_be_clear) {
        allowed.emplace_back("the clear value");
    }
    bool is_first = !may_be_clear;
    for (const uint32_t t : depths.writers_of(expected)) {
        judges_older_depth_ = true;
        values_.tell_ratios(needs_ratios_);
        const ref::FragmentVerdict v = values_.judge(t, id, device, ref::FragmentPart::depth);
        judges_older_depth_ = false;
        if (v.ok) {
            return std::nullopt;
        }
        const ref::ValueMismatch& m = v.mismatches.front();
        finding.level = is_first ? m.level : std::max(finding.level, m.level);
        is_first = false;
        if (std::ranges::find(allowed, m.expected) == allowed.end()) {
            allowed.push_back(m.expected);
        }
        finding.ratio = m.ratio;
    }
    finding.expected = fmt::format("{}", fmt::join(allowed, ", or "));
    finding.got = cases::number_text(device.depth);
    const auto is_clear = [](const cases::Draw& draw) { return draw.clear.has_value(); };
    tell(finding, std::ranges::any_of(case_.draws, is_clear) ? ref::ReasonKind::depth_of_cleared
                  : cases::stores_discarded(case_)           ? ref::ReasonKind::depth_of_discarded
                  : cases::tests_bounds(case_)               ? ref::ReasonKind::depth_of_bounded
                                                             : ref::ReasonKind::depth_unwritten);
    return finding;
}

bool LastFragment::wrote(const capture::Writer& writer, const cases::Triangle& t) const {
    return writer.draw == t.draw && writer.provoking_vertex == t.provoking &&
           (!capture_.has_primitive || writer.primitive == t.primitive);
}

bool LastFragment::is_provoking(const capture::Writer& writer) const {
    return std::any_of(expectation_.triangles.begin(), expectation_.triangles.end(),
                       [&](const auto& t) {
                           return t.draw == writer.draw && t.provoking == writer.provoking_vertex;
                       });
}

bool LastFragment::provokes_by_last(uint32_t draw) const {
    return draw < case_.draws.size() && case_.draws[draw].provoking == cases::ProvokingVertex::last;
}

Finding LastFragment::writer_finding(cases::SampleId id, const capture::Writer& writer,
                                     const ref::SampleExpectation& expected) {
    Finding finding = finding_at(FindingKind::order, case_.target, id);
    tell(finding, ref::ReasonKind::writer_not_last);
    const bool by_last = provokes_by_last(writer.draw);
    const auto is_triangle = [&] {
        return std::ranges::any_of(expectation_.triangles,
                                   [&](const cases::Triangle& t) { return wrote(writer, t); });
    };
    std::string allowed;
    for (uint32_t k = 0; k < std::min(expected.writers_count, 4U); ++k) {
        const cases::Triangle& t =
            expectation_.triangles[expectation_.writers[expected.writers_begin + k]];
        allowed += fmt::format("{}draw {} primitive {} (provoking vertex {})",
                               k == 0 ? "" : ", or ", t.draw, t.primitive, t.provoking);
        const bool same_primitive =
            writer.draw == t.draw && capture_.has_primitive && writer.primitive == t.primitive;
        // That of another instance is another triangle.
        if (same_primitive && writer.provoking_vertex != t.provoking && !is_triangle()) {
            tell(finding, by_last ? ref::ReasonKind::writer_other_last
                                  : ref::ReasonKind::writer_other_first);
        }
    }
    if (!capture_.has_primitive && finding.rule == cases::rule::order_primitive &&
        !is_provoking(writer)) {
        tell(finding,
             by_last ? ref::ReasonKind::writer_none_last : ref::ReasonKind::writer_none_first);
    }
    if (expected.writers_count > 4) {
        allowed += fmt::format(", or {} others", expected.writers_count - 4);
    }
    finding.expected = allowed;
    if (finding.rule == cases::rule::order_primitive) {
        attribution_.attribute_writer(finding,
                                      [&](const cases::Triangle& t) { return wrote(writer, t); });
    } else {
        finding.level = cases::Profile::vulkan;
    }
    finding.got =
        capture_.has_primitive
            ? fmt::format("draw {} primitive {} (provoking vertex {})", writer.draw,
                          writer.primitive, writer.provoking_vertex)
            : fmt::format("draw {} (provoking vertex {})", writer.draw, writer.provoking_vertex);
    return finding;
}

}  // namespace diff
