// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/algorithms/device.hpp"

#include <algorithm>
#include <cmath>

#include "rasterizers/algorithms/block_integers.hpp"
#include "rasterizers/algorithms/edge.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/position.hpp"

namespace rasterizers {

namespace {

constexpr ref::Limits kLimits{kSubpixelBits};
constexpr int64_t kFixedPerUnit = ref::kFixedOne / kPixel;

SubpixelPoint to_point(const ref::FixedPoint& p) {
    return {p.x / kFixedPerUnit, p.y / kFixedPerUnit};  // exact: a multiple of the grid
}

bool is_plain(const cases::Attribute& a) {
    return a.source == cases::Source::vertex && a.probe == cases::Probe::value &&
           a.auxiliary == cases::Auxiliary::none;
}

// The pixels inside scissor, framebuffer and viewport: those whose samples lie in [x, x + width).
PixelRect pixels_of(const cases::Draw& d, const cases::Target& target,
                    const SubpixelPoint& offset) {
    const auto first = [](double edge, int64_t o) {
        const double unit = 1.0 / static_cast<double>(kPixel);
        return static_cast<int64_t>(std::ceil(edge - static_cast<double>(o) * unit));
    };
    const auto x = static_cast<double>(d.viewport.x);
    const double right = x + static_cast<double>(d.viewport.width);
    const auto y = static_cast<double>(d.viewport.y);
    const double other = y + static_cast<double>(d.viewport.height);
    const int64_t scissor_right = int64_t{d.scissor.x} + d.scissor.width;
    const int64_t scissor_bottom = int64_t{d.scissor.y} + d.scissor.height;
    return {
        std::max({int64_t{0}, int64_t{d.scissor.x}, first(x, offset.x)}),
        std::max({int64_t{0}, int64_t{d.scissor.y}, first(std::min(y, other), offset.y)}),
        std::min({int64_t{target.width}, scissor_right, first(right, offset.x)}),
        std::min({int64_t{target.height}, scissor_bottom, first(std::max(y, other), offset.y)})};
}

// Everything of a triangle that its fragments need.
class Shader {
  public:
    Shader(const cases::Draw& draw, const cases::Triangle& triangle, const Corners& corners,
           const Device& device)
        : draw_(draw), triangle_(triangle), corners_(corners), device_(device) {
        std::array<float, 3> w{};
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec4& p = draw.positions[triangle.vertex[k]];
            w[k] = p.w;
            inv_w_[k] = 1.0F / p.w;
            z_[k] = p.z / p.w * (draw.viewport.max_depth - draw.viewport.min_depth) +
                    draw.viewport.min_depth;
        }
        products_ = device.w_bits == 0 ? w_products(w) : block_w_products(w, device.w_bits);
    }

    // Values at the pixel's centre (Direct3D 11), depth at the sample.
    void shade(uint32_t i, uint32_t j, const SubpixelPoint& sample,
               ref::FragmentValues& out) const {
        const Areas areas = areas_at(corners_, sample_of(i, j, {kPixel / 2, kPixel / 2}));
        const float inv_w = device_.linear(areas, inv_w_);
        const float z = device_.linear(areas, z_);
        out.frag_coord = {static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F, z, inv_w};
        const auto [low, high] = std::minmax(draw_.viewport.min_depth, draw_.viewport.max_depth);
        out.depth = std::clamp(device_.linear(areas_at(corners_, sample), z_), low, high);
        for (size_t a = 0; a < draw_.attributes.size(); ++a) {
            const cases::Attribute& attribute = draw_.attributes[a];
            glm::vec4& value = out.attributes[a];
            value = glm::vec4(0);
            for (glm::vec4::length_type c = 0;
                 c < static_cast<glm::vec4::length_type>(attribute.components); ++c) {
                if (attribute.interpolation == cases::Interpolation::flat) {
                    value[c] = attribute.values[triangle_.provoking][c];
                    continue;
                }
                Values f{};
                for (size_t k = 0; k < 3; ++k) {
                    f[k] = attribute.values[triangle_.vertex[k]][c];
                }
                value[c] = attribute.interpolation == cases::Interpolation::noperspective
                               ? device_.linear(areas, f)
                               : smooth(areas, f, inv_w);
            }
        }
    }

  private:
    float smooth(const Areas& areas, const Values& f, float inv_w) const {
        if (device_.has_w_products) {
            return brown(areas, products_, f);
        }
        const Values scaled{f[0] * inv_w_[0], f[1] * inv_w_[1], f[2] * inv_w_[2]};
        return device_.linear(areas, scaled) / inv_w;
    }

    const cases::Draw& draw_;
    const cases::Triangle& triangle_;
    const Corners& corners_;
    const Device& device_;
    Values inv_w_{}, z_{};
    std::array<float, 3> products_{};
};

// Front or back, by the sign of the area on screen; nothing if culled or without area.
enum class Side : uint8_t { front, back, none };
Side side_of(const cases::Draw& d, const Corners& t) {
    const int64_t area = edge_function(t[0], t[1], t[2]);  // positive: clockwise on screen
    if (area == 0) {
        return Side::none;
    }
    const bool is_front = (area > 0) == (d.front_face == cases::FrontFace::clockwise);
    const bool is_culled = d.cull == cases::CullMode::front_and_back ||
                           d.cull == (is_front ? cases::CullMode::front : cases::CullMode::back);
    return is_culled ? Side::none : is_front ? Side::front : Side::back;
}

}  // namespace

std::span<const Device> all_devices() {
    static constexpr Device kDevices[] = {
        {"flat-parts", "flat-top and flat-bottom parts, nested lines", scan_flat_parts,
         nested_lines},
        {"incremental", "edge functions by addition, three multiplies", scan_incremental,
         three_multiplies},
        {"quads", "2x2 quads, two multiplies", scan_quads, two_multiplies},
        {"tiles", "tiles of 64, 16 and 4 pixels, two multiplies", scan_tiles, two_multiplies},
        {"same-sign", "half planes in either winding, three multiplies", scan_same_sign,
         three_multiplies},
        {"areas", "unsigned areas, nested lines", scan_areas, nested_lines},
        {"brown", "Brown's areas and products of w", scan_brown, three_multiplies, true},
        {"brown-15", "the same with products of w block-normalised to 15 bits: loses accuracy",
         scan_brown, three_multiplies, true, 15},
    };
    return kDevices;
}

const Device* find_device(std::string_view name) {
    const std::span<const Device> all = all_devices();
    const auto found = std::ranges::find(all, name, &Device::name);
    return found == all.end() ? nullptr : &*found;
}

std::string unsupported_reason(const cases::Case& c) {
    if (c.blit || !c.relations.empty() || !(c.variation == cases::Variation{})) {
        return "the algorithms draw a case once, and blit nothing";
    }
    cases::Target plain;
    plain.width = c.target.width;
    plain.height = c.target.height;
    plain.samples = c.target.samples;
    if (!(c.target == plain)) {
        return "the algorithms draw to the default attachments with standard sample locations only";
    }
    for (const cases::Draw& d : c.draws) {
        if (!(d.depth == cases::DepthState{}) || !(d.distances == cases::ClipDistances{}) ||
            !(d.multisample == cases::Multisample{}) || d.rasterizer_discard ||
            d.provoking != cases::ProvokingVertex::first || d.layer != 0 || d.viewport_index != 0) {
            return "the algorithms have no depth state, clip distances, sample masks, layers, "
                   "provoking vertices and rasterizer discard";
        }
        if (d.clear) {
            return "the algorithms have no clears among the draws";
        }
        if (d.query != cases::Query::none) {
            return "the algorithms have no queries";
        }
        if (d.conservative != cases::Conservative::none) {
            return "the algorithms cover by samples, and not by area";
        }
        if (cases::asks_shading_rate(d)) {
            return "the algorithms have fragments of one pixel";
        }
        if (d.discard != cases::Discard::none || d.early_tests || d.frag_depth) {
            return "the algorithms have no shaders that discard fragments or write their depth";
        }
        if (!std::ranges::all_of(d.attributes, is_plain)) {
            return "the algorithms interpolate plain vertex attributes only";
        }
    }
    for (const cases::Triangle& t : assemble(c)) {
        const cases::Draw& d = c.draws[t.draw];
        for (const uint32_t v : t.vertex) {
            const glm::vec4& p = d.positions[v];
            if (!ref::is_projectable(p) || std::fabs(p.w) < 0x1p-126F || p.z < 0 || p.z > p.w) {
                return "the algorithms do not clip: a vertex lies before the near or behind the "
                       "far plane";
            }
            const std::optional<ref::FixedPoint> at = ref::snap_nearest(p, d.viewport, kLimits);
            if (!at || std::abs(at->x / kFixedPerUnit) > kMaxCoordinate ||
                std::abs(at->y / kFixedPerUnit) > kMaxCoordinate) {
                return "the algorithms do not clip: a vertex lies beyond their guard band of 2^21 "
                       "pixels";
            }
        }
    }
    return {};
}

std::vector<DrawnSample> draw(const cases::Case& c, const Device& device) {
    std::vector<DrawnSample> out(size_t{c.target.width} * c.target.height * c.target.samples);
    for (const cases::Triangle& t : assemble(c)) {
        const cases::Draw& d = c.draws[t.draw];
        Corners corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] =
                to_point(*ref::snap_nearest(d.positions[t.vertex[k]], d.viewport, kLimits));
        }
        const Side side = side_of(d, corners);
        if (side == Side::none) {
            continue;
        }
        const Shader shader(d, t, corners, device);
        for (uint32_t s = 0; s < c.target.samples; ++s) {
            if (!is_in_mask(d.multisample, s)) {
                continue;
            }
            const SubpixelPoint offset = to_point(ref::sample_position(0, 0, s, c.target));
            Picture picture;
            device.scan(corners, pixels_of(d, c.target, offset), offset, picture);
            for (const Span& span : picture.spans) {
                for (int64_t x = span.x0; x < span.x1; ++x) {
                    DrawnSample& sample =
                        out[static_cast<size_t>(span.y * c.target.width + x) * c.target.samples +
                            s];
                    ++(side == Side::front ? sample.front : sample.back);
                    sample.last = t;
                    shader.shade(static_cast<uint32_t>(x), static_cast<uint32_t>(span.y),
                                 sample_of(x, span.y, offset), sample.values);
                }
            }
        }
    }
    return out;
}

}  // namespace rasterizers
