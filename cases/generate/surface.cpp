// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Closed meshes of up to a million triangles, straight in clip space: their vertices are binary32
// from the start, because a rational a coordinate would take longer than drawing them. Only +, -,
// *, / and sqrt of binary64 are used, which IEEE 754 rounds alike on every machine, and integer
// draws.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases/generate/generator_keys.hpp"

namespace cases {

namespace {

constexpr std::array<std::string_view, 4> kShape = {"plane", "terrain", "sphere", "disc"};
constexpr int64_t kMaxSide = 4096;

struct Vector {
    double x = 0, y = 0, z = 0, w = 1;
};

// A number in [0, 1) that depends on a lattice point and the seed: splitmix64's finalizer
// (Steele, Lea and Flood 2014).
double noise(uint64_t seed, int64_t i, int64_t j) {
    uint64_t n = seed * 0x9e3779b97f4a7c15U + static_cast<uint64_t>(i) * 0xbf58476d1ce4e5b9U +
                 static_cast<uint64_t>(j) * 0x94d049bb133111ebU;
    n = (n ^ (n >> 30U)) * 0xbf58476d1ce4e5b9U;
    n = (n ^ (n >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<double>((n ^ (n >> 31U)) >> 40U) * 0x1p-24;
}

// Noise on an 8 x 8 lattice over [0,1]^2, linear in between.
double height(uint64_t seed, double u, double v) {
    constexpr double kCells = 8;
    const double i = std::floor(u * kCells);
    const double j = std::floor(v * kCells);
    const double s = u * kCells - i;
    const double t = v * kCells - j;
    const auto at = [&](int64_t di, int64_t dj) {
        return noise(seed, static_cast<int64_t>(i) + di, static_cast<int64_t>(j) + dj);
    };
    return (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
}

class SurfaceMaker {
  public:
    SurfaceMaker(int64_t columns, int64_t rows, uint64_t seed, const Vector& center, double radius)
        : columns_(columns), rows_(rows), seed_(seed), center_(center), radius_(radius) {
        result_.indices.emplace();
    }

    // Room for a mesh of so many.
    void reserve(int64_t vertices, int64_t triangles) {
        result_.clip.reserve(static_cast<size_t>(vertices));
        result_.indices->reserve(3 * static_cast<size_t>(triangles));
    }

    // A lattice over [-1,1]^2; each inner vertex is moved by up to 1/4 of a cell.
    void plane() {
        lattice([&](int64_t i, int64_t j) {
            const auto move = [&](int64_t k, int64_t n, uint64_t salt) {
                const double jitter = k > 0 && k < n ? (noise(seed_ + salt, i, j) - 0.5) / 2 : 0;
                return (2 * (static_cast<double>(k) + jitter)) / static_cast<double>(n) - 1;
            };
            return Vector{move(i, columns_, 0), move(j, rows_, 1), 0.5, 1};
        });
    }

    // A landscape seen from above its near edge: distance d = w from 1 to 4, heights up to 1/32, so
    // that no hill hides another.
    void terrain() {
        lattice([&](int64_t i, int64_t j) {
            const double u = static_cast<double>(i) / static_cast<double>(columns_);
            const double v = static_cast<double>(j) / static_cast<double>(rows_);
            const double d = 4 - 3 * v;  // the far edge is the upper one
            return Vector{2 * u - 1, 1 - height(seed_, u, v) / 32, d - 1, d};
        });
    }

    // An octahedron whose eight faces are cut into rows^2 triangles, blown up; seen from 2.5 radii.
    void sphere() {
        for (uint32_t face = 0; face < 8; ++face) {
            const std::array<double, 3> sign = {(face & 1U) != 0 ? -1.0 : 1.0,
                                                (face & 2U) != 0 ? -1.0 : 1.0,
                                                (face & 4U) != 0 ? -1.0 : 1.0};
            const auto first = static_cast<uint32_t>(result_.clip.size());
            for (int64_t b = 0; b <= rows_; ++b) {
                for (int64_t a = 0; a <= rows_ - b; ++a) {
                    const std::array<int64_t, 3> p = {a, b, rows_ - a - b};
                    std::array<double, 3> unit{};
                    double square = 0;
                    for (size_t k = 0; k < 3; ++k) {
                        // No negative zero: seams must be the same bits from both sides.
                        unit.at(k) = p.at(k) == 0 ? 0 : sign.at(k) * static_cast<double>(p.at(k));
                        square += unit.at(k) * unit.at(k);
                    }
                    const double length = std::sqrt(square);
                    const double z = unit[2] / length;
                    add({2 * unit[0] / length, 2 * unit[1] / length, 1.25 * (1.5 + z), 2.5 + z});
                }
            }
            // Row b begins after the rows_ + 1, rows_, ... vertices before it.
            const auto at = [&](int64_t a, int64_t b) {
                return first + static_cast<uint32_t>(b * (rows_ + 1) - b * (b - 1) / 2 + a);
            };
            const bool is_mirrored = sign[0] * sign[1] * sign[2] < 0;
            for (int64_t b = 0; b < rows_; ++b) {
                for (int64_t a = 0; a < rows_ - b; ++a) {
                    add_triangle(at(a, b), at(a + 1, b), at(a, b + 1), is_mirrored);
                    if (a + b + 1 < rows_) {
                        add_triangle(at(a + 1, b), at(a + 1, b + 1), at(a, b + 1), is_mirrored);
                    }
                }
            }
        }
    }

    // `columns` needles around the centre; the rim by the rational parametrization of the circle.
    void disc() {
        add({0, 0, 0.5, 1});
        for (int64_t k = 0; k < columns_; ++k) {
            const int64_t quadrant = 4 * k / columns_;
            const double t =
                static_cast<double>(4 * k - quadrant * columns_) / static_cast<double>(columns_);
            const double c = (1 - t * t) / (1 + t * t);
            const double s = 2 * t / (1 + t * t);
            const std::array<Vector, 4> turned = {
                {{c, s, 0.5, 1}, {-s, c, 0.5, 1}, {-c, -s, 0.5, 1}, {s, -c, 0.5, 1}}};
            add(turned.at(static_cast<size_t>(quadrant)));
        }
        for (int64_t k = 0; k < columns_; ++k) {
            add_triangle(0, static_cast<uint32_t>(1 + k),
                         static_cast<uint32_t>(1 + (k + 1) % columns_), true);
        }
    }

    Generated take() { return std::move(result_); }

  private:
    // x_c = center w + radius x, and y likewise; rounded once to binary32.
    void add(const Vector& v) {
        result_.clip.emplace_back(static_cast<float>(center_.x * v.w + radius_ * v.x),
                                  static_cast<float>(center_.y * v.w + radius_ * v.y),
                                  static_cast<float>(v.z), static_cast<float>(v.w));
    }
    void add_triangle(uint32_t a, uint32_t b, uint32_t c, bool is_turned) {
        for (const uint32_t vertex : {a, is_turned ? c : b, is_turned ? b : c}) {
            result_.indices->push_back(vertex);
        }
    }
    template <class At>
    void lattice(At at) {
        for (int64_t j = 0; j <= rows_; ++j) {
            for (int64_t i = 0; i <= columns_; ++i) {
                add(at(i, j));
            }
        }
        for (int64_t j = 0; j < rows_; ++j) {
            for (int64_t i = 0; i < columns_; ++i) {
                const auto a = static_cast<uint32_t>(j * (columns_ + 1) + i);
                const uint32_t c = a + static_cast<uint32_t>(columns_) + 1;
                add_triangle(a, c, a + 1, false);
                add_triangle(a + 1, c, c + 1, false);
            }
        }
    }

    int64_t columns_, rows_;
    uint64_t seed_;
    Vector center_;
    double radius_;
    Generated result_;
};

}  // namespace

std::optional<Generated> generate_surface(GeneratorKeys& keys) {
    const size_t shape = keys.word("shape", kShape, 0);
    const bool is_disc = shape == 3;
    const int64_t columns = keys.integer(
        "columns", is_disc ? 3 : 1, is_disc ? static_cast<int64_t>(kMaxVertices) - 1 : kMaxSide,
        shape == 2 ? std::optional<int64_t>(1) : std::nullopt);
    const int64_t rows =
        keys.integer("rows", 1, kMaxSide, is_disc ? std::optional<int64_t>(1) : std::nullopt);
    const ExactPoint center = keys.point("center", ExactPoint{0, 0});
    const mpq_class radius = keys.length("radius", mpq_class(1));
    const uint64_t seed = keys.seed();
    if (!keys.good()) {
        return std::nullopt;
    }
    const int64_t vertices = shape == 2 ? 4 * (rows + 1) * (rows + 2)
                             : is_disc  ? columns + 1
                                        : (columns + 1) * (rows + 1);
    if (vertices > static_cast<int64_t>(kMaxVertices)) {
        keys.error("columns", fmt::format("{} vertices are too many; a draw has at most {}",
                                          vertices, kMaxVertices));
        return std::nullopt;
    }
    SurfaceMaker maker(columns, rows, seed, {center.x.get_d(), center.y.get_d(), 0, 1},
                       radius.get_d());
    maker.reserve(vertices, shape == 2 ? 8 * rows * rows : is_disc ? columns : 2 * columns * rows);
    switch (shape) {
        case 0:
            maker.plane();
            break;
        case 1:
            maker.terrain();
            break;
        case 2:
            maker.sphere();
            break;
        default:
            maker.disc();
    }
    return maker.take();
}

}  // namespace cases
