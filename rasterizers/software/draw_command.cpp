// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/draw_command.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rasterizers/software/area_test.hpp"

namespace software {

namespace {

// Where a draw's fragments may land.
PixelRect draw_rect(const cases::Draw& draw, const cases::Target& target, const Device& device) {
    PixelRect rect{draw.scissor.x, draw.scissor.y,
                   int64_t{draw.scissor.x} + int64_t{draw.scissor.width},
                   int64_t{draw.scissor.y} + int64_t{draw.scissor.height}};
    switch (device.fault) {
        case "scissor-closed"_fault:
            rect.x1 += 1;
            rect.y1 += 1;
            break;
        case "scissor-off-by-one"_fault:
            rect.x0 += rect.x0 > 0 ? 1 : 0;
            rect.y0 += rect.y0 > 0 ? 1 : 0;
            break;
        case "scissor-ignored"_fault:
            rect = {0, 0, int64_t{target.width}, int64_t{target.height}};
            break;
        case "scissor-half-early"_fault:  // cover() leaves out the samples farther away
            rect.x0 -= target.samples > 1 ? 1 : 0;
            rect.y0 -= target.samples > 1 ? 1 : 0;
            break;
        case "scissor-closed-odd"_fault:
            rect.y1 += target.width % 2;
            break;
        case "scissor-follows-viewport"_fault: {
            const auto dx = static_cast<int64_t>(draw.viewport.x);
            const auto dy = static_cast<int64_t>(draw.viewport.y);
            rect = {rect.x0 + dx, rect.y0 + dy, rect.x1 + dx, rect.y1 + dy};
            break;
        }
        default:
            break;
    }
    return {std::max<int64_t>(rect.x0, 0), std::max<int64_t>(rect.y0, 0),
            std::min<int64_t>(rect.x1, target.width), std::min<int64_t>(rect.y1, target.height)};
}

// The draw with the state that the device has in mind.
// A bound of a viewport on the device's grid, halves up.
double on_grid(double bound, int bits) {
    return std::ldexp(std::floor(std::ldexp(bound, bits) + 0.5), -bits);
}

void keep_on_grid(float& origin, float& extent, int bits) {
    const double low = on_grid(double{origin}, bits);
    const double high = on_grid(double{origin} + double{extent}, bits);
    origin = static_cast<float>(low);
    extent = static_cast<float>(high - low);
}

cases::Draw effective(const cases::Case& c, uint32_t number, const Device& device) {
    const Fault fault = device.fault;
    cases::Draw draw = c.draws[number];
    if (fault == "state-of-first-draw"_fault) {
        const cases::Draw& first = c.draws[0];
        draw.viewport = first.viewport;
        draw.scissor = first.scissor;
        draw.cull = first.cull;
        draw.front_face = first.front_face;
    }
    if (fault == "conservative-ignored"_fault) {
        draw.conservative = cases::Conservative::none;
    } else if (fault == "conservative-of-first-draw"_fault) {
        draw.conservative = c.draws[0].conservative;
        draw.conservative_extra = c.draws[0].conservative_extra;
    } else if (fault == "underestimate-enlarges"_fault &&
               draw.conservative == cases::Conservative::underestimate) {
        draw.conservative = cases::Conservative::overestimate;
    }
    if (fault == "fragment-size-ignored"_fault) {
        draw.fragment_size = {1, 1};
    } else if (fault == "fragment-size-exchanged"_fault) {
        std::swap(draw.fragment_size[0], draw.fragment_size[1]);
    } else if (fault == "fragment-size-of-first-draw"_fault) {
        draw.fragment_size = c.draws[0].fragment_size;
    }
    if (fault == "layer-of-first-draw"_fault) {
        draw.layer = c.draws[0].layer;
    }
    if (fault == "viewport-rounded"_fault) {
        draw.viewport.x = std::round(draw.viewport.x);
        draw.viewport.y = std::round(draw.viewport.y);
        draw.viewport.width = std::round(draw.viewport.width);
        draw.viewport.height = std::round(draw.viewport.height);
    }
    if (device.keeps_viewport_grid) {
        keep_on_grid(draw.viewport.x, draw.viewport.width, device.viewport_bits);
        keep_on_grid(draw.viewport.y, draw.viewport.height, device.viewport_bits);
    }
    return draw;
}

}  // namespace

DrawCommand::DrawCommand(const cases::Case& c, uint32_t number, const Device& device,
                         capture::Capture& out, Attachments& attachments)
    : draw_(effective(c, number, device)),
      number_(number),
      device_(device),
      out_(out),
      attachments_(attachments),
      rect_(draw_rect(draw_, c.target, device)),
      vertices_(draw_, device),
      fragments_(draw_, c, number, device, rect_, out, attachments) {}

void DrawCommand::run() {
    const std::vector<Primitive> primitives = assemble_primitives(draw_, device_.fault);
    count_assembled(draw_, number_, primitives, device_, attachments_.queries);
    if (draw_.rasterizer_discard && device_.fault != "discard-ignored"_fault) {
        return;
    }
    for (const Primitive& primitive : primitives) {
        const int times = device_.fault == "draw-doubled"_fault ? 2 : 1;
        for (int k = 0; k < times; ++k) {
            rasterize(primitive);
        }
    }
}

void DrawCommand::rasterize(const Primitive& primitive) {
    const bool counts_late = device_.fault == "statistics-without-culled"_fault;
    if (!counts_late) {
        attachments_.queries.add(number_, cases::Query::clipping_invocations, 1);
    }
    if (vertices_.is_distance_culled(primitive)) {
        ++culled_;
        return;
    }
    const std::array<ClipVertex, 3> triangle = vertices_.triangle_of(primitive);
    const ClippedPolygon clipped = clip_triangle(triangle, draw_, device_);
    attachments_.queries.count_clipped(number_, clipped.vertices.size(), clipped.was_cut);
    std::vector<WindowVertex> window;
    for (const ClipVertex& v : clipped.vertices) {
        if (!(v.position.w > 0) && device_.fault != "clip-none"_fault) {
            return;  // inside the volume w = 0 is a single point
        }
        window.push_back(vertices_.project(v));
    }
    if (window.size() >= 3) {
        rasterize_polygon(primitive, triangle, std::move(window), clipped);
    }
}

Facet DrawCommand::facet_of(const Primitive& primitive, const WindowVertex& first,
                            const std::vector<WindowVertex>& polygon,
                            const ClippedPolygon& clipped) const {
    float largest_z = 0;
    for (const WindowVertex& v : polygon) {
        largest_z = std::max(largest_z, std::fabs(v.z));
    }
    const bool skips = device_.fault == "primitive-id-skips-culled"_fault;
    return {primitive,
            first,
            false,
            largest_z,
            clipped.tests_depth,
            skips ? primitive.id - culled_ : primitive.id};
}

// What a degenerate triangle covers if its edges are taken as inclusive.
void DrawCommand::rasterize_line(const Facet& facet, const std::vector<WindowVertex>& v) {
    Device inclusive = device_;
    inclusive.fault = "ties-all-inclusive"_fault;
    std::array<WindowVertex, 3> wide{v[0], v[1], v[2]};
    for (size_t k = 0; k < 3; ++k) {  // planes need an area
        wide[k].x += k == 1 ? 1.0F : 0.0F;
        wide[k].y += k == 2 ? 1.0F : 0.0F;
    }
    const TrianglePlanes planes(wide, true, draw_, device_);
    scan({{v[0], v[1], v[2]}, {}, false}, rect_, fragments_.samples(), inclusive,
         [&](int64_t i, int64_t j, uint32_t s) { fragments_.cover(facet, planes, i, j, s); });
    fragments_.shade_covered(facet);
}

// The planes of the largest piece inside the viewport; nothing if none is left there.
std::unique_ptr<TrianglePlanes> DrawCommand::planes_in_viewport(
    const std::array<ClipVertex, 3>& whole, bool positive) const {
    Device geometric = device_;
    geometric.clip = ClipMethod::geometric;
    const ClippedPolygon inner = clip_triangle(whole, draw_, geometric);
    std::array<WindowVertex, 3> best;
    int64_t best_area = 0;
    for (size_t k = 1; k + 1 < inner.vertices.size(); ++k) {
        const std::array<WindowVertex, 3> piece{vertices_.project(inner.vertices[0]),
                                                vertices_.project(inner.vertices[k]),
                                                vertices_.project(inner.vertices[k + 1])};
        const int64_t area = positive ? twice_area(piece) : -twice_area(piece);
        if (area > best_area) {
            best_area = area;
            best = piece;
        }
    }
    if (best_area == 0) {
        return nullptr;
    }
    return std::make_unique<TrianglePlanes>(best, positive, draw_, device_);
}

std::unique_ptr<TrianglePlanes> DrawCommand::common_planes(const std::array<ClipVertex, 3>& whole,
                                                           const ClippedPolygon& clipped,
                                                           bool positive) {
    if (!clipped.was_cut) {
        return nullptr;
    }
    std::array<WindowVertex, 3> window;
    bool is_projectable = true;  // binary32 holds the snapped positions
    for (size_t k = 0; k < 3; ++k) {
        window[k] = vertices_.project(whole[k]);
        is_projectable = is_projectable && whole[k].position.w > 0 &&
                         std::fabs(window[k].x) < 0x1p15F && std::fabs(window[k].y) < 0x1p15F;
    }
    if (is_projectable && !device_.piece_planes) {
        return std::make_unique<TrianglePlanes>(window, positive, draw_, device_);
    }
    // A guard band's cuts are too far away for planes in binary32: those are set up in the
    // viewport.
    return device_.clip == ClipMethod::guard_band ? planes_in_viewport(whole, positive) : nullptr;
}

namespace {

// Whether a polygon is smaller than a pixel.
bool is_small(const std::vector<WindowVertex>& polygon, int subpixel_bits) {
    const auto [x0, x1] = std::ranges::minmax(polygon, {}, &WindowVertex::sx);
    const auto [y0, y1] = std::ranges::minmax(polygon, {}, &WindowVertex::sy);
    const int64_t pixel = int64_t{1} << subpixel_bits;
    return x1.sx - x0.sx < pixel && y1.sy - y0.sy < pixel;
}

}  // namespace

void DrawCommand::rasterize_polygon(const Primitive& primitive,
                                    const std::array<ClipVertex, 3>& whole,
                                    std::vector<WindowVertex> polygon,
                                    const ClippedPolygon& clipped) {
    const WindowVertex first = polygon[0];
    Facet facet = facet_of(primitive, first, polygon, clipped);
    if (device_.fault == "clip-last-piece-lost"_fault && polygon.size() > 3) {
        polygon.pop_back();
    }
    const int64_t area = twice_area(polygon);
    const bool is_conservative = draw_.conservative != cases::Conservative::none;
    if (area == 0 && is_conservative) {
        cover_degenerate(primitive, polygon, clipped);
        return;
    }
    const int unsnapped = device_.facing_unsnapped ? unsnapped_sign(polygon) : 0;
    facet.front = vertices_.is_front(unsnapped != 0 && area != 0 ? unsnapped : area, whole);
    if (area == 0) {
        if (device_.fault == "degenerate-drawn"_fault && polygon.size() == 3 &&
            !vertices_.is_culled(facet.front)) {
            rasterize_line(facet, polygon);
        }
        return;
    }
    if (device_.fault == "small-culled"_fault && is_small(polygon, device_.subpixel_bits)) {
        return;
    }
    if (vertices_.is_culled(facet.front)) {
        ++culled_;
        return;
    }
    if (device_.fault == "statistics-without-culled"_fault) {
        attachments_.queries.add(number_, cases::Query::clipping_invocations, 1);
    }
    const std::unique_ptr<TrianglePlanes> common = common_planes(whole, clipped, area > 0);
    const bool keeps_planes = device_.fault == "planes-of-last"_fault;
    if (keeps_planes && cached_source_ != first.source) {
        cached_planes_.reset();
        cached_source_ = first.source;
    }
    Pieces pieces(std::move(polygon), common.get(), keeps_planes ? &cached_planes_ : nullptr, draw_,
                  device_);
    if (is_conservative) {
        cover_areas(facet, pieces);
    } else if (pieces.count() == 1 || device_.fault == "clip-diagonal-double"_fault) {
        cover_pieces(facet, pieces);
    } else {
        cover_by_winding(facet, pieces);
    }
}

void DrawCommand::cover_pieces(const Facet& facet, Pieces& pieces) {
    for (size_t k = 0; k < pieces.count(); ++k) {
        const ScanTriangle t = pieces.triangle(k);
        if (twice_area(t.v) > 0) {
            scan(t, rect_, fragments_.samples(), device_, [&](int64_t i, int64_t j, uint32_t s) {
                fragments_.cover(facet, pieces.planes(k), i, j, s);
            });
        }
    }
    fragments_.shade_covered(facet);
}

// Snapping can bend a clipped polygon, so that pieces fold over. The winding number counts each
// sample once all the same.
void DrawCommand::cover_by_winding(const Facet& facet, Pieces& pieces) {
    const size_t samples = fragments_.samples().size();
    PixelRect box = box_of(pieces.polygon(), device_.subpixel_bits);
    box = {std::max(box.x0, rect_.x0), std::max(box.y0, rect_.y0), std::min(box.x1, rect_.x1),
           std::min(box.y1, rect_.y1)};
    if (device_.fault == "draws-everything"_fault) {
        box = rect_;
    }
    const auto width = static_cast<size_t>(std::max<int64_t>(box.x1 - box.x0, 0));
    const auto height = static_cast<size_t>(std::max<int64_t>(box.y1 - box.y0, 0));
    struct Cell {
        int8_t winding = 0;
        int8_t piece = -1;
    };
    std::vector<Cell> cells(width * height * samples);
    for (size_t k = 0; k < pieces.count(); ++k) {
        ScanTriangle t = pieces.triangle(k);
        const int64_t piece_area = twice_area(t.v);
        if (piece_area == 0) {
            continue;
        }
        if (piece_area < 0) {
            std::swap(t.v[1], t.v[2]);
            std::swap(t.inner[0], t.inner[2]);
        }
        const int sign = piece_area > 0 ? 1 : -1;
        scan(t, box, fragments_.samples(), device_, [&](int64_t i, int64_t j, uint32_t s) {
            Cell& cell =
                cells[(static_cast<size_t>(j - box.y0) * width + static_cast<size_t>(i - box.x0)) *
                          samples +
                      s];
            cell.winding = static_cast<int8_t>(cell.winding + sign);
            if (sign > 0 && cell.piece < 0) {
                cell.piece = static_cast<int8_t>(k);
            }
        });
    }
    const Cell* cell = cells.data();
    for (int64_t j = box.y0; j < box.y1; ++j) {
        for (int64_t i = box.x0; i < box.x1; ++i) {
            for (uint32_t s = 0; s < samples; ++s, ++cell) {
                if (cell->winding > 0) {
                    fragments_.cover(facet, pieces.planes(static_cast<size_t>(cell->piece)), i, j,
                                     s);
                }
            }
        }
    }
    fragments_.shade_covered(facet);
}

void DrawCommand::cover_areas(const Facet& facet, Pieces& pieces) {
    size_t largest = 0;
    int64_t most = 0;
    for (size_t k = 0; k < pieces.count(); ++k) {
        const std::array<WindowVertex, 3> corners = pieces.corners(k);
        const int64_t area = twice_area(corners);
        if (device_.covers_by_piece && area > 0) {
            cover_area(facet, pieces.planes(k), {corners.begin(), corners.end()});
        }
        if (area > most) {
            most = area;
            largest = k;
        }
    }
    if (!device_.covers_by_piece) {
        cover_area(facet, pieces.planes(largest), pieces.polygon());
    }
}

void DrawCommand::cover_area(const Facet& facet, const TrianglePlanes& planes,
                             const std::vector<WindowVertex>& polygon) {
    const std::vector<SampleOffset>& samples = fragments_.samples();
    const uint32_t id = facet.primitive.number;
    const AreaTest test(polygon, draw_, device_);
    const int64_t pixel = int64_t{1} << device_.subpixel_bits;
    PixelRect rect = rect_;
    if (device_.fault == "conservative-beyond-scissor"_fault) {
        rect = {std::max<int64_t>(rect.x0 - 1, 0), std::max<int64_t>(rect.y0 - 1, 0),
                std::min<int64_t>(rect.x1 + 1, out_.target.width),
                std::min<int64_t>(rect.y1 + 1, out_.target.height)};
    }
    rect = test.within(rect);
    for (int64_t j = rect.y0; j < rect.y1; ++j) {
        for (int64_t i = rect.x0; i < rect.x1; ++i) {
            const double x = static_cast<double>(i) + 0.5;
            const double y = static_cast<double>(j) + 0.5;
            if (!test.covers_pixel(i, j, samples) || !fragments_.is_seen(facet, planes, x, y)) {
                continue;
            }
            if (device_.fault == "conservative-shared-once"_fault &&
                owners_.try_emplace({i, j}, id).first->second != id) {
                continue;
            }
            uint32_t covered = 0;
            for (uint32_t s = 0; s < samples.size(); ++s) {
                if (test.covers_sample(i * pixel + samples[s].x, j * pixel + samples[s].y)) {
                    covered |= 1U << s;
                }
            }
            if (device_.fault != "conservative-mask-partial"_fault || covered == 0) {
                covered = (1U << samples.size()) - 1;
            }
            fragments_.shade_pixel(facet, planes, i, j, covered);
        }
    }
}

// "The fragment input values for these degenerate triangles take their attribute and depth values
// from the provoking vertex."
void DrawCommand::cover_degenerate(const Primitive& primitive,
                                   const std::vector<WindowVertex>& polygon,
                                   const ClippedPolygon& clipped) {
    const bool is_kept =
        device_.rasterizes_degenerates != (device_.fault == "degenerates-otherwise"_fault);
    const bool front = device_.fault == "degenerates-front"_fault;
    if (draw_.conservative != cases::Conservative::overestimate || !is_kept ||
        vertices_.is_culled(front)) {
        ++culled_;
        return;
    }
    const auto provoking = std::ranges::find(polygon, primitive.provoking, &WindowVertex::source);
    const WindowVertex& v = provoking == polygon.end() ? polygon.front() : *provoking;
    std::array<WindowVertex, 3> level{v, v, v};
    level[1].x += 1.0F;  // planes need an area
    level[2].y += 1.0F;
    level[1].sx += int64_t{1} << device_.subpixel_bits;
    level[2].sy += int64_t{1} << device_.subpixel_bits;
    const TrianglePlanes planes(level, true, draw_, device_);
    Facet facet = facet_of(primitive, v, polygon, clipped);
    facet.front = front;
    cover_area(facet, planes, polygon);
}

}  // namespace software
