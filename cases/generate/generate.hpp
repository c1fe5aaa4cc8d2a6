// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertices made by a rule instead of a list: everything is a function of the keys alone. Random
// numbers come from std::mt19937_64, whose sequence the C++ standard fixes, by integer draws only.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <random>
#include <vector>

#include "cases/generate/vertices.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

struct Generated {
    Topology topology = Topology::triangle_list;
    std::vector<ExactVertex> vertices;  // pixels
    std::optional<std::vector<uint32_t>> indices;
    std::vector<glm::vec4> clip;  // instead of `vertices`: clip space, for meshes at scale
};

// The table `generate` of a draw.
std::optional<Generated> generate(LeafContext& context, const TomlValue& table,
                                  const Target& target);

// Draws uniform integers, which are the same on every machine.
class Random {
  public:
    explicit Random(uint64_t seed) : engine_(seed) {}
    // One of [low, high]; high - low < 2^63. It rejects the highest draws, so it is uniform.
    int64_t between(int64_t low, int64_t high) {
        const uint64_t range = static_cast<uint64_t>(high) - static_cast<uint64_t>(low) + 1;
        const uint64_t limit = UINT64_MAX - UINT64_MAX % range;
        uint64_t draw = engine_();
        while (draw >= limit) {
            draw = engine_();
        }
        return static_cast<int64_t>(static_cast<uint64_t>(low) + draw % range);
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace cases
