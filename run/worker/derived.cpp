// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/worker/derived.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <set>
#include <string>

#include "cases/base/limits.hpp"
#include "cases/model/device.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"

namespace run {

using capture::Rendered;

namespace {

// Where a derived rendering belongs.
struct Origin {
    size_t of = 0;          // number of the case in the batch
    size_t derivation = 0;  // of the case
};

// What of a picture that has other bits than the plain one is wrong by itself, at profile vulkan;
// empty if nothing is. With `plain`, only rules count that the plain picture does not break itself.
std::string wrong_at_vulkan(const cases::Case& filed, const Rendered& drawn,
                            const capture::DeviceInfo& device, const Rendered* plain) {
    try {
        const ref::Limits limits = limits_of(device);
        const std::optional<cases::Case> placed = ref::as_drawn(filed, limits);
        const cases::Case& c = placed ? *placed : filed;
        const ref::Expectation expectation = ref::expect(c, limits, cases::Profile::vulkan);
        if (expectation.must_samples == 0) {
            return "";  // a black picture would not be wrong, either
        }
        const auto seen = [&](const Rendered& picture) {
            capture::CaptureView view = view_of(picture);
            view.target = c.target;
            return view;
        };
        // All that is wrong takes much longer to tell, and all other cases wait for it.
        const diff::Verdict first =
            diff::compare(c, expectation, seen(drawn), diff::Wanted::first_finding);
        if (!first.error.empty() || first.findings.empty()) {
            return first.error;
        }
        const diff::Verdict verdict =
            plain == nullptr
                ? first
                : diff::compare(c, expectation, seen(drawn), diff::Wanted::findings_without_ratios);
        std::set<std::string> broken;
        if (plain != nullptr) {
            for (const diff::Finding& f :
                 diff::compare(c, expectation, seen(*plain), diff::Wanted::findings_without_ratios)
                     .findings) {
                broken.insert(f.rule);
            }
        }
        for (const diff::Finding& f : verdict.findings) {
            if (!broken.contains(f.rule)) {
                return fmt::format("{} at ({}, {}): {}", f.rule, f.x, f.y, f.why);
            }
        }
        return "";
    } catch (const std::exception& e) {
        if (cases::is_limit(e)) {
            throw;  // which says nothing of the picture
        }
        return fmt::format("the comparison failed: {}", e.what());
    }
}

// What other bits through a door amount to: what of the picture is wrong, or that nothing is to be
// said of them.
void judge_door(const cases::Case& c, const Rendered& plain, const Rendered& drawn,
                const capture::DeviceInfo& device, cases::DoorPromise promise,
                diff::Consistency& found) {
    if (promise == cases::DoorPromise::same_bits) {
        return;
    }
    // Where other bits are no finding, neither is what the plain picture does wrong, too.
    const bool is_alone = promise == cases::DoorPromise::right_alone;
    found.wrong = wrong_at_vulkan(c, drawn, device, is_alone ? &plain : nullptr);
    // A picture that is right through the door differs from a wrong one: no fault of the door.
    if (found.wrong.empty() && (is_alone || !wrong_at_vulkan(c, plain, device, nullptr).empty())) {
        found.different = 0;
        found.differences.clear();
    }
}

struct Round {
    std::vector<cases::Case> cases;
    std::vector<Origin> origins;
};

}  // namespace

ref::Limits limits_of(const capture::DeviceInfo& device) {
    // Vulkan requires 4 bits of all three. What a device with more than the reference knows is not
    // judged by stands in vk_harness/draw_check.cpp.
    ref::Limits limits =
        ref::limits_of(device.subpixel_bits, device.sample_locations, device.depth_beside_stencil);
    // A device that rasterizes a sample only at the centre may have 0 bits, and asks for no offset.
    // The steps of 64 bits are below the rounding of any offset and any level.
    limits.interpolation_offset_bits =
        static_cast<int>(std::clamp(device.interpolation_offset_bits, 4U, 64U));
    limits.mipmap_bits = static_cast<int>(std::clamp(device.mipmap_bits, 4U, 64U));
    limits.viewport_bits =
        static_cast<int>(std::min(device.viewport_subpixel_bits, cases::kMostSubpixelBits));
    limits.first_strip_order = device.has_first_strip_order;
    limits.overestimation = device.overestimation;
    limits.overestimation_step = device.overestimation_step;
    limits.rasterizes_degenerates = device.rasterizes_degenerates;
    return limits;
}

std::vector<RenderedCase> render_with_derived(
    capture::Renderer& renderer, const std::vector<cases::Case>& batch, const capture::Step& step,
    const capture::PlaneStore& store, const std::function<void(size_t, Rendered&)>& damage) {
    std::vector<std::vector<cases::Derivation>> derivations;
    Round beside;
    Round later;
    for (const cases::Case& c : batch) {
        // What a derivation changes follows from the case as it is drawn, as for who judges it.
        derivations.push_back(
            cases::derivations(ref::as_drawn(c, limits_of(renderer.device())).value_or(c)));
    }
    // Doors come last: not many of them are in one submission, and others are to be in that of the
    // cases themselves.
    for (const bool are_doors : {false, true}) {
        for (size_t k = 0; k < batch.size(); ++k) {
            for (size_t d = 0; d < derivations[k].size(); ++d) {
                const cases::Derivation& derivation = derivations[k][d];
                if ((derivation.kind == cases::RelationKind::door) == are_doors) {
                    Round& round = derivation.variation.later ? later : beside;
                    round.cases.push_back(cases::derive(batch[k], derivation));
                    round.origins.push_back({k, d});
                }
            }
        }
    }

    std::vector<RenderedCase> results(batch.size());
    std::vector<Rendered> drawn;
    if (beside.cases.empty()) {
        drawn = renderer.render(batch, capture::kEveryPlane, step, store);
    } else {
        std::vector<cases::Case> all = batch;
        std::move(beside.cases.begin(), beside.cases.end(), std::back_inserter(all));
        const auto store_own = [&](size_t slot, uint64_t bytes) {
            return store && slot < batch.size() ? store(slot, bytes) : std::span<std::byte>();
        };
        drawn = renderer.render(all, capture::kEveryPlane, step, store_own);
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
        const bool is_door = derivation.kind == cases::RelationKind::door;
        if (is_door && derived.status == Rendered::Status::unsupported) {
            result.consistency[origin.derivation].closed = derived.reason;
            return;
        }
        if (derived.status != Rendered::Status::drawn) {
            own.status = derived.status;
            own.reason = "the rendering " + derivation.name + ": " + derived.reason;
            result.consistency.clear();
            return;
        }
        for (capture::StrayWrite& write : derived.stray_writes) {
            write.attachment += ", " + derivation.name;
            own.stray_writes.push_back(std::move(write));
        }
        if (damage) {
            damage(origin.of, derived);
        }
        diff::Consistency& found = result.consistency[origin.derivation];
        found = diff::compare_bits(batch[origin.of], view_of(own), view_of(derived), derivation);
        if (is_door && found.different > 0) {
            judge_door(batch[origin.of], own, derived, renderer.device(),
                       cases::row_of(derivation.variation.door).promise, found);
        }
    };
    for (size_t k = 0; k < beside.origins.size(); ++k) {
        compare(beside.origins[k], drawn[batch.size() + k]);
    }
    drawn.clear();
    if (!later.cases.empty()) {
        std::vector<Rendered> again = renderer.render(later.cases, capture::kEveryPlane, step, {});
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
