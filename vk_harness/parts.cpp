// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/parts.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/case_check.hpp"
#include "vk_harness/target/attachments.hpp"
#include "vk_harness/target/target_layout.hpp"

namespace vk_harness {

namespace {

// Whether the input makes the shader run once a sample, or may do so (Vulkan specification, "Sample
// Shading").
bool asks_for_samples(const cases::Attribute& a) {
    return a.auxiliary == cases::Auxiliary::sample || a.source == cases::Source::sample_id ||
           a.source == cases::Source::sample_position;
}

// Whether a draw has other fragments without its attribute k.
bool decides(const cases::Case& c, const cases::Draw& draw, uint32_t k) {
    return k < draw.attributes.size() &&
           ((cases::discards_by_value(draw) && draw.discard_attribute == k) ||
            (c.target.samples > 1 && asks_for_samples(draw.attributes[k])));
}

// The attributes by which some draw has other fragments than without them, and the others.
struct Attributes {
    std::vector<uint32_t> deciding, rest;
};
Attributes sorted_attributes(const cases::Case& c) {
    Attributes out;
    for (uint32_t k = 0; k < cases::attributes_of(c); ++k) {
        const bool is_deciding = std::ranges::any_of(
            c.draws, [&](const cases::Draw& draw) { return decides(c, draw, k); });
        (is_deciding ? out.deciding : out.rest).push_back(k);
    }
    return out;
}

// The planes that are masked, where the attributes have other numbers.
uint32_t masked_planes(uint32_t masked, const std::vector<uint32_t>& attributes) {
    uint32_t all = 0;
    for (uint32_t k = 0; k < cases::kMaxAttributes; ++k) {
        all |= 1U << (capture::kAttributePlane + k);
    }
    uint32_t out = masked & ~all;
    for (uint32_t k = 0; k < attributes.size(); ++k) {
        out |= (masked >> (capture::kAttributePlane + attributes[k]) & 1U)
               << (capture::kAttributePlane + k);
    }
    return out;
}

// The case with its instruments, some of its attributes (ascending) and no colours.
cases::Case with_attributes(const cases::Case& c, const std::vector<uint32_t>& attributes) {
    cases::Case out = c;
    out.target.color.reset();
    out.target.other_colors.clear();
    out.target.judged_color = 0;
    out.target.color_resolve = cases::Resolve::none;
    out.variation.masked = masked_planes(c.variation.masked, attributes);
    for (size_t d = 0; d < c.draws.size(); ++d) {
        const cases::Draw& from = c.draws[d];
        cases::Draw& draw = out.draws[d];
        draw.color = {};
        draw.other_colors.clear();
        draw.attributes.clear();
        for (const uint32_t k : attributes) {
            if (k >= from.attributes.size()) {
                continue;
            }
            if (from.discard_attribute == k) {
                draw.discard_attribute = static_cast<uint32_t>(draw.attributes.size());
            }
            draw.attributes.push_back(from.attributes[k]);
        }
        if (!cases::discards_by_value(from)) {
            draw.discard_attribute = 0;
        }
    }
    return out;
}

void leave_queries(cases::Case& c) {
    for (cases::Draw& draw : c.draws) {
        draw.query = cases::Query::none;
    }
}

// The case with its colours alone.
cases::Case colors_alone(const cases::Case& c) {
    cases::Case out = c;
    out.target.has_instruments = false;
    out.target.depth_resolve = out.target.stencil_resolve = cases::Resolve::none;
    leave_queries(out);
    return out;
}

// Whether every draw has the attributes that decide its fragments where the colours are drawn
// alone. Those that discard always are inputs there.
bool colors_have_deciding(const cases::Case& c) {
    return std::ranges::all_of(c.draws, [&](const cases::Draw& draw) {
        const std::vector<uint32_t> drawn = cases::drawn_attributes(c.target, draw);
        for (uint32_t k = 0; k < cases::kMaxAttributes; ++k) {
            if (decides(c, draw, k) && std::ranges::find(drawn, k) == drawn.end()) {
                return false;
            }
        }
        return true;
    });
}

bool has_room(const Capabilities& capabilities, const cases::Case& c) {
    return color_count(attachments_of(c, target_layout(capabilities, c))) <=
           capabilities.info.max_color_attachments;
}

bool counts_hits(const Capabilities& capabilities, const cases::Case& c) {
    return !check_counting(capabilities, c, target_layout(capabilities, c));
}

}  // namespace

std::vector<Part> parts_of(const Capabilities& capabilities, const cases::Case& c) {
    if (!c.target.has_instruments || c.blit ||
        (has_room(capabilities, c) && counts_hits(capabilities, c))) {
        return {};
    }
    const auto [deciding, rest] = sorted_attributes(c);
    std::vector<Part> parts;
    for (size_t next = 0; parts.empty() || next < rest.size();) {
        const bool is_first = parts.empty();
        const auto fits = [&](const cases::Case& test) {
            return has_room(capabilities, test) && (!is_first || counts_hits(capabilities, test));
        };
        Part part;
        part.has_fragments = is_first;
        part.attributes = deciding;
        part.taken = is_first ? deciding : std::vector<uint32_t>();
        part.test = with_attributes(c, part.attributes);
        if (!fits(part.test)) {
            return {};
        }
        const size_t begin = next;
        for (; next < rest.size(); ++next) {
            std::vector<uint32_t> more = part.attributes;
            more.insert(std::ranges::upper_bound(more, rest[next]), rest[next]);
            cases::Case test = with_attributes(c, more);
            if (!fits(test)) {
                break;
            }
            part.taken.push_back(rest[next]);
            part.attributes = std::move(more);
            part.test = std::move(test);
        }
        if (!is_first) {
            if (next == begin) {
                return {};
            }
            leave_queries(part.test);
            part.test.target.depth_resolve = part.test.target.stencil_resolve =
                cases::Resolve::none;
        }
        parts.push_back(std::move(part));
    }
    if (c.target.color) {
        Part part;
        part.has_color = true;
        part.test = colors_alone(c);
        if (!has_room(capabilities, part.test) || !colors_have_deciding(c)) {
            return {};
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

std::optional<Rejection> check_parts(const Capabilities& capabilities, const cases::Case& c) {
    const std::vector<Part> parts = parts_of(capabilities, c);
    if (parts.empty()) {
        return check_case(capabilities, c);
    }
    for (const Part& part : parts) {
        if (auto rejection = check_case(capabilities, part.test, part.has_fragments)) {
            return rejection;
        }
    }
    return std::nullopt;
}

namespace {

bool tells_plane(const Part& part, uint32_t number) {
    if (number >= capture::kAttributePlane &&
        number < capture::kAttributePlane + cases::kMaxAttributes) {
        return std::ranges::find(part.taken, number - capture::kAttributePlane) != part.taken.end();
    }
    const std::string_view name = capture::name_of_plane(number);
    return name == "color" || name == "resolved_color" ? part.has_color : part.has_fragments;
}

}  // namespace

void take_part(const Part& part, const capture::CaptureView& drawn, const capture::PlaneSpans& to) {
    capture::CaptureView from = drawn;
    from.attributes = {};
    for (size_t k = 0; k < part.attributes.size(); ++k) {
        from.attributes.at(part.attributes[k]) = drawn.attributes.at(k);
    }
    capture::for_each_plane(
        [&](const capture::Plane& plane, const auto& source, const auto& taken) {
            if (plane.entries > 0 && tells_plane(part, plane.number)) {
                std::ranges::copy(source, taken.begin());
            }
        },
        to, from, to);
}

}  // namespace vk_harness
