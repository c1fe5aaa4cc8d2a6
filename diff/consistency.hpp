// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Self-consistency: two renderings of a case, bit for bit. No reference is asked and nothing is
// tolerated; samples that the specification leaves free are compared like all others.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/derive.hpp"
#include "diff/verdict.hpp"

namespace diff {

// One sample or resolved pixel whose bits differ: its first word that does.
struct Difference {
    uint64_t sample = 0;    // index in its plane
    uint32_t plane = 0;     // its number (capture.hpp), below kPlanes, or kCounts
    uint32_t word = 0;      // of the sample in its plane
    uint64_t expected = 0;  // bits of the case itself, changed as the variation demands
    uint64_t got = 0;
    static void fields(auto&& visit, auto&... d) {
        visit("sample", d.sample...);
        visit("plane", d.plane...);
        visit("word", d.word...);
        visit("expected", d.expected...);
        visit("got", d.got...);
    }
    friend bool operator==(const Difference&, const Difference&) = default;
};
// The planes that are compared: all that the case itself draws.
inline constexpr uint32_t kPlanes = capture::kPlaneNumbers;
// In place of a plane's number: what the query of draw `word` counted, which belongs to no sample.
inline constexpr uint32_t kCounts = kPlanes;
inline constexpr size_t kMaxDifferences = 64;

// What comparing one derived rendering with the case's own has found.
struct Consistency {
    uint64_t compared = 0;                // samples, resolved pixels, and counts of queries
    uint64_t different = 0;               // of them
    std::vector<Difference> differences;  // the first kMaxDifferences
    // Of a picture through a door: why the device has no such door; then nothing was compared.
    std::string closed;
    // Of a door that need not have the same bits and has others: what of its picture is wrong by
    // the reference at profile vulkan; empty if nothing is.
    std::string wrong;
    static void fields(auto&& visit, auto&... c) {
        visit("compared", c.compared...);
        visit("different", c.different...);
        visit("differences", c.differences...);
        visit("closed", c.closed...);
        visit("wrong", c.wrong...);
    }
    friend bool operator==(const Consistency&, const Consistency&) = default;
};

// `base` is the case as it stands, `derived` what cases::derive() drew. Samples of `base` that
// contradict themselves or were not copied are passed over: compare() reports them. So are resolved
// pixels of which the variation does not say what they become (consistency.cpp).
Consistency compare_bits(const cases::Case& c, const capture::CaptureView& base,
                         const capture::CaptureView& derived, const cases::Derivation& derivation);

// Makes a capture of a case into what the variation should have drawn (fakes in tests, and the
// reference as a device).
void vary(capture::Capture& capture, const cases::Variation& variation);

// Adds the differences to a verdict, one finding a sample or resolved pixel, as far as the
// verdict's profile demands the rules. `found` holds one result a derivation.
void add_differences(const cases::Case& c, std::span<const cases::Derivation> derivations,
                     std::span<const Consistency> found, Verdict& verdict);

// What a query gave: "64", "no result".
std::string count_text(uint64_t counted);

// "attribute 1.z", "hits.x", ...
std::string plane_name(uint32_t plane, uint32_t word);

}  // namespace diff
