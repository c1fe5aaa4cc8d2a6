// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Devices that take a case for another one: some state is ignored, exchanged, lost or a little off.
// What the faults of the software device (rasterizers/software/choice) have already is left to
// them.
#include <algorithm>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

#include "diagnosis/hypothesis.hpp"

namespace diagnosis {

namespace {

using cases::BlendFactor;
using cases::BlendOp;
using cases::Case;
using cases::CompareOp;
using cases::CullMode;
using cases::Draw;
using cases::Interpolation;
using cases::Topology;

// Changes draws one by one; true if one was changed.
bool each(Case& c, bool (*change)(Draw&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = change(d) || is_changed;
    }
    return is_changed;
}

// Sets a field; true if it had another value.
template <class T, class U = T>
bool set(T& field, const U& value) {
    if (std::equal_to<>()(field, value)) {
        return false;
    }
    field = value;
    return true;
}

template <class T>
bool exchange(T& field, const T& a, const T& b) {
    if (field == a) {
        field = b;
        return true;
    }
    return field == b && set(field, a);
}

// What the draws have in common with the first one.
template <class T>
bool all_as_first(Case& c, T Draw::*field) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = set(d.*field, c.draws.front().*field) || is_changed;
    }
    return is_changed;
}

template <CompareOp from, CompareOp to>
bool compare_as(Case& c) {
    return each(c, [](Draw& d) { return d.depth.compare == from && set(d.depth.compare, to); });
}

bool each_bias(Case& c, bool (*change)(cases::DepthBias&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = (d.depth.bias && change(*d.depth.bias)) || is_changed;
    }
    return is_changed;
}

bool each_blend(Case& c, bool (*change)(cases::Blend&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        is_changed = (d.color.blend && change(*d.color.blend)) || is_changed;
    }
    return is_changed;
}

bool each_equation(Case& c, bool (*change)(cases::BlendEquation&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        if (d.color.blend) {
            is_changed = change(d.color.blend->color) || is_changed;
            is_changed = change(d.color.blend->alpha) || is_changed;
        }
    }
    return is_changed;
}

template <BlendFactor from, BlendFactor to>
bool factor_as(Case& c) {
    return each_equation(c, [](cases::BlendEquation& e) {
        const bool is_source = e.source == from && set(e.source, to);
        return (e.destination == from && set(e.destination, to)) || is_source;
    });
}

bool each_attribute(Case& c, bool (*change)(cases::Attribute&)) {
    bool is_changed = false;
    for (Draw& d : c.draws) {
        for (cases::Attribute& a : d.attributes) {
            is_changed = (a.source == cases::Source::vertex && change(a)) || is_changed;
        }
    }
    return is_changed;
}

template <Interpolation from, Interpolation to>
bool interpolated_as(Case& c) {
    return each_attribute(
        c, [](cases::Attribute& a) { return a.interpolation == from && set(a.interpolation, to); });
}

// An input that is evaluated at each sample makes each sample an invocation of its own.
template <cases::Auxiliary from, cases::Auxiliary to>
bool placed_as(Case& c) {
    return c.target.samples > 1 && each(c, [](Draw& d) {
               bool is_changed = false;
               for (cases::Attribute& a : d.attributes) {
                   is_changed = (a.source == cases::Source::vertex && a.auxiliary == from &&
                                 a.interpolation != Interpolation::flat && set(a.auxiliary, to)) ||
                                is_changed;
               }
               if (is_changed && to == cases::Auxiliary::sample) {
                   d.multisample.min_sample_shading = 1.0F;
               }
               return is_changed;
           });
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

// Moves entries of a picture: entry (x, y) is taken from (x + dx, y + dy) where there is one.
void take_from(capture::Capture& capture, int64_t dx, int64_t dy) {
    const int64_t width = capture.target.width;
    const int64_t height = capture.target.rows();
    capture::for_each_plane(
        [&](const capture::Plane& plane, auto& entries) {
            if (entries.empty()) {
                return;
            }
            const auto per_pixel =
                static_cast<int64_t>(plane.entries) / std::max<int64_t>(1, width * height);
            const auto old = entries;
            for (int64_t y = 0; y < height; ++y) {
                for (int64_t x = 0; x < width; ++x) {
                    const int64_t from =
                        std::min(y + dy, height - 1) * width + std::min(x + dx, width - 1);
                    for (int64_t s = 0; s < per_pixel; ++s) {
                        entries[static_cast<size_t>((y * width + x) * per_pixel + s)] =
                            old[static_cast<size_t>(from * per_pixel + s)];
                    }
                }
            }
        },
        capture, capture);
}

// Draws that the device draws more than once, or in another order, keep their numbers.
void renumber(capture::Capture& capture, uint32_t (*number)(uint32_t)) {
    for (capture::Writer& writer : capture.writers) {
        writer.draw = writer.draw == capture::kClearId ? writer.draw : number(writer.draw);
    }
}

struct Row {
    std::string_view name, what;
    Change change;
    PictureChange after = nullptr;
};

constexpr auto kAlways = [](Case&) { return true; };

const Row kRows[] = {
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
    {"attribute-w-one", "The fourth component of attributes is read as 1",
     [](Case& c) {
         return each_attribute(c, [](cases::Attribute& a) {
             for (glm::vec4& v : a.values) {
                 v.w = 1;
             }
             return a.components == 4;
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
    // inputs
    {"flat-as-noperspective", "Flat inputs are interpolated without perspective",
     interpolated_as<Interpolation::flat, Interpolation::noperspective>},
    {"noperspective-as-flat", "Inputs without perspective are flat",
     interpolated_as<Interpolation::noperspective, Interpolation::flat>},
    {"smooth-as-noperspective", "Smooth inputs are interpolated without perspective",
     interpolated_as<Interpolation::smooth, Interpolation::noperspective>},
    {"centroid-as-sample", "Centroid inputs are evaluated at each sample",
     placed_as<cases::Auxiliary::centroid, cases::Auxiliary::sample>},
    {"plain-as-centroid", "Plain inputs are evaluated at the centroid",
     placed_as<cases::Auxiliary::none, cases::Auxiliary::centroid>},
    {"sample-as-centroid", "Sample inputs are evaluated at the centroid",
     placed_as<cases::Auxiliary::sample, cases::Auxiliary::centroid>},
    {"plain-as-sample", "Plain inputs are evaluated at each sample",
     placed_as<cases::Auxiliary::none, cases::Auxiliary::sample>},
    {"sample-mask-rotated", "The bits of the sample mask belong to the next sample each",
     [](Case& c) {
         for (Draw& d : c.draws) {
             const uint32_t all = (1U << c.target.samples) - 1;
             const uint32_t mask = d.multisample.sample_mask & all;
             d.multisample.sample_mask = mask << 1U | mask >> (c.target.samples - 1);
         }
         return c.target.samples > 1;
     }},
    {"sample-shading-always", "Every sample is shaded by itself",
     [](Case& c) {
         return c.target.samples > 1 && each(c, [](Draw& d) {
                    return set(d.multisample.min_sample_shading, std::optional<float>(1.0F));
                });
     }},
    {"sample-shading-halved", "The least part of samples to be shaded counts half",
     [](Case& c) {
         return each(c, [](Draw& d) {
             std::optional<float>& least = d.multisample.min_sample_shading;
             return least && *least > 0 && set(*least, *least / 2);
         });
     }},
    // clip and cull distances
    {"clip-distance-culls", "Clip distances cull whole triangles",
     [](Case& c) {
         return each(c, [](Draw& d) {
             cases::ClipDistances& x = d.distances;
             const bool has = x.clip_count > 0 && x.cull_count == 0;
             if (has) {
                 x = {0, x.clip_count, {}, std::move(x.clip)};
             }
             return has;
         });
     }},
    {"cull-distance-clips", "Cull distances clip",
     [](Case& c) {
         return each(c, [](Draw& d) {
             cases::ClipDistances& x = d.distances;
             const bool has = x.cull_count > 0 && x.clip_count == 0;
             if (has) {
                 x = {x.cull_count, 0, std::move(x.cull), {}};
             }
             return has;
         });
     }},
    {"cull-distance-negated", "Cull distances cull the other side",
     [](Case& c) {
         return each(c, [](Draw& d) {
             for (glm::vec4& x : d.distances.cull) {
                 x = -x;
             }
             return d.distances.cull_count > 0;
         });
     }},
    {"cull-distance-lost", "The last cull distance culls nothing",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return d.distances.cull_count > 0 && (--d.distances.cull_count, true);
         });
     }},
    // depth
    {"less-as-less-or-equal", "LESS lets equal depths pass",
     compare_as<CompareOp::less, CompareOp::less_or_equal>},
    {"less-or-equal-as-less", "LESS_OR_EQUAL rejects equal depths",
     compare_as<CompareOp::less_or_equal, CompareOp::less>},
    {"greater-as-greater-or-equal", "GREATER lets equal depths pass",
     compare_as<CompareOp::greater, CompareOp::greater_or_equal>},
    {"greater-or-equal-as-greater", "GREATER_OR_EQUAL rejects equal depths",
     compare_as<CompareOp::greater_or_equal, CompareOp::greater>},
    {"not-equal-as-always", "NOT_EQUAL lets all depths pass",
     compare_as<CompareOp::not_equal, CompareOp::always>},
    {"equal-as-less-or-equal", "EQUAL lets smaller depths pass, too",
     compare_as<CompareOp::equal, CompareOp::less_or_equal>},
    {"never-as-always", "NEVER lets all depths pass",
     compare_as<CompareOp::never, CompareOp::always>},
    {"compare-mirrored", "Less and greater are exchanged in the depth test",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return exchange(d.depth.compare, CompareOp::less, CompareOp::greater) ||
                    exchange(d.depth.compare, CompareOp::less_or_equal,
                             CompareOp::greater_or_equal);
         });
     }},
    {"depth-test-off", "There is no depth test, and so no depth is written",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool tests = set(d.depth.compare, CompareOp::always);
             return set(d.depth.write, false) || tests;
         });
     }},
    {"depth-write-off", "Depth is not written",
     [](Case& c) { return each(c, [](Draw& d) { return set(d.depth.write, false); }); }},
    {"depth-write-on", "Depth is written even where that is off",
     [](Case& c) { return each(c, [](Draw& d) { return set(d.depth.write, true); }); }},
    {"bias-no-constant", "The constant of the depth bias counts as 0",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.constant, 0.0F); }); }},
    {"bias-constant-doubled", "The constant of the depth bias counts twice",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.constant, 2 * b.constant); }); }},
    {"bias-no-slope", "The slope of the depth bias counts as 0",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.slope, 0.0F); }); }},
    {"bias-slope-negated", "The slope factor of the depth bias counts negative",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.slope, -b.slope); }); }},
    {"bias-slope-halved", "The slope of the depth bias counts half",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.slope, b.slope / 2); }); }},
    {"bias-clamp-negated", "The clamp of the depth bias is applied to the other side",
     [](Case& c) { return each_bias(c, [](auto& b) { return set(b.clamp, -b.clamp); }); }},
    {"depth-clamp-off", "Depth is clipped where it is to be clamped",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool clamps = set(d.depth.clamp, false);
             return clamps && set(d.depth.clip, std::optional<bool>(true));
         });
     }},
    {"depth-clip-flipped", "Depth is clipped where that is off, and the reverse",
     [](Case& c) {
         return each(c, [](Draw& d) {
             d.depth.clip = !d.depth.clip.value_or(!d.depth.clamp);
             return true;
         });
     }},
    // colour
    {"blend-off-unless-adding", "Only equations that add are blended",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const bool adds = !d.color.blend || (d.color.blend->color.op == BlendOp::add &&
                                                  d.color.blend->alpha.op == BlendOp::add);
             return !adds && (d.color.blend.reset(), true);
         });
     }},
    {"blend-alpha-replaced", "Alpha is replaced instead of blended",
     [](Case& c) {
         return each_blend(c, [](cases::Blend& b) { return set(b.alpha, cases::BlendEquation{}); });
     }},
    {"src-alpha-as-one", "SRC_ALPHA counts as ONE",
     factor_as<BlendFactor::src_alpha, BlendFactor::one>},
    {"src-alpha-as-dst-alpha", "SRC_ALPHA counts as DST_ALPHA",
     factor_as<BlendFactor::src_alpha, BlendFactor::dst_alpha>},
    {"one-minus-src-alpha-as-one", "ONE_MINUS_SRC_ALPHA counts as ONE",
     factor_as<BlendFactor::one_minus_src_alpha, BlendFactor::one>},
    {"dst-alpha-as-one", "DST_ALPHA counts as ONE",
     factor_as<BlendFactor::dst_alpha, BlendFactor::one>},
    {"dst-color-as-src-color", "DST_COLOR counts as SRC_COLOR",
     factor_as<BlendFactor::dst_color, BlendFactor::src_color>},
    {"constant-color-as-alpha", "CONSTANT_COLOR counts as CONSTANT_ALPHA",
     factor_as<BlendFactor::constant_color, BlendFactor::constant_alpha>},
    {"min-max-exchanged", "MIN and MAX of blending are exchanged",
     [](Case& c) {
         return each_equation(c,
                              [](auto& e) { return exchange(e.op, BlendOp::min, BlendOp::max); });
     }},
    {"subtract-adds", "SUBTRACT adds",
     [](Case& c) {
         return each_equation(
             c, [](auto& e) { return e.op == BlendOp::subtract && set(e.op, BlendOp::add); });
     }},
    {"blend-constants-red-blue", "Red and blue of the blend constants are exchanged",
     [](Case& c) {
         return each_blend(c, [](cases::Blend& b) {
             std::swap(b.constants.x, b.constants.z);
             return b.constants.x < b.constants.z || b.constants.x > b.constants.z;
         });
     }},
    {"write-mask-no-alpha", "Alpha is never written",
     [](Case& c) {
         return each(c, [](Draw& d) {
             return set(d.color.write_mask, static_cast<uint8_t>(d.color.write_mask & 7U));
         });
     }},
    {"write-mask-red-blue", "Red and blue of the write mask are exchanged",
     [](Case& c) {
         return each(c, [](Draw& d) {
             const unsigned m = d.color.write_mask;
             return set(d.color.write_mask,
                        static_cast<uint8_t>((m & 0xaU) | (m & 1U) << 2U | (m & 4U) >> 2U));
         });
     }},
    {"depth-cleared-to-one", "Depth is cleared to 1 whatever is asked",
     [](Case& c) { return c.target.has_depth && set(c.target.depth_clear, 1.0F); }},
    // the whole picture
    {"read-back-right", "Copies of the picture begin one column further right", kAlways,
     [](capture::Capture& p) { take_from(p, 1, 0); }},
    {"read-back-below", "Copies of the picture begin one row lower", kAlways,
     [](capture::Capture& p) { take_from(p, 0, 1); }},
    // blits
    {"blit-mirrored-x", "Blits are mirrored left to right",
     [](Case& c) { return c.blit && (std::swap(c.blit->source.x0, c.blit->source.x1), true); }},
    {"blit-mirrored-y", "Blits are mirrored top to bottom",
     [](Case& c) { return c.blit && (std::swap(c.blit->source.y0, c.blit->source.y1), true); }},
    {"blit-source-column-lost", "Blits leave out the last column of their source",
     [](Case& c) {
         return c.blit &&
                (--(c.blit->source.x1 > c.blit->source.x0 ? c.blit->source.x1 : c.blit->source.x0),
                 true);
     }},
    {"blit-destination-row-lost", "Blits leave out the last row of their destination",
     [](Case& c) {
         return c.blit &&
                (--(c.blit->destination.y1 > c.blit->destination.y0 ? c.blit->destination.y1
                                                                    : c.blit->destination.y0),
                 true);
     }},
};

}  // namespace

std::vector<Hypothesis> as_if_hypotheses() {
    std::vector<Hypothesis> out;
    for (const Row& row : kRows) {
        Hypothesis h{std::string(row.name), std::string(row.what)};
        h.change = row.change;
        h.after = row.after;
        out.push_back(std::move(h));
    }
    return out;
}

}  // namespace diagnosis
