// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypothesis.hpp"

#include <fmt/format.h>

#include <utility>

#include "cases/fault/fault.hpp"
#include "rasterizers/strength/strength.hpp"

namespace diagnosis {

namespace {

using cases::operator""_fault;
using software::Device;
using software::Rounding;

// Sentences stand in tables with a full stop.
std::string without_stop(std::string_view sentence) {
    if (sentence.ends_with('.')) {
        sentence.remove_suffix(1);
    }
    return std::string(sentence);
}

// What is legal at some profile, and what is told of the device that is not as it was found.
std::vector<Hypothesis> choices(int subpixel_bits) {
    std::vector<Hypothesis> out;
    const auto add = [&](std::string name, std::string what, const auto& choose) {
        Hypothesis h{std::move(name), std::move(what)};
        h.device.subpixel_bits = subpixel_bits;
        choose(h.device);
        out.push_back(std::move(h));
    };
    add("snaps-half-up", "Vertices half-way between two subpixel positions snap upwards",
        [](Device& d) { d.rounding = Rounding::half_up; });
    add("snaps-toward-zero", "Vertices snap towards zero",
        [](Device& d) { d.rounding = Rounding::truncate; });
    add("ties-by-axes", "Exactly vertical left edges and edges above own their samples",
        [](Device& d) { d.ties = software::TieRule::left_top; });
    add("centroid-mean", "The centroid is the mean of the covered samples",
        [](Device& d) { d.centroid = software::Centroid::mean; });
    add("facing-unsnapped", "Facing comes from unsnapped positions",
        [](Device& d) { d.facing_unsnapped = true; });
    add("half-toward-zero", "Halves are rounded towards zero",
        [](Device& d) { d.half_toward_zero = true; });
    for (int bits = 4; bits <= 12; ++bits) {
        if (bits != subpixel_bits) {
            add(fmt::format("subpixel-bits-{}", bits),
                fmt::format("Vertices snap to 1/{} pixel, {} subpixel bits instead of {}",
                            1 << bits, bits, subpixel_bits),
                [bits](Device& d) { d.subpixel_bits = bits; });
        }
    }
    return out;
}

}  // namespace

std::vector<Hypothesis> known_hypotheses(int subpixel_bits) {
    std::vector<Hypothesis> out;
    const auto add_faults = [&](bool with_code) {
        for (const cases::FaultRow& row : cases::kFaults) {
            if (cases::has_code(row.fault) != with_code || row.fault == "coarse-snapping"_fault) {
                continue;  // the latter is a choice of subpixel bits
            }
            Hypothesis h{std::string(row.name), without_stop(row.sentence)};
            h.device.subpixel_bits = subpixel_bits;
            h.device.fault = row.fault;
            out.push_back(std::move(h));
        }
    };
    add_faults(false);
    for (Hypothesis& h : choices(subpixel_bits)) {
        out.push_back(std::move(h));
    }
    add_faults(true);
    return out;
}

std::optional<capture::Capture> draw(const Hypothesis& hypothesis, const cases::Case& c) {
    const cases::Fault fault = hypothesis.device.fault;
    if (fault != cases::kNoFault && !software::can_matter(fault, c)) {
        return std::nullopt;
    }
    cases::Case moved = c;
    for (cases::Draw& d : moved.draws) {
        d.viewport.x += hypothesis.moved_x;
        d.viewport.y += hypothesis.moved_y;
    }
    return software::captured(moved, hypothesis.device);
}

}  // namespace diagnosis
