// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/assembly.hpp"

#include <algorithm>
#include <utility>

namespace software {

namespace {

// The state machine of an input assembler.
class Assembler {
  public:
    Assembler(const cases::Draw& draw, Fault fault)
        : topology_(draw.topology),
          is_last_((draw.provoking == cases::ProvokingVertex::last) !=
                   (fault == "provoking-mode-ignored"_fault &&
                    draw.provoking == cases::ProvokingVertex::last)),
          fault_(fault) {}

    void restart() {
        if (fault_ == "restart-ignored"_fault) {
            return;
        }
        if (fault_ == "restart-keeps-one"_fault && count_ > 0) {
            window_[0] = window_[std::min<uint32_t>(count_, 2) - 1];
            count_ = 1;
            odd_ = false;
            return;
        }
        count_ = 0;
        odd_ = false;
        run_ = 0;
        if (fault_ == "primitive-id-restarts"_fault) {
            next_id_ = 0;
        }
    }

    void push(uint32_t vertex) {
        if (count_ < 2) {
            window_[count_] = vertex;
            ++count_;
            return;
        }
        const uint32_t a = window_[0];
        const uint32_t b = window_[1];
        switch (topology_) {
            case cases::Topology::triangle_list:
                emit({a, b, vertex}, a, vertex);
                count_ = 0;
                break;
            case cases::Topology::triangle_strip:
                if (odd_ && fault_ != "strip-parity"_fault) {
                    emit({a, vertex, b}, a, fault_ == "provoking-strip-odd"_fault ? b : vertex);
                } else {
                    emit({a, b, vertex}, a, vertex);
                }
                odd_ = fault_ == "strip-batch-parity"_fault && run_ % 9 == 0 ? false : !odd_;
                window_ = {b, vertex};
                break;
            case cases::Topology::triangle_fan:  // window: hub, last rim vertex
                emit({b, vertex, a}, fault_ == "fan-hub-provoking"_fault ? a : b,
                     fault_ == "provoking-fan-last-hub"_fault ? a : vertex);
                if (fault_ == "fan-batch-hub"_fault && run_ % 9 == 0) {
                    window_[0] = b;
                }
                window_[1] = vertex;
                break;
        }
    }

    // Those that follow are of an instance whose vertices begin at `begin`.
    void begin_instance(uint32_t begin) {
        begin_ = begin;
        count_ = 0;
        odd_ = false;
        run_ = 0;
        if (fault_ != "instance-primitive-id-continues"_fault) {
            next_id_ = 0;
        }
    }

    std::vector<Primitive> take() { return std::move(out_); }

  private:
    void emit(std::array<uint32_t, 3> vertex, uint32_t first, uint32_t last) {
        const uint32_t provoking = is_last_ || fault_ == "provoking-last"_fault ? last : first;
        if (is_last_ && fault_ == "provoking-turns"_fault) {
            std::swap(vertex[0], vertex[2]);
        }
        const auto number = static_cast<uint32_t>(out_.size());
        Primitive& made = out_.emplace_back(vertex, provoking, next_id_, values_of(vertex), number);
        for (uint32_t k = 0; k < 3; ++k) {
            made.vertex[k] += begin_;
            made.values[k] += begin_;
        }
        made.provoking += fault_ == "instance-flat-of-first"_fault ? 0 : begin_;
        ++next_id_;
        ++run_;
    }

    std::array<uint32_t, 3> values_of(std::array<uint32_t, 3> vertex) const {
        if (fault_ == "strip-values-exchanged"_fault && odd_) {
            std::swap(vertex[0], vertex[1]);
        } else if (fault_ == "fan-values-exchanged"_fault && run_ % 2 == 1 &&
                   topology_ == cases::Topology::triangle_fan) {
            std::swap(vertex[1], vertex[2]);
        }
        return vertex;
    }

    cases::Topology topology_;
    bool is_last_;  // mode of the draw
    Fault fault_;
    std::array<uint32_t, 2> window_{};
    uint32_t count_ = 0;  // vertices in the window
    bool odd_ = false;
    uint32_t begin_ = 0;
    uint32_t next_id_ = 0;
    uint32_t run_ = 0;  // triangles since the start or the last restart
    std::vector<Primitive> out_;
};

}  // namespace

std::vector<Primitive> assemble_primitives(const cases::Draw& draw, Fault fault) {
    Assembler assembler(draw, fault);
    const auto vertex_count = static_cast<uint32_t>(draw.vertex_count());
    const uint32_t instances = fault == "instances-first-only"_fault ? 1 : draw.instances;
    for (uint32_t k = 0; k < instances; ++k) {
        const uint32_t i = fault == "instances-reversed"_fault ? instances - 1 - k : k;
        assembler.begin_instance(i * vertex_count);
        if (draw.indices && fault != "indices-ignored"_fault) {
            for (const uint32_t index : *draw.indices) {
                if (index == cases::kRestartIndex && draw.primitive_restart) {
                    assembler.restart();
                } else if (index < vertex_count) {
                    assembler.push(index);
                }
            }
        } else {
            for (uint32_t v = 0; v < vertex_count; ++v) {
                assembler.push(v);
            }
        }
    }
    std::vector<Primitive> primitives = assembler.take();
    if (fault == "batch-tail-lost"_fault && !primitives.empty()) {
        primitives.pop_back();
    }
    if (fault == "primitives-paired"_fault) {
        for (size_t k = 0; k + 1 < primitives.size(); k += 2) {
            std::swap(primitives[k], primitives[k + 1]);
        }
    }
    if (fault == "primitives-reversed"_fault) {
        std::ranges::reverse(primitives);
    }
    return primitives;
}

}  // namespace software
