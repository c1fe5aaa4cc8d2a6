// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ref {

namespace {

color::Color constant_color(const cases::ColorOutput& output) {
    color::Color out;
    for (size_t k = 0; k < 4; ++k) {
        out[k] = color::point(static_cast<double>(output.value[static_cast<int>(k)]));
    }
    return out;
}

std::string_view store_rule(cases::ComponentKind kind) {
    switch (kind) {
        case cases::ComponentKind::unorm:
            return "store.unorm";
        case cases::ComponentKind::srgb:
            return "store.srgb";
        case cases::ComponentKind::half:
            return "store.half";
        case cases::ComponentKind::binary32:
            return "store.float";
        case cases::ComponentKind::uint:
            break;
    }
    return "store.integer";
}

}  // namespace

ColorReference::ColorReference(const cases::Case& c, const Expectation& expectation)
    : case_(c),
      expectation_(expectation),
      unit_{c.target.color->format, expectation.profile},
      cleared_(unit_.cleared(*c.target.color)),
      values_(c, expectation.limits, expectation.profile) {
    for (const cases::Draw& draw : c.draws) {
        constants_.push_back(constant_color(draw.color));
    }
    is_constant_ = std::all_of(c.draws.begin(), c.draws.end(),
                               [](const auto& draw) { return draw.color.attribute < 0; });
}

std::span<const PossibleHit> ColorReference::hits_at(size_t index) const {
    const auto begin = expectation_.fragments_begin[index];
    return std::span(expectation_.fragments)
        .subspan(begin, expectation_.fragments_begin[index + 1] - begin);
}

// Every set of fragments that the hit bounds allow; the empty list of sets if there are too many
// open ones.
std::vector<ColorReference::Sequence> ColorReference::allowed(
    size_t index, const std::optional<ColorWitness>& witness) const {
    const std::span<const PossibleHit> hits = hits_at(index);
    const HitBounds& bounds = expectation_.samples[index].hits;
    std::vector<size_t> open;
    for (size_t k = 0; k < hits.size(); ++k) {
        if (!hits[k].is_certain) {
            open.push_back(k);
        }
    }
    std::vector<Sequence> out;
    if (open.size() > kMaxOpen) {
        return out;
    }
    for (uint32_t choice = 0; choice < 1U << open.size(); ++choice) {
        Sequence sequence;
        size_t nth = 0;
        for (const PossibleHit& hit : hits) {
            if (hit.is_certain || (choice >> nth++ & 1U) != 0) {
                sequence.push_back(hit.triangle);
            }
        }
        const bool fits =
            witness ? sequence.size() == witness->hits &&
                          (sequence.empty() || sequence.back() == witness->writer)
                    : sequence.size() >= bounds.total_min && sequence.size() <= bounds.total_max;
        if (fits) {
            out.push_back(std::move(sequence));
        }
    }
    return out;
}

const color::Color& ColorReference::source_of(uint32_t triangle, SampleId id) {
    const uint32_t draw = expectation_.triangles[triangle].draw;
    const int32_t attribute = case_.draws[draw].color.attribute;
    if (attribute < 0) {
        return constants_[draw];
    }
    if (!(at_ == id)) {
        sources_.clear();
        at_ = id;
    }
    const auto [found, is_new] = sources_.try_emplace(triangle);
    if (is_new) {
        for (uint32_t k = 0; k < 4; ++k) {
            const ValueRange range = values_.range(triangle, id, attribute, k);
            // Nothing is promised of the value: any finite one.
            const double most = 0x1.fffffep127;
            found->second[k] = range.is_promised
                                   ? color::Interval{mpq_class(range.low), mpq_class(range.high)}
                                   : color::Interval{mpq_class(-most), mpq_class(most)};
        }
    }
    return found->second;
}

const cases::ColorOutput& ColorReference::output_of(uint32_t triangle) const {
    return case_.draws[expectation_.triangles[triangle].draw].color;
}

bool ColorReference::replaces(uint32_t triangle, bool masked) const {
    const cases::ColorOutput& output = output_of(triangle);
    return !output.blend && (!masked || output.write_mask == 0xf);
}

color::Color ColorReference::color_of(const Sequence& sequence, SampleId id, const glm::vec4* last,
                                      bool masked) {
    const bool is_constant = last == nullptr && masked &&
                             std::all_of(sequence.begin(), sequence.end(),
                                         [&](uint32_t t) { return output_of(t).attribute < 0; });
    Sequence draws;
    if (is_constant) {
        for (const uint32_t t : sequence) {
            draws.push_back(expectation_.triangles[t].draw);
        }
        if (const auto found = by_draws_.find(draws); found != by_draws_.end()) {
            return found->second;
        }
    }
    // Nothing is left of what a fragment replaces.
    size_t first = sequence.size();
    while (first > 0 && !replaces(sequence[--first], masked)) {
    }
    color::Color color = cleared_;
    for (size_t k = first; k < sequence.size(); ++k) {
        cases::ColorOutput output = output_of(sequence[k]);
        output.write_mask = masked ? output.write_mask : 0xf;
        if (last != nullptr && k + 1 == sequence.size() && output.attribute >= 0) {
            color::Color source;
            for (size_t i = 0; i < 4; ++i) {
                source[i] = color::point(static_cast<double>((*last)[static_cast<int>(i)]));
            }
            color = unit_.write(output, source, color);
        } else {
            color = unit_.write(output, source_of(sequence[k], id), color);
        }
    }
    if (is_constant) {
        by_draws_.emplace(std::move(draws), color);
    }
    return color;
}

std::string ColorReference::rule_of(const Sequence& sequence, bool is_as_unmasked) const {
    const bool blends = std::any_of(sequence.begin(), sequence.end(),
                                    [&](uint32_t t) { return output_of(t).blend.has_value(); });
    const bool masks = std::any_of(sequence.begin(), sequence.end(),
                                   [&](uint32_t t) { return output_of(t).write_mask != 0xf; });
    return std::string(masks && is_as_unmasked ? "blend.write-mask"
                       : blends                ? "blend.equation"
                       : masks                 ? "blend.write-mask"
                               : store_rule(cases::component_of(unit_.format, 0).kind));
}

bool ColorReference::explains(size_t index, SampleId id, const std::array<uint32_t, 4>& codes,
                              const std::optional<ColorWitness>& witness) {
    return explains(allowed(index, witness), id, codes, witness);
}

bool ColorReference::explains(const std::vector<Sequence>& sets, SampleId id,
                              const std::array<uint32_t, 4>& codes,
                              const std::optional<ColorWitness>& witness) {
    const glm::vec4* last = witness ? witness->written : nullptr;
    // A device whose hits are wrong already has a finding of its own.
    return sets.empty() || std::any_of(sets.begin(), sets.end(), [&](const Sequence& sequence) {
               return unit_.allows(color_of(sequence, id, last), codes);
           });
}

bool ColorReference::is_as_before(const Accepted& accepted, size_t index,
                                  const std::array<uint32_t, 4>& codes,
                                  const std::optional<ColorWitness>& witness) const {
    const HitBounds& bounds = expectation_.samples[index].hits;
    const std::span<const PossibleHit> hits = hits_at(index);
    return accepted.is_set && accepted.codes == codes && accepted.total_min == bounds.total_min &&
           accepted.total_max == bounds.total_max &&
           (!witness ||
            (accepted.witnessed == witness->hits && accepted.writer == witness->writer)) &&
           std::equal(hits.begin(), hits.end(), accepted.hits.begin(), accepted.hits.end());
}

ColorVerdict ColorReference::judge(size_t index, SampleId id, const std::array<uint32_t, 4>& codes,
                                   const std::optional<ColorWitness>& witness) {
    ColorVerdict verdict;
    Accepted& accepted = accepted_[hits_at(index).empty() ? 0 : 1];
    if (is_constant_ && is_as_before(accepted, index, codes, witness)) {
        return verdict;
    }
    const std::vector<Sequence> sets = allowed(index, witness);
    if (sets.empty()) {
        verdict.kind = ColorVerdict::Kind::open;
        return verdict;
    }
    if (explains(sets, id, codes, witness)) {
        if (is_constant_) {
            const HitBounds& bounds = expectation_.samples[index].hits;
            const std::span<const PossibleHit> hits = hits_at(index);
            accepted = {true,
                        {hits.begin(), hits.end()},
                        bounds.total_min,
                        bounds.total_max,
                        codes,
                        witness ? witness->hits : 0,
                        witness ? witness->writer : 0};
        }
        return verdict;
    }
    const glm::vec4* last = witness ? witness->written : nullptr;
    for (size_t k = 0; k < std::min<size_t>(sets.size(), 3); ++k) {
        verdict.expected += (k == 0 ? "" : "; or ") + unit_.text_of(color_of(sets[k], id, last));
    }
    verdict.expected += sets.size() > 3 ? "; or others" : "";
    verdict.kind = ColorVerdict::Kind::value;
    const Sequence& most = *std::max_element(
        sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    verdict.rule = rule_of(most, unit_.allows(color_of(most, id, last, false), codes));
    const auto tells = [&](const Sequence& sequence) {
        return unit_.allows(color_of(sequence, id, nullptr), codes);
    };
    if (witness) {
        Sequence turned(most.rbegin(), most.rend());
        if (most.size() > 1 && tells(turned)) {
            verdict.kind = ColorVerdict::Kind::order;
        }
        return verdict;
    }
    // Without instruments the colour tells what is wrong with the coverage, if anything does.
    for (size_t k = 0; k < most.size(); ++k) {
        Sequence less = most;
        less.erase(less.begin() + static_cast<std::ptrdiff_t>(k));
        if (tells(less)) {
            verdict.kind = ColorVerdict::Kind::missing;
            verdict.hits = static_cast<uint32_t>(less.size());
            return verdict;
        }
    }
    if (!most.empty() && tells({})) {
        verdict.kind = ColorVerdict::Kind::missing;
        return verdict;
    }
    Sequence turned(most.rbegin(), most.rend());
    if (most.size() > 1 && tells(turned)) {
        verdict.kind = ColorVerdict::Kind::order;
        return verdict;
    }
    for (size_t k = 0; k < most.size(); ++k) {
        Sequence more = most;
        more.insert(more.begin() + static_cast<std::ptrdiff_t>(k), most[k]);
        if (tells(more)) {
            verdict.kind = ColorVerdict::Kind::twice;
            verdict.hits = static_cast<uint32_t>(more.size());
            return verdict;
        }
    }
    if (most.empty()) {
        verdict.kind = ColorVerdict::Kind::extra;
        verdict.hits = 1;
    }
    return verdict;
}

std::array<uint32_t, 4> ColorReference::codes(size_t index, SampleId id,
                                              const std::optional<ColorWitness>& witness) {
    const std::vector<Sequence> sets = allowed(index, witness);
    const glm::vec4* last = witness ? witness->written : nullptr;
    return unit_.codes_of(sets.empty() ? cleared_ : color_of(sets.front(), id, last));
}

// Equal z and w = 1 at all vertices, in a viewport of depths 0 to 1: the depth is z itself.
bool ColorReference::is_constant_depth(uint32_t triangle, float depth) const {
    const Triangle& t = expectation_.triangles[triangle];
    const cases::Draw& draw = case_.draws[t.draw];
    const auto same = [](float a, float b) {
        return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
    };
    return same(draw.viewport.min_depth, 0.0F) && same(draw.viewport.max_depth, 1.0F) &&
           !draw.depth.negative_one_to_one &&
           std::all_of(t.vertex.begin(), t.vertex.end(), [&](uint32_t v) {
               return same(draw.positions[v].z, depth) && same(draw.positions[v].w, 1.0F);
           });
}

bool ColorReference::explains_depth(size_t index, SampleId id, float depth, float clear) {
    // Only the plain write is judged here; depth tests, bias and clamping need the instruments.
    const bool is_plain = std::all_of(case_.draws.begin(), case_.draws.end(),
                                      [](const auto& d) { return d.depth == cases::DepthState{}; });
    if (!is_plain || case_.target.depth_format != cases::DepthFormat::d32_float) {
        return true;
    }
    const std::vector<Sequence> sets = allowed(index, std::nullopt);
    return sets.empty() || std::any_of(sets.begin(), sets.end(), [&](const Sequence& sequence) {
               if (sequence.empty()) {
                   return std::bit_cast<uint32_t>(depth) == std::bit_cast<uint32_t>(clear);
               }
               if (is_constant_depth(sequence.back(), depth)) {
                   return true;
               }
               const ValueRange range = values_.range(sequence.back(), id, kDepthAttribute, 0);
               const auto value = static_cast<double>(depth);
               return std::isfinite(depth) &&
                      (!range.is_promised || (value >= range.low && value <= range.high));
           });
}

}  // namespace ref
