// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "cases/model/sample.hpp"
#include "ref/position/clip.hpp"
#include "ref/value/fragment/shading_rate.hpp"

namespace ref {

using cases::Draw;
using cases::Profile;
using cases::Query;
using cases::Topology;

namespace {

// What a draw hands to the input assembly, which does "the set of primitives ... once for each
// instance" [Vulkan specification, "Programmable Primitive Shading"].
struct Assembly {
    uint64_t vertices = 0;    // of complete primitives,
    uint64_t distinct = 0;    // each once,
    uint64_t leftover = 0;    // and of incomplete ones
    uint64_t restarts = 0;    // indices that restart
    uint64_t primitives = 0;  // complete ones
    uint64_t incomplete = 0;
};

Assembly assembly_of(const Draw& draw) {
    Assembly out;
    std::vector<uint32_t> all(draw.vertex_count());
    std::iota(all.begin(), all.end(), 0U);
    all = draw.indices.value_or(all);
    std::set<uint32_t> distinct;
    const bool is_list = draw.topology == Topology::triangle_list;
    const auto add_piece = [&](std::span<const uint32_t> piece) {
        const size_t n = piece.size();
        const size_t used = is_list ? n - n % 3 : n < 3 ? 0 : n;
        out.vertices += used;
        out.leftover += n - used;
        out.primitives += is_list ? used / 3 : used < 3 ? 0 : used - 2;
        out.incomplete += n > used ? 1 : 0;
        distinct.insert(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(used));
    };
    size_t begin = 0;
    for (size_t k = 0; k < all.size(); ++k) {
        if (draw.primitive_restart && draw.indices && all[k] == cases::kRestartIndex) {
            add_piece(std::span(all).subspan(begin, k - begin));
            begin = k + 1;
            ++out.restarts;
        }
    }
    add_piece(std::span(all).subspan(begin));
    out.distinct = distinct.size();
    for (uint64_t* count : {&out.vertices, &out.distinct, &out.leftover, &out.restarts,
                            &out.primitives, &out.incomplete}) {
        *count *= draw.instances;
    }
    return out;
}

// Of one triangle and the clip volume.
struct Clipped {
    bool is_inside = false;        // as a whole
    bool has_vertex = false;       // a vertex lies inside, and on no plane
    bool is_beyond_depth = false;  // all of it lies beyond a depth plane
    uint64_t planes = 0;           // that may cut it
    bool is_known = true;          // its positions are numbers
};

Clipped clipped_of(const Draw& draw, const cases::Triangle& triangle) {
    const ClipInput input(draw, triangle.vertex);
    const ClipVolume volume = clip_volume_of(draw);
    Clipped out;
    out.is_inside = true;
    std::array<bool, 3> is_within{true, true, true};
    for (const glm::vec4& at : input.clip) {
        for (int k = 0; k < 4; ++k) {
            out.is_known = out.is_known && std::isfinite(at[k]);
        }
    }
    for (const ClipPlane plane : volume.all()) {
        size_t outside = 0;
        for (size_t v = 0; v < 3; ++v) {
            const PlaneSide side = plane_side(input, v, plane);
            outside += side.value < side.bound ? 1 : 0;
            is_within.at(v) = is_within.at(v) && side.value > side.bound;
        }
        const auto depth = volume.depth();
        const bool is_depth = std::find(depth.begin(), depth.end(), plane) != depth.end();
        out.is_beyond_depth = out.is_beyond_depth || (is_depth && outside == 3);
        out.planes += outside > 0 ? 1 : 0;
        out.is_inside = out.is_inside && outside == 0;
    }
    for (size_t v = 0; v < 3; ++v) {
        const bool is_before = input.clip.at(v).w > 0;
        out.has_vertex = out.has_vertex || (is_within.at(v) && is_before);
        out.is_inside = out.is_inside && is_before;
        out.planes += is_before ? 0 : 1;
    }
    return out;
}

// Where a vertex lies, for bounds that need not be tight.
std::array<double, 2> pixel_of(const Draw& draw, uint32_t vertex) {
    const glm::vec4& at = draw.positions[vertex];
    const cases::Viewport& v = draw.viewport;
    const auto w = static_cast<double>(at.w);
    return {static_cast<double>(v.x) +
                (static_cast<double>(at.x) / w + 1) / 2 * static_cast<double>(v.width),
            static_cast<double>(v.y) +
                (static_cast<double>(at.y) / w + 1) / 2 * static_cast<double>(v.height)};
}

// Whether the centre of some pixel must lie in a triangle before the eye, however its corners are
// snapped: that of every disc with radius sqrt(1/2) does. With four subpixel bits a corner moves by
// up to 1/16 each way, which takes 0.089 of the incircle's radius.
bool has_area(const Draw& draw, const cases::Triangle& t) {
    std::array<std::array<double, 2>, 3> at{};
    std::ranges::transform(t.vertex, at.begin(), [&](uint32_t v) { return pixel_of(draw, v); });
    double perimeter = 0;
    double area = 0;  // twice that
    for (size_t k = 0; k < 3; ++k) {
        const auto& [x0, y0] = at.at(k);
        const auto& [x1, y1] = at.at((k + 1) % 3);
        perimeter += std::hypot(x1 - x0, y1 - y0);
        area += x0 * y1 - x1 * y0;
    }
    return std::fabs(area) > 0.8 * perimeter;  // which times the incircle's radius it is
}

// Whether a viewport lies on whole pixels, where no device moves it.
bool is_whole(const cases::Viewport& v) {
    return std::ranges::all_of(std::array{v.x, v.y, v.width, v.height},
                               [](float f) { return std::equal_to<>()(std::floor(f), f); });
}

// Whether a triangle in the clip volume must cover a sample by its place alone, whatever else is
// drawn.
bool has_sample(const Draw& draw, const cases::Triangle& t, const cases::Target& target) {
    const double x0 = std::max<double>(draw.scissor.x, 0);
    const double y0 = std::max<double>(draw.scissor.y, 0);
    const double x1 = std::min(static_cast<double>(draw.scissor.x) + draw.scissor.width,
                               static_cast<double>(target.width));
    const double y1 = std::min(static_cast<double>(draw.scissor.y) + draw.scissor.height,
                               static_cast<double>(target.height));
    const bool has_centre = target.samples == 1 && target.sample_locations.empty() &&
                            draw.multisample.sample_mask % 2 == 1;
    return has_centre && draw.cull == cases::CullMode::none &&
           draw.conservative == cases::Conservative::none && is_whole(draw.viewport) &&
           has_area(draw, t) && std::ranges::all_of(t.vertex, [&](uint32_t v) {
               const auto at = pixel_of(draw, v);
               return at[0] >= x0 && at[0] <= x1 && at[1] >= y0 && at[1] <= y1;
           });
}

// A triangle of the draw that asks.
struct Asked {
    const cases::Triangle* triangle = nullptr;
    Clipped clipped;
    // It must cover a sample: it alone may have written one that is hit, or, from practice on (at
    // vulkan errors grow with the target), it has one by its place.
    bool covers = false;
};

std::vector<Asked> asked_triangles(const Draw& draw, size_t number, const Expectation& e) {
    std::vector<Asked> out;
    std::vector<size_t> of_triangle(e.triangles.size(), SIZE_MAX);
    for (size_t t = 0; t < e.triangles.size(); ++t) {
        if (e.triangles[t].draw != number) {
            continue;
        }
        of_triangle[t] = out.size();
        Asked& asked = out.emplace_back(Asked{&e.triangles[t], clipped_of(draw, e.triangles[t])});
        asked.covers = e.profile != Profile::vulkan && draw.distances.cull_count == 0 &&
                       asked.clipped.is_known && asked.clipped.is_inside &&
                       has_sample(draw, e.triangles[t], e.target);
    }
    for (size_t index = 0; index < e.samples.size(); ++index) {
        const SampleExpectation& sample = e.samples[index];
        if (sample.hits.total_min > 0 && sample.writers_count == 1) {
            const size_t k = of_triangle[e.writers_of(sample).front()];
            if (k != SIZE_MAX) {
                out[k].covers = true;
            }
        }
    }
    return out;
}

uint64_t covering(const Draw& draw, size_t number, const Expectation& expectation) {
    const std::vector<Asked> asked = asked_triangles(draw, number, expectation);
    return static_cast<uint64_t>(std::ranges::count_if(asked, &Asked::covers));
}

CountBounds clipping_primitives(const Draw& draw, size_t number, const Assembly& assembly,
                                const Expectation& expectation) {
    const bool is_direct3d = expectation.profile == Profile::direct3d;
    CountBounds out{0, assembly.incomplete};
    for (const Asked& asked : asked_triangles(draw, number, expectation)) {
        const Clipped& clipped = asked.clipped;
        if (!clipped.is_known) {
            out.most = kNoMost;
            continue;
        }
        const bool is_whole = is_direct3d && clipped.is_inside && draw.distances.cull_count == 0 &&
                              has_area(draw, *asked.triangle);
        out.least += is_whole || (clipped.has_vertex && asked.covers) ? 1U : 0U;
        out.most += out.most == kNoMost       ? 0
                    : clipped.is_inside       ? 1
                    : clipped.is_beyond_depth ? 0
                                              : 1 + clipped.planes;
    }
    out.least = draw.rasterizer_discard ? 0 : out.least;
    return out;
}

// The quads of pixels that a draw's fragments may lie in, or no bound: primitive by primitive those
// of the rectangle around it, or of the scissor, for each piece that clipping may make of it.
// Pieces share quads along their common sides.
std::optional<uint64_t> quads_of(const Draw& draw, size_t number, const Expectation& expectation) {
    const cases::Target& target = expectation.target;
    const auto quads = [](double low, double high) {
        return high > low ? std::ceil(high / 2) - std::floor(low / 2) : 0.0;
    };
    const double x0 = draw.scissor.x;
    const double y0 = draw.scissor.y;
    const double x1 = std::min(x0 + draw.scissor.width, static_cast<double>(target.width));
    const double y1 = std::min(y0 + draw.scissor.height, static_cast<double>(target.height));
    double out = 0;
    for (const cases::Triangle& t : expectation.triangles) {
        if (t.draw != number) {
            continue;
        }
        const Clipped clipped = clipped_of(draw, t);
        if (!clipped.is_known) {
            return std::nullopt;
        }
        std::array<double, 4> box{x0, y0, x1, y1};
        const bool is_bounded =
            draw.conservative == cases::Conservative::none &&
            std::ranges::all_of(t.vertex, [&](uint32_t v) {
                const auto at = pixel_of(draw, v);
                return draw.positions[v].w > 0 && std::isfinite(at[0]) && std::isfinite(at[1]);
            });
        if (is_bounded) {
            std::array<double, 4> own{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
            for (const uint32_t v : t.vertex) {
                const auto at = pixel_of(draw, v);
                own = {std::min(own[0], at[0] - 1), std::min(own[1], at[1] - 1),
                       std::max(own[2], at[0] + 1), std::max(own[3], at[1] + 1)};
            }
            box = {std::max(x0, std::floor(own[0])), std::max(y0, std::floor(own[1])),
                   std::min(x1, std::ceil(own[2])), std::min(y1, std::ceil(own[3]))};
        }
        out +=
            static_cast<double>(1 + clipped.planes) * quads(box[0], box[2]) * quads(box[1], box[3]);
    }
    return static_cast<uint64_t>(out);
}

CountBounds fragment_invocations(const cases::Case& c, size_t number,
                                 const Expectation& expectation, const ShownAt& shown) {
    const Draw& draw = c.draws[number];
    const uint32_t samples = c.target.samples;
    const bool is_vulkan = expectation.profile == Profile::vulkan;
    const bool is_by_sample =
        !is_vulkan && value::shading_rate(draw, samples) == value::ShadingRate::sample;
    CountBounds out{0, kNoMost};
    uint64_t of_pixel = 0;
    for (size_t index = 0; index < expectation.samples.size(); ++index) {
        const ShownSample here = shown ? shown(index) : ShownSample{};
        // What the device shows wrong is a finding of its own.
        const uint64_t of_sample =
            here.is_right
                ? passed_at(expectation, c, index, static_cast<uint32_t>(number), here, !is_vulkan)
                      .least
                : 0;
        of_pixel = is_by_sample ? of_pixel + of_sample : std::max(of_pixel, of_sample);
        if ((index + 1) % samples == 0) {
            out.least += of_pixel;
            of_pixel = 0;
        }
    }
    if (expectation.profile == Profile::direct3d && !draw.rasterizer_discard) {
        const bool is_split = value::shading_rate(draw, samples) != value::ShadingRate::fragment;
        if (const auto quads = quads_of(draw, number, expectation)) {
            out.most = 4 * *quads * (is_split ? samples : 1);
        }
    }
    return out;
}

}  // namespace

CountBounds statistic_bounds(const cases::Case& c, size_t draw, const Expectation& expectation,
                             const ShownAt& shown) {
    const Draw& d = c.draws[draw];
    const Assembly a = assembly_of(d);
    const bool is_direct3d = expectation.profile == Profile::direct3d;
    CountBounds out;
    switch (d.query) {
        case Query::none:
        case Query::occlusion:
        case Query::occlusion_precise:
            break;
        case Query::input_vertices:
            out.least = is_direct3d || !d.indices ? a.vertices : a.distinct;
            out.most =
                std::max(a.vertices, d.topology == Topology::triangle_fan ? 3 * a.primitives : 0) +
                a.leftover + a.restarts;
            break;
        case Query::input_primitives:
            out = {a.primitives, a.primitives + a.incomplete};
            break;
        case Query::vertex_invocations:
            out = {a.distinct, 3 * a.primitives + a.leftover};
            break;
        case Query::clipping_invocations:
            out = {d.rasterizer_discard ? 0
                   : is_direct3d        ? a.primitives
                                        : covering(d, draw, expectation),
                   a.primitives + a.incomplete};
            break;
        case Query::clipping_primitives:
            out = clipping_primitives(d, draw, a, expectation);
            break;
        case Query::fragment_invocations:
            out = fragment_invocations(c, draw, expectation, shown);
            break;
    }
    out.most = is_direct3d ? out.most : kNoMost;
    return out;
}

std::vector<CountBounds> query_bounds(const cases::Case& c, const Expectation& expectation,
                                      const ShownAt& shown) {
    std::vector<CountBounds> out = count_bounds(expectation, c, shown);
    for (size_t k = 0; k < c.draws.size(); ++k) {
        if (cases::is_statistic(c.draws[k].query)) {
            out[k] = statistic_bounds(c, k, expectation, shown);
        }
    }
    return out;
}

}  // namespace ref
