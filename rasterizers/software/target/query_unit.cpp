// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/query_unit.hpp"

#include <algorithm>

#include "cases/model/sample.hpp"

namespace software {

using cases::Query;

QueryUnit::QueryUnit(const cases::Case& c, const Device& device) : case_(c), device_(device) {
    if (cases::asks_queries(c)) {
        counts_.assign(c.draws.size(), 0);
    }
}

void QueryUnit::count(uint32_t draw, Ending ending, bool is_first) {
    const Fault fault = device_.fault;
    if (counts_.empty() || (fault == Fault::query_counts_pixels && !is_first)) {
        return;
    }
    bool is_counted = ending == Ending::shown || ending == Ending::hidden;
    switch (ending) {
        case Ending::masked:
            is_counted = fault == Fault::query_before_mask;
            break;
        case Ending::discarded:
            is_counted = fault == Fault::query_before_discard;
            break;
        case Ending::out_of_bounds:
            is_counted = fault == Fault::query_before_bounds;
            break;
        case Ending::stencil_failed:
            is_counted = fault == Fault::query_before_stencil;
            break;
        case Ending::depth_failed:
            is_counted = fault == Fault::query_before_depth;
            break;
        case Ending::hidden:
            is_counted = fault != Fault::query_without_hidden;
            break;
        case Ending::shown:
            break;
    }
    counts_[draw] += is_counted ? 1 : 0;
}

std::vector<uint64_t> QueryUnit::results() const {
    std::vector<uint64_t> out = counts_;
    uint64_t before = 0;
    for (size_t k = 0; k < out.size(); ++k) {
        const Query query = case_.draws[k].query;
        if (query == Query::none) {
            out[k] = 0;
            continue;
        }
        switch (device_.fault) {
            case Fault::query_halved:
                out[k] /= 2;
                break;
            case Fault::query_not_reset:
                out[k] += before;
                break;
            case Fault::query_in_16_bits:
                out[k] &= 0xffff;
                break;
            case Fault::query_precise_as_any:
                out[k] = std::min(out[k], uint64_t{1});
                break;
            case Fault::query_always_any:
                out[k] = query == Query::occlusion ? 1 : out[k];
                break;
            default:
                break;
        }
        before = out[k];
        out[k] = query == Query::occlusion ? std::min(out[k], uint64_t{1}) : out[k];
    }
    return out;
}

}  // namespace software
