// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From a draw's primitives to the samples that they cover.
#include "rasterizers/software/draw_command.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rasterizers/software/assembly.hpp"

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
      first_discard_(c.draws[0].discard),
      first_alpha_to_coverage_(c.draws[0].color.alpha_to_coverage),
      first_bounds_(c.draws[0].depth.bounds),
      first_depth_(c.draws[0].frag_depth),
      device_(device),
      out_(out),
      attachments_(attachments),
      rect_(draw_rect(draw_, c.target, device)),
      samples_(sample_offsets(c.target, device)) {
    if (device.fault == "bounds-at-draw-start"_fault) {
        other_depth_ = out.depth;
    } else if (device.fault == "bounds-of-clear"_fault) {
        other_depth_.assign(out.depth.size(), c.target.depth_clear);
    }
}

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
    if (is_distance_culled(primitive)) {
        ++culled_;
        return;
    }
    std::array<ClipVertex, 3> triangle;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = cached_vertex(primitive.vertex[k]);
        const uint32_t value_vertex = cached_vertex(primitive.values[k]);
        triangle[k].position = draw_.positions[v];
        triangle[k].source = v;
        triangle[k].distance = distances_of(v, primitive, k);
        for (size_t a = 0; a < draw_.attributes.size(); ++a) {
            const bool flat = draw_.attributes[a].interpolation == cases::Interpolation::flat &&
                              device_.fault != "flat-smooth"_fault &&
                              device_.fault != "clip-flat-piece"_fault;
            if (draw_.attributes[a].source == cases::Source::barycentric) {
                // Turned so that the provoking vertex is the first, or the last.
                const auto provoking =
                    static_cast<size_t>(std::find(primitive.vertex.begin(), primitive.vertex.end(),
                                                  primitive.provoking) -
                                        primitive.vertex.begin());
                size_t turn = draw_.provoking == cases::ProvokingVertex::last ? 2 : 3;
                turn += device_.fault == "barycentric-rotated"_fault ? 1 : 0;
                const bool keeps_order = device_.first_strip_order && turn == 2 &&
                                         draw_.topology == cases::Topology::triangle_strip;
                const size_t number = keeps_order ? k : (k + 3 - provoking + turn) % 3;
                triangle[k].values[a][static_cast<glm::vec4::length_type>(number)] = 1;
            }
            if (draw_.attributes[a].source == cases::Source::vertex) {
                triangle[k].values[a] =
                    draw_.attributes[a].values[flat ? primitive.provoking : value_vertex];
            }
        }
    }
    const ClippedPolygon polygon = clip_triangle(triangle, draw_, device_);
    tests_depth_ = polygon.tests_depth;
    attachments_.queries.count_clipped(number_, polygon.vertices.size(), polygon.was_cut);
    std::vector<WindowVertex> window;
    largest_z_ = 0;
    for (const ClipVertex& v : polygon.vertices) {
        if (!(v.position.w > 0) && device_.fault != "clip-none"_fault) {
            return;  // inside the volume w = 0 is a single point
        }
        window.push_back(project(v));
        largest_z_ = std::max(largest_z_, std::fabs(window.back().z));
    }
    if (window.size() >= 3) {
        if (device_.fault == "clip-last-piece-lost"_fault && window.size() > 3) {
            window.pop_back();
        }
        rasterize_polygon(primitive, triangle, std::move(window), polygon.was_cut);
    }
}

// What a degenerate triangle covers if its edges are taken as inclusive.
void DrawCommand::rasterize_line(const Primitive& primitive, std::vector<WindowVertex>& v) {
    if (v.size() != 3) {
        return;
    }
    Device inclusive = device_;
    inclusive.fault = "ties-all-inclusive"_fault;
    const bool front = is_front(0, {});
    if (is_culled(front)) {
        return;
    }
    std::array<WindowVertex, 3> wide{v[0], v[1], v[2]};
    for (size_t k = 0; k < 3; ++k) {  // planes need an area
        wide[k].x += k == 1 ? 1.0F : 0.0F;
        wide[k].y += k == 2 ? 1.0F : 0.0F;
    }
    const TrianglePlanes planes(wide, true, draw_, device_);
    scan({{v[0], v[1], v[2]}, {}, false}, rect_, samples_, inclusive,
         [&](int64_t i, int64_t j, uint32_t s) { cover(primitive, planes, v[0], front, i, j, s); });
    shade_covered(primitive, v[0], front);
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
        const std::array<WindowVertex, 3> piece{
            project(inner.vertices[0]), project(inner.vertices[k]), project(inner.vertices[k + 1])};
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

namespace {

// Of the area of the polygon's unsnapped positions.
int unsnapped_sign(const std::vector<WindowVertex>& polygon) {
    double area = 0;
    for (size_t k = 0; k < polygon.size(); ++k) {
        const WindowVertex& a = polygon[k];
        const WindowVertex& b = polygon[(k + 1) % polygon.size()];
        const auto relative = [&](float v, float origin) {
            return static_cast<double>(v) - static_cast<double>(origin);
        };
        area += relative(a.x, polygon[0].x) * relative(b.y, polygon[0].y) -
                relative(b.x, polygon[0].x) * relative(a.y, polygon[0].y);
    }
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

}  // namespace

void DrawCommand::rasterize_polygon(const Primitive& primitive,
                                    const std::array<ClipVertex, 3>& whole,
                                    std::vector<WindowVertex> polygon, bool was_cut) {
    const int64_t area = twice_area(polygon);
    if (area == 0 && draw_.conservative != cases::Conservative::none) {
        cover_degenerate(primitive, polygon);
        return;
    }
    if (area == 0) {
        if (device_.fault == "degenerate-drawn"_fault) {
            rasterize_line(primitive, polygon);
        }
        return;
    }
    if (device_.fault == "small-culled"_fault) {
        const auto by_x = [](const WindowVertex& a, const WindowVertex& b) { return a.sx < b.sx; };
        const auto by_y = [](const WindowVertex& a, const WindowVertex& b) { return a.sy < b.sy; };
        const auto [x0, x1] = std::minmax_element(polygon.begin(), polygon.end(), by_x);
        const auto [y0, y1] = std::minmax_element(polygon.begin(), polygon.end(), by_y);
        const int64_t pixel = int64_t{1} << device_.subpixel_bits;
        if (x1->sx - x0->sx < pixel && y1->sy - y0->sy < pixel) {
            return;
        }
    }
    const int unsnapped = device_.facing_unsnapped ? unsnapped_sign(polygon) : 0;
    const bool front = is_front(unsnapped != 0 ? unsnapped : area, whole);
    if (is_culled(front)) {
        ++culled_;
        return;
    }
    if (device_.fault == "statistics-without-culled"_fault) {
        attachments_.queries.add(number_, cases::Query::clipping_invocations, 1);
    }
    // Planes of the whole triangle where binary32 holds its snapped positions, else of each piece.
    const bool projectable = std::all_of(whole.begin(), whole.end(), [&](const ClipVertex& v) {
        const WindowVertex window = project(v);
        return v.position.w > 0 && std::fabs(window.x) < 0x1p15F && std::fabs(window.y) < 0x1p15F;
    });
    std::unique_ptr<TrianglePlanes> whole_planes;
    if (was_cut && projectable && !device_.piece_planes) {
        whole_planes = std::make_unique<TrianglePlanes>(
            std::array{project(whole[0]), project(whole[1]), project(whole[2])}, area > 0, draw_,
            device_);
    }
    // A guard band's cuts are too far away for planes in binary32: those are set up in the
    // viewport.
    if (was_cut && !whole_planes && device_.clip == ClipMethod::guard_band) {
        whole_planes = planes_in_viewport(whole, area > 0);
    }
    const WindowVertex first = polygon[0];
    if (device_.fault == "planes-of-last"_fault && cached_planes_ &&
        cached_first_.source != first.source) {
        cached_planes_.reset();
    }

    const bool reversed = area < 0;
    if (reversed) {  // keep the first vertex, walk the others backwards
        std::reverse(polygon.begin() + 1, polygon.end());
    }
    const size_t pieces = polygon.size() - 2;
    std::vector<std::unique_ptr<TrianglePlanes>> planes(pieces);
    const auto planes_of = [&](size_t k) -> const TrianglePlanes& {
        if (whole_planes) {
            return *whole_planes;
        }
        if (device_.fault == "planes-of-last"_fault) {
            if (!cached_planes_) {
                cached_planes_ = std::make_unique<TrianglePlanes>(
                    std::array{polygon[0], polygon[k + 1], polygon[k + 2]}, true, draw_, device_);
                cached_first_ = first;
            }
            return *cached_planes_;
        }
        if (!planes[k]) {
            planes[k] = std::make_unique<TrianglePlanes>(
                std::array{polygon[0], polygon[k + 1], polygon[k + 2]}, true, draw_, device_);
        }
        return *planes[k];
    };
    if (draw_.conservative != cases::Conservative::none) {
        size_t largest = 0;
        int64_t most = 0;
        for (size_t k = 0; k < pieces; ++k) {
            const std::vector<WindowVertex> corners{polygon[0], polygon[k + 1], polygon[k + 2]};
            const int64_t of_piece = twice_area(corners);
            if (device_.covers_by_piece && of_piece > 0) {
                cover_area(primitive, planes_of(k), corners, first, front);
            }
            if (of_piece > most) {
                most = of_piece;
                largest = k;
            }
        }
        if (!device_.covers_by_piece) {
            cover_area(primitive, planes_of(largest), polygon, first, front);
        }
        return;
    }
    const auto piece = [&](size_t k) {
        ScanTriangle t{{polygon[0], polygon[k + 1], polygon[k + 2]}, {}, reversed};
        t.inner = {k > 0, false, k + 1 < pieces};
        return t;
    };

    if (pieces == 1 || device_.fault == "clip-diagonal-double"_fault) {
        for (size_t k = 0; k < pieces; ++k) {
            const ScanTriangle t = piece(k);
            if (twice_area(t.v) > 0) {
                scan(t, rect_, samples_, device_, [&](int64_t i, int64_t j, uint32_t s) {
                    cover(primitive, planes_of(k), first, front, i, j, s);
                });
            }
        }
        shade_covered(primitive, first, front);
        return;
    }
    // Snapping can bend a clipped polygon, so that pieces fold over. The winding number counts each
    // sample once all the same.
    PixelRect box{INT64_MAX, INT64_MAX, INT64_MIN, INT64_MIN};
    for (const WindowVertex& v : polygon) {
        box = {std::min(box.x0, v.sx >> device_.subpixel_bits),
               std::min(box.y0, v.sy >> device_.subpixel_bits),
               std::max(box.x1, (v.sx >> device_.subpixel_bits) + 1),
               std::max(box.y1, (v.sy >> device_.subpixel_bits) + 1)};
    }
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
    std::vector<Cell> cells(width * height * samples_.size());
    for (size_t k = 0; k < pieces; ++k) {
        ScanTriangle t = piece(k);
        const int64_t piece_area = twice_area(t.v);
        if (piece_area == 0) {
            continue;
        }
        if (piece_area < 0) {
            std::swap(t.v[1], t.v[2]);
            std::swap(t.inner[0], t.inner[2]);
        }
        const int sign = piece_area > 0 ? 1 : -1;
        scan(t, box, samples_, device_, [&](int64_t i, int64_t j, uint32_t s) {
            const size_t at =
                (static_cast<size_t>(j - box.y0) * width + static_cast<size_t>(i - box.x0)) *
                    samples_.size() +
                s;
            cells[at].winding = static_cast<int8_t>(cells[at].winding + sign);
            if (sign > 0 && cells[at].piece < 0) {
                cells[at].piece = static_cast<int8_t>(k);
            }
        });
    }
    size_t at = 0;
    for (int64_t j = box.y0; j < box.y1; ++j) {
        for (int64_t i = box.x0; i < box.x1; ++i) {
            for (uint32_t s = 0; s < samples_.size(); ++s, ++at) {
                if (cells[at].winding > 0) {
                    cover(primitive, planes_of(static_cast<size_t>(cells[at].piece)), first, front,
                          i, j, s);
                }
            }
        }
    }
    shade_covered(primitive, first, front);
}

}  // namespace software
