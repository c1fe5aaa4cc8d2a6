// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/sample_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "cases/base/float_bits.hpp"
#include "cases/model/sample.hpp"
#include "ref/number/fixed_point.hpp"

namespace ref::value {

namespace {

using cases::Profile;

struct Pair {
    float x = 0, y = 0;  // multiples of 1/16 below 2^15: exact in binary32
};

using cases::same_bits;

Pair location(const Fragment& f, uint32_t s) {
    const auto& at = sample_locations(*f.target)[s];
    return {static_cast<float>(at[0]) / 16.0F, static_cast<float>(at[1]) / 16.0F};
}

Pair in_framebuffer(const Fragment& f, const Pair& in_pixel) {
    return {static_cast<float>(f.id.x) + in_pixel.x, static_cast<float>(f.id.y) + in_pixel.y};
}

// Of the fragment: a half, or a whole number below 2^15.
Pair centre_of(const Fragment& f) {
    const auto at = [](uint32_t first, uint32_t side) {
        return static_cast<float>(first) + static_cast<float>(side) / 2.0F;
    };
    return {at(f.block.x, f.block.width), at(f.block.y, f.block.height)};
}

// The bits of a mask of samples for all pixels of a fragment.
uint32_t in_all_pixels(const Fragment& f, uint32_t mask) {
    const uint32_t samples = f.target->samples;
    const uint32_t bits = f.block.width * f.block.height * samples;
    const uint32_t one = mask & static_cast<uint32_t>((uint64_t{1} << samples) - 1);
    uint32_t out = 0;
    for (uint32_t j = 0; j < std::min(bits, cases::kMaxFragmentSamples); j += samples) {
        out |= one << j;
    }
    return out;
}

// Where FragCoord.xy may be.
std::vector<Pair> frag_coords(const Fragment& f, Profile profile) {
    const Pair centre = centre_of(f);
    const Pair own = in_framebuffer(f, location(f, f.id.sample));
    std::vector<Pair> all_samples;
    for (uint32_t s = 0; s < f.target->samples; ++s) {
        all_samples.push_back(in_framebuffer(f, location(f, s)));
    }
    switch (shading_rate(*f.draw, f.target->samples)) {
        case ShadingRate::fragment:
            return {centre};
        case ShadingRate::may_split:
            if (profile != Profile::vulkan) {
                return {centre, own};
            }
            all_samples.push_back(centre);
            return all_samples;
        case ShadingRate::some:
            // A minimum of one invocation asks for nothing that a fragment without sample shading
            // does not have; devices then leave it off.
            if (least_invocations(*f.draw, f.target->samples) == 1) {
                all_samples.insert(all_samples.begin(), centre);
            }
            return all_samples;
        case ShadingRate::sample:
            break;
    }
    return profile == Profile::vulkan ? all_samples : std::vector<Pair>{own};
}

// Where FragCoord.xy or gl_SamplePosition may be; the likeliest first at direct3d.
std::vector<Pair> pairs_of(const Fragment& f, Kind kind, Profile profile) {
    if (kind == Kind::pixel_centre) {
        return frag_coords(f, profile);
    }
    if (profile != Profile::vulkan) {
        return {location(f, f.id.sample)};
    }
    std::vector<Pair> all;
    for (uint32_t s = 0; s < f.target->samples; ++s) {
        all.push_back(location(f, s));
    }
    return all;
}

// Component `c` of `got` is blamed if no pair has it, or if no pair has both and it is the first.
bool is_in(std::span<const Pair> pairs, const Pair& got, uint32_t c) {
    bool has_x = false, has_y = false, has_both = false;
    for (const Pair& p : pairs) {
        const bool x = same_bits(p.x, got.x);
        const bool y = same_bits(p.y, got.y);
        has_x = has_x || x;
        has_y = has_y || y;
        has_both = has_both || (x && y);
    }
    return has_both || (c == 0 ? has_x && !has_y : has_y);
}

// A whole number in [0, 2^16), or -1.
int64_t whole(float v) {
    return v >= 0.0F && v < 0x1p16F && same_bits(v, std::floor(v)) ? static_cast<int64_t>(v) : -1;
}

// gl_SampleMaskIn of the invocation that writes the sample: all of `must`, nothing beyond `may`.
// Before the shader runs, early tests may have taken samples away ("the coverage mask for the
// current fragment as calculated by fragment operations that executed prior to fragment shading",
// Vulkan specification, "Sample Mask") or not ("the set of samples covered by the primitive", at
// the built-in): no text says which.
struct MaskBounds {
    uint32_t own = 0, must = 0, may = 0;
};
MaskBounds mask_bounds(const Fragment& f) {
    const uint32_t own = 1U << cases::coverage_index(f.block, *f.target, f.id);
    const uint32_t state = in_all_pixels(f, f.draw->multisample.sample_mask);
    const uint32_t must = f.draw->early_tests ? 0U : f.coverage.must & state;
    return {own, must | own, (f.coverage.may & state) | own};
}

bool is_mask_in(const Fragment& f, float value, Profile profile) {
    const int64_t got = whole(value);
    if (got < 0) {
        return false;
    }
    const auto mask = static_cast<uint32_t>(got);
    const auto [own, must, may] = mask_bounds(f);
    if ((mask & own) == 0 || (mask & ~may) != 0) {
        return false;
    }
    switch (shading_rate(*f.draw, f.target->samples)) {
        case ShadingRate::fragment:
            // Several invocations of a fragment of several pixels may share out its samples.
            return !f.coverage.is_one_fragment || (mask & must) == must ||
                   (profile == Profile::vulkan && cases::has_large_fragments(*f.draw));
        case ShadingRate::may_split:
        case ShadingRate::some:
            return true;
        case ShadingRate::sample:
            break;
    }
    return profile == Profile::vulkan || mask == own;
}

// "or A, B": component `c` of the pairs, but for `nominal`, each once.
std::string others(std::span<const Pair> pairs, uint32_t c, float nominal) {
    std::vector<float> numbers;
    for (const Pair& p : pairs) {
        const float n = c == 0 ? p.x : p.y;
        if (!same_bits(n, nominal) && std::none_of(numbers.begin(), numbers.end(),
                                                   [n](float m) { return same_bits(n, m); })) {
            numbers.push_back(n);
        }
    }
    return numbers.empty() ? "" : fmt::format("or {}", fmt::join(numbers, ", "));
}

}  // namespace

StoredDepth::StoredDepth(const cases::Draw& draw, cases::DepthFormat format, float written)
    : format_(format), steps_(cases::depth_steps(format)) {
    const auto [low, high] = std::minmax(draw.viewport.min_depth, draw.viewport.max_depth);
    is_free_ = !draw.depth.clamp && (written < low || written > high);
    z_ = draw.depth.clamp ? std::clamp(written, low, high) : written;
    low_ = high_ = z_;
    if (steps_ > 0) {
        exact_ = static_cast<double>(z_) * steps_;  // 24 bits times at most 24
        const auto depth_of = [&](double code) {
            return cases::depth_of_code(static_cast<uint32_t>(std::clamp(code, 0.0, steps_)),
                                        format_);
        };
        low_ = depth_of(std::floor(exact_));
        high_ = depth_of(std::ceil(exact_));
    }
}

bool StoredDepth::may_be(float stored, Profile profile) const {
    if (is_free_ || steps_ <= 0) {
        return is_free_ || (stored <= z_ && stored >= z_);  // a zero of either sign
    }
    // Of 24 bits binary32 has the product with 2^24 - 1 to a quarter or half of a step only.
    const bool is_any = profile != Profile::direct3d || format_ == cases::DepthFormat::d24_unorm;
    const auto is_near = [&](double code) { return is_any || std::fabs(code - exact_) <= 0.6; };
    return (same_bits(stored, low_) && is_near(std::floor(exact_))) ||
           (same_bits(stored, high_) && is_near(std::ceil(exact_)));
}

float StoredDepth::nominal() const {
    return exact_ - std::floor(exact_) < 0.5 ? low_ : high_;
}

std::string StoredDepth::text() const {
    return is_free_                 ? "any depth"
           : same_bits(low_, high_) ? fmt::format("{} exactly", low_)
                                    : fmt::format("{} or {}", low_, high_);
}

std::array<double, 2> StoredDepth::range() const {
    return {static_cast<double>(low_), static_cast<double>(high_)};
}

namespace {

StoredDepth stored_of(const Fragment& f) {
    return {*f.draw, f.target->depth_format, *cases::written_depth(*f.draw, f.id.x, f.id.y)};
}

}  // namespace

bool is_sample_kind(Kind kind) {
    return kind == Kind::written_depth || kind == Kind::pixel_centre || kind == Kind::sample_mask ||
           kind == Kind::sample_id || kind == Kind::sample_position || kind == Kind::shading_rate;
}

bool may_be(const Fragment& f, const Quantity& q, const FragmentValues& device, Profile profile) {
    const float got = q.get(device);
    switch (q.kind) {
        case Kind::pixel_centre: {
            const Pair at{device.frag_coord.x, device.frag_coord.y};
            if (shading_rate(*f.draw, f.target->samples) == ShadingRate::fragment) {
                const Pair centre = centre_of(f);  // the only one; no list for every fragment
                return is_in({&centre, 1}, at, q.id.component);
            }
            return is_in(pairs_of(f, q.kind, profile), at, q.id.component);
        }
        case Kind::sample_position: {
            const glm::vec4& v = device.attributes[q.id.attribute];
            return is_in(pairs_of(f, q.kind, profile), {v.x, v.y}, q.id.component);
        }
        case Kind::sample_id:
            return profile == Profile::vulkan
                       ? whole(got) >= 0 && whole(got) < int64_t{f.target->samples}
                       : whole(got) == int64_t{f.id.sample};
        case Kind::sample_mask:
            return is_mask_in(f, got, profile);
        case Kind::shading_rate:
            return whole(got) == int64_t{cases::shading_rate_bits(*f.draw)};
        case Kind::written_depth:
            return stored_of(f).may_be(got, profile);
        default:
            return true;
    }
}

float nominal_number(const Fragment& f, const Quantity& q) {
    const bool is_by_sample = shading_rate(*f.draw, f.target->samples) == ShadingRate::sample;
    switch (q.kind) {
        case Kind::pixel_centre:
        case Kind::sample_position: {
            const Pair p = is_by_sample && q.kind == Kind::pixel_centre
                               ? in_framebuffer(f, location(f, f.id.sample))
                               : pairs_of(f, q.kind, Profile::direct3d).front();
            return q.id.component == 0 ? p.x : p.y;
        }
        case Kind::written_depth:
            return stored_of(f).nominal();
        case Kind::sample_id:
            return static_cast<float>(f.id.sample);
        case Kind::sample_mask:
            return static_cast<float>(is_by_sample
                                          ? 1U << f.id.sample
                                          : f.coverage.may & 0xffffU &
                                                in_all_pixels(f, f.draw->multisample.sample_mask));
        case Kind::shading_rate:
            return static_cast<float>(cases::shading_rate_bits(*f.draw));
        default:
            return 0;
    }
}

std::string also_allowed(const Fragment& f, const Quantity& q, Profile profile) {
    const ShadingRate rate = shading_rate(*f.draw, f.target->samples);
    switch (q.kind) {
        case Kind::pixel_centre:
        case Kind::sample_position:
            return others(pairs_of(f, q.kind, profile), q.id.component, nominal_number(f, q));
        case Kind::sample_id:
            return profile == Profile::vulkan && f.target->samples > 1
                       ? "or that of another sample of the pixel"
                       : "";
        case Kind::sample_mask: {
            const auto [own, must, may] = mask_bounds(f);
            if (may == own || (rate == ShadingRate::sample && profile != Profile::vulkan)) {
                return "";
            }
            if (rate == ShadingRate::fragment && f.coverage.is_one_fragment) {
                return must == may ? "" : fmt::format("or others from {:#b} to {:#b}", must, may);
            }
            return fmt::format("or others of {:#b} with sample {}", may, f.id.sample);
        }
        default:
            return {};
    }
}

std::string allowed_text(const Fragment& f, const Quantity& q, Profile profile) {
    if (q.kind == Kind::written_depth) {
        return stored_of(f).text() +
               (f.draw->clear ? ", which a clear stores" : ", which the fragment shader wrote");
    }
    const std::string also = also_allowed(f, q, profile);
    if (!also.empty()) {
        return fmt::format("{} {}", nominal_number(f, q), also);
    }
    const bool is_centre = q.kind == Kind::pixel_centre &&
                           shading_rate(*f.draw, f.target->samples) == ShadingRate::fragment;
    const std::string centre = cases::has_large_fragments(*f.draw)
                                   ? fmt::format("the centre of the fragment's {} x {} pixels",
                                                 f.block.width, f.block.height)
                                   : "the pixel centre";
    const std::string rate =
        fmt::format("the rate of fragments of {} x {} pixels", f.block.width, f.block.height);
    return fmt::format("{} exactly, {}", nominal_number(f, q),
                       is_centre                      ? centre
                       : q.kind == Kind::sample_mask  ? "the covered samples of the invocation"
                       : q.kind == Kind::shading_rate ? rate
                                                      : fmt::format("sample {}", f.id.sample));
}

}  // namespace ref::value
