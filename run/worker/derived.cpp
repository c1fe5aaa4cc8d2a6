// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/derived.hpp"

#include <algorithm>
#include <iterator>

namespace run {

using vk_harness::Rendered;

namespace {

// Where a derived rendering belongs.
struct Origin {
    size_t of = 0;          // number of the case in the batch
    size_t derivation = 0;  // of the case
};

struct Round {
    std::vector<cases::Case> cases;
    std::vector<Origin> origins;
};

}  // namespace

capture::CaptureView view_of(const Rendered& rendered) {
    const capture::Capture& c = rendered.capture;
    return rendered.placed.empty()
               ? capture::CaptureView(c)
               : capture::view_planes(c.target, c.has_primitive, c.attribute_count,
                                      rendered.placed.data());
}

std::vector<RenderedCase> render_with_derived(
    Backend& backend, const std::vector<cases::Case>& batch,
    const std::function<void(std::string_view)>& step, const vk_harness::PlaneStore& store,
    const std::function<void(size_t, Rendered&)>& damage) {
    std::vector<std::vector<cases::Derivation>> derivations;
    Round beside;
    Round later;
    for (size_t k = 0; k < batch.size(); ++k) {
        derivations.push_back(cases::derivations(batch[k]));
        for (size_t d = 0; d < derivations[k].size(); ++d) {
            Round& round = derivations[k][d].variation.later ? later : beside;
            round.cases.push_back(cases::derive(batch[k], derivations[k][d]));
            round.origins.push_back({k, d});
        }
    }

    std::vector<RenderedCase> results(batch.size());
    std::vector<Rendered> drawn;
    if (beside.cases.empty()) {
        drawn = backend.render(batch, step, store);
    } else {
        std::vector<cases::Case> all = batch;
        std::move(beside.cases.begin(), beside.cases.end(), std::back_inserter(all));
        const auto store_own = [&](size_t slot, uint64_t bytes) {
            return store && slot < batch.size() ? store(slot, bytes) : std::span<std::byte>();
        };
        drawn = backend.render(all, step, store_own);
    }
    for (size_t k = 0; k < batch.size(); ++k) {
        results[k].rendered = std::move(drawn[k]);
        results[k].consistency.resize(derivations[k].size());
    }

    const auto compare = [&](const Origin& origin, Rendered& derived) {
        RenderedCase& result = results[origin.of];
        const cases::Derivation& derivation = derivations[origin.of][origin.derivation];
        Rendered& own = result.rendered;
        own.messages.insert(own.messages.end(), derived.messages.begin(), derived.messages.end());
        if (own.status != Rendered::Status::drawn) {
            return;
        }
        if (derived.status != Rendered::Status::drawn) {
            own.status = derived.status;
            own.reason = "the rendering " + derivation.name + ": " + derived.reason;
            result.consistency.clear();
            return;
        }
        own.stray_writes.insert(own.stray_writes.end(), derived.stray_writes.begin(),
                                derived.stray_writes.end());
        if (damage) {
            damage(origin.of, derived);
        }
        result.consistency[origin.derivation] =
            diff::compare_bits(view_of(own), view_of(derived), derivation);
    };
    for (size_t k = 0; k < beside.origins.size(); ++k) {
        compare(beside.origins[k], drawn[batch.size() + k]);
    }
    drawn.clear();
    if (!later.cases.empty()) {
        std::vector<Rendered> again = backend.render(later.cases, step, {});
        for (size_t k = 0; k < later.origins.size(); ++k) {
            compare(later.origins[k], again[k]);
        }
    }
    for (RenderedCase& result : results) {
        if (result.rendered.status != Rendered::Status::drawn) {
            result.consistency.clear();
        }
    }
    return results;
}

}  // namespace run
