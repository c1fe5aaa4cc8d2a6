// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells which vertices of a case are the same to a device, and so which edges triangles share.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"

namespace ref {

class VertexNumbers {
  public:
    // Keeps a reference to the case.
    explicit VertexNumbers(const cases::Case& c);

    // The number of a vertex, at least 1. Two vertices have the same one exactly if their draws
    // have one layer, viewport and count of clip distances, and position and clip distances are
    // bitwise equal. Numbers are given out as vertices are asked for.
    uint32_t of(uint32_t draw, uint32_t vertex);

  private:
    // A vertex with its number; a slot whose number is 0 is free.
    struct Slot {
        uint32_t hash = 0, number = 0;
        uint32_t draw = 0, vertex = 0;
    };

    uint64_t hash_of(uint32_t draw, uint32_t vertex) const;
    bool is_same(const Slot& slot, uint32_t draw, uint32_t vertex) const;
    void grow();

    const cases::Case& case_;
    std::vector<uint32_t> kinds_;  // of draws: equal for equal layer, viewport, count
    std::vector<std::vector<uint32_t>> numbers_;  // per draw; 0 = not yet numbered
    // The first vertex of each number, in the first free slot from its hash on (Knuth, The Art of
    // Computer Programming 3, 6.4, algorithm L). At most half full; the size is a power of two.
    std::vector<Slot> slots_;
    uint32_t count_ = 0;
};

}  // namespace ref
