// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/device.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "mutants/assembly.hpp"
#include "mutants/blend_unit.hpp"
#include "mutants/clipper.hpp"
#include "mutants/depth.hpp"
#include "mutants/multisample.hpp"
#include "mutants/planes.hpp"
#include "mutants/probes.hpp"
#include "mutants/resolve_unit.hpp"
#include "mutants/tiles.hpp"

namespace mutants {

namespace {

// The value with 11 significant bits, as a 16-bit float has.
float to_half_precision(float v) {
    const uint32_t bits = std::bit_cast<uint32_t>(v);
    return std::bit_cast<float>((bits + 0x1000U) & 0xffffe000U);
}

int64_t to_fixed(float v, const Device& device) {
    int bits = device.subpixel_bits;
    Rounding rounding = device.rounding;
    if (device.fault == Fault::floor_snapping) {
        rounding = Rounding::floor;
    } else if (device.fault == Fault::ceil_snapping) {
        rounding = Rounding::ceil;
    }
    int coarse = 0;
    if (device.fault == Fault::coarse_snapping) {
        coarse = bits - 4;
        bits = 4;
    }
    // Far outside only without clipping; the limit keeps edge functions inside 64 bits.
    const double scaled = std::ldexp(std::clamp(static_cast<double>(v), -0x1p18, 0x1p18), bits);
    double whole = 0;
    switch (rounding) {
        case Rounding::nearest_even:
            whole = std::nearbyint(scaled);
            break;
        case Rounding::half_up:
            whole = std::floor(scaled + 0.5);
            break;
        case Rounding::floor:
            whole = std::floor(scaled);
            break;
        case Rounding::ceil:
            whole = std::ceil(scaled);
            break;
        case Rounding::truncate:
            whole = std::trunc(scaled);
            break;
    }
    return static_cast<int64_t>(whole) * (int64_t{1} << coarse);
}

// Where a draw's fragments may land.
PixelRect draw_rect(const cases::Draw& draw, const cases::Target& target, const Device& device) {
    PixelRect rect{draw.scissor.x, draw.scissor.y,
                   int64_t{draw.scissor.x} + int64_t{draw.scissor.width},
                   int64_t{draw.scissor.y} + int64_t{draw.scissor.height}};
    switch (device.fault) {
        case Fault::scissor_closed:
            rect.x1 += 1;
            rect.y1 += 1;
            break;
        case Fault::scissor_off_by_one:
            rect.x0 += rect.x0 > 0 ? 1 : 0;
            rect.y0 += rect.y0 > 0 ? 1 : 0;
            break;
        case Fault::scissor_ignored:
            rect = {0, 0, int64_t{target.width}, int64_t{target.height}};
            break;
        case Fault::scissor_follows_viewport: {
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
cases::Draw effective(const cases::Case& c, uint32_t number, Fault fault) {
    cases::Draw draw = c.draws[number];
    if (fault == Fault::state_of_first_draw) {
        const cases::Draw& first = c.draws[0];
        draw.viewport = first.viewport;
        draw.scissor = first.scissor;
        draw.cull = first.cull;
        draw.front_face = first.front_face;
    }
    if (fault == Fault::layer_of_first_draw) {
        draw.layer = c.draws[0].layer;
    }
    if (fault == Fault::viewport_rounded) {
        draw.viewport.x = std::round(draw.viewport.x);
        draw.viewport.y = std::round(draw.viewport.y);
        draw.viewport.width = std::round(draw.viewport.width);
        draw.viewport.height = std::round(draw.viewport.height);
    }
    return draw;
}

// Attachments that are written in drawing order, beside the capture's own planes.
struct Attachments {
    ColorAttachment color;
    StencilAttachment stencil;
};

// One draw of a case onto the capture.
class DrawCommand {
  public:
    DrawCommand(const cases::Case& c, uint32_t number, const Device& device, diff::Capture& out,
                Attachments& attachments)
        : draw_(effective(c, number, device.fault)),
          number_(number),
          device_(device),
          out_(out),
          attachments_(attachments),
          rect_(draw_rect(draw_, c.target, device)),
          samples_(sample_offsets(c.target, device)) {}

    void run() {
        for (const Primitive& primitive : assemble_primitives(draw_, device_.fault)) {
            const int times = device_.fault == Fault::draw_doubled ? 2 : 1;
            for (int k = 0; k < times; ++k) {
                rasterize(primitive);
            }
        }
    }

  private:
    void rasterize(const Primitive& primitive);
    uint32_t cached_vertex(uint32_t v);
    void rasterize_polygon(const Primitive& primitive, const std::array<ClipVertex, 3>& whole,
                           std::vector<WindowVertex> polygon, bool was_cut);
    void rasterize_line(const Primitive& primitive, std::vector<WindowVertex>& v);
    WindowVertex project(const ClipVertex& v) const;
    std::unique_ptr<TrianglePlanes> planes_in_viewport(const std::array<ClipVertex, 3>& whole,
                                                       bool positive) const;
    bool is_front(int64_t area, const std::array<ClipVertex, 3>& whole) const;
    bool is_culled(bool front) const;
    bool is_distance_culled(const Primitive& primitive) const;
    bool is_distance_clipped(const TrianglePlanes& planes, int64_t i, int64_t j, uint32_t s) const;
    glm::vec4 distances_of(uint32_t v, const Primitive& primitive, size_t k) const;
    bool inside_viewport(int64_t i, int64_t j, uint32_t s) const;
    // Sample s of pixel (i,j) is covered: with several samples the fragment waits until all of its
    // samples are known.
    void cover(const Primitive& primitive, const TrianglePlanes& planes, const WindowVertex& first,
               bool front, int64_t i, int64_t j, uint32_t s);
    void shade_covered(const Primitive& primitive, const WindowVertex& first, bool front);
    void shade(const Primitive& primitive, const TrianglePlanes& planes, const WindowVertex& first,
               bool front, int64_t i, int64_t j, uint32_t s, uint32_t covered);
    // The same in one layer of the target.
    void shade_in(uint32_t layer, const Primitive& primitive, const TrianglePlanes& planes,
                  const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s,
                  uint32_t covered);
    size_t index_in(uint32_t layer, int64_t i, int64_t j, uint32_t s) const;
    void write_color(size_t at, uint32_t primitive);

    const cases::Draw draw_;
    uint32_t number_;
    const Device& device_;
    diff::Capture& out_;
    Attachments& attachments_;
    PixelRect rect_;
    std::vector<SampleOffset> samples_;
    // Samples of the fragments of the triangle at hand: by pixel (row first) and planes.
    std::map<std::tuple<int64_t, int64_t, const TrianglePlanes*>, uint32_t> covered_;
    std::unique_ptr<TrianglePlanes> cached_planes_;
    WindowVertex cached_first_;
    uint32_t culled_ = 0;  // triangles so far
    float largest_z_ = 0;  // of the polygon being drawn
    std::array<uint32_t, 32> vertex_cache_ = [] {
        std::array<uint32_t, 32> empty{};
        empty.fill(UINT32_MAX);
        return empty;
    }();
};

WindowVertex DrawCommand::project(const ClipVertex& v) const {
    const auto mad = [&](float a, float b, float c) {
        return device_.fused ? std::fma(a, b, c) : a * b + c;
    };
    const glm::vec4& p = v.position;
    const cases::Viewport& view = draw_.viewport;
    WindowVertex out;
    out.values = v.values;
    out.source = v.source;
    out.distance = v.distance;
    out.w = p.w;
    out.inv_w = 1.0F / p.w;
    const auto divide = [&](float a) { return device_.reciprocal_w ? a * out.inv_w : a / p.w; };

    float height = view.height;
    float top = view.y;
    if (device_.fault == Fault::height_sign_ignored && height < 0) {
        top += height;
        height = -height;
    }
    out.x = mad(divide(p.x), view.width * 0.5F, view.x + view.width * 0.5F);
    out.y = mad(divide(p.y), height * 0.5F, top + height * 0.5F);
    out.z = mad(divide(p.z), view.max_depth - view.min_depth, view.min_depth);
    if (draw_.depth.negative_one_to_one && device_.fault != Fault::depth_scale_ignored) {
        out.z = mad(divide(p.z), (view.max_depth - view.min_depth) * 0.5F,
                    (view.max_depth + view.min_depth) * 0.5F);
    }
    switch (device_.fault) {
        case Fault::depth_range_ignored:
            out.z = divide(p.z);
            break;
        case Fault::depth_before_divide:
            out.z = mad(p.z, view.max_depth - view.min_depth, view.min_depth);
            break;
        case Fault::half_pixel_shift:
            out.x += 0.5F;
            out.y += 0.5F;
            break;
        case Fault::viewport_nudge:
            out.x += 0x1p-8F;
            break;
        case Fault::position_half:
            out.x = to_half_precision(out.x);
            out.y = to_half_precision(out.y);
            break;
        default:
            break;
    }
    out.sx = to_fixed(out.x, device_);
    out.sy = to_fixed(out.y, device_);
    return out;
}

bool DrawCommand::is_front(int64_t area, const std::array<ClipVertex, 3>& whole) const {
    bool clockwise = area > 0;
    if (device_.fault == Fault::face_unclipped_w) {
        int negative = 0;
        for (const ClipVertex& v : whole) {
            negative += v.position.w < 0 ? 1 : 0;
        }
        clockwise = clockwise != (negative % 2 == 1);
    }
    const bool front = clockwise == (draw_.front_face == cases::FrontFace::clockwise);
    return device_.fault == Fault::front_face_inverted ? !front : front;
}

bool DrawCommand::is_culled(bool front) const {
    switch (draw_.cull) {
        case cases::CullMode::none:
            return false;
        case cases::CullMode::front:
            return device_.fault == Fault::cull_inverted ? !front : front;
        case cases::CullMode::back:
            return device_.fault == Fault::cull_inverted ? front : !front;
        case cases::CullMode::front_and_back:
            return true;
    }
    return false;
}

// With a guard band the viewport's rectangle is a scissor for each sample.
bool DrawCommand::inside_viewport(int64_t i, int64_t j, uint32_t s) const {
    if (device_.clip != ClipMethod::guard_band) {
        return true;
    }
    const double unit = std::ldexp(1.0, -device_.subpixel_bits);
    const double x = static_cast<double>(i) + static_cast<double>(samples_[s].x) * unit;
    const double y = static_cast<double>(j) + static_cast<double>(samples_[s].y) * unit;
    const cases::Viewport& view = draw_.viewport;
    const double left = static_cast<double>(view.x);
    const double right = left + static_cast<double>(view.width);
    double top = static_cast<double>(view.y);
    double bottom = top + static_cast<double>(view.height);
    if (bottom < top) {
        std::swap(top, bottom);
    }
    return x >= left && x < right && y >= top && y < bottom;
}

// Which vertex's data a reader of vertex v gets.
uint32_t DrawCommand::cached_vertex(uint32_t v) {
    if (device_.fault != Fault::vertex_cache_aliased) {
        return v;
    }
    uint32_t& entry = vertex_cache_[v % vertex_cache_.size()];
    if (entry == UINT32_MAX) {
        entry = v;
    }
    return entry;
}

// What the distances of vertex v are for a primitive.
glm::vec4 DrawCommand::distances_of(uint32_t v, const Primitive& primitive, size_t k) const {
    const std::vector<glm::vec4>& all = draw_.distances.clip;
    if (all.empty()) {
        return glm::vec4(0.0F);
    }
    if (device_.fault == Fault::distance_by_order) {
        // Right for lists without indices only.
        return all[(3 * size_t{primitive.id} + k) % all.size()];
    }
    const glm::vec4& d = all[v];
    return device_.fault == Fault::distance_rotated ? glm::vec4(d.y, d.z, d.w, d.x) : d;
}

bool DrawCommand::is_distance_culled(const Primitive& primitive) const {
    const cases::ClipDistances& d = draw_.distances;
    const auto is_out = [&](uint32_t v, uint32_t k) {
        const float c = d.cull[v][static_cast<glm::vec4::length_type>(k)];
        return device_.fault == Fault::cull_distance_zero ? c <= 0 : c < 0;
    };
    bool is_mixed = d.cull_count > 0;
    for (const uint32_t v : primitive.vertex) {
        bool is_out_of_some = false;
        for (uint32_t k = 0; k < d.cull_count; ++k) {
            is_out_of_some = is_out_of_some || is_out(v, k);
        }
        is_mixed = is_mixed && is_out_of_some;
    }
    bool is_culled = false;
    for (uint32_t k = 0; k < d.cull_count; ++k) {
        const auto count = std::count_if(primitive.vertex.begin(), primitive.vertex.end(),
                                         [&](uint32_t v) { return is_out(v, k); });
        switch (device_.fault) {
            case Fault::cull_distance_any:
                is_culled = is_culled || count > 0;
                break;
            case Fault::cull_distance_provoking:
                is_culled = is_culled || is_out(primitive.provoking, k);
                break;
            default:
                is_culled = is_culled || count == 3;
                break;
        }
    }
    if (device_.fault == Fault::cull_distance_mixed) {
        return is_mixed;
    }
    return is_culled && device_.fault != Fault::cull_distance_ignored;
}

void DrawCommand::rasterize(const Primitive& primitive) {
    if (is_distance_culled(primitive)) {
        ++culled_;
        return;
    }
    std::array<ClipVertex, 3> triangle;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = cached_vertex(primitive.vertex[k]);
        triangle[k].position = draw_.positions[v];
        triangle[k].source = v;
        triangle[k].distance = distances_of(v, primitive, k);
        for (size_t a = 0; a < draw_.attributes.size(); ++a) {
            const bool flat = draw_.attributes[a].interpolation == cases::Interpolation::flat &&
                              device_.fault != Fault::flat_smooth &&
                              device_.fault != Fault::clip_flat_piece;
            if (draw_.attributes[a].source == cases::Source::barycentric) {
                // Turned so that the provoking vertex is the first, or the last.
                const auto provoking =
                    static_cast<size_t>(std::find(primitive.vertex.begin(), primitive.vertex.end(),
                                                  primitive.provoking) -
                                        primitive.vertex.begin());
                size_t turn = draw_.provoking == cases::ProvokingVertex::last ? 2 : 3;
                turn += device_.fault == Fault::barycentric_rotated ? 1 : 0;
                const size_t number = (k + 3 - provoking + turn) % 3;
                triangle[k].values[a][static_cast<glm::vec4::length_type>(number)] = 1;
            }
            if (draw_.attributes[a].source == cases::Source::vertex) {
                triangle[k].values[a] = draw_.attributes[a].values[flat ? primitive.provoking : v];
            }
        }
    }
    const ClippedPolygon polygon = clip_triangle(triangle, draw_, device_);
    std::vector<WindowVertex> window;
    largest_z_ = 0;
    for (const ClipVertex& v : polygon.vertices) {
        if (!(v.position.w > 0) && device_.fault != Fault::clip_none) {
            return;  // inside the volume w = 0 is a single point
        }
        window.push_back(project(v));
        largest_z_ = std::max(largest_z_, std::fabs(window.back().z));
    }
    if (window.size() >= 3) {
        if (device_.fault == Fault::clip_last_piece_lost && window.size() > 3) {
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
    inclusive.fault = Fault::ties_all_inclusive;
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

void DrawCommand::rasterize_polygon(const Primitive& primitive,
                                    const std::array<ClipVertex, 3>& whole,
                                    std::vector<WindowVertex> polygon, bool was_cut) {
    const int64_t area = twice_area(polygon);
    if (area == 0) {
        if (device_.fault == Fault::degenerate_drawn) {
            rasterize_line(primitive, polygon);
        }
        return;
    }
    if (device_.fault == Fault::small_culled) {
        const auto by_x = [](const WindowVertex& a, const WindowVertex& b) { return a.sx < b.sx; };
        const auto by_y = [](const WindowVertex& a, const WindowVertex& b) { return a.sy < b.sy; };
        const auto [x0, x1] = std::minmax_element(polygon.begin(), polygon.end(), by_x);
        const auto [y0, y1] = std::minmax_element(polygon.begin(), polygon.end(), by_y);
        const int64_t pixel = int64_t{1} << device_.subpixel_bits;
        if (x1->sx - x0->sx < pixel && y1->sy - y0->sy < pixel) {
            return;
        }
    }
    const bool front = is_front(area, whole);
    if (is_culled(front)) {
        ++culled_;
        return;
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
    if (device_.fault == Fault::planes_of_last && cached_planes_ &&
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
        if (device_.fault == Fault::planes_of_last) {
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
    const auto piece = [&](size_t k) {
        ScanTriangle t{{polygon[0], polygon[k + 1], polygon[k + 2]}, {}, reversed};
        t.inner = {k > 0, false, k + 1 < pieces};
        return t;
    };

    if (pieces == 1 || device_.fault == Fault::clip_diagonal_double) {
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
    if (device_.fault == Fault::draws_everything) {
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

// With clip distances tested at each sample.
bool DrawCommand::is_distance_clipped(const TrianglePlanes& planes, int64_t i, int64_t j,
                                      uint32_t s) const {
    if (!tests_distances(device_)) {
        return false;
    }
    const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
    const float x = static_cast<float>(i) + static_cast<float>(samples_[s].x) * unit;
    const float y = static_cast<float>(j) + static_cast<float>(samples_[s].y) * unit;
    for (int k = 0; k < static_cast<int>(draw_.distances.clip_count); ++k) {
        const float c = planes.distance(k, x, y);
        if (device_.fault == Fault::distance_plane_never ? !(c > 0) : !(c >= 0)) {
            return true;
        }
    }
    return false;
}

void DrawCommand::cover(const Primitive& primitive, const TrianglePlanes& planes,
                        const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s) {
    if (!inside_viewport(i, j, s) || is_distance_clipped(planes, i, j, s)) {
        return;
    }
    if (samples_.size() == 1) {
        shade(primitive, planes, first, front, i, j, s, 1U);
    } else {
        covered_[{j, i, &planes}] |= 1U << s;
    }
}

void DrawCommand::shade_covered(const Primitive& primitive, const WindowVertex& first, bool front) {
    for (const auto& [where, covered] : covered_) {
        const auto& [j, i, planes] = where;
        for (uint32_t s = 0; s < samples_.size(); ++s) {
            if (((covered >> s) & 1U) != 0) {
                shade(primitive, *planes, first, front, i, j, s, covered);
            }
        }
    }
    covered_.clear();
}

void DrawCommand::shade(const Primitive& primitive, const TrianglePlanes& planes,
                        const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s,
                        uint32_t covered) {
    const uint32_t layers = out_.target.layers;
    uint32_t layer = draw_.layer;
    switch (device_.fault) {
        case Fault::layer_ignored:
            layer = 0;
            break;
        case Fault::layer_off_by_one:
            layer = (layer + 1) % layers;
            break;
        case Fault::layer_of_viewport:
            layer = std::min(draw_.viewport_index, layers - 1);
            break;
        case Fault::all_layers_written:
            for (uint32_t k = 0; k < layers; ++k) {
                shade_in(k, primitive, planes, first, front, i, j, s, covered);
            }
            return;
        default:
            break;
    }
    shade_in(layer, primitive, planes, first, front, i, j, s, covered);
}

size_t DrawCommand::index_in(uint32_t layer, int64_t i, int64_t j, uint32_t s) const {
    const cases::Target& target = out_.target;
    const size_t row = size_t{layer} * target.height + static_cast<size_t>(j);
    return (row * target.width + static_cast<size_t>(i)) * target.samples + s;
}

void DrawCommand::shade_in(uint32_t layer, const Primitive& primitive, const TrianglePlanes& planes,
                           const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s,
                           uint32_t covered) {
    const Fault fault = device_.fault;
    const Invocation invocation = invoke(draw_, device_, samples_, i, j, s, covered);
    if (!invocation.is_written) {
        return;
    }
    const size_t at = index_in(layer, i, j, s);
    const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
    const float sample_x = static_cast<float>(i) + static_cast<float>(samples_[s].x) * unit;
    const float sample_y = static_cast<float>(j) + static_cast<float>(samples_[s].y) * unit;
    float z = planes.depth(sample_x, sample_y);
    if (fault == Fault::values_at_corner) {
        z = planes.depth(static_cast<float>(i), static_cast<float>(j));
    } else if (fault == Fault::depth_at_centre) {
        z = planes.depth(static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F);
    }
    const float largest = fault == Fault::bias_exponent_of_sample ? std::fabs(z) : largest_z_;
    const cases::DepthFormat format = out_.target.depth_format;
    const float bias =
        depth_bias(draw_, format, planes.depth_dx(), planes.depth_dy(), largest, device_);
    z = fragment_depth(z, bias, draw_, format, device_);
    const size_t tested = fault == Fault::layer_depth_of_first ? index_in(0, i, j, s) : at;
    const bool passes = passes_depth_test(draw_, z, out_.depth[tested], device_);
    if ((passes && (draw_.depth.write || fault == Fault::depth_write_ignored)) ||
        fault == Fault::depth_write_before_test) {
        out_.depth[at] = z;
    }
    attachments_.stencil.test(at, draw_, front, passes);
    if (!passes) {
        return;
    }
    out_.hits[at] += front ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1);
    const bool of_piece = fault == Fault::clip_flat_piece;
    const uint32_t id =
        fault == Fault::primitive_id_skips_culled ? primitive.id - culled_ : primitive.id;
    out_.writers[at] = {number_, id, of_piece ? first.source : primitive.provoking, diff::kClearId};

    const float corner = fault == Fault::values_at_corner ? -0.5F : 0.0F;
    const float x = invocation.centre.x + corner;
    const float y = invocation.centre.y + corner;
    const float corner_xy = fault == Fault::frag_coord_corner ? -0.5F : 0.0F;
    const float inverse_w = planes.inverse_w(x, y);
    const glm::vec4 older_frag_coord = out_.frag_coord[at];
    out_.frag_coord[at] = {invocation.frag_coord.x + corner_xy, invocation.frag_coord.y + corner_xy,
                           planes.depth(x, y),
                           fault == Fault::frag_coord_w ? 1.0F / inverse_w : inverse_w};
    out_.frag_coord[at] = attachments_.color.beside(number_, out_.frag_coord[at], older_frag_coord);

    for (size_t a = 0; a < draw_.attributes.size(); ++a) {
        bool flat = draw_.attributes[a].interpolation == cases::Interpolation::flat;
        if (fault == Fault::flat_smooth) {
            flat = false;
        }
        if (fault == Fault::smooth_flat &&
            draw_.attributes[a].interpolation == cases::Interpolation::smooth) {
            flat = true;
        }
        const bool is_sample = draw_.attributes[a].auxiliary == cases::Auxiliary::sample;
        const bool is_centroid = draw_.attributes[a].auxiliary == cases::Auxiliary::centroid;
        Place place{x, y};
        if (samples_.size() > 1 && (is_sample || is_centroid)) {
            place = is_sample ? invocation.sample : invocation.centroid;
        }
        glm::vec4 value = flat
                              ? first.values[a]
                              : probe(draw_, device_, planes, samples_, a, i, j, place, invocation);
        if (fault == Fault::one_over_w_cached && !flat &&
            draw_.attributes[a].interpolation == cases::Interpolation::smooth) {
            value *= planes.inverse_w(place.x, place.y) / inverse_w;
        }
        switch (draw_.attributes[a].source) {
            case cases::Source::sample_mask_in:
                value = glm::vec4(static_cast<float>(invocation.mask_in), 0, 0, 0);
                break;
            case cases::Source::sample_id:
                value = glm::vec4(static_cast<float>(invocation.sample_id), 0, 0, 0);
                break;
            case cases::Source::sample_position:
                value = {invocation.sample_position.x, invocation.sample_position.y, 0, 0};
                break;
            case cases::Source::vertex:
            case cases::Source::barycentric:
                break;
        }
        if (fault == Fault::values_clamped) {
            value = glm::clamp(value, 0.0F, 1.0F);
        }
        if (fault == Fault::components_rotated) {
            value = {value.y, value.z, value.w, value.x};
        }
        if (fault == Fault::values_half && !flat) {
            for (int k = 0; k < 4; ++k) {
                value[k] = to_half_precision(value[k]);
            }
        }
        const size_t location =
            fault == Fault::attributes_swapped && draw_.attributes.size() > 1 && a < 2 ? 1 - a : a;
        out_.attributes[location][at] = value;
    }
    write_color(at, primitive.id);
}

void DrawCommand::write_color(size_t at, uint32_t primitive) {
    const int32_t attribute = draw_.color.attribute;
    attachments_.color.write(
        at, number_, primitive,
        attribute < 0 ? draw_.color.value : out_.attributes[static_cast<size_t>(attribute)][at]);
}

}  // namespace

diff::Capture render(const cases::Case& c, const Device& device) {
    diff::Capture out;
    out.target = c.target;
    out.has_primitive = true;
    const size_t count = out.sample_count();
    out.hits.assign(count, glm::vec4(0, 0, diff::kHitGuard, diff::kHitGuard));
    out.writers.assign(count, diff::Writer{});
    out.frag_coord.assign(count, glm::vec4(diff::kClearValue));
    out.depth.assign(count, stored_depth(c.target.depth_clear, c.target.depth_format, device));
    for (const cases::Draw& draw : c.draws) {
        out.attribute_count =
            std::max(out.attribute_count, static_cast<uint32_t>(draw.attributes.size()));
    }
    for (uint32_t a = 0; a < out.attribute_count; ++a) {
        out.attributes[a].assign(count, glm::vec4(diff::kClearValue));
    }
    Attachments attachments{{c, device}, {c.target, device}};
    const auto finish = [&] {
        out.color = attachments.color.read_back();
        out.stencil = attachments.stencil.values();
        resolve(out, device);
    };
    const auto draws =
        device.fault == Fault::draws_nothing ? 0U : static_cast<uint32_t>(c.draws.size());
    for (uint32_t d = 0; d < draws; ++d) {
        if (d + 1 == draws && device.fault == Fault::resolve_early) {
            finish();
        }
        const bool reversed = device.fault == Fault::draws_reversed;
        DrawCommand(c, reversed ? draws - 1 - d : d, device, out, attachments).run();
    }
    const diff::Capture early = device.fault == Fault::resolve_early ? out : diff::Capture{};
    finish();
    if (device.fault == Fault::resolve_early) {
        out.resolved_color = early.resolved_color;
        out.resolved_depth = early.resolved_depth;
    }
    return out;
}

}  // namespace mutants
