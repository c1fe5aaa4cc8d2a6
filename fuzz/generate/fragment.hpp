// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a generated draw does with the depth of its fragments and of what is stored, and what it
// counts: depth bounds, depths that the shader writes, queries.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

// Depths that may be stored when a draw begins: later draws meet them exactly, or just not.
class StoredDepths {
  public:
    StoredDepths(const Pose& pose, double clear);
    void add(double depth) { depths_.push_back(depth); }
    double any(Dice& dice) const;
    // One of them, the next number of binary32 or of the format beside it, or any number.
    double near(Dice& dice) const;

  private:
    double beside(double depth, Dice& dice) const;

    double step_ = 0;  // of the format's numbers; 0: those of binary32
    std::vector<double> depths_;
};

// `{ constant = 3, slope = 0.5 }`. What r is, which few devices let a draw say, is said in some
// cases by `control` alone: the others of such a pose are drawn everywhere.
std::string bias_of(const Pose& pose, Dice& turn, Dice& control);

// `[minimum, maximum]` of draw `number` of `draws`; empty without a test.
std::string bounds_of(const Pose& pose, size_t number, size_t draws, const StoredDepths& stored,
                      Dice& dice);

// The smallest and the largest depth that vertices of the pose are given, in the viewport's range
// 0..1. They leave room on both sides for depths that a layout promises to be greater or less.
std::array<double, 2> vertex_depths(const Pose& pose);

// The value of the key `frag_depth` of draw `number` of `draws`, whose viewport has these depths;
// empty without one. The depths that the draw may store are added to `stored`. `state` decides what
// costs a pipeline.
std::string frag_depth_of(const Pose& pose, size_t number, size_t draws,
                          std::array<double, 2> viewport, StoredDepths& stored, Dice& state,
                          Dice& dice);

// The keys of what the draw's shader discards, each line with its end; empty if it discards
// nothing.
std::string discard_of(const Pose& pose, Dice& dice);

// The word of the draw's query; empty without one.
std::string query_of(const Pose& pose, size_t number, size_t draws, Dice& dice);

}  // namespace fuzz
