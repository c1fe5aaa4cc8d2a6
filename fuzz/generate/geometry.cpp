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

    // The next triangles of a bare list. `corners`: of a rectangle that may be filled.
    void add_plain_to(std::vector<Triangle>& all, const std::array<Position, 4>& corners) {
        const auto [a, b, c, d] = corners;
        switch (dice_.below(9)) {
            case 0:  // one triangle over all of it
                all.push_back({a, {2 * b.x - a.x, b.y}, {d.x, 2 * d.y - a.y}});
                break;
            case 1:
                all.push_back({a, b, c});
                all.push_back({a, c, d});
                break;
            case 2:
            case 3:
            case 4:
                add_rectangle(all);
                break;
            case 5: {  // next to no height, or none
                const Position p = anywhere(), q = anywhere();
                const double finer = dice_.one_in(2) ? unit() : 1 / kFinest;
                const double x = steps(1) * finer, y = steps(1) * finer;
                const double at = static_cast<double>(dice_.between(-2, 10)) / 8;
                all.push_back({p, q, {p.x + (q.x - p.x) * at + x, p.y + (q.y - p.y) * at + y}});
                break;
            }
            case 6: {  // a point, or a line along x, y or both
                const Position p = anywhere(), q = anywhere(), r = anywhere();
                const bool is_along_x = dice_.one_in(2), is_along_y = dice_.one_in(3);
                const auto beside = [&](const Position& v) {
                    return Position{is_along_x ? v.x : p.x, is_along_y ? v.y : p.y};
                };
                all.push_back({p, beside(q), beside(is_along_x && is_along_y ? q : r)});
                break;
            }
            default:
                add_to(all);
                break;
        }
    }

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

void add_indices(Shape& shape, Connection connection, bool with_restart, Dice& dice) {
    const size_t n = shape.vertices.size();
    for (size_t k = 0; k < n; ++k) {
        // Mostly each vertex in turn, now and then another one: shared and repeated vertices.
        shape.indices.push_back(static_cast<int64_t>(dice.one_in(5) ? dice.below(n) : k));
        if (with_restart && connection != Connection::list && k >= 2 && k + 3 < n &&
            dice.one_in(4)) {
            shape.indices.push_back(-1);
        }
    }
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
    if (with_indices) {
        add_indices(shape, connection, with_restart, dice);
    }
    return shape;
}

Frame placed(std::string_view place, int64_t width, int64_t height, Dice& dice) {
    // Along one side: where it begins, and how long it is.
    struct Along {
        int64_t begin, length;
    };
    const auto around = [&](int64_t side) {
        const int64_t begin = -dice.between(0, side);
        return Along{begin, side - begin + dice.between(0, side)};
    };
    const auto beside = [&](int64_t side) {
        const int64_t length = dice.one_in(2) ? side : dice.between(1, 2 * side);
        const int64_t over = dice.one_in(2) ? 0 : dice.between(-2, 2);
        return Along{dice.one_in(2) ? over - length : side + over, length};
    };
    // Longer ones and places beyond 2^15 are no viewports (cases/load/load_draw.cpp).
    const auto far = [&](int64_t side) {
        const int64_t length = int64_t{1} << dice.between(8, 14);
        const int64_t kind = dice.between(0, 3);
        return Along{kind == 0   ? -length
                     : kind == 1 ? side
                     : kind == 2 ? -length / 2
                                 : dice.between(-length, side),
                     length};
    };
    const bool is_along_x = dice.one_in(2), is_both = dice.one_in(4);
    const auto along = [&](int64_t side, bool is_placed) {
        return !is_placed && !is_both && place != "around" ? Along{0, side}
               : place == "beside"                         ? beside(side)
               : place == "far"                            ? far(side)
                                                           : around(side);
    };
    const Along x = along(width, is_along_x), y = along(height, !is_along_x);
    const bool is_flipped = dice.one_in(4);
    return {x.begin, is_flipped ? y.begin + y.length : y.begin, x.length,
            is_flipped ? -y.length : y.length};
}

Shape make_bare_shape(Dice& dice, Connection connection, bool with_indices, uint32_t width,
                      uint32_t height, const Frame& frame) {
    const bool is_framed = dice.one_in(2);
    const Frame target{0, 0, width, height};
    const Frame& all = is_framed ? frame : target;
    const auto corner = [&](int k) {
        return Position{static_cast<double>(all.x + (k % 3 == 0 ? 0 : all.width)),
                        static_cast<double>(all.y + (k < 2 ? 0 : all.height))};
    };
    Shape shape;
    if (connection != Connection::list && dice.one_in(3)) {
        // The whole of it, as a strip or a fan.
        shape.vertices = {corner(0), corner(1), corner(3), corner(2)};
        if (connection == Connection::fan) {
            std::swap(shape.vertices[2], shape.vertices[3]);
        }
    } else if (connection != Connection::list) {
        Maker maker(dice, width, height);
        const size_t count = 3 + dice.below(3);
        shape.vertices = connection == Connection::strip ? maker.zigzag(count) : maker.ring(count);
    } else {
        std::vector<Triangle> triangles;
        Maker maker(dice, width, height);
        for (uint64_t count = 1 + (dice.one_in(2) ? 0 : dice.below(3)); triangles.size() < count;) {
            maker.add_plain_to(triangles, {corner(0), corner(1), corner(2), corner(3)});
        }
        for (const Triangle& t : triangles) {
            shape.vertices.insert(shape.vertices.end(), t.begin(), t.end());
        }
    }
    if (with_indices) {
        add_indices(shape, connection, false, dice);
    }
    return shape;
}

}  // namespace fuzz
