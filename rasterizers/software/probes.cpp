// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/probes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

namespace software {

namespace {

using cases::Probe;

class Prober {
  public:
    Prober(const Device& device, const TrianglePlanes& planes, size_t a, int64_t i, int64_t j,
           Place place)
        : device_(device),
          planes_(planes),
          a_(a),
          right_(static_cast<int>((i + (device.odd_quads ? 1 : 0)) & 1)),
          bottom_(static_cast<int>((j + (device.odd_quads ? 1 : 0)) & 1)),
          place_(place) {}

    // Along x or y in the quad, in the pixel's own line or in the quad's first.
    glm::vec4 difference(bool along_x, bool is_coarse) const {
        const glm::vec4 d = whole_difference(along_x, is_coarse);
        return device_.fault == "derivative-halved"_fault ? d * 0.5F : d;
    }

    glm::vec4 width(bool is_coarse) const {
        return glm::abs(difference(true, is_coarse)) + glm::abs(difference(false, is_coarse));
    }

    glm::vec4 lod(const cases::Attribute& attribute) const {
        float rho = 0;
        for (const bool along_x : {true, false}) {
            const glm::vec4 d = difference(along_x, true);
            const float u = d.x * static_cast<float>(attribute.texture_size[0]);
            const float v = d.y * static_cast<float>(attribute.texture_size[1]);
            const float length = std::sqrt(u * u + v * v);
            rho = device_.fault == "lod-norm"_fault && !along_x ? std::min(rho, length)
                                                                : std::max(rho, length);
        }
        float lambda = std::log2(rho) - (device_.fault == "lod-one-less"_fault ? 1.0F : 0.0F);
        if (device_.short_levels) {
            lambda = std::clamp(lambda, -16.0F, 31.0F);
        }
        const auto levels =
            std::bit_width(std::max(attribute.texture_size[0], attribute.texture_size[1]));
        return {std::clamp(lambda, 0.0F, static_cast<float>(levels - 1)), lambda, 0, 0};
    }

  private:
    glm::vec4 whole_difference(bool along_x, bool is_coarse) const;

    glm::vec4 at(float dx, float dy) const {
        return planes_.attribute(a_, place_.x + dx, place_.y + dy);
    }

    const Device& device_;
    const TrianglePlanes& planes_;
    size_t a_;
    int right_, bottom_;
    Place place_;
};

glm::vec4 Prober::whole_difference(bool along_x, bool is_coarse) const {
    const int own = along_x ? right_ : bottom_;
    const int line = is_coarse ? -(along_x ? bottom_ : right_) : 0;
    if (device_.fault == "derivative-partial"_fault) {
        const float h = 0x1p-6F;
        const glm::vec4 plus = along_x ? at(h, 0) : at(0, h);
        return (plus - at(0, 0)) / h;
    }
    if (along_x) {
        return at(static_cast<float>(1 - own), static_cast<float>(line)) -
               at(static_cast<float>(-own), static_cast<float>(line));
    }
    const glm::vec4 d = at(static_cast<float>(line), static_cast<float>(1 - own)) -
                        at(static_cast<float>(line), static_cast<float>(-own));
    return device_.fault == "derivative-y-up"_fault ? -d : d;
}

}  // namespace

bool interpolates(Probe probe) {
    return probe == Probe::at_centroid || probe == Probe::at_sample || probe == Probe::at_offset;
}

glm::vec4 probe(const cases::Draw& draw, const Device& device, const TrianglePlanes& planes,
                std::span<const SampleOffset> samples, size_t a, int64_t i, int64_t j, Place place,
                const Invocation& invocation) {
    const cases::Attribute& attribute = draw.attributes[a];
    const Prober prober(device, planes, a, i, j, place);
    const auto at = [&](float x, float y) {
        const glm::vec4 value = planes.attribute(a, x, y);
        const bool divides = attribute.interpolation == cases::Interpolation::smooth &&
                             (device.fault == "interpolate-at-centre-w"_fault ||
                              device.fault == "one-over-w-cached"_fault);
        return divides ? value * (planes.inverse_w(x, y) /
                                  planes.inverse_w(invocation.centre.x, invocation.centre.y))
                       : value;
    };
    switch (attribute.probe) {
        case Probe::value:
            break;
        case Probe::at_centroid:
            return samples.size() > 1 ? at(invocation.centroid.x, invocation.centroid.y)
                                      : at(place.x, place.y);
        case Probe::at_sample: {
            const float unit = std::ldexp(1.0F, -device.subpixel_bits);
            const SampleOffset& s = samples[attribute.probe_sample];
            return at(static_cast<float>(i) + static_cast<float>(s.x) * unit,
                      static_cast<float>(j) + static_cast<float>(s.y) * unit);
        }
        case Probe::at_offset: {
            const auto on_grid = [&](float offset) {
                return device.fault == "offset-ignored"_fault ? 0.0F : std::floor(offset * 16) / 16;
            };
            return at(static_cast<float>(i) + 0.5F + on_grid(attribute.probe_offset[0]),
                      static_cast<float>(j) + 0.5F + on_grid(attribute.probe_offset[1]));
        }
        case Probe::dx:
        case Probe::dx_coarse:
            return prober.difference(true, true);
        case Probe::dy:
        case Probe::dy_coarse:
            return prober.difference(false, true);
        case Probe::dx_fine:
            return prober.difference(true, false);
        case Probe::dy_fine:
            return prober.difference(false, false);
        case Probe::width:
        case Probe::width_coarse:
            return prober.width(true);
        case Probe::width_fine:
            return prober.width(false);
        case Probe::lod:
            return prober.lod(attribute);
    }
    return planes.attribute(a, place.x, place.y);
}

}  // namespace software
