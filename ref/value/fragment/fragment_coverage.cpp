// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/fragment_coverage.hpp"

#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/fast/half_plane.hpp"
#include "ref/number/fixed_point.hpp"

namespace ref {

namespace {

using Points = std::vector<value::Point<mpq_class>>;

template <class Classify>
PixelCoverage coverage_of(const cases::Target& target, const TriangleSetup& setup,
                          const cases::PixelBlock& block, Classify classify) {
    PixelCoverage out;
    out.is_one_fragment = !setup.is_clipped;
    const auto add = [&](const cases::SampleId& id) {
        const uint32_t j = cases::coverage_index(block, target, id);
        // Beyond the framebuffer there are no samples.
        if (j >= cases::kMaxFragmentSamples || id.x >= target.width || id.y >= target.height) {
            return;
        }
        switch (classify(setup, sample_position(id.x, id.y, id.sample, target))) {
            case Coverage::must:
                out.must |= 1U << j;
                out.may |= 1U << j;
                break;
            case Coverage::either:
                out.may |= 1U << j;
                break;
            case Coverage::must_not:
                break;
        }
    };
    for (uint32_t y = block.y; y < block.y + block.height; ++y) {
        for (uint32_t x = block.x; x < block.x + block.width; ++x) {
            for (uint32_t s = 0; s < target.samples; ++s) {
                add({x, y, s});
            }
        }
    }
    return out;
}

}  // namespace

Points cut(const Points& polygon, const value::Form<mpq_class>& inside) {
    Points out;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const value::Point<mpq_class>& a = polygon[i];
        const value::Point<mpq_class>& b = polygon[(i + 1) % polygon.size()];
        const mpq_class at_a = inside.at(a);
        const mpq_class at_b = inside.at(b);
        if (at_a >= 0) {
            out.push_back(a);
        }
        if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
            const mpq_class t = at_a / (at_a - at_b);
            out.push_back({mpq_class(a.x + t * (b.x - a.x)), mpq_class(a.y + t * (b.y - a.y))});
        }
    }
    return out;
}

Points pixel_region(const TriangleSetup& setup, const cases::PixelBlock& block) {
    const mpq_class x0(block.x), y0(block.y), x1(block.x + block.width), y1(block.y + block.height);
    Points region = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    if (setup.kind != TriangleSetup::Kind::outlines || !setup.has_outline) {
        return region;
    }
    // Clip distances may leave nothing; what a device draws all the same, which tests them sample
    // by sample, has no bounds then.
    if (setup.unclipped.vertices().empty()) {
        return region;
    }
    // The unclipped outline holds the clipped one: "within the bounds of the primitive".
    const fast::ConvexSet hull = fast::hull_set(setup.unclipped.vertices());
    const mpq_class unit(kFixedOne);
    const auto side = [](int a, int b, const mpq_class& c) {
        return value::Form<mpq_class>{mpq_class(a), mpq_class(b), c};
    };
    region = cut(region, side(1, 0, mpq_class(-hull.bounds.x0) / unit));
    region = cut(region, side(-1, 0, mpq_class(hull.bounds.x1) / unit));
    region = cut(region, side(0, 1, mpq_class(-hull.bounds.y0) / unit));
    region = cut(region, side(0, -1, mpq_class(hull.bounds.y1) / unit));
    for (const HalfPlane& h : hull.planes) {
        // S47.16 to pixels: a X + b Y + c with X = 2^16 x.
        const mpq_class a(to_mpz(h.a)), b(to_mpz(h.b)), c(to_mpz(h.c));
        region = cut(region, {mpq_class(a * unit), mpq_class(b * unit), c});
    }
    return region;
}

FragmentCoverage::FragmentCoverage(const cases::Case& c, const Limits& limits,
                                   cases::Profile profile,
                                   const std::vector<cases::Triangle>& triangles)
    : case_(c), triangles_(triangles), setups_(c, triangles, limits, profile, false, false) {}

const PixelCoverage& FragmentCoverage::of(uint32_t t, uint32_t x, uint32_t y) {
    const cases::PixelBlock block = block_of(t, x, y);
    if (!last_ || !last_->is_of(t, block)) {
        last_ = {t, block, coverage_of(case_.target, setups_[t], block, fast::classify)};
    }
    return last_->answer;
}

const Points& FragmentCoverage::region(uint32_t t, uint32_t x, uint32_t y) {
    const cases::PixelBlock block = block_of(t, x, y);
    if (!last_region_ || !last_region_->is_of(t, block)) {
        last_region_ = {t, block, pixel_region(setups_[t], block)};
    }
    return last_region_->answer;
}

PixelCoverage FragmentCoverage::exact(uint32_t t, uint32_t x, uint32_t y) {
    return coverage_of(case_.target, setups_[t], block_of(t, x, y), exact::classify);
}

}  // namespace ref
