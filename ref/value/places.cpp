// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/places.hpp"

#include <algorithm>
#include <iterator>

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

// Anywhere in the fragment's pixels, at least `inset` from their borders: a linear function, and a
// quotient of two where the denominator stays positive, is largest at a corner. Centroid inputs lie
// in the primitive, too; with one sample a pixel both sentences of the text hold of them, and the
// centre may lie outside of it. At profile practice one place has to explain all inputs of a
// fragment that are decorated alike, as every known device has it.
template <class T>
Evaluation<T> anywhere_in(const Fragment& f, Profile profile, double inset,
                          const std::vector<Point<T>>& frag_coord) {
    const cases::PixelBlock b = cases::fragment_block(*f.draw, f.id.x, f.id.y);
    const auto inside = [&]<class U>(double by, U) {
        return rectangle<U>(b.x + by, b.y + by, b.x + b.width - by, b.y + b.height - by);
    };
    const Spot own = spot_of(f, f.id.sample);
    const bool is_single = f.target->samples == 1;
    Evaluation<T> out{inside(inset, T{}), frag_coord, point_of<T>(own), {}, {}};
    if (is_single) {
        out.centroid = inside(0, T{});
    }
    for (size_t k = 0; !is_single && k < f.region.size(); ++k) {
        out.centroid.push_back({from_exact<T>(f.region[k].x), from_exact<T>(f.region[k].y)});
    }
    if (out.centroid.empty()) {
        out.centroid = {out.sample};
    }
    if (profile == Profile::practice) {
        out.one_point = {inside(inset, mpq_class()),
                         is_single ? inside(0, mpq_class())
                         : f.region.empty()
                             ? std::vector<Point<mpq_class>>{point_of<mpq_class>(own)}
                             : f.region};
    }
    return out;
}

// As evaluations(), of a fragment of several pixels, which has no sample shading.
template <class T>
std::vector<Evaluation<T>> block_evaluations(const Fragment& f, Profile profile) {
    const cases::PixelBlock& b = f.block;
    const Spot centre{b.x + b.width / 2.0, b.y + b.height / 2.0};
    const Spot own = spot_of(f, f.id.sample);
    std::vector<Spot> centroid;
    if (has_centroid(*f.draw)) {
        centroid = block_centroids(f, centre);
    }
    if (centroid.empty()) {
        centroid = {own};
    }
    std::vector<Evaluation<T>> all;
    for (const Spot& c : centroid) {
        all.push_back(
            {{point_of<T>(centre)}, {point_of<T>(centre)}, point_of<T>(own), {point_of<T>(c)}, {}});
    }
    if (profile == Profile::direct3d) {
        return all;
    }
    // With one sample a pixel between the samples, of which the centre is one of the places. Of
    // FragCoord.z and w no text says a place: at vulkan anywhere.
    const double inset = f.target->samples == 1 ? 0.5 : 0;
    std::vector<Point<T>> frag_coord;
    if (profile == Profile::vulkan) {
        frag_coord = rectangle<T>(b.x, b.y, b.x + b.width, b.y + b.height);
    }
    all.push_back(anywhere_in<T>(f, profile, inset, frag_coord));
    return all;
}

// FragCoord.z and w: "not fully specified" under sample shading (Vulkan-Docs issue 1544); those of
// the centre or of a sample that the invocation may stand for. Direct3D interpolates them at a
// place, so nothing between is right there; the looser profiles have the hull.
template <class T>
std::vector<Point<T>> coord_places(const Fragment& f, const Spot& centre, ShadingRate rate) {
    std::vector<Spot> spots = {centre};
    add(spots, spot_of(f, f.id.sample));
    for (uint32_t s = 0; rate == ShadingRate::some && s < f.target->samples; ++s) {
        add(spots, spot_of(f, s));
    }
    std::vector<Point<T>> out;
    std::ranges::transform(spots, std::back_inserter(out), point_of<T>);
    return out;
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
    std::vector<Point<T>> frag_coord = coord_places<T>(f, centre, rate);
    std::vector<std::vector<Point<T>>> alternatives = {frag_coord};
    if (profile == Profile::direct3d) {
        if (rate == ShadingRate::sample) {
            std::swap(frag_coord.front(), frag_coord.back());
        }
        alternatives.clear();
        for (const Point<T>& place : frag_coord) {
            alternatives.push_back({place});
        }
    }
    std::vector<Evaluation<T>> all;
    for (const Spot& u : undecorated) {
        for (const Spot& c : centroid) {
            for (const std::vector<Point<T>>& z : alternatives) {
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
    // Vulkan's text says nothing of FragCoord.z's place at all.
    all.push_back(anywhere_in<T>(
        f, profile, 0, profile == Profile::practice ? frag_coord : std::vector<Point<T>>()));
    return all;
}

template std::vector<Evaluation<Ball>> evaluations<Ball>(const Fragment&, Profile);
template std::vector<Evaluation<mpq_class>> evaluations<mpq_class>(const Fragment&, Profile);

}  // namespace ref::value
