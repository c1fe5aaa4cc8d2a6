// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fuzz {

namespace {

constexpr double kFinest = 4096;  // units a pixel
// Of positions: whole pixels, pixel centres, quarters, ..., the finest grid that a device must have
// (1/16), the commonest (1/256), and none that it has.
constexpr std::array<double, 7> kGrids = {1, 2, 4, 16, 256, 256, kFinest};

using Triangle = std::array<Position, 3>;

class Maker {
  public:
    Maker(Dice& dice, uint32_t width, uint32_t height)
        : dice_(dice), width_(width), height_(height), grid_(dice.of(kGrids)) {}

    // Anywhere on and a quarter beside the target.
    Position anywhere() { return {along(width_), along(height_)}; }

    // The next triangles of a list: one, or several that belong together.
    void add_to(std::vector<Triangle>& all) {
        const Triangle last =
            all.empty() ? Triangle{anywhere(), anywhere(), anywhere()} : all.back();
        switch (dice_.below(13)) {
            case 0:  // small, a few pixels
                all.push_back(around(anywhere(), 3));
                break;
            case 1:  // covers much of the target
                all.push_back({on_grid({-0.25 * width_, -0.25 * height_}),
                               on_grid({1.75 * width_, along(height_) * 0.25}),
                               on_grid({along(width_) * 0.25, 1.75 * height_})});
                break;
            case 2:
            case 3:
                add_rectangle(all);
                break;
            case 4: {  // a sliver: the third vertex a unit or two beside the line of the others
                const Position a = anywhere(), b = anywhere();
                const double at = static_cast<double>(dice_.between(-4, 20)) / 16;
                all.push_back({a, b,
                               on_grid({a.x + (b.x - a.x) * at + unit() * steps(2),
                                        a.y + (b.y - a.y) * at + unit() * steps(2)})});
                break;
            }
            case 5: {  // degenerate: a repeated vertex, or all on one line
                const Position a = anywhere(), b = anywhere();
                all.push_back(dice_.one_in(2) ? Triangle{a, b, a}
                                              : Triangle{a, b, {2 * b.x - a.x, 2 * b.y - a.y}});
                break;
            }
            case 6:  // inside one pixel
                all.push_back(around(anywhere(), 0.5));
                break;
            case 7: {  // huge
                const double far = std::ldexp(1.0, static_cast<int>(dice_.between(7, 14)));
                all.push_back({anywhere(), on_grid({far * steps(4) / 4, far * steps(4) / 4}),
                               on_grid({far * steps(4) / 4, far * steps(4) / 4})});
                break;
            }
            case 8:  // the last one again, from another vertex, of either winding
                all.push_back(dice_.one_in(2) ? Triangle{last[1], last[2], last[0]}
                                              : Triangle{last[2], last[1], last[0]});
                break;
            case 9:
            case 10:  // shares an edge with the last one, in the other direction
                all.push_back({last[2], last[1], anywhere()});
                break;
            default:
                all.push_back({anywhere(), anywhere(), anywhere()});
                break;
        }
    }

    std::vector<Position> ring(size_t count) {  // a centre, and vertices around it
        const Position centre = anywhere();
        const double radius =
            static_cast<double>(dice_.between(2, static_cast<int64_t>(std::max(width_, height_))));
        std::vector<Position> out{centre};
        for (size_t k = 0; k < count; ++k) {
            const double turn =
                2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count - 1);
            out.push_back(dice_.one_in(8) ? anywhere()
                                          : on_grid({centre.x + radius * std::cos(turn),
                                                     centre.y + radius * std::sin(turn)}));
        }
        return out;
    }

    std::vector<Position> zigzag(size_t count) {
        std::vector<Position> out;
        const double top = along(height_), bottom = along(height_);
        for (size_t k = 0; k < count; ++k) {
            const double x = width_ * static_cast<double>(k) / static_cast<double>(count - 1);
            out.push_back(dice_.one_in(6) ? anywhere() : on_grid({x, k % 2 == 0 ? top : bottom}));
        }
        return out;
    }

  private:
    double unit() const { return 1 / grid_; }
    double steps(int64_t most) { return static_cast<double>(dice_.between(-most, most)); }
    Position on_grid(Position p) const {
        return {std::round(p.x * grid_) / grid_, std::round(p.y * grid_) / grid_};
    }
    double along(double side) {
        const auto quarter = static_cast<int64_t>(side * grid_ / 4);
        return static_cast<double>(dice_.between(-quarter, 5 * quarter)) / grid_;
    }
    Triangle around(Position p, double reach) {
        Triangle out;
        for (Position& v : out) {
            const auto far = std::max(int64_t{1}, static_cast<int64_t>(reach * kFinest));
            v = {p.x + static_cast<double>(dice_.between(-far, far)) / kFinest,
                 p.y + static_cast<double>(dice_.between(-far, far)) / kFinest};
            v = dice_.one_in(2) ? v : on_grid(v);
        }
        return out;
    }
    // A rectangle of two triangles, or nearly one: drivers know rectangles, and rasterize them
    // otherwise.
    void add_rectangle(std::vector<Triangle>& all) {
        const Position a = anywhere(), b = anywhere();
        std::array<Position, 4> corner = {a, Position{b.x, a.y}, b, Position{a.x, b.y}};
        if (dice_.one_in(3)) {
            Position& moved = corner[dice_.below(4)];
            (dice_.one_in(2) ? moved.x : moved.y) += unit() * (dice_.one_in(2) ? 1 : -1);
        }
        const uint64_t first = dice_.below(4);
        const auto at = [&](uint64_t k) { return corner[(first + k) % 4]; };
        all.push_back({at(0), at(1), at(2)});
        all.push_back(dice_.one_in(4) ? Triangle{at(0), at(3), at(2)}
                                      : Triangle{at(0), at(2), at(3)});
    }

    Dice& dice_;
    double width_, height_;
    double grid_;
};

size_t count_of(Dice& dice) {  // of triangles
    const uint64_t kind = dice.below(20);
    return 1 + static_cast<size_t>(kind < 9    ? dice.below(2)
                                   : kind < 16 ? dice.below(6)
                                   : kind < 19 ? dice.below(24)
                                               : dice.below(96));
}

}  // namespace

Shape make_shape(Dice& dice, Connection connection, bool with_indices, bool with_restart,
                 uint32_t width, uint32_t height) {
    Maker maker(dice, width, height);
    const size_t count = count_of(dice);
    Shape shape;
    if (connection == Connection::list) {
        std::vector<Triangle> triangles;
        while (triangles.size() < count) {
            maker.add_to(triangles);
        }
        for (const Triangle& t : triangles) {
            shape.vertices.insert(shape.vertices.end(), t.begin(), t.end());
        }
    } else {
        shape.vertices =
            connection == Connection::strip ? maker.zigzag(count + 2) : maker.ring(count + 1);
    }
    if (!with_indices) {
        return shape;
    }
    const size_t n = shape.vertices.size();
    for (size_t k = 0; k < n; ++k) {
        // Mostly each vertex in turn, now and then another one: shared and repeated vertices.
        shape.indices.push_back(static_cast<int64_t>(dice.one_in(5) ? dice.below(n) : k));
        if (with_restart && connection != Connection::list && k >= 2 && k + 3 < n &&
            dice.one_in(4)) {
            shape.indices.push_back(-1);
        }
    }
    return shape;
}

}  // namespace fuzz
