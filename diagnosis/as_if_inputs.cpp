// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "cases/model/sample.hpp"
#include "diagnosis/as_if.hpp"

namespace diagnosis::as_if {

namespace {

using cases::Interpolation;

bool each_attribute(Case& c, bool (*change)(cases::Attribute&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        for (cases::Attribute& a : d.attributes) {
            is_changed = (a.source == cases::Source::vertex && change(a)) || is_changed;
        }
    }
    return is_changed;
}

template <Interpolation from, Interpolation to>
bool interpolated_as(Case& c) {
    return each_attribute(
        c, [](cases::Attribute& a) { return a.interpolation == from && set(a.interpolation, to); });
}

// An input that is evaluated at each sample makes each sample an invocation of its own.
template <cases::Auxiliary from, cases::Auxiliary to>
bool placed_as(Case& c) {
    return c.target.samples > 1 && each(c, [](Draw& d) {
               bool is_changed = false;
               for (cases::Attribute& a : d.attributes) {
                   is_changed = (a.source == cases::Source::vertex && a.auxiliary == from &&
                                 a.interpolation != Interpolation::flat && set(a.auxiliary, to)) ||
                                is_changed;
               }
               if (is_changed && to == cases::Auxiliary::sample) {
                   d.multisample.min_sample_shading = 1.0F;
               }
               return is_changed;
           });
}

// Changes the locations of four samples or more, in 1/16 pixel.
bool with_locations(Case& c, void (*change)(std::vector<std::array<uint8_t, 2>>&)) {
    const auto known = cases::sample_locations(c.target);
    std::vector<std::array<uint8_t, 2>> changed(known.begin(), known.end());
    if (changed.size() < 4) {
        return false;
    }
    change(changed);
    return set(c.target.sample_locations, changed);
}

const Row kInputsRows[] = {
    // inputs
    {"attribute-w-one", "The fourth component of attributes is read as 1",
     [](Case& c) {
         return each_attribute(c, [](cases::Attribute& a) {
             for (glm::vec4& v : a.values) {
                 v.w = 1;
             }
             return a.components == 4;
         });
     }},
    {"flat-as-noperspective", "Flat inputs are interpolated without perspective",
     interpolated_as<Interpolation::flat, Interpolation::noperspective>},
    {"noperspective-as-flat", "Inputs without perspective are flat",
     interpolated_as<Interpolation::noperspective, Interpolation::flat>},
    {"smooth-as-noperspective", "Smooth inputs are interpolated without perspective",
     interpolated_as<Interpolation::smooth, Interpolation::noperspective>},
    {"centroid-as-sample", "Centroid inputs are evaluated at each sample",
     placed_as<cases::Auxiliary::centroid, cases::Auxiliary::sample>},
    {"plain-as-centroid", "Plain inputs are evaluated at the centroid",
     placed_as<cases::Auxiliary::none, cases::Auxiliary::centroid>},
    {"sample-as-centroid", "Sample inputs are evaluated at the centroid",
     placed_as<cases::Auxiliary::sample, cases::Auxiliary::centroid>},
    {"plain-as-sample", "Plain inputs are evaluated at each sample",
     placed_as<cases::Auxiliary::none, cases::Auxiliary::sample>},
    {"sample-mask-rotated", "The bits of the sample mask belong to the next sample each",
     [](Case& c) {
         for (Draw& d : c.draws) {
             const uint32_t all = (1U << c.target.samples) - 1;
             const uint32_t mask = d.multisample.sample_mask & all;
             d.multisample.sample_mask = mask << 1U | mask >> (c.target.samples - 1);
         }
         return c.target.samples > 1;
     }},
    {"sample-shading-always", "Every sample is shaded by itself",
     [](Case& c) {
         return c.target.samples > 1 && each(c, [](Draw& d) {
                    return set(d.multisample.min_sample_shading, std::optional<float>(1.0F));
                });
     }},
    {"sample-shading-halved", "The least part of samples to be shaded counts half",
     [](Case& c) {
         return each(c, [](Draw& d) {
             std::optional<float>& least = d.multisample.min_sample_shading;
             return least && *least > 0 && set(*least, *least / 2);
         });
     }},
    {"samples-one-two-exchanged", "Samples 1 and 2 of a pixel are exchanged",
     [](Case& c) { return with_locations(c, [](auto& at) { std::swap(at[1], at[2]); }); }},
    {"sample-three-at-centre", "Sample 3 lies at the centre of its pixel",
     [](Case& c) { return with_locations(c, [](auto& at) {
                       at[3] = {8, 8};
                   }); }},
    // clip and cull distances
    {"clip-distance-culls", "Clip distances cull whole triangles",
     [](Case& c) {
         return each(c, [](Draw& d) {
             cases::ClipDistances& x = d.distances;
             const bool has = x.clip_count > 0 && x.cull_count == 0;
             if (has) {
                 x = {0, x.clip_count, {}, std::move(x.clip)};
             }
             return has;
         });
     }},
    {"cull-distance-clips", "Cull distances clip",
     [](Case& c) {
         return each(c, [](Draw& d) {
             cases::ClipDistances& x = d.distances;
             const bool has = x.cull_count > 0 && x.clip_count == 0;
             if (has) {
                 x = {x.cull_count, 0, std::move(x.cull), {}};
             }
             return has;
         });
     }},
    {"cull-distance-negated", "Cull distances cull the other side",
     [](Case& c) {
         return each(c, [](Draw& d) {
             for (glm::vec4& x : d.distances.cull) {
                 x = -x;
             }
             return d.distances.cull_count > 0;
         });
     }},
    {"cull-distance-lost", "The last cull distance culls nothing",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return d.distances.cull_count > 0 && (--d.distances.cull_count, true);
         });
     }},
};

}  // namespace

std::span<const Row> input_rows() {
    return kInputsRows;
}

}  // namespace diagnosis::as_if
