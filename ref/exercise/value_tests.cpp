// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/value_tests.hpp"

#include <algorithm>

#include "cases/model/sample.hpp"
#include "ref/coverage/exact/exact.hpp"
#include "ref/value/fragment/shading_rate.hpp"

namespace ref {

using value::Kind;

namespace {

// Some quantity of a writer for which the test holds.
template <class Test>
bool any_quantity(const View& view, const Test& test) {
    return is_written_by(view, [&](uint32_t t) {
        const uint32_t draw = view.facts.triangles()[t].draw;
        return std::ranges::any_of(view.facts.quantities(draw), [&](const value::Quantity& q) {
            return test(q) && is_shown(view.of(), view.of().draws[draw], q.id);
        });
    });
}

}  // namespace

bool has_value(const View& view, std::string_view rule) {
    return any_quantity(view, [&](const value::Quantity& q) { return q.rule == rule; });
}

// A device that says 0 of every sample is right of the first.
bool has_sample_number(const View& view, std::string_view rule) {
    return view.sample.id.sample != 0 && has_value(view, rule);
}

// Values at the centre of a fragment of several pixels may lie beyond those of the vertices.
bool has_interpolated(const View& view, std::string_view) {
    return any_quantity(view,
                        [](const value::Quantity& q) {
                            return q.id.is_attribute() &&
                                   (q.kind == Kind::linear || q.kind == Kind::perspective);
                        }) &&
           is_written_by_draw(
               view, [](const cases::Draw& draw) { return !cases::has_large_fragments(draw); });
}

bool has_barycentric(const View& view, std::string_view) {
    return is_written_by_draw(view, [](const cases::Draw& draw) {
        return std::ranges::any_of(draw.attributes, [](const cases::Attribute& a) {
            return a.source == cases::Source::barycentric;
        });
    });
}

// A device without the extension says 0 of every fragment.
bool has_rate_of_several(const View& view, std::string_view rule) {
    return has_value(view, rule) && is_written_by_draw(view, [](const cases::Draw& draw) {
               return cases::has_large_fragments(draw);
           });
}

// Another pixel of the fragment keeps what this one shows: the triangle covers it, no test takes it
// away, and no later triangle reaches it.
bool is_of_shared_fragment(const View& view, std::string_view) {
    const cases::Target& target = view.of().target;
    const cases::SampleId& id = view.sample.id;
    const auto at = [&](uint32_t t, uint32_t x, uint32_t y, uint32_t s) {
        return exact::classify(view.setups[t], sample_position(x, y, s, target));
    };
    const auto is_kept = [&](uint32_t t, uint32_t x, uint32_t y, uint32_t s) {
        if (at(t, x, y, s) != Coverage::must) {
            return false;
        }
        for (uint32_t later = t + 1; later < view.facts.triangles().size(); ++later) {
            if (at(later, x, y, s) != Coverage::must_not) {
                return false;
            }
        }
        return true;
    };
    const auto has_other = [&](uint32_t t) {
        const cases::Draw& draw = view.facts.draw_of(t);
        const bool is_tested =
            target.has_depth &&
            (draw.depth.compare != cases::CompareOp::always || draw.depth.bounds.has_value());
        if (view.setups[t].is_clipped || is_tested || target.has_stencil) {
            return false;
        }
        const cases::PixelBlock block = cases::fragment_block(draw, id.x, id.y);
        const uint32_t end_x = std::min(block.x + block.width, target.width);
        const uint32_t end_y = std::min(block.y + block.height, target.height);
        for (uint32_t y = block.y; y < end_y; ++y) {
            for (uint32_t x = block.x; x < end_x; ++x) {
                for (uint32_t s = 0; s < target.samples && (x != id.x || y != id.y); ++s) {
                    if ((draw.multisample.sample_mask >> s & 1U) != 0 && is_kept(t, x, y, s)) {
                        return true;
                    }
                }
            }
        }
        return false;
    };
    return target.has_instruments && is_written_by(view, has_other);
}

bool is_at_sample(const View& view, std::string_view) {
    return any_quantity(view, [](const value::Quantity& q) {
        return (q.id.is_attribute() && q.at_sample) || q.kind == Kind::sample_position;
    });
}

bool is_sample_shaded(const View& view, std::string_view) {
    return view.of().target.has_instruments &&
           is_written_by_draw(view, [&](const cases::Draw& draw) {
               const auto rate = value::shading_rate(draw, view.of().target.samples);
               return rate == value::ShadingRate::some || rate == value::ShadingRate::sample;
           });
}

bool is_written(const View& view, std::string_view) {
    return is_surely_hit(view);
}

// Of a colour alone: with instruments there are no logical operations.
bool is_passed_by_logic(const View& view, std::string_view) {
    return view.facts.shown() != nullptr && view.of().target.color && is_surely_hit(view) &&
           view.facts.shown()->shows_passed_logic(view.sample.index, view.sample.id);
}

}  // namespace ref
