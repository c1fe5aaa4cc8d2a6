// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws that are lost, drawn twice, cut short or out of order.
#include <algorithm>
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

uint32_t last_primitive_size(VkPrimitiveTopology topology) {
    return topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST ? 3 : 1;
}

bool swap_first_two(std::vector<uint32_t>& order) {
    if (order.size() < 2) {
        return false;
    }
    std::swap(order[0], order[1]);
    return true;
}

bool reverse(std::vector<uint32_t>& order) {
    std::reverse(order.begin(), order.end());
    return order.size() > 1;
}

bool drop_last(std::vector<uint32_t>& order) {
    if (order.size() < 2) {
        return false;
    }
    order.pop_back();
    return true;
}

bool read_first_of_zero(PipelineCopy& p) {
    bool altered = false;
    for (const VkVertexInputBindingDivisorDescriptionEXT& divisor : p.divisors) {
        for (VkVertexInputBindingDescription& binding : p.bindings) {
            if (divisor.divisor == 0 && binding.binding == divisor.binding) {
                altered = change(binding.stride, 0) || altered;
            }
        }
    }
    return altered;
}

bool double_divisors(PipelineCopy& p) {
    bool altered = false;
    for (VkVertexInputBindingDivisorDescriptionEXT& divisor : p.divisors) {
        altered = (divisor.divisor > 1 && change(divisor.divisor, 2 * divisor.divisor)) || altered;
    }
    return altered;
}

constexpr std::array kDrawFaults = {
    Fault{"draw-dropped",
          "draws-nothing"_fault,
          {.draw = [](DrawCall& d) { return change(d.times, 0); }}},
    Fault{"draw-first-only",
          "draw-first-only"_fault,
          {.draw = [](DrawCall& d) { return d.number > 0 && change(d.times, 0); }}},
    Fault{"draw-last-dropped", "draw-last-lost"_fault, {.order = drop_last}},
    Fault{"draw-indexed-dropped",
          "draw-indexed-lost"_fault,
          {.draw = [](DrawCall& d) { return d.indexed && change(d.times, 0); }}},
    Fault{"draw-doubled",
          "draw-doubled"_fault,
          {.draw = [](DrawCall& d) { return change(d.times, 2); }}},
    Fault{"draw-second-doubled",
          "draw-second-twice"_fault,
          {.draw = [](DrawCall& d) { return d.number == 1 && change(d.times, 2); }}},
    Fault{"draw-last-triangle",
          "last-triangle-lost"_fault,
          {.draw =
               [](DrawCall& d) {
                   const uint32_t size = last_primitive_size(d.topology);
                   return d.count > 3 && change(d.count, d.count - size);
               }}},
    Fault{"draw-last-vertex",
          "The last vertex of a draw is lost, and the triangle with it.",
          {.draw = [](DrawCall& d) { return d.count > 3 && change(d.count, d.count - 1); }}},
    Fault{"draw-at-most-64-triangles",
          "A triangle list is cut off behind 64 triangles, as by a batch that is not continued.",
          {.draw =
               [](DrawCall& d) {
                   return d.topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST && d.count > 192 &&
                          change(d.count, 192);
               }}},
    Fault{"draw-first-triangle-lost",
          "first-triangle-lost"_fault,
          {.draw =
               [](DrawCall& d) {
                   if (d.topology != VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST || d.count < 6) {
                       return false;
                   }
                   d.first += 3;
                   d.count -= 3;
                   return true;
               }}},
    Fault{"first-vertex-off-by-one",
          "first-vertex-late"_fault,
          {.draw =
               [](DrawCall& d) {
                   d.count -= d.indexed ? 0 : 1;
                   return !d.indexed && change(d.first, d.first + 1);
               }}},
    Fault{"first-index-off-by-one",
          "first-index-late"_fault,
          {.draw =
               [](DrawCall& d) {
                   d.count -= d.indexed ? 1 : 0;
                   return d.indexed && change(d.first, d.first + 1);
               }}},
    Fault{"vertex-offset-one",
          "index-names-next-vertex"_fault,
          {.draw = [](DrawCall& d) { return d.indexed && change(d.vertex_offset, 1); }}},
    Fault{"instances-first-only",
          "instances-first-only"_fault,
          {.draw = [](DrawCall& d) { return d.instances > 1 && change(d.instances, 1); }}},
    Fault{
        "instances-last-lost",
        "The last of several instances is lost.",
        {.draw =
             [](DrawCall& d) { return d.instances > 1 && change(d.instances, d.instances - 1); }}},
    Fault{"instances-first-lost",
          "Several instances begin one instance late.",
          {.draw =
               [](DrawCall& d) {
                   const bool has_several = d.instances > 1;
                   d.instances -= has_several ? 1 : 0;
                   d.first_instance += has_several ? 1 : 0;
                   return has_several;
               }}},
    Fault{"instances-reversed",
          "instances-reversed"_fault,
          {.draw =
               [](DrawCall& d) {  // by which each instance would begin anew
                   return d.instances > 1 && !d.pipeline.has_divisors &&
                          change(d.is_reversed, true);
               }}},
    Fault{"instance-divisor-zero-from-zero",
          "A divisor of 0 reads the first element of the buffer, whatever firstInstance is.",
          {.pipeline = read_first_of_zero}},
    Fault{"instance-divisor-doubled",
          "A divisor above 1 counts twice.",
          {.pipeline = double_divisors}},
    Fault{"draws-reversed", "draws-reversed"_fault, {.order = reverse}},
    Fault{"draws-swapped", "draws-swapped"_fault, {.order = swap_first_two}},
};

}  // namespace

std::span<const Fault> draw_faults() {
    return kDrawFaults;
}

}  // namespace breaking
