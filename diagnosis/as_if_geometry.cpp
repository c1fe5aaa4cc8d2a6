// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "diagnosis/as_if.hpp"

namespace diagnosis::as_if {

namespace {

using cases::CullMode;
using cases::Topology;

// What the draws have in common with the first one.
template <class T>
bool all_as_first(Case& c, T Draw::*field) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = set(d.*field, c.draws.front().*field) || is_changed;
    }
    return is_changed;
}

template <Topology from, Topology to>
bool assembled_as(Case& c) {
    return each(c, [](Draw& d) {
        return d.topology == from && (d.indices ? d.indices->size() : d.positions.size()) > 3 &&
               set(d.topology, to);
    });
}

// What one draw keeps of its vertices, from vertex or index `first` on, `left_out` fewer of them.
bool cut_vertices(Draw& d, size_t first, size_t left_out) {
    std::vector<uint32_t> all;
    if (d.indices) {
        all = *d.indices;
    } else {
        for (uint32_t v = 0; v < d.positions.size(); ++v) {
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

// Draws that the device draws more than once, or in another order, keep their numbers.
void renumber(capture::Capture& capture, uint32_t (*number)(uint32_t)) {
    for (capture::Writer& writer : capture.writers) {
        writer.draw = writer.draw == capture::kClearId ? writer.draw : number(writer.draw);
    }
}

const Row kGeometryRows[] = {
    // viewport and scissor
    {"viewport-mirrored-y", "The picture is upside down",
     [](Case& c) {
         return each(c, [](Draw& d) {
             d.viewport.y += d.viewport.height;
             d.viewport.height = -d.viewport.height;
             return true;
         });
     }},
    {"viewport-mirrored-x", "The picture is mirrored left to right",
     [](Case& c) {
         return each(c, [](Draw& d) {
             for (glm::vec4& p : d.positions) {
                 p.x = -p.x;
             }
             return true;
         });
     }},
    {"viewport-first-for-all", "All draws use the first one's viewport",
     [](Case& c) { return all_as_first(c, &Draw::viewport); }},
    {"scissor-first-for-all", "All draws use the first one's scissor",
     [](Case& c) { return all_as_first(c, &Draw::scissor); }},
    {"depth-range-as-zero-to-one", "The depth range counts as 0 to 1",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool low = set(d.viewport.min_depth, 0.0F);
             return set(d.viewport.max_depth, 1.0F) || low;
         });
     }},
    {"depth-range-swapped", "The ends of the depth range are exchanged",
     [](Case& c) {
         return each(c, [](Draw& d) {
             std::swap(d.viewport.min_depth, d.viewport.max_depth);
             return d.viewport.min_depth < d.viewport.max_depth ||
                    d.viewport.min_depth > d.viewport.max_depth;
         });
     }},
    {"depth-range-ordered", "A reversed depth range counts as an ordinary one",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool is_reversed = d.viewport.min_depth > d.viewport.max_depth;
             if (is_reversed) {
                 std::swap(d.viewport.min_depth, d.viewport.max_depth);
             }
             return is_reversed;
         });
     }},
    {"scissor-right", "The scissor lies one pixel too far right",
     [](Case& c) { return each(c, [](Draw& d) { return ++d.scissor.x, true; }); }},
    {"scissor-low", "The scissor lies one pixel too low",
     [](Case& c) { return each(c, [](Draw& d) { return ++d.scissor.y, true; }); }},
    {"scissor-wider", "The scissor is closed at its right side",
     [](Case& c) { return each(c, [](Draw& d) { return ++d.scissor.width, true; }); }},
    {"scissor-higher", "The scissor is closed at its lower side",
     [](Case& c) { return each(c, [](Draw& d) { return ++d.scissor.height, true; }); }},
    {"scissor-row-lost", "The scissor's last row is missing",
     [](Case& c) {
         return each(c, [](Draw& d) { return d.scissor.height > 0 && (--d.scissor.height, true); });
     }},
    {"scissor-column-lost", "The scissor's last column is missing",
     [](Case& c) {
         return each(c, [](Draw& d) { return d.scissor.width > 0 && (--d.scissor.width, true); });
     }},
    // draws and their vertices
    {"draw-nothing", "Draws leave nothing",
     [](Case& c) { return each(c, [](Draw& d) { return set(d.rasterizer_discard, true); }); }},
    {"draw-first-only", "Only the first draw of a rendering is drawn",
     [](Case& c) { return c.draws.size() > 1 && (c.draws.resize(1), true); }},
    {"draw-last-lost", "The last of several draws is lost",
     [](Case& c) { return c.draws.size() > 1 && (c.draws.pop_back(), true); }},
    {"draw-indexed-lost", "Indexed draws are lost",
     [](Case& c) {
         return each(c, [](Draw& d) { return d.indices && (d.indices->clear(), true); });
     }},
    {"draw-each-twice", "Every draw is drawn twice",
     [](Case& c) {
         std::vector<Draw> twice;
         for (const Draw& d : c.draws) {
             twice.insert(twice.end(), 2, d);
         }
         c.draws = std::move(twice);
         return true;
     },
     [](capture::Capture& p) { renumber(p, [](uint32_t k) { return k / 2; }); }},
    {"draw-second-twice", "The second draw of a rendering is drawn twice",
     [](Case& c) {
         if (c.draws.size() < 2) {
             return false;
         }
         const Draw second = c.draws[1];
         c.draws.insert(c.draws.begin() + 1, second);
         return true;
     },
     [](capture::Capture& p) { renumber(p, [](uint32_t k) { return k < 2 ? k : k - 1; }); }},
    {"draws-swapped", "The first two draws are drawn in the other order",
     [](Case& c) { return c.draws.size() > 1 && (std::swap(c.draws[0], c.draws[1]), true); },
     [](capture::Capture& p) { renumber(p, [](uint32_t k) { return k < 2 ? 1 - k : k; }); }},
    {"first-triangle-lost", "A draw of several triangles loses its first one",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return d.topology == Topology::triangle_list && d.positions.size() > 3 &&
                    cut_vertices(d, 3, 0);
         });
     }},
    {"last-triangle-lost", "A draw of several triangles loses its last one",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool is_list = d.topology == Topology::triangle_list;
             return (d.indices ? d.indices->size() : d.positions.size()) > 3 &&
                    cut_vertices(d, 0, is_list ? 3 : 1);
         });
     }},
    {"first-vertex-late", "A draw without indices begins one vertex late",
     [](Case& c) { return each(c, [](Draw& d) { return !d.indices && cut_vertices(d, 1, 0); }); }},
    {"first-index-late", "A draw with indices begins one index late",
     [](Case& c) { return each(c, [](Draw& d) { return d.indices && cut_vertices(d, 1, 0); }); }},
    {"index-names-next-vertex", "Indices name the next vertex",
     [](Case& c) {
         return each(c, [](Draw& d) {
             if (!d.indices) {
                 return false;
             }
             for (uint32_t& i : *d.indices) {
                 i = i == cases::kRestartIndex ? i : i + 1;
             }
             // Beyond the last vertex a robust device reads zeros.
             d.positions.emplace_back(0.0F);
             for (cases::Attribute& a : d.attributes) {
                 if (a.source == cases::Source::vertex) {
                     a.values.emplace_back(0.0F);
                 }
             }
             for (std::vector<glm::vec4>* list : {&d.distances.clip, &d.distances.cull}) {
                 if (!list->empty()) {
                     list->emplace_back(0.0F);
                 }
             }
             return true;
         });
     }},
    {"index-16-bits", "Indices of 32 bits are read as indices of 16 bits",
     [](Case& c) {
         return each(c, [](Draw& d) {
             if (!d.indices) {
                 return false;
             }
             const std::vector<uint32_t> words = *d.indices;
             for (size_t k = 0; k < words.size(); ++k) {
                 const uint32_t half = (words[k / 2] >> (k % 2 * 16)) & 0xffffU;
                 (*d.indices)[k] =
                     half == 0xffffU && d.primitive_restart ? cases::kRestartIndex : half;
             }
             return std::all_of(d.indices->begin(), d.indices->end(), [&](uint32_t i) {
                 return i == cases::kRestartIndex || i < d.positions.size();
             });
         });
     }},
    {"strip-as-list", "A triangle strip is drawn as a list",
     assembled_as<Topology::triangle_strip, Topology::triangle_list>},
    {"list-as-strip", "A triangle list is drawn as a strip",
     assembled_as<Topology::triangle_list, Topology::triangle_strip>},
    {"fan-as-strip", "A triangle fan is drawn as a strip",
     assembled_as<Topology::triangle_fan, Topology::triangle_strip>},
    {"position-w-one", "The w of positions is read as 1",
     [](Case& c) {
         return each(c, [](Draw& d) {
             bool is_changed = false;
             for (glm::vec4& p : d.positions) {
                 is_changed = set(p.w, 1.0F) || is_changed;
             }
             return is_changed;
         });
     }},
    {"position-z-zero", "Positions are read without z and w",
     [](Case& c) {
         return each(c, [](Draw& d) {
             for (glm::vec4& p : d.positions) {
                 p = {p.x, p.y, 0, 1};
             }
             return true;
         });
     }},
    // facing
    {"cull-none", "Nothing is culled",
     [](Case& c) { return each(c, [](Draw& d) { return set(d.cull, CullMode::none); }); }},
    {"cull-back-always", "Back faces are culled where nothing is to be",
     [](Case& c) {
         return each(
             c, [](Draw& d) { return d.cull == CullMode::none && set(d.cull, CullMode::back); });
     }},
    {"cull-both-as-front", "Of front and back faces only front faces are culled",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return d.cull == CullMode::front_and_back && set(d.cull, CullMode::front);
         });
     }},
    {"front-always-counter-clockwise", "Front faces are always the counter-clockwise ones",
     [](Case& c) {
         return each(
             c, [](Draw& d) { return set(d.front_face, cases::FrontFace::counter_clockwise); });
     }},
};

}  // namespace

std::span<const Row> geometry_rows() {
    return kGeometryRows;
}

}  // namespace diagnosis::as_if
