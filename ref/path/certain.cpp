// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/path/certain.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace ref::path {

using cases::kStencilBits;

std::optional<Resolution> resolve_certain(const Question& question) {
    if (question.is_unknown) {
        return std::nullopt;
    }
    const size_t count = question.fragments.size();
    std::vector<uint32_t> members(question.sets.size());
    for (const Fragment& f : question.fragments) {
        if (f.set >= 0) {
            ++members[static_cast<size_t>(f.set)];
        }
    }
    Resolution out;
    out.fates.resize(count);
    out.is_last.assign(count, false);
    out.is_stored.assign(count, false);
    Outcome outcome;
    uint32_t value = question.clear & kStencilBits;
    int stored = kClearDepth, last = -1;
    for (size_t m = 0; m < count; ++m) {
        const Fragment& f = question.fragments[m];
        const FragmentSet* const set =
            f.set < 0 ? nullptr : &question.sets[static_cast<size_t>(f.set)];
        const bool is_whole = set != nullptr && set->least == members[static_cast<size_t>(f.set)];
        Fate& fate = out.fates[m];
        if (set != nullptr && set->most == 0 && !f.is_sure && f.twin < 0) {
            fate.is_absent = true;
            continue;
        }
        const Fate* const twin = f.twin < 0 ? nullptr : &out.fates[static_cast<size_t>(f.twin)];
        const bool is_there = f.is_sure || is_whole || (twin != nullptr && !twin->is_absent);
        if (!is_there || f.can_be_front == f.can_be_back || f.is_discard_open ||
            (twin != nullptr && twin->is_absent)) {
            return std::nullopt;
        }
        const DepthOutcome bounds = question.bounds_of(stored, m);
        if (bounds != DepthOutcome::passes) {
            fate.fails_bounds = true;
            if (bounds == DepthOutcome::open) {
                return std::nullopt;
            }
            continue;
        }
        const cases::StencilFace& face = f.can_be_front ? f.state->front : f.state->back;
        fate.met.set(value);
        if (!stencil::passes(face, value)) {
            fate.fails = true;
            value = stencil::updated(face.fail, face, value);
            continue;
        }
        const DepthOutcome depth = question.depth_of(stored, m);
        if (depth != DepthOutcome::passes) {
            fate.fails_depth = true;
            if (depth == DepthOutcome::open) {
                return std::nullopt;
            }
            value = stencil::updated(face.depth_fail, face, value);
            continue;
        }
        value = stencil::updated(face.pass, face, value);
        stored = f.writes_depth ? static_cast<int>(m) : stored;
        fate.is_discarded = f.can_be_front ? f.is_discarded_front : f.is_discarded_back;
        fate.passes = !fate.is_discarded;
        if (fate.passes) {
            last = static_cast<int>(m);
            outcome.front += f.can_be_front ? 1 : 0;
            outcome.back += f.can_be_back ? 1 : 0;
        }
    }
    outcome.values.set(value);
    out.outcomes.push_back(outcome);
    if (last >= 0) {
        out.is_last[static_cast<size_t>(last)] = true;
    }
    out.may_be_clear = stored == kClearDepth;
    if (stored != kClearDepth) {
        out.is_stored[static_cast<size_t>(stored)] = true;
    }
    return out;
}

}  // namespace ref::path
