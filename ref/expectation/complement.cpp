// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/complement.hpp"

#include <cmath>

#include "cases/base/float_bits.hpp"

namespace ref {

namespace {

using cases::same_bits;

bool same_bits(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b, bool is_negated) {
    if (a.size() != b.size()) {
        return false;
    }
    for (size_t v = 0; v < a.size(); ++v) {
        for (glm::vec4::length_type k = 0; k < 4; ++k) {
            const float want = is_negated ? -a[v][k] : a[v][k];
            // Components beyond the count are 0 in both.
            const bool is_zero = !(std::abs(want) > 0) && !(std::abs(b[v][k]) > 0);
            if (!same_bits(want, b[v][k]) && !(is_negated && is_zero)) {
                return false;
            }
        }
    }
    return true;
}

bool same_attributes(const cases::Draw& a, const cases::Draw& b) {
    if (a.attributes.size() != b.attributes.size()) {
        return false;
    }
    for (size_t k = 0; k < a.attributes.size(); ++k) {
        if (a.attributes[k].interpolation != b.attributes[k].interpolation ||
            a.attributes[k].source != b.attributes[k].source) {
            return false;  // not the same pipeline
        }
    }
    return true;
}

bool are_complementary(const cases::Draw& a, const cases::Draw& b) {
    const cases::ClipDistances& da = a.distances;
    const cases::ClipDistances& db = b.distances;
    // Conservative draws share out nothing: along the cut both cover the pixels that they touch.
    const bool is_by_samples =
        a.conservative == cases::Conservative::none && b.conservative == cases::Conservative::none;
    return is_by_samples && !a.rasterizer_discard && !b.rasterizer_discard && da.clip_count > 0 &&
           da.clip_count == db.clip_count && da.cull_count == db.cull_count &&
           a.topology == b.topology && a.indices == b.indices && a.instances == b.instances &&
           a.primitive_restart == b.primitive_restart && a.viewport == b.viewport &&
           a.scissor == b.scissor && a.cull == b.cull && a.front_face == b.front_face &&
           a.provoking == b.provoking && a.depth == b.depth && a.multisample == b.multisample &&
           a.discard == b.discard && a.early_tests == b.early_tests && a.layer == b.layer &&
           a.viewport_index == b.viewport_index && same_attributes(a, b) &&
           same_bits(a.positions, b.positions, false) && same_bits(da.cull, db.cull, false) &&
           same_bits(da.clip, db.clip, true);
}

bool is_cut(const cases::Draw& draw, const cases::Triangle& t) {
    for (uint32_t k = 0; k < draw.distances.clip_count; ++k) {
        bool has_negative = false;
        bool has_positive = false;
        for (const uint32_t v : t.vertex) {
            const float d = draw.distances.clip[v][static_cast<glm::vec4::length_type>(k)];
            has_negative = has_negative || d < 0;
            has_positive = has_positive || d > 0;
        }
        if (has_negative && has_positive) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<Complement> complements_of(const cases::Case& c,
                                       const std::vector<cases::Triangle>& triangles) {
    // Triangles of a draw stand together.
    std::vector<uint32_t> first(c.draws.size() + 1, static_cast<uint32_t>(triangles.size()));
    for (uint32_t t = static_cast<uint32_t>(triangles.size()); t-- > 0;) {
        first[triangles[t].draw] = t;
    }
    for (size_t d = c.draws.size(); d-- > 0;) {
        if (first[d] == triangles.size()) {
            first[d] = first[d + 1];
        }
    }
    std::vector<Complement> out;
    std::vector<bool> is_paired(c.draws.size());
    for (size_t a = 0; a < c.draws.size(); ++a) {
        for (size_t b = a + 1; b < c.draws.size() && !is_paired[a]; ++b) {
            if (is_paired[b] || !are_complementary(c.draws[a], c.draws[b])) {
                continue;
            }
            is_paired[a] = is_paired[b] = true;
            out.resize(triangles.size());
            const bool fills = c.draws[a].distances.clip_count == 1;
            for (uint32_t k = 0; first[a] + k < first[a + 1]; ++k) {
                if (is_cut(c.draws[a], triangles[first[a] + k])) {
                    out[first[a] + k] = {first[b] + k, fills};
                    out[first[b] + k] = {first[a] + k, fills};
                }
            }
        }
    }
    return out;
}

}  // namespace ref
