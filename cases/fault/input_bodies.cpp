// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cases/fault/bodies.hpp"
#include "cases/model/sample.hpp"

namespace cases::fault {

namespace {

template <Interpolation from, Interpolation to>
bool interpolated_as(Attribute& a) {
    return a.source == Source::vertex && replace(a.interpolation, from, to);
}

// An input that is evaluated at each sample makes each sample an invocation of its own.
template <Auxiliary from, Auxiliary to>
bool placed_as(Case& c) {
    return c.target.samples > 1 && any_of(c.draws, [](Draw& d) {
               const bool is_changed = any_of(d.attributes, [](Attribute& a) {
                   return a.source == Source::vertex && a.interpolation != Interpolation::flat &&
                          replace(a.auxiliary, from, to);
               });
               if (is_changed && to == Auxiliary::sample) {
                   d.multisample.min_sample_shading = 1.0F;
               }
               return is_changed;
           });
}

template <ProvokingVertex convention>
bool provoked_by_other(Draw& d) {
    return replace(
        d.provoking, convention,
        convention == ProvokingVertex::first ? ProvokingVertex::last : ProvokingVertex::first);
}

bool forget_division(Draw& d) {
    return any_of(d.attributes, [&](Attribute& a) {
        if (a.interpolation != Interpolation::smooth || a.values.empty()) {
            return false;
        }
        a.interpolation = Interpolation::noperspective;
        for (size_t v = 0; v < a.values.size(); ++v) {
            a.values[v] /= d.positions[v].w;
        }
        return true;
    });
}

template <Probe probe>
bool without_probe(Attribute& a) {
    return replace(a.probe, probe, Probe::value);
}
template <Probe probe>
bool probed_in_corner(Attribute& a) {
    a.probe_offset = a.probe == probe ? std::array{-0.5F, -0.5F} : a.probe_offset;
    return replace(a.probe, probe, Probe::at_offset);
}

// Exchanges the samples of a mask for those in reverse, or for the next each.
bool reverse(uint32_t& mask, uint32_t samples) {
    uint32_t now = 0, reversed = 0;
    for (uint32_t s = 0; s < samples; ++s) {
        const uint32_t bit = mask >> s & 1U;
        now |= bit << s;
        reversed |= bit << (samples - 1 - s);
    }
    mask = reversed;
    return now != reversed;
}
bool rotate_masks(Case& c) {
    for (Draw& d : c.draws) {
        const uint32_t all = (1U << c.target.samples) - 1;
        const uint32_t mask = d.multisample.sample_mask & all;
        d.multisample.sample_mask = mask << 1U | mask >> (c.target.samples - 1);
    }
    return c.target.samples > 1;
}
bool reverse_masks(Case& c) {
    return any_of(c.draws, [&](Draw& d) {
        const bool is_changed = reverse(d.multisample.sample_mask, c.target.samples);
        return (d.multisample.shader_mask &&
                reverse(*d.multisample.shader_mask, c.target.samples)) ||
               is_changed;
    });
}

using Locations = std::vector<std::array<uint8_t, 2>>;  // in 1/16 pixel

// Changes the locations of so many samples or more.
bool locate(Case& c, size_t least, void (*change)(Locations&)) {
    const auto now = sample_locations(c.target);
    const Locations known(now.begin(), now.end());
    Locations changed = known;
    if (changed.size() < least) {
        return false;
    }
    change(changed);
    const bool is_other = changed != known;
    if (is_other) {
        c.target.sample_locations = changed;
    }
    return is_other;
}

bool zero_distances_outside(Draw& d) {
    return any_of(d.distances.clip, [&](glm::vec4& distances) {
        bool is_changed = false;
        for (uint32_t k = 0; k < d.distances.clip_count; ++k) {
            float& distance = distances[static_cast<int>(k)];
            if (std::fpclassify(distance) == FP_ZERO) {
                distance = -1;
                is_changed = true;
            }
        }
        return is_changed;
    });
}

const Body kInputBodies[] = {
    // inputs
    {"attribute-w-one"_fault,
     [](Attribute& a) {
         for (glm::vec4& v : a.values) {
             v.w = 1;
         }
         return a.source == Source::vertex && a.components == 4;
     }},
    {"attributes-of-first-vertex"_fault,
     [](Attribute& a) {
         return any_of(a.values, [&](glm::vec4& v) { return set(v, glm::vec4(a.values.front())); });
     }},
    {"flat-as-noperspective"_fault,
     interpolated_as<Interpolation::flat, Interpolation::noperspective>},
    {"noperspective-as-flat"_fault,
     interpolated_as<Interpolation::noperspective, Interpolation::flat>},
    {"smooth-as-noperspective"_fault,
     interpolated_as<Interpolation::smooth, Interpolation::noperspective>},
    {"division-forgotten"_fault, forget_division},
    {"centroid-at-centre"_fault,
     [](Attribute& a) { return replace(a.auxiliary, Auxiliary::centroid, Auxiliary::none); }},
    {"centroid-as-sample"_fault, placed_as<Auxiliary::centroid, Auxiliary::sample>},
    {"plain-as-centroid"_fault, placed_as<Auxiliary::none, Auxiliary::centroid>},
    {"sample-as-centroid"_fault, placed_as<Auxiliary::sample, Auxiliary::centroid>},
    {"plain-as-sample"_fault, placed_as<Auxiliary::none, Auxiliary::sample>},
    {"offset-ignored"_fault, without_probe<Probe::at_offset>},
    {"at-sample-ignored"_fault, without_probe<Probe::at_sample>},
    {"at-sample-in-corner"_fault, probed_in_corner<Probe::at_sample>},
    {"at-centroid-ignored"_fault, without_probe<Probe::at_centroid>},
    {"at-centroid-in-corner"_fault, probed_in_corner<Probe::at_centroid>},
    {"provoking-last"_fault, provoked_by_other<ProvokingVertex::first>},
    {"provoking-mode-ignored"_fault, provoked_by_other<ProvokingVertex::last>},
    {"provoking-flipped"_fault,
     [](Draw& d) { return exchange(d.provoking, ProvokingVertex::first, ProvokingVertex::last); }},
    // samples
    {"sample-mask-rotated"_fault, rotate_masks},
    {"mask-reversed"_fault, reverse_masks},
    {"sample-masks-ignored"_fault,
     [](Draw& d) {
         const bool is_masked = set(d.multisample.sample_mask, 0xffffffffU);
         return set(d.multisample.shader_mask, std::optional<uint32_t>()) || is_masked;
     }},
    {"sample-shading-always"_fault,
     [](Case& c) {
         return c.target.samples > 1 && any_of(c.draws, [](Draw& d) {
                    return set(d.multisample.min_sample_shading, std::optional<float>(1.0F));
                });
     }},
    {"sample-shading-halved"_fault,
     [](Case& c) {
         return any_of(c.draws, [&](Draw& d) {
             std::optional<float>& least = d.multisample.min_sample_shading;
             const bool is_halved = least && *least > 0 && set(*least, *least / 2);
             if (is_halved && *least * static_cast<float>(c.target.samples) <= 1) {
                 least.reset();  // one invocation a fragment, as without sample shading
             }
             return is_halved;
         });
     }},
    {"samples-one-two-exchanged"_fault,
     [](Case& c) { return locate(c, 4, [](Locations& at) { std::swap(at[1], at[2]); }); }},
    {"sample-three-at-centre"_fault,
     [](Case& c) { return locate(c, 4, [](Locations& at) {
                       at[3] = {8, 8};
                   }); }},
    {"samples-at-centre"_fault,
     [](Case& c) { return locate(c, 1, [](Locations& at) {
                       at.assign(at.size(), {8, 8});
                   }); }},
    {"samples-at-first"_fault,
     [](Case& c) {
         return locate(c, 1, [](Locations& at) { at.assign(at.size(), Locations(at).front()); });
     }},
    // clip and cull distances
    {"clip-distance-culls"_fault,
     [](Draw& d) {
         ClipDistances& x = d.distances;
         const bool has = x.clip_count > 0 && x.cull_count == 0;
         if (has) {
             x = {0, x.clip_count, {}, std::move(x.clip)};
         }
         return has;
     }},
    {"clip-distances-ignored"_fault,
     [](Draw& d) {
         d.distances.clip.clear();
         return set(d.distances.clip_count, 0U);
     }},
    {"distance-zero-outside"_fault, zero_distances_outside},
    {"cull-distance-clips"_fault,
     [](Draw& d) {
         ClipDistances& x = d.distances;
         const bool has = x.cull_count > 0 && x.clip_count == 0;
         if (has) {
             x = {x.cull_count, 0, std::move(x.cull), {}};
         }
         return has;
     }},
    {"cull-distance-negated"_fault,
     [](Draw& d) {
         for (glm::vec4& x : d.distances.cull) {
             x = -x;
         }
         return d.distances.cull_count > 0;
     }},
    {"cull-distance-lost"_fault,
     [](Draw& d) { return d.distances.cull_count > 0 && (--d.distances.cull_count, true); }},
    {"cull-distance-ignored"_fault,
     [](Draw& d) {
         d.distances.cull.clear();
         return set(d.distances.cull_count, 0U);
     }},
};

}  // namespace

std::span<const Body> input_bodies() {
    return kInputBodies;
}

}  // namespace cases::fault
