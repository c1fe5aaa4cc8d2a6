// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <tuple>

#include "mutants/judge.hpp"
#include "ref/expectation/expectation.hpp"

namespace mutants {

namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

constexpr size_t kBatch = 16;

capture::Capture captured(const cases::Case& c, Fault fault) {
    Device device;
    device.fault = fault;
    return captured(c, device);
}

}  // namespace

bool same_bits(const capture::Capture& a, const capture::Capture& b) {
    bool same = same_bits(a.hits, b.hits) && same_bits(a.writers, b.writers) &&
                same_bits(a.frag_coord, b.frag_coord) && same_bits(a.depth, b.depth) &&
                same_bits(a.color, b.color) && same_bits(a.stencil, b.stencil) &&
                same_bits(a.resolved_color, b.resolved_color) &&
                same_bits(a.resolved_depth, b.resolved_depth);
    for (size_t k = 0; k < a.attributes.size(); ++k) {
        same = same && same_bits(a.attributes[k], b.attributes[k]);
    }
    return same;
}

bool is_small(const cases::Case& c) {
    size_t vertices = 0;
    for (const cases::Draw& draw : c.draws) {
        vertices += draw.indices ? draw.indices->size() : draw.positions.size();
    }
    return c.target.width * c.target.height * c.target.samples <= 64U * 64U && vertices <= 1024;
}

size_t MatrixRow::file_count() const {
    size_t count = 0;
    for (const auto& [family, names] : files) {
        count += names.size();
    }
    return count;
}

bool can_matter(Fault fault, const cases::Case& c) {
    const auto is_between = [&](Fault first, Fault last) {
        return fault >= first && fault <= last;  // as fault.hpp groups them
    };
    const auto any_draw = [&](const auto& has) {
        return std::any_of(c.draws.begin(), c.draws.end(), has);
    };
    if (is_between(Fault::blit_mirror_ignored, Fault::blit_missing_alpha_zero)) {
        return c.blit.has_value();
    }
    if (is_between(Fault::blend_ignored, Fault::srgb_gamma)) {
        // Resolved numbers are converted, too; all of them come from a colour.
        return c.target.color.has_value();
    }
    if (is_between(Fault::stencil_faces_exchanged, Fault::stencil_never_written)) {
        return c.target.has_stencil;
    }
    if (is_between(Fault::resolve_one_sample, Fault::resolve_ignored)) {
        return capture::resolves_color(c.target) || capture::resolves_depth(c.target);
    }
    if (is_between(Fault::distance_flipped, Fault::distance_plane_never)) {
        return any_draw([](const cases::Draw& d) { return d.distances.clip_count > 0; });
    }
    if (is_between(Fault::cull_distance_any, Fault::cull_distance_provoking)) {
        return any_draw([](const cases::Draw& d) { return d.distances.cull_count > 0; });
    }
    if (is_between(Fault::depth_volume_ignored, Fault::depth_scale_ignored)) {
        return any_draw([](const cases::Draw& d) { return d.depth.negative_one_to_one; });
    }
    if (is_between(Fault::provoking_mode_ignored, Fault::provoking_turns)) {
        return any_draw(
            [](const cases::Draw& d) { return d.provoking == cases::ProvokingVertex::last; });
    }
    if (is_between(Fault::bias_ignored, Fault::bias_clamp_both_ends)) {
        return any_draw([](const cases::Draw& d) { return d.depth.bias.has_value(); });
    }
    if (is_between(Fault::derivative_partial, Fault::lod_norm)) {
        return any_draw([](const cases::Draw& d) {
            return std::any_of(d.attributes.begin(), d.attributes.end(),
                               [](const auto& a) { return a.probe != cases::Probe::value; });
        });
    }
    return true;
}

std::string family_of(const cases::Case& c) {
    return c.id.substr(0, c.id.find('/'));
}

std::string file_of(const cases::Case& c) {
    return c.id.substr(0, c.id.find(':'));
}

std::vector<size_t> leaves_by_turn(std::span<const cases::Case> suite) {
    // Number in the file, number of the file in its family, number in the suite.
    std::vector<std::tuple<size_t, size_t, size_t>> order;
    std::map<std::string, size_t> leaves, files;
    for (size_t k = 0; k < suite.size(); ++k) {
        const size_t leaf = leaves[file_of(suite[k])]++;
        size_t& file = files[family_of(suite[k])];
        file += leaf == 0 ? 1 : 0;
        order.emplace_back(leaf, file, k);
    }
    std::sort(order.begin(), order.end());
    std::vector<size_t> out;
    for (const auto& [leaf, file, k] : order) {
        out.push_back(k);
    }
    return out;
}

void measure(std::span<const cases::Case> suite, std::span<const size_t> leaves,
             std::vector<MatrixRow>& rows, const std::function<bool(const MatrixRow&)>& asks,
             const std::function<void(const std::string&)>& alarm) {
    // In batches, so that what is asked does not hang on which thread was first.
    for (; leaves.size() > kBatch; leaves = leaves.subspan(kBatch)) {
        measure(suite, leaves.first(kBatch), rows, asks, alarm);
    }
    std::vector<size_t> asked;
    for (size_t r = 0; r < rows.size(); ++r) {
        if (asks(rows[r])) {
            asked.push_back(r);
        }
    }
    if (asked.empty()) {
        return;
    }
    std::mutex mutex;
    for_each_parallel(leaves.size(), [&](size_t n) {
        const cases::Case& c = suite[leaves[n]];
        const ref::Expectation expectation = ref::expect(c, {}, cases::Profile::direct3d);
        const capture::Capture right = captured(c, Fault::none);
        if (const diff::Verdict verdict = compare(c, expectation, right); !verdict.ok()) {
            const std::lock_guard lock(mutex);
            alarm(describe(c, verdict));
            return;
        }
        for (const size_t r : asked) {
            if (!can_matter(rows[r].fault, c)) {
                continue;
            }
            const capture::Capture wrong = captured(c, rows[r].fault);
            if (same_bits(right, wrong)) {
                continue;
            }
            const diff::Verdict verdict = compare(c, expectation, wrong);
            if (verdict.ok() || !verdict.error.empty()) {
                continue;
            }
            const std::lock_guard lock(mutex);
            MatrixRow& row = rows[r];
            row.loosest = row.lines.empty() ? verdict.level : std::min(row.loosest, verdict.level);
            row.files[family_of(c)].insert(file_of(c));
            row.first_rule.emplace(file_of(c), verdict.findings.front().rule);
            row.lines.push_back(
                fmt::format("{}  {}", cases::to_string(verdict.level), describe(c, verdict)));
        }
    });
}

}  // namespace mutants
