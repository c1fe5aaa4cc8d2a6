// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Independent random triangles of a class.
#include <algorithm>
#include <array>
#include <cstdlib>

#include "cases/generate/delaunay.hpp"
#include "cases/generate/generator_keys.hpp"

namespace cases {

namespace {

enum class Class : uint8_t { on_grid, off_grid, sliver, tiny, huge, clipped };
constexpr std::array<std::string_view, 6> kClasses = {"on-grid", "off-grid", "sliver",
                                                      "tiny",    "huge",     "clipped"};
constexpr int64_t kFiner = 251;     // off-grid positions: a prime number of parts a grid step
constexpr int64_t kHugeReach = 16;  // rectangles beyond each side
constexpr int64_t kMaxTriangles = 65536;
// Of the classes whose triangles are as large as the rectangle, and so lie over each other.
constexpr int64_t kMaxLarge = 4096;
constexpr int64_t kWithoutGrid = 256;  // the lattice's denominator if grid = 0

using Triangle = std::array<LatticePoint, 3>;

class TriangleMaker {
  public:
    TriangleMaker(Class kind, const LatticePoint& low, const LatticePoint& high, int64_t pixel,
                  Random& random)
        : kind_(kind), low_(low), high_(high), pixel_(pixel), random_(random) {}

    // Draws until the triangle has an area and its class's property.
    Triangle make() {
        while (true) {
            const Triangle t = draw();
            if (orientation(t[0], t[1], t[2]) != 0 && (kind_ != Class::huge || holds_centre(t))) {
                return t;
            }
        }
    }

  private:
    LatticePoint inside() {
        return {random_.between(low_.x, high_.x), random_.between(low_.y, high_.y)};
    }

    Triangle draw() {
        switch (kind_) {
            case Class::tiny: {
                const LatticePoint p = inside();
                const auto near = [&]() {
                    return LatticePoint{p.x + random_.between(0, pixel_),
                                        p.y + random_.between(0, pixel_)};
                };
                return {near(), near(), near()};
            }
            case Class::sliver: {
                // The third vertex lies within one step of a point of the first two's line.
                const LatticePoint a = inside();
                const LatticePoint b = inside();
                const int64_t part = random_.between(0, 256);
                const LatticePoint c{a.x + (b.x - a.x) * part / 256 + random_.between(-1, 1),
                                     a.y + (b.y - a.y) * part / 256 + random_.between(-1, 1)};
                return {a, b, c};
            }
            case Class::huge: {
                const int64_t width = high_.x - low_.x;
                const int64_t height = high_.y - low_.y;
                const auto far = [&]() {
                    return LatticePoint{
                        random_.between(low_.x - kHugeReach * width, high_.x + kHugeReach * width),
                        random_.between(low_.y - kHugeReach * height,
                                        high_.y + kHugeReach * height)};
                };
                return {far(), far(), far()};
            }
            default:
                return {inside(), inside(), inside()};
        }
    }

    bool holds_centre(const Triangle& t) const {
        const LatticePoint centre{(low_.x + high_.x) / 2, (low_.y + high_.y) / 2};
        const bool side = orientation(t[0], t[1], t[2]) > 0;
        for (size_t i = 0; i < 3; ++i) {
            const int64_t o = orientation(t.at(i), t.at((i + 1) % 3), centre);
            if (o == 0 || (o > 0) != side) {
                return false;
            }
        }
        return true;
    }

    Class kind_;
    LatticePoint low_, high_;
    int64_t pixel_;
    Random& random_;
};

// Moves one or two vertices out of the clip volume: before the near plane, beyond the far plane, or
// behind the eye (w < 0).
void push_out(std::array<ExactVertex, 3>& t, Random& random) {
    const int64_t first = random.between(0, 2);
    const int64_t count = random.between(1, 2);
    for (int64_t i = 0; i < count; ++i) {
        ExactVertex& v = t.at(static_cast<size_t>((first + i) % 3));
        switch (random.between(0, 2)) {
            case 0:
                v.xyzw[2].value = mpq_class(-random.between(1, 256), 256);
                break;
            case 1:
                v.xyzw[2].value = mpq_class(256 + random.between(1, 256), 256);
                break;
            default:
                v.xyzw[3].value = -v.w();
                break;
        }
        v.xyzw[2].value.canonicalize();
    }
}

}  // namespace

std::optional<Generated> generate_triangles(GeneratorKeys& keys) {
    const auto kind = static_cast<Class>(keys.word("class", kClasses, 0));
    const bool is_small = kind == Class::tiny || kind == Class::sliver;
    const int64_t count =
        keys.integer("count", 1, is_small ? kMaxTriangles : kMaxLarge, std::nullopt);
    const GeneratorKeys::Rectangle r = keys.rectangle();
    const int64_t given_grid = keys.grid();
    const std::optional<GeneratorKeys::WRange> w = keys.w_range();
    Random random(keys.seed());
    if (!keys.good()) {
        return std::nullopt;
    }
    // Everything happens on a lattice of 1/pixel; off-grid triangles, and all without a grid, on
    // one that is finer by a prime and so misses every grid of a power of two.
    const int64_t grid = given_grid == 0 ? kWithoutGrid : given_grid;
    const bool finer = kind == Class::off_grid || given_grid == 0;
    const int64_t pixel = finer ? grid * kFiner : grid;
    const mpq_class scale(pixel);
    const LatticePoint low{-floor_of(-r.from.x * scale).get_si(),
                           -floor_of(-r.from.y * scale).get_si()};
    const LatticePoint high{floor_of(r.to.x * scale).get_si(), floor_of(r.to.y * scale).get_si()};
    const int64_t reach =
        std::max({std::llabs(low.x), std::llabs(low.y), std::llabs(high.x), std::llabs(high.y)});
    if (high.x - low.x < 2 || high.y - low.y < 2) {
        keys.error("to", "the rectangle is smaller than two grid steps; make it larger");
        return std::nullopt;
    }
    // Keeps the orientation's products of differences below 2^63.
    if (reach > (int64_t{1} << (kind == Class::huge ? 24U : 29U))) {
        keys.error("grid",
                   "the rectangle has too many grid steps; make it smaller or grid coarser");
        return std::nullopt;
    }
    TriangleMaker maker(kind, low, high, pixel, random);
    Generated result;
    for (int64_t i = 0; i < count; ++i) {
        Triangle t = maker.make();
        if (finer) {
            for (LatticePoint& p : t) {
                // No coordinate on the coarse grid itself.
                p.x += p.x % kFiner == 0 ? 1 : 0;
                p.y += p.y % kFiner == 0 ? 1 : 0;
            }
            if (orientation(t[0], t[1], t[2]) == 0) {
                --i;
                continue;
            }
        }
        std::array<ExactVertex, 3> vertices;
        for (size_t v = 0; v < 3; ++v) {
            mpq_class x(t.at(v).x, pixel);
            mpq_class y(t.at(v).y, pixel);
            x.canonicalize();
            y.canonicalize();
            vertices.at(v) = exact_vertex(x, y);
        }
        result.vertices.insert(result.vertices.end(), vertices.begin(), vertices.end());
    }
    draw_w(result.vertices, w, random);
    if (kind == Class::clipped) {
        for (size_t i = 0; i < result.vertices.size(); i += 3) {
            std::array<ExactVertex, 3> t = {result.vertices[i], result.vertices[i + 1],
                                            result.vertices[i + 2]};
            push_out(t, random);
            std::ranges::copy(t, result.vertices.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
    return result;
}

}  // namespace cases
