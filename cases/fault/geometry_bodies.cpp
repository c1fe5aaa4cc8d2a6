// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/fault/bodies.hpp"
#include "cases/model/instances.hpp"
#include "cases/model/sample.hpp"

namespace cases::fault {

namespace {

// Draws have in common with the first one.
template <auto field>
bool as_first(Case& c) {
    return any_of(c.draws, [&](Draw& d) { return set(d.*field, c.draws.front().*field); });
}

template <Topology from, Topology to>
bool assembled_as(Draw& d) {
    return d.element_count() > 3 && replace(d.topology, from, to);
}

// Keeps the vertices of a draw from vertex or index `first` on, `left_out` fewer of them.
bool cut_vertices(Draw& d, size_t first, size_t left_out) {
    std::vector<uint32_t> all;
    if (d.indices) {
        all = *d.indices;
    } else {
        for (uint32_t v = 0; v < d.vertex_count(); ++v) {
            all.push_back(v);
        }
    }
    const size_t end = all.size() - std::min(all.size(), left_out);
    if ((first == 0 && left_out == 0) || first >= end) {
        return false;
    }
    d.indices.emplace(all.begin() + static_cast<std::ptrdiff_t>(first),
                      all.begin() + static_cast<std::ptrdiff_t>(end));
    return true;
}

bool name_next_vertices(Draw& d) {
    if (!d.indices || d.instances > 1) {
        return false;
    }
    for (uint32_t& i : *d.indices) {
        i = i == kRestartIndex ? i : i + 1;
    }
    // Beyond the last vertex a robust device reads zeros.
    d.positions.emplace_back(0.0F);
    for (Attribute& a : d.attributes) {
        if (a.source == Source::vertex) {
            a.values.emplace_back(0.0F);
        }
    }
    for (std::vector<glm::vec4>* list : {&d.distances.clip, &d.distances.cull}) {
        if (!list->empty()) {
            list->emplace_back(0.0F);
        }
    }
    return true;
}

bool read_halves(Draw& d) {
    if (!d.indices) {
        return false;
    }
    const std::vector<uint32_t> words = *d.indices;
    for (size_t k = 0; k < words.size(); ++k) {
        const uint32_t half = (words[k / 2] >> (k % 2 * 16)) & 0xffffU;
        (*d.indices)[k] = half == 0xffffU && d.primitive_restart ? kRestartIndex : half;
    }
    return std::ranges::all_of(
        *d.indices, [&](uint32_t i) { return i == kRestartIndex || i < d.vertex_count(); });
}

bool read_inputs_of_first(Draw& d) {
    bool is_changed = false;
    const auto copy_first = [&](std::vector<glm::vec4>& list) {
        for (size_t v = d.vertex_count(); v < list.size(); ++v) {
            is_changed = set(list[v], list[v - d.vertex_count()]) || is_changed;
        }
    };
    copy_first(d.positions);
    for (Attribute& a : d.attributes) {
        copy_first(a.values);
    }
    return is_changed;
}

bool ignore_divisors(Draw& d) {
    bool is_changed = false;
    for (Attribute& a : d.attributes) {
        if (a.divisor.value_or(0) > 1) {
            std::vector<glm::vec4> elements = elements_read(d, a.values, a.divisor);
            elements.resize(d.instances, elements.back());
            is_changed =
                set(a.values, for_all_instances(d, elements, 1, d.vertex_count())) || is_changed;
        }
    }
    return is_changed;
}

bool draw_each_twice(Case& c) {
    std::vector<Draw> twice;
    for (const Draw& d : c.draws) {
        twice.insert(twice.end(), 2, d);
    }
    c.draws = std::move(twice);
    return true;
}

bool exchange_depth_range(Viewport& v) {
    std::swap(v.min_depth, v.max_depth);
    return v.min_depth < v.max_depth || v.min_depth > v.max_depth;
}

// Gives a vertex another w at its place in the framebuffer; what is not finite stays as it is.
bool scale(glm::vec4& p, float by) {
    const glm::vec4 scaled = p * by;
    return std::isfinite(scaled.x) && std::isfinite(scaled.y) && std::isfinite(scaled.z) &&
           scaled.w > 0 && set(p, scaled);
}

bool double_third_w(Draw& d) {
    constexpr float kLargest = 0x1p120F;  // and what is not finite stays as it is
    bool is_changed = false;
    for (size_t v = 0; v < d.positions.size(); v += 3) {
        glm::vec4& p = d.positions[v];
        if (std::fabs(p.x) < kLargest && std::fabs(p.y) < kLargest && std::fabs(p.z) < kLargest &&
            std::fabs(p.w) < kLargest) {
            p *= 2.0F;
            is_changed = true;
        }
    }
    return is_changed;
}

bool unhide_queried(Draw& d) {
    if (!is_occlusion(d.query)) {
        return false;
    }
    d.cull = CullMode::none;
    d.discard = Discard::none;
    d.rasterizer_discard = false;
    d.multisample.sample_mask = UINT32_MAX;
    d.multisample.shader_mask.reset();
    d.depth.compare = CompareOp::always;
    d.depth.bounds.reset();
    d.stencil.front.compare = d.stencil.back.compare = CompareOp::always;
    return true;
}

const Body kGeometryBodies[] = {
    // viewport and scissor
    {"viewport-mirrored-y"_fault,
     [](Draw& d) {
         d.viewport.y += d.viewport.height;
         d.viewport.height = -d.viewport.height;
         return true;
     }},
    {"viewport-mirrored-x"_fault,
     [](Draw& d) {
         for (glm::vec4& p : d.positions) {
             p.x = -p.x;
         }
         return true;
     }},
    {"viewport-first-for-all"_fault, as_first<&Draw::viewport>},
    {"scissor-first-for-all"_fault, as_first<&Draw::scissor>},
    {"depth-range-as-zero-to-one"_fault,
     [](Draw& d) {
         const bool low = set(d.viewport.min_depth, 0.0F);
         return set(d.viewport.max_depth, 1.0F) || low;
     }},
    {"depth-range-swapped"_fault, [](Draw& d) { return exchange_depth_range(d.viewport); }},
    {"depth-range-ordered"_fault,
     [](Draw& d) {
         return d.viewport.min_depth > d.viewport.max_depth && exchange_depth_range(d.viewport);
     }},
    {"scissor-right"_fault, [](Draw& d) { return ++d.scissor.x, true; }},
    {"scissor-low"_fault, [](Draw& d) { return ++d.scissor.y, true; }},
    {"scissor-wider"_fault, [](Draw& d) { return ++d.scissor.width, true; }},
    {"scissor-higher"_fault, [](Draw& d) { return ++d.scissor.height, true; }},
    {"scissor-row-lost"_fault,
     [](Draw& d) { return d.scissor.height > 0 && (--d.scissor.height, true); }},
    {"scissor-column-lost"_fault,
     [](Draw& d) { return d.scissor.width > 0 && (--d.scissor.width, true); }},
    {"scissor-ignored"_fault,
     [](Case& c) {
         const Rect whole{0, 0, c.target.width, c.target.height};
         return any_of(c.draws, [&](Draw& d) { return set(d.scissor, whole); });
     }},
    // draws and their vertices
    {"draw-nothing"_fault, [](Draw& d) { return set(d.rasterizer_discard, true); }},
    {"draw-first-only"_fault,
     [](Case& c) { return c.draws.size() > 1 && (c.draws.resize(1), true); }},
    {"draw-last-lost"_fault,
     [](Case& c) { return c.draws.size() > 1 && (c.draws.pop_back(), true); }},
    {"draw-indexed-lost"_fault, [](Draw& d) { return d.indices && (d.indices->clear(), true); }},
    {"draw-each-twice"_fault, draw_each_twice},
    {"draw-second-twice"_fault,
     [](Case& c) {
         return c.draws.size() > 1 && (c.draws.insert(c.draws.begin() + 1, Draw(c.draws[1])), true);
     }},
    {"draws-swapped"_fault,
     [](Case& c) { return c.draws.size() > 1 && (std::swap(c.draws[0], c.draws[1]), true); }},
    {"first-triangle-lost"_fault,
     [](Draw& d) {
         return d.topology == Topology::triangle_list && d.vertex_count() > 3 &&
                cut_vertices(d, 3, 0);
     }},
    {"last-triangle-lost"_fault,
     [](Draw& d) {
         const bool is_list = d.topology == Topology::triangle_list;
         return d.element_count() > 3 && cut_vertices(d, 0, is_list ? 3 : 1);
     }},
    {"first-vertex-late"_fault, [](Draw& d) { return !d.indices && cut_vertices(d, 1, 0); }},
    {"first-index-late"_fault, [](Draw& d) { return d.indices && cut_vertices(d, 1, 0); }},
    {"index-names-next-vertex"_fault, name_next_vertices},
    {"index-16-bits"_fault, read_halves},
    {"strip-as-list"_fault, assembled_as<Topology::triangle_strip, Topology::triangle_list>},
    {"list-as-strip"_fault, assembled_as<Topology::triangle_list, Topology::triangle_strip>},
    {"fan-as-strip"_fault, assembled_as<Topology::triangle_fan, Topology::triangle_strip>},
    {"instance-input-of-first"_fault, read_inputs_of_first},
    {"instance-divisor-ignored"_fault, ignore_divisors},
    {"position-w-one"_fault, [](glm::vec4& p) { return set(p.w, 1.0F); }},
    {"position-z-zero"_fault,
     [](glm::vec4& p) {
         p = {p.x, p.y, 0, 1};
         return true;
     }},
    {"w-doubled"_fault, double_third_w},
    {"w-of-first-vertex"_fault,
     [](Draw& d) {
         const float w = d.positions.front().w;
         return any_of(d.positions, [w](glm::vec4& p) { return scale(p, w / p.w); });
     }},
    {"layer-ignored"_fault, [](Draw& d) { return set(d.layer, 0U); }},
    {"layer-always-last"_fault,
     [](Case& c) {
         return any_of(c.draws, [&](Draw& d) { return set(d.layer, c.target.layers - 1); });
     }},
    // discarding
    {"discard-ignored"_fault, [](Draw& d) { return set(d.rasterizer_discard, false); }},
    {"discard-fragment-ignored"_fault, [](Draw& d) { return set(d.discard, Discard::none); }},
    {"discard-value-ignored"_fault,
     [](Draw& d) { return discards_by_value(d) && set(d.discard, Discard::none); }},
    {"discard-tests-late"_fault, [](Draw& d) { return set(d.early_tests, false); }},
    {"queried-draws-unhidden"_fault, unhide_queried},
    // facing
    {"cull-none"_fault, [](Draw& d) { return set(d.cull, CullMode::none); }},
    {"cull-back-always"_fault,
     [](Draw& d) { return replace(d.cull, CullMode::none, CullMode::back); }},
    {"cull-both-as-front"_fault,
     [](Draw& d) { return replace(d.cull, CullMode::front_and_back, CullMode::front); }},
    {"cull-inverted"_fault,
     [](Draw& d) { return exchange(d.cull, CullMode::front, CullMode::back); }},
    {"front-always-counter-clockwise"_fault,
     [](Draw& d) { return set(d.front_face, FrontFace::counter_clockwise); }},
    {"front-face-inverted"_fault,
     [](Draw& d) {
         return exchange(d.front_face, FrontFace::clockwise, FrontFace::counter_clockwise);
     }},
    {"conservative-ignored"_fault, [](Draw& d) { return set(d.conservative, Conservative::none); }},
};

}  // namespace

std::span<const Body> geometry_bodies() {
    return kGeometryBodies;
}

}  // namespace cases::fault
