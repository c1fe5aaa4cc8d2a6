// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/stored_depths.hpp"

#include <algorithm>

namespace ref {

bool StoredDepths::is_of(uint32_t triangle, cases::SampleId id, float depth) {
    FragmentValues values;
    values.depth = depth;
    return values_.judge(triangle, id, values, FragmentPart::depth).ok;
}

bool StoredDepths::allows(const SampleExpectation& s, cases::SampleId id, float depth,
                          bool is_clear) {
    return (is_clear && may_be_clear(s)) ||
           std::ranges::any_of(writers_of(s), [&](uint32_t t) { return is_of(t, id, depth); });
}

void StoredDepths::observe(const SampleExpectation& s, cases::SampleId id, float depth,
                           bool is_clear, path::Observed& out, const std::vector<bool>* of) {
    const std::span<const uint32_t> writers = writers_of(s);
    out.may_be_clear = is_clear;
    for (const path::Fragment& f : expectation_.fragments_of(s)) {
        out.stored.push_back((of == nullptr || (*of)[out.stored.size()]) &&
                             std::ranges::find(writers, f.triangle) != writers.end() &&
                             is_of(f.triangle, id, depth));
    }
}

}  // namespace ref
