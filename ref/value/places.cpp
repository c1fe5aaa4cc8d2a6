// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/places.hpp"

#include <algorithm>
#include <cmath>

#include "ref/number/fixed_point.hpp"

namespace ref::value {

namespace {

using cases::Profile;

// Multiples of 1/16 below 2^14: exact in binary64.
struct Spot {
    double x = 0, y = 0;
    friend bool operator==(const Spot&, const Spot&) = default;
};

Spot spot_of(const Fragment& f, uint32_t sample) {
    const FixedPoint p = sample_position(f.id.x, f.id.y, sample, *f.target);
    return {pixels(p.x), pixels(p.y)};
}

void add(std::vector<Spot>& spots, const Spot& spot) {
    if (std::find(spots.begin(), spots.end(), spot) == spots.end()) {
        spots.push_back(spot);
    }
}

// Where the invocations of the fragment may take all their inputs from, besides the centre.
void add_invocations(const Fragment& f, ShadingRate rate, std::vector<Spot>& spots) {
    if (rate != ShadingRate::fragment) {
        add(spots, spot_of(f, f.id.sample));
    }
    if (rate == ShadingRate::some) {
        for (uint32_t s = 0; s < f.target->samples; ++s) {
            add(spots, spot_of(f, s));
        }
    }
}

// Direct3D's centroid, for every coverage that the fragment may have. The fragments of a clipped
// triangle may be those of its pieces, which cover any part of the pixel's samples.
void add_centroids(const Fragment& f, const Spot& centre, std::vector<Spot>& spots) {
    const uint32_t all = (1U << f.target->samples) - 1;
    const uint32_t mask = f.draw->multisample.sample_mask & all;
    if (f.coverage.may == all) {
        add(spots, centre);
        if (f.coverage.is_one_fragment && f.coverage.must == all && mask == all) {
            return;
        }
    }
    for (uint32_t s = 0; s < f.target->samples; ++s) {
        if (((f.coverage.may & mask) >> s & 1U) != 0) {
            add(spots, spot_of(f, s));
        }
        if (f.coverage.is_one_fragment && ((f.coverage.must & mask) >> s & 1U) != 0) {
            return;
        }
    }
}

template <class T>
Point<T> point_of(const Spot& spot) {
    return {T(spot.x), T(spot.y)};
}

template <class T>
std::vector<Point<T>> rectangle(double x0, double y0, double x1, double y1) {
    return {{T(x0), T(y0)}, {T(x1), T(y0)}, {T(x1), T(y1)}, {T(x0), T(y1)}};
}

// Whether the scissor or the target's end cuts the block: nothing says if its centroid then is that
// of what is left.
bool is_cut(const Fragment& f) {
    const cases::PixelBlock& b = f.block;
    const cases::Rect& scissor = f.draw->scissor;
    const auto reaches_beyond = [](int64_t begin, int64_t end, int64_t low, int64_t size) {
        return begin < low || end > low + size;
    };
    return reaches_beyond(b.x, b.x + b.width, 0, f.target->width) ||
           reaches_beyond(b.y, b.y + b.height, 0, f.target->height) ||
           reaches_beyond(b.x, b.x + b.width, scissor.x, scissor.width) ||
           reaches_beyond(b.y, b.y + b.height, scissor.y, scissor.height);
}

// Where a fragment of several pixels may have its centroid at direct3d: at its centre if all of its
// samples may be covered, or some may have been cut off, or there is one a pixel (then nothing says
// that it is elsewhere), or at any that may be. Which of them is the first is not asked: no text of
// Vulkan has that order.
std::vector<Spot> block_centroids(const Fragment& f, const Spot& centre) {
    const cases::PixelBlock& b = f.block;
    const uint32_t samples = f.target->samples;
    const uint64_t all = (uint64_t{1} << (b.width * b.height * samples)) - 1;
    std::vector<Spot> spots;
    if (samples == 1 || f.coverage.may == all || is_cut(f)) {
        spots.push_back(centre);
    }
    for (uint32_t y = b.y; y < b.y + b.height; ++y) {
        for (uint32_t x = b.x; x < b.x + b.width; ++x) {
            for (uint32_t s = 0; s < samples; ++s) {
                const uint32_t j = cases::coverage_index(b, *f.target, {x, y, s});
                if ((f.coverage.may >> j & 1U) != 0 &&
                    (f.draw->multisample.sample_mask >> s & 1U) != 0) {
                    const FixedPoint p = sample_position(x, y, s, *f.target);
                    spots.push_back({pixels(p.x), pixels(p.y)});
                }
            }
        }
    }
    return spots;
}

// The same as evaluations(), of a fragment of several pixels, which has no sample shading.
template <class T>
std::vector<Evaluation<T>> block_evaluations(const Fragment& f, Profile profile) {
    const cases::PixelBlock& b = f.block;
    const Spot centre{b.x + b.width / 2.0, b.y + b.height / 2.0};
    const Spot own = spot_of(f, f.id.sample);
    const Point<T> sample = point_of<T>(own);
    std::vector<Spot> centroid;
    if (has_centroid(*f.draw)) {
        centroid = block_centroids(f, centre);
    }
    if (centroid.empty()) {
        centroid = {own};
    }
    std::vector<Evaluation<T>> all;
    for (const Spot& c : centroid) {
        all.push_back({{point_of<T>(centre)}, {point_of<T>(centre)}, sample, {point_of<T>(c)}, {}});
    }
    if (profile == Profile::direct3d) {
        return all;
    }
    // Anywhere in the block; with one sample a pixel between the samples, of which the centre is
    // one of the places. Of FragCoord.z and w no text says a place: at vulkan anywhere.
    const bool is_single = f.target->samples == 1;
    const double inset = is_single ? 0.5 : 0;
    Evaluation<T> anywhere;
    anywhere.attributes =
        rectangle<T>(b.x + inset, b.y + inset, b.x + b.width - inset, b.y + b.height - inset);
    if (profile == Profile::vulkan) {
        anywhere.frag_coord = rectangle<T>(b.x, b.y, b.x + b.width, b.y + b.height);
    }
    anywhere.sample = sample;
    if (is_single) {  // both sentences hold of it, and the centre may lie outside of the primitive
        anywhere.centroid = rectangle<T>(b.x, b.y, b.x + b.width, b.y + b.height);
    } else {
        for (const Point<mpq_class>& p : f.region) {
            anywhere.centroid.push_back({from_exact<T>(p.x), from_exact<T>(p.y)});
        }
    }
    if (anywhere.centroid.empty()) {
        anywhere.centroid = {sample};
    }
    if (profile == Profile::practice) {
        const auto exact = [&](double by) {
            return rectangle<mpq_class>(b.x + by, b.y + by, b.x + b.width - by,
                                        b.y + b.height - by);
        };
        anywhere.one_point = {exact(inset),
                              is_single ? exact(0)
                              : f.region.empty()
                                  ? std::vector<Point<mpq_class>>{point_of<mpq_class>(own)}
                                  : f.region};
    }
    all.push_back(std::move(anywhere));
    return all;
}

}  // namespace

template <class T>
std::vector<Evaluation<T>> evaluations(const Fragment& f, Profile profile) {
    if (cases::has_large_fragments(*f.draw)) {
        return block_evaluations<T>(f, profile);
    }
    const Spot centre{f.id.x + 0.5, f.id.y + 0.5};
    const Spot own = spot_of(f, f.id.sample);
    const Point<T> sample = point_of<T>(own);
    if (f.target->samples == 1 && centre == own) {
        return {{{sample}, {}, sample, {sample}, {}}};
    }
    const ShadingRate rate = shading_rate(*f.draw, f.target->samples);
    std::vector<Spot> undecorated = {centre};
    std::vector<Spot> centroid;
    if (f.target->samples == 1) {
        undecorated.push_back(own);
        centroid = undecorated;
    } else {
        add_invocations(f, rate, undecorated);
        if (rate == ShadingRate::sample) {
            std::swap(undecorated.front(), undecorated.back());  // the own sample is likelier
        }
        if (has_centroid(*f.draw)) {
            add_centroids(f, centre, centroid);
            add_invocations(f, rate, centroid);
        }
        if (centroid.empty()) {
            centroid = {own};
        }
    }
    // FragCoord.z and w: "not fully specified" under sample shading (Vulkan-Docs issue 1544); those
    // of the centre or of a sample that the invocation may stand for. Direct3D interpolates them at
    // a place, so nothing between is right there; the looser profiles have the hull.
    std::vector<Spot> coords = {centre};
    add(coords, own);
    if (rate == ShadingRate::some) {
        for (uint32_t s = 0; s < f.target->samples; ++s) {
            add(coords, spot_of(f, s));
        }
    }
    std::vector<Point<T>> frag_coord;
    for (const Spot& spot : coords) {
        frag_coord.push_back(point_of<T>(spot));
    }
    std::vector<std::vector<Point<T>>> coord_places = {frag_coord};
    if (profile == Profile::direct3d) {
        if (rate == ShadingRate::sample) {
            std::swap(frag_coord.front(), frag_coord.back());
        }
        coord_places.clear();
        for (const Point<T>& place : frag_coord) {
            coord_places.push_back({place});
        }
    }
    std::vector<Evaluation<T>> all;
    for (const Spot& u : undecorated) {
        for (const Spot& c : centroid) {
            for (const std::vector<Point<T>>& z : coord_places) {
                all.push_back({{point_of<T>(u)}, z, sample, {point_of<T>(c)}, {}});
            }
        }
    }
    if (profile == Profile::direct3d) {
        return all;
    }
    if (f.target->samples == 1) {
        const std::vector<Point<T>> both = {point_of<T>(centre), sample};
        all.push_back({both, {}, sample, both, {}});
        return all;
    }
    // Anywhere: a linear function, and a quotient of two where the denominator stays positive, is
    // largest at a corner. At profile practice one place has to explain all inputs of a fragment
    // that are decorated alike, as every known device has it.
    const double x = f.id.x;
    const double y = f.id.y;
    Evaluation<T> anywhere;
    anywhere.attributes = {{T(x), T(y)}, {T(x + 1), T(y)}, {T(x + 1), T(y + 1)}, {T(x), T(y + 1)}};
    if (profile == Profile::practice) {  // Vulkan's text says nothing of FragCoord.z's place at all
        anywhere.frag_coord = frag_coord;
    }
    anywhere.sample = sample;
    for (const Point<mpq_class>& p : f.region) {
        anywhere.centroid.push_back({from_exact<T>(p.x), from_exact<T>(p.y)});
    }
    if (anywhere.centroid.empty()) {
        anywhere.centroid = {sample};
    }
    if (profile == Profile::practice) {
        const mpq_class low_x(x);
        const mpq_class low_y(y);
        const mpq_class high_x(x + 1);
        const mpq_class high_y(y + 1);
        anywhere.one_point = {
            {{low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}},
            f.region.empty() ? std::vector<Point<mpq_class>>{{mpq_class(own.x), mpq_class(own.y)}}
                             : f.region};
    }
    all.push_back(std::move(anywhere));
    return all;
}

template std::vector<Evaluation<Ball>> evaluations<Ball>(const Fragment&, Profile);
template std::vector<Evaluation<mpq_class>> evaluations<mpq_class>(const Fragment&, Profile);

}  // namespace ref::value
