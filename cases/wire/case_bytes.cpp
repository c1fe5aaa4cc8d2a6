// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/wire/case_bytes.hpp"

#include <algorithm>

#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"
#include "cases/wire/bytes.hpp"

namespace cases {

namespace {

constexpr uint32_t kMagic = 0x45434733;  // "ECG3"

// Sizes that a renderer takes memory for.
bool has_possible_sizes(const Case& c) {
    const auto fits = [](uint32_t a, uint32_t b) {
        return a <= kMaxTargetSize && b <= kMaxTargetSize;
    };
    return (!c.blit || fits(c.blit->source_width, c.blit->source_height)) &&
           std::ranges::all_of(c.relations,
                               [&fits](const Relation& r) {
                                   return fits(r.tile[0], r.tile[1]) &&
                                          (r.kind == RelationKind::door) == (r.door != Door::none);
                               }) &&
           std::ranges::find(c.doors, Door::none) == c.doors.end();
}

// Each draw writes to every colour target.
bool has_possible_colors(const Case& c) {
    const size_t others = c.target.other_colors.size();
    return others < kMaxColorTargets && c.target.judged_color <= others &&
           (others == 0 || c.target.color) &&
           std::ranges::all_of(
               c.draws, [others](const Draw& draw) { return draw.other_colors.size() == others; });
}

// Of fragments: a side divides a pixel's coordinates, and their samples are numbered.
bool has_possible_fragments(const Case& c) {
    const auto is_side = [](uint32_t side) { return side == 1 || side == 2 || side == 4; };
    return std::ranges::all_of(c.draws, [&](const Draw& draw) {
        return is_side(draw.fragment_size[0]) && is_side(draw.fragment_size[1]) &&
               (!has_large_fragments(draw) ||
                samples_of_fragment(draw, c.target) <= kMaxFragmentSamples);
    });
}

}  // namespace

std::string to_bytes(const Case& c) {
    wire::Writer w;
    w.put(kMagic);
    w.put(c);
    return w.take();
}

Expected<Case> from_bytes(std::span<const char> bytes) {
    wire::Reader r(std::string_view(bytes.data(), bytes.size()));
    if (r.get<uint32_t>() != kMagic) {
        return failure("these bytes are not a case of this program");
    }
    Case c = r.get<Case>();
    if (!r.good() || !has_possible_sizes(c) || !has_possible_colors(c) ||
        !has_possible_fragments(c)) {
        return failure("the bytes of a case are cut short or damaged");
    }
    if (!r.at_end()) {
        return failure("more bytes follow than the case has");
    }
    return c;
}

}  // namespace cases
