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

void QueryUnit::count(uint32_t draw, Ending ending, bool is_first, const Quad& quad) {
    const Fault fault = device_.fault;
    if (counts_.empty()) {
        return;
    }
    if (cases::is_statistic(case_.draws[draw].query)) {
        count_fragment(draw, ending, is_first, quad);
        return;
    }
    if (fault == "query-counts-pixels"_fault && !is_first) {
        return;
    }
    bool is_counted = ending == Ending::shown || ending == Ending::hidden;
    switch (ending) {
        case Ending::masked:
            is_counted = fault == "query-before-mask"_fault;
            break;
        case Ending::discarded:
            is_counted = fault == "query-before-discard"_fault;
            break;
        case Ending::out_of_bounds:
            is_counted = fault == "query-before-bounds"_fault;
            break;
        case Ending::stencil_failed:
            is_counted = fault == "query-before-stencil"_fault;
            break;
        case Ending::depth_failed:
            is_counted = fault == "query-before-depth"_fault;
            break;
        case Ending::hidden:
            is_counted = fault != "query-without-hidden"_fault;
            break;
        case Ending::shown:
            break;
    }
    counts_[draw] += is_counted ? 1 : 0;
}

namespace {

// Whether each sample of the draw has an invocation of its own.
bool is_shaded_by_sample(const cases::Draw& draw) {
    return draw.multisample.min_sample_shading.has_value() ||
           std::ranges::any_of(draw.attributes, [](const cases::Attribute& a) {
               return a.auxiliary == cases::Auxiliary::sample ||
                      a.source == cases::Source::sample_id ||
                      a.source == cases::Source::sample_position;
           });
}

}  // namespace

void QueryUnit::count_fragment(uint32_t draw, Ending ending, bool is_first, const Quad& quad) {
    is_fragment_done_ = is_fragment_done_ && !is_first;
    const Fault fault = device_.fault;
    if (quads_draw_ != draw) {
        quads_draw_ = draw;
        quads_.clear();
    }
    const bool by_sample =
        is_shaded_by_sample(case_.draws[draw]) && fault != "statistics-fragments-by-pixel"_fault;
    const bool is_shaded = device_.counts_most || ending == Ending::discarded ||
                           ending == Ending::hidden || ending == Ending::shown;
    if (!is_shaded || (is_fragment_done_ && !by_sample)) {
        return;
    }
    is_fragment_done_ = true;
    uint64_t more = 1;
    if (device_.counts_most || fault == "statistics-fragments-by-quad"_fault) {
        const uint64_t samples = by_sample ? case_.target.samples : 1;
        more = !quads_.insert(quad).second ? 0 : device_.counts_most ? 4 * samples : 1;
    }
    add(draw, Query::fragment_invocations, more);
}

void QueryUnit::count_clipped(uint32_t draw, size_t corners, bool was_cut) {
    uint64_t more = corners < 3 ? 0 : corners - 2;
    if (device_.fault == "statistics-clipping-lossless"_fault) {
        more = std::max(more, uint64_t{1});
    } else if (device_.fault == "statistics-clipping-uncut"_fault && was_cut) {
        more = 0;
    }
    add(draw, Query::clipping_primitives, more);
}

void QueryUnit::add(uint32_t draw, Query statistic, uint64_t more) {
    if (!counts_.empty() && case_.draws[draw].query == statistic) {
        counts_[draw] += more;
    }
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
            case "query-halved"_fault:
                out[k] /= 2;
                break;
            case "query-not-reset"_fault:
                out[k] += before;
                break;
            case "query-in-16-bits"_fault:
                out[k] &= 0xffff;
                break;
            case "query-precise-as-any"_fault:
                out[k] = query == Query::occlusion_precise ? std::min(out[k], uint64_t{1}) : out[k];
                break;
            case "query-always-any"_fault:
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
