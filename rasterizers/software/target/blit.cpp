// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/blit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cases/model/blit_source.hpp"
#include "rasterizers/software/target/store.hpp"

namespace software {

namespace {

using cases::TexelCodes;

// What the device reads along one axis for each texel of the destination.
struct Axis {
    int32_t s0, s1, d0, d1;
    uint32_t size;  // of the source
    bool contains(int32_t i, bool is_closed) const {
        return i >= std::min(d0, d1) && i < std::max(d0, d1) + (is_closed ? 1 : 0);
    }
};

class Blitter {
  public:
    Blitter(const cases::Case& c, const Device& device)
        : blit_(*c.blit),
          device_(device),
          source_(cases::blit_source(blit_)),
          from_(layout_of(blit_.source_format)),
          to_(layout_of(c.target.color->format)),
          is_copied_(blit_.source_format == c.target.color->format),
          across_{blit_.source.x0, blit_.source.x1, blit_.destination.x0, blit_.destination.x1,
                  blit_.source_width},
          down_{blit_.source.y0, blit_.source.y1, blit_.destination.y0, blit_.destination.y1,
                blit_.source_height} {
        if (device.fault == "blit-mirror-ignored"_fault) {
            for (Axis* axis : {&across_, &down_}) {
                *axis = {std::min(axis->s0, axis->s1), std::max(axis->s0, axis->s1),
                         std::min(axis->d0, axis->d1), std::max(axis->d0, axis->d1), axis->size};
            }
        }
    }

    bool writes(uint32_t x, uint32_t y) const {
        const bool closed = device_.fault == "blit-region-closed"_fault;
        return device_.fault != "draws-nothing"_fault &&
               across_.contains(static_cast<int32_t>(x), closed) &&
               down_.contains(static_cast<int32_t>(y), closed);
    }

    TexelCodes texel(uint32_t x, uint32_t y) const {
        const float u = coordinate(across_, static_cast<int32_t>(x));
        const float v = coordinate(down_, static_cast<int32_t>(y));
        const bool linear = blit_.filter == cases::BlitFilter::linear &&
                            device_.fault != "blit-filter-ignored"_fault;
        return linear ? filtered(u, v) : converted(fetch(std::floor(u), std::floor(v)));
    }

  private:
    // The source coordinate, in texels.
    float coordinate(const Axis& axis, int32_t i) const {
        const auto side = static_cast<float>(axis.d1 - axis.d0);
        float scale = static_cast<float>(axis.s1 - axis.s0) / side;
        if (device_.fault == "blit-scale-truncated"_fault && std::fabs(scale) > 1) {
            scale = std::trunc(scale);
        }
        if (device_.fault == "blit-corners-aligned"_fault && std::abs(axis.d1 - axis.d0) > 1) {
            const float last = std::fabs(static_cast<float>(axis.s1 - axis.s0)) - 1;
            scale = std::copysign(last / (std::fabs(side) - 1), scale);
        }
        const float half = device_.fault == "blit-half-texel-lost"_fault ? 0.0F : 0.5F;
        if (device_.blit_steps) {  // from texel to texel, from the region's first one on
            const int32_t first = std::min(axis.d0, axis.d1);
            float u =
                (static_cast<float>(first - axis.d0) + half) * scale + static_cast<float>(axis.s0);
            for (int32_t k = first; k < i; ++k) {
                u += scale;
            }
            return u;
        }
        return (static_cast<float>(i - axis.d0) + half) * scale + static_cast<float>(axis.s0);
    }

    // A texel, clamped at the image or, as other devices do, at the region.
    const TexelCodes& fetch(float x, float y) const {
        const auto place = [this](float at, const Axis& axis) {
            const bool region = device_.blit_edge == BlitEdge::region;
            const int low = region ? std::min(axis.s0, axis.s1) : 0;
            const int high = region ? std::max(axis.s0, axis.s1) : static_cast<int>(axis.size);
            const int texel = static_cast<int>(at);
            if (device_.fault == "blit-edge-wraps"_fault) {
                const int size = static_cast<int>(axis.size);
                return static_cast<size_t>((texel % size + size) % size);
            }
            return static_cast<size_t>(std::clamp(texel, low, high - 1));
        };
        return source_[place(y, down_) * blit_.source_width + place(x, across_)];
    }

    TexelCodes converted(const TexelCodes& texel) const {
        if (is_copied_ || device_.fault == "blit-copies-codes"_fault) {
            TexelCodes out{};
            for (size_t k = 0; k < 4; ++k) {
                const uint32_t bits = to_.channels[k].bits;
                out[k] = bits == 0 ? 0 : bits == 32 ? texel[k] : texel[k] & ((1U << bits) - 1);
            }
            return out;
        }
        if (to_.channels[0].number == Number::uint) {
            return whole(texel);
        }
        std::array<float, 4> numbers{};
        for (size_t k = 0; k < 4; ++k) {
            numbers[k] = load(texel, k);
        }
        return stored(numbers);
    }

    // A component that the source lacks.
    uint32_t missing(size_t k) const {
        return k == 3 && device_.fault != "blit-missing-alpha-zero"_fault ? 1 : 0;
    }

    // Integers are clamped to what the format holds.
    TexelCodes whole(const TexelCodes& texel) const {
        TexelCodes out{};
        for (size_t k = 0; k < 4; ++k) {
            const uint32_t code = from_.channels[k].bits == 0 ? missing(k) : texel[k];
            const uint32_t bits = to_.channels[k].bits;
            const bool cuts = device_.fault == "integer-8-bits"_fault;
            out[k] = bits == 0            ? 0
                     : bits == 8 && !cuts ? std::min(code, 0xffU)
                     : bits == 8 || cuts  ? code & 0xffU
                                          : code;
        }
        return out;
    }

    float load(const TexelCodes& texel, size_t k) const {
        if (from_.channels[k].bits == 0) {
            return static_cast<float>(missing(k));
        }
        return load_channel(texel[k], from_.channels[k], device_);
    }

    TexelCodes stored(const std::array<float, 4>& numbers) const {
        TexelCodes out{};
        for (size_t k = 0; k < 4; ++k) {
            const size_t source = device_.fault == "bgra-swapped"_fault && k < 3 ? 2 - k : k;
            out[k] = to_.channels[k].bits == 0
                         ? 0
                         : store_channel(numbers[source], to_.channels[k], device_);
        }
        return out;
    }

    TexelCodes filtered(float u, float v) const {
        const float shift = device_.fault == "blit-filter-unshifted"_fault ? 0.0F : 0.5F;
        const auto split = [&](float at, float& whole) {
            const float texel = at - shift;
            whole = std::floor(texel);
            return std::floor((texel - whole) * 256.0F + 0.5F) / 256.0F;
        };
        float column = 0;
        float row = 0;
        const float alpha = split(u, column);
        const float beta =
            device_.fault == "blit-filters-one-axis"_fault ? (split(v, row), 0.0F) : split(v, row);
        std::array<float, 4> numbers{};
        for (size_t k = 0; k < 4; ++k) {
            const auto at = [&](float x, float y) { return load(fetch(x, y), k); };
            const auto lerp = [](float a, float b, float t) { return a + (b - a) * t; };
            numbers[k] = lerp(lerp(at(column, row), at(column + 1, row), alpha),
                              lerp(at(column, row + 1), at(column + 1, row + 1), alpha), beta);
        }
        return stored(numbers);
    }

    const cases::Blit& blit_;
    const Device& device_;
    std::vector<TexelCodes> source_;
    FormatLayout from_, to_;
    bool is_copied_;  // the same format: bit for bit
    Axis across_, down_;
};

}  // namespace

capture::Capture blit(const cases::Case& c, const Device& device) {
    capture::Capture out;
    out.target = c.target;
    const FormatLayout layout = layout_of(c.target.color->format);
    capture::ColorCodes clear{};
    for (size_t k = 0; k < 4; ++k) {
        if (layout.channels[k].bits != 0) {
            clear[k] = store_channel(c.target.color->clear[static_cast<int>(k)], layout.channels[k],
                                     device);
        }
    }
    out.color.assign(out.sample_count(), clear);
    const Blitter blitter(c, device);
    for (uint32_t y = 0; y < c.target.height; ++y) {
        for (uint32_t x = 0; x < c.target.width; ++x) {
            if (blitter.writes(x, y)) {
                out.color[size_t{y} * c.target.width + x] = blitter.texel(x, y);
            }
        }
    }
    return out;
}

}  // namespace software
