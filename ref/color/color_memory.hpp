// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What fragments of the same colours leave in the same order is computed once: a tree whose root is
// the cleared target and whose edges are fragments. What a fragment leaves depends on what its
// draw does with its colour, on the colour, and on what was there: on the edge and on its node.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <unordered_map>

#include "ref/color/blend.hpp"

namespace ref::color {

// What a shader wrote, by component: every interval of it has ends in binary64. Infinite ends mean
// that nothing is known of the component, which may be NaN.
struct Source {
    std::array<double, 4> low{}, high{};
    auto operator<=>(const Source&) const = default;
};
// The same in rationals, without any rounding.
Color color_of(const Source& source);

class ColorMemory {
  public:
    // A colour, and the codes that it was found to allow last: neighbours mostly hold the same.
    struct Node {
        uint32_t number = 0;
        Color color;
        std::optional<std::array<uint32_t, 4>> accepted;
    };

    // `capacity`: so many nodes and so many edges' names are kept at most. What is beyond is not
    // remembered and has to be computed.
    ColorMemory(Color cleared, size_t capacity) : capacity_(capacity) {
        nodes_.push_back({0, std::move(cleared), {}});
    }
    Node& root() { return nodes_.front(); }

    // The name of what a draw does with a colour; nothing if there are too many. `masked`: by its
    // write mask.
    std::optional<uint32_t> name_of(uint32_t draw, bool masked, const Source& source);

    // What a fragment leaves on what a node says; `leave` computes that: Color(). Null if it is new
    // and nothing more is kept.
    template <class Leave>
    Node* after(const Node& before, uint32_t name, Leave leave) {
        const uint64_t key = uint64_t{before.number} << 32U | name;
        if (const auto found = edges_.find(key); found != edges_.end()) {
            return &nodes_[found->second];
        }
        if (nodes_.size() >= capacity_) {
            return nullptr;
        }
        const auto number = static_cast<uint32_t>(nodes_.size());
        nodes_.push_back({number, leave(), {}});
        edges_.emplace(key, number);
        return &nodes_.back();
    }

  private:
    struct Fragment {
        uint32_t draw = 0;
        bool masked = true;
        Source source;
        auto operator<=>(const Fragment&) const = default;
    };
    size_t capacity_;
    std::map<Fragment, uint32_t> names_;
    std::deque<Node> nodes_;
    std::unordered_map<uint64_t, uint32_t> edges_;  // (node, name) to node
};

}  // namespace ref::color
