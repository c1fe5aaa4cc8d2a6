// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the generators share: reading their keys, rounding to a grid, exact areas.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/generate/generate.hpp"

namespace cases {

struct ExactPoint {
    mpq_class x, y;  // pixels
};

// Reads the keys of one generator by type. A key that is missing takes its default or is an error;
// after any mistake good() is false.
class GeneratorKeys {
  public:
    GeneratorKeys(LeafContext& context, const TomlValue& table, const Target& target)
        : context_(context),
          table_(table),
          target_(target),
          errors_before_(context.errors().size()) {}

    const Target& target() const { return target_; }
    bool good() const { return context_.errors().size() == errors_before_; }
    // A mistake at a key (or at the table if the key is not given).
    void error(const char* key, std::string message);

    int64_t integer(const char* key, int64_t low, int64_t high, std::optional<int64_t> otherwise);
    // A number >= 0.
    mpq_class length(const char* key, std::optional<mpq_class> otherwise);
    ExactPoint point(const char* key, std::optional<ExactPoint> otherwise);
    bool boolean(const char* key);  // false if missing
    size_t word(const char* key, std::span<const std::string_view> words, size_t otherwise);
    // The denominator of positions; 0 if they are not rounded.
    int64_t grid() { return integer("grid", 0, 65536, 256); }
    uint64_t seed() { return static_cast<uint64_t>(integer("seed", 0, INT64_MAX, 1)); }
    // The rectangle from..to, which is the whole target if not given. An empty one is an error.
    struct Rectangle {
        ExactPoint from, to;
    };
    Rectangle rectangle();
    // What w = [lo, hi] says, in multiples of 1/256; nothing if it is not given.
    struct WRange {
        int64_t low = 256, high = 256;  // 1/256
    };
    std::optional<WRange> w_range();

  private:
    LeafContext& context_;
    const TomlValue& table_;
    const Target& target_;
    size_t errors_before_;
};

// The largest integer that is not larger.
mpz_class floor_of(const mpq_class& q);

// The nearest multiple of 1/grid, ties upward; unchanged if grid is 0.
mpq_class on_grid(const mpq_class& value, int64_t grid);
ExactPoint on_grid(const ExactPoint& p, int64_t grid);

// (b - a) x (c - a): twice the area, positive if a, b, c run clockwise on screen.
mpq_class twice_area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);

// Gives every vertex its own w from the range.
void draw_w(std::vector<ExactVertex>& vertices, const std::optional<GeneratorKeys::WRange>& range,
            Random& random);

// Exchanges triangles at random and turns each to start at a random vertex.
void shuffle_triangles(std::vector<uint32_t>& indices, Random& random);

// The generators, one a kind. They return nothing after a mistake.
std::optional<Generated> generate_grid(GeneratorKeys& keys);
std::optional<Generated> generate_fan(GeneratorKeys& keys);
std::optional<Generated> generate_strip(GeneratorKeys& keys);
std::optional<Generated> generate_mesh(GeneratorKeys& keys);
std::optional<Generated> generate_triangles(GeneratorKeys& keys);
std::optional<Generated> generate_surface(GeneratorKeys& keys);

}  // namespace cases
