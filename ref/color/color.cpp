// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/color/color.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "cases/fault/neighbour.hpp"
#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/texels.hpp"
#include "ref/color/color_steps.hpp"
#include "ref/color/component_filter.hpp"
#include "ref/color/logic.hpp"
#include "ref/value/texel.hpp"

namespace ref {

namespace {

color::Source point_source(const glm::vec4& value) {
    color::Source out;
    for (size_t k = 0; k < 4; ++k) {
        out.low[k] = out.high[k] = static_cast<double>(value[static_cast<int>(k)]);
    }
    return out;
}

// What may be read of the texels that coordinates in these ranges may choose: between the ends of
// their codes, c / 255 in binary32 or beside it.
void take_texels(color::Source& coordinates, cases::Profile profile) {
    for (size_t k = 0; k < 2; ++k) {
        double &low = coordinates.low[k], &high = coordinates.high[k];
        if (std::isfinite(low) && std::isfinite(high)) {
            const auto [first, last] = value::texels_of(low, high, cases::kTexels, profile);
            low = cases::texel_code(first) / 255.0 * (1 - 0x1p-22);
            high = cases::texel_code(last) / 255.0 * (1 + 0x1p-22);
        }
    }
    for (size_t k = 2; k < 4; ++k) {
        coordinates.low[k] = coordinates.high[k] = 1;
    }
}

// What a wrong colour breaks where nothing is blended or masked, in the order of ComponentKind.
constexpr std::string_view kStoreRules[] = {cases::rule::store_unorm,   cases::rule::store_srgb,
                                            cases::rule::store_half,    cases::rule::store_float,
                                            cases::rule::store_integer, cases::rule::store_snorm,
                                            cases::rule::store_integer};
static_assert(std::size(kStoreRules) == static_cast<size_t>(cases::ComponentKind::sint) + 1);

}  // namespace

ColorReference::ColorReference(const cases::Case& c, const Expectation& expectation)
    : case_(c),
      expectation_(expectation),
      unit_{c.target.color->format, expectation.profile},
      cleared_(unit_.cleared(*c.target.color)),
      values_(c, expectation.limits, expectation.profile),
      memory_(cleared_, kRemembered) {
    for (const cases::Draw& draw : c.draws) {
        constants_.push_back(point_source(draw.color.value));
    }
    is_constant_ = std::all_of(c.draws.begin(), c.draws.end(),
                               [](const auto& draw) { return draw.color.attribute < 0; });
}

std::span<const path::Fragment> ColorReference::fragments_at(size_t index) const {
    return expectation_.fragments_of(expectation_.samples[index]);
}

std::vector<ColorReference::Sequence> ColorReference::allowed(
    size_t index, const ColorWitness& witness, bool whole, const path::Question* question) const {
    const std::span<const path::Fragment> fragments = fragments_at(index);
    const SampleExpectation& expected = expectation_.samples[index];
    if (!expected.is_open) {
        return {shown_at(expectation_, expected)};
    }
    if (expected.is_free) {
        return {};
    }
    path::Kinds kinds;
    for (uint32_t m = 0; m < fragments.size(); ++m) {
        const uint32_t draw = expectation_.triangles[fragments[m].triangle].draw;
        const bool is_like_last = m > 0 && output_of(fragments[m].triangle).attribute < 0 &&
                                  expectation_.triangles[fragments[m - 1].triangle].draw == draw;
        kinds.kind.push_back(is_like_last ? kinds.kind.back() : m);
        kinds.replaces.push_back(replaces(fragments[m].triangle, true));
    }
    path::Shown shown =
        path::shown_by(question != nullptr ? *question : question_of(expectation_, case_, expected),
                       witness.paths, whole ? nullptr : &kinds);
    for (Sequence& list : shown.lists) {
        for (uint32_t& m : list) {
            m = fragments[m].triangle;
        }
    }
    return std::move(shown.lists);
}

const color::Source& ColorReference::source_of(uint32_t triangle, cases::SampleId id) {
    const uint32_t draw = expectation_.triangles[triangle].draw;
    const int32_t attribute = case_.draws[draw].color.attribute;
    if (attribute < 0) {
        return constants_[draw];
    }
    if (!(at_ == id)) {
        sources_.clear();
        outer_sources_.clear();
        at_ = id;
    }
    const auto [found, is_new] = (takes_outer_ ? outer_sources_ : sources_).try_emplace(triangle);
    if (is_new) {
        const auto which = static_cast<size_t>(attribute);
        const std::array<ValueRange, 4> ranges = values_.ranges(triangle, id, which, takes_outer_);
        for (size_t k = 0; k < 4; ++k) {
            // Of what nothing is promised: where the value is divided by zero, it is no number.
            found->second.low[k] = ranges[k].is_promised ? ranges[k].low : -HUGE_VAL;
            found->second.high[k] = ranges[k].is_promised ? ranges[k].high : HUGE_VAL;
        }
        if (case_.draws[draw].color.from == cases::ColorFrom::texels) {
            take_texels(found->second, unit_.profile);
        }
    }
    return found->second;
}

const cases::ColorOutput& ColorReference::output_of(uint32_t triangle) const {
    return case_.draws[expectation_.triangles[triangle].draw].color;
}

bool ColorReference::replaces(uint32_t triangle, bool masked) const {
    const cases::ColorOutput& output = output_of(triangle);
    const bool mixes = output.logic ? color::takes_logic(unit_.format) : output.blend.has_value();
    return !mixes && (!masked || output.write_mask == 0xf);
}

color::Source ColorReference::source_of(uint32_t triangle, cases::SampleId id,
                                        const ColorWitness& witness) {
    const int32_t attribute = output_of(triangle).attribute;
    const glm::vec4* const written =
        attribute < 0 ? nullptr : witness.written.at(static_cast<size_t>(attribute));
    const bool is_captured =
        written != nullptr && !glm::any(glm::isnan(*written)) && !glm::any(glm::isinf(*written));
    if (!is_captured) {
        return source_of(triangle, id);
    }
    color::Source out = point_source(*written);
    if (output_of(triangle).from == cases::ColorFrom::texels) {
        take_texels(out, unit_.profile);
    }
    return out;
}

bool ColorReference::is_flat(uint32_t triangle) const {
    const cases::Draw& draw = case_.draws[expectation_.triangles[triangle].draw];
    const int32_t attribute = draw.color.attribute;
    return attribute < 0 || draw.attributes[static_cast<size_t>(attribute)].interpolation ==
                                cases::Interpolation::flat;
}

color::ColorMemory::Node& ColorReference::left_by(const Sequence& sequence, cases::SampleId id,
                                                  const ColorWitness& witness, bool masked) {
    // Nothing is left of what a fragment replaces.
    size_t first = sequence.size();
    while (first > 0 && !replaces(sequence[--first], masked)) {
    }
    // Interpolated colours are each sample's own: only flat ones come again. What is laid over a
    // colour that is not remembered is not, either.
    color::ColorMemory::Node* node = &memory_.root();
    for (size_t k = first; k < sequence.size(); ++k) {
        const uint32_t triangle = sequence[k];
        const color::Source source =
            k + 1 == sequence.size() ? source_of(triangle, id, witness) : source_of(triangle, id);
        const auto write = [&] {
            cases::ColorOutput output = output_of(triangle);
            output.write_mask = masked ? output.write_mask : 0xf;
            return unit_.write(output, color::color_of(source), node->color);
        };
        color::ColorMemory::Node* next = nullptr;
        if (node != &beyond_ && is_flat(triangle)) {
            const uint32_t draw = expectation_.triangles[triangle].draw;
            if (const std::optional<uint32_t> name = memory_.name_of(draw, masked, source)) {
                next = memory_.after(*node, *name, write);
            }
        }
        if (next == nullptr) {
            beyond_.color = write();
            beyond_.accepted.reset();
            next = &beyond_;
        }
        node = next;
    }
    return *node;
}

std::optional<bool> ColorReference::may_write(uint32_t triangle, cases::SampleId id,
                                              const ColorWitness& witness,
                                              const std::array<uint32_t, 4>& codes) {
    const color::Source source = source_of(triangle, id, witness);
    const bool is_one = color::replaces_alpha(output_of(triangle), unit_.format);
    bool is_known = true;
    for (uint32_t k = 0; k < 4; ++k) {
        const color::Component component(cases::component_of(unit_.format, k));
        if (!component.exists()) {
            continue;
        }
        const std::optional<bool> may =
            color::may_store(component, is_one && k == 3 ? 1 : source.low[k],
                             is_one && k == 3 ? 1 : source.high[k], codes[k], unit_.profile);
        if (may && !*may) {
            return false;
        }
        is_known = is_known && may;
    }
    return is_known ? std::optional(true) : std::nullopt;
}

bool ColorReference::leaves(const Sequence& sequence, cases::SampleId id,
                            const ColorWitness& witness, const std::array<uint32_t, 4>& codes) {
    if (!sequence.empty() && replaces(sequence.back(), true)) {
        if (const std::optional<bool> may = may_write(sequence.back(), id, witness, codes)) {
            return *may;
        }
    }
    color::ColorMemory::Node& node = left_by(sequence, id, witness);
    if (node.accepted == codes) {
        return true;
    }
    const bool is_allowed = unit_.allows(node.color, codes);
    if (is_allowed) {
        node.accepted = codes;
    }
    return is_allowed;
}

std::string ColorReference::rule_of(const Sequence& sequence, bool is_as_unmasked) const {
    const bool blends = std::any_of(sequence.begin(), sequence.end(),
                                    [&](uint32_t t) { return output_of(t).blend.has_value(); });
    const bool takes_second = std::any_of(sequence.begin(), sequence.end(), [&](uint32_t t) {
        return output_of(t).blend && cases::takes_second(*output_of(t).blend);
    });
    const bool operates = std::any_of(sequence.begin(), sequence.end(),
                                      [&](uint32_t t) { return output_of(t).logic.has_value(); });
    const bool is_one = std::any_of(sequence.begin(), sequence.end(),
                                    [&](uint32_t t) { return output_of(t).alpha_to_one; });
    const bool masks = std::any_of(sequence.begin(), sequence.end(),
                                   [&](uint32_t t) { return output_of(t).write_mask != 0xf; });
    return std::string(masks && is_as_unmasked ? cases::rule::blend_write_mask
                       : is_one                ? cases::rule::sample_alpha_to_one
                       : operates              ? cases::rule::logic_operation
                       : takes_second          ? cases::rule::blend_second_source
                       : blends                ? cases::rule::blend_equation
                       : masks                 ? cases::rule::blend_write_mask
                               : kStoreRules[static_cast<size_t>(row_of(unit_.format).kind)]);
}

struct ColorReference::Mistake {
    cases::Case test;
    ColorReference reference;
    Mistake(cases::Case c, const Expectation& expectation)
        : test(std::move(c)), reference(test, expectation) {}
};

ColorReference::~ColorReference() = default;

bool ColorReference::is_of_neighbour(const Sequence& sequence, cases::SampleId id,
                                     const std::array<uint32_t, 4>& codes) {
    using cases::Taken;
    // Asked without the value that was written, as below, it may be right: then nothing is mixed
    // up.
    if (leaves(sequence, id, {}, codes)) {
        return false;
    }
    const uint32_t count = mistakes_.empty() ? case_.target.color_count() : 0;
    for (uint32_t k = 0; k < count; ++k) {
        for (const Taken taken : {Taken::state, Taken::color, Taken::clear, Taken::all}) {
            cases::Case other = case_;
            if (k != case_.target.judged_color && cases::take_from(other, k, taken)) {
                mistakes_.push_back(std::make_unique<Mistake>(std::move(other), expectation_));
            }
        }
    }
    return std::ranges::any_of(mistakes_, [&](const auto& mistake) {
        return mistake->reference.leaves(sequence, id, {}, codes);
    });
}

bool ColorReference::explains(size_t index, cases::SampleId id,
                              const std::array<uint32_t, 4>& codes, const ColorWitness& witness,
                              const path::Question* question) {
    return explains(allowed(index, witness, false, question), id, codes, witness);
}

bool ColorReference::may_explain(size_t index, cases::SampleId id,
                                 const std::array<uint32_t, 4>& codes,
                                 const ColorWitness& witness) {
    takes_outer_ = true;
    const std::unique_ptr<bool, void (*)(bool*)> until(&takes_outer_,
                                                       [](bool* takes) { *takes = false; });
    return explains(index, id, codes, witness);
}

bool ColorReference::explains(const std::vector<Sequence>& lists, cases::SampleId id,
                              const std::array<uint32_t, 4>& codes, const ColorWitness& witness) {
    // A device whose other planes are wrong already has a finding of its own.
    return lists.empty() || std::any_of(lists.begin(), lists.end(), [&](const Sequence& sequence) {
               return leaves(sequence, id, witness, codes);
           });
}

void ColorReference::tell_coverage(const Sequence& most, cases::SampleId id,
                                   const std::array<uint32_t, 4>& codes, ColorVerdict& verdict) {
    using Kind = ColorVerdict::Kind;
    // What leaves anything, as infinity that is blended, tells nothing.
    const auto tells = [&](const Sequence& sequence) {
        return leaves(sequence, id, {}, codes) &&
               std::ranges::none_of(color_of(sequence, id, {}), &color::Component::is_anything);
    };
    // Whether one fragment less, or one of them twice, tells.
    const auto tells_of_one = [&](Kind kind) {
        for (size_t k = 0; k < most.size(); ++k) {
            Sequence other = most;
            const auto at = other.begin() + static_cast<std::ptrdiff_t>(k);
            if (kind == Kind::missing) {
                other.erase(at);
            } else {
                other.insert(at, most[k]);
            }
            if (tells(other)) {
                verdict.kind = kind;
                verdict.hits = static_cast<uint32_t>(other.size());
                verdict.triangle = most[k];
                return true;
            }
        }
        return false;
    };
    const bool is_turned = most.size() > 1 && tells({most.rbegin(), most.rend()});
    if (tells_of_one(Kind::missing)) {
        return;
    }
    if (!most.empty() && tells({})) {
        verdict.kind = Kind::missing;
    } else if (is_turned) {
        verdict.kind = Kind::order;
    } else if (!tells_of_one(Kind::twice) && most.empty()) {
        verdict.kind = Kind::extra;
        verdict.hits = 1;
    }
}

ColorVerdict ColorReference::judge(size_t index, cases::SampleId id,
                                   const std::array<uint32_t, 4>& codes,
                                   const ColorWitness& witness) {
    ColorVerdict verdict;
    const std::span<const path::Fragment> fragments = fragments_at(index);
    Accepted& accepted = accepted_[fragments.empty() ? 0 : 1];
    const bool is_known = is_constant_ && !expectation_.samples[index].is_open;
    if (is_known && accepted.is_set && accepted.codes == codes &&
        std::ranges::equal(fragments, accepted.fragments)) {
        return verdict;
    }
    std::vector<Sequence> lists = allowed(index, witness, false);
    if (lists.empty()) {
        verdict.kind = ColorVerdict::Kind::open;
        return verdict;
    }
    if (explains(lists, id, codes, witness)) {
        if (is_known) {
            accepted = {true, {fragments.begin(), fragments.end()}, codes};
        }
        return verdict;
    }
    if (std::vector<Sequence> whole = allowed(index, witness, true); !whole.empty()) {
        lists = std::move(whole);
    }
    for (size_t k = 0; k < std::min<size_t>(lists.size(), 3); ++k) {
        const color::Color color = color_of(lists[k], id, witness);
        verdict.expected += (k == 0 ? "" : "; or ") + unit_.text_of(color);
        verdict.may_overflow = verdict.may_overflow || unit_.may_overflow(color);
    }
    verdict.expected += lists.size() > 3 ? "; or others" : "";
    verdict.kind = ColorVerdict::Kind::value;
    const Sequence& most =
        *std::max_element(lists.begin(), lists.end(),
                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const auto is_clear = [&](uint32_t t) {
        return case_.draws[expectation_.triangles[t].draw].clear.has_value();
    };
    verdict.rule = !most.empty() && is_clear(most.back()) ? cases::rule::clear_attachments
                   : is_of_neighbour(most, id, codes)
                       ? cases::rule::color_location
                       : rule_of(most, unit_.allows(color_of(most, id, witness, false), codes));
    if (witness.knows_fragments) {
        // Who wrote last is known: only those before it may have come in another order.
        Sequence turned = most;
        std::reverse(turned.begin(), turned.end() - std::min<std::ptrdiff_t>(1, std::ssize(most)));
        verdict.kind = most.size() > 2 && leaves(turned, id, witness, codes)
                           ? ColorVerdict::Kind::order
                           : ColorVerdict::Kind::value;
        return verdict;
    }
    tell_coverage(most, id, codes, verdict);
    const bool is_turned =
        verdict.kind == ColorVerdict::Kind::order && std::ranges::any_of(most, is_clear);
    if (is_turned || (verdict.triangle && is_clear(*verdict.triangle))) {
        verdict.kind = ColorVerdict::Kind::value;
        verdict.rule = cases::rule::clear_attachments;
    }
    return verdict;
}

std::array<uint32_t, 4> ColorReference::codes(size_t index, cases::SampleId id,
                                              const ColorWitness& witness) {
    const std::vector<Sequence> lists = allowed(index, witness, true);
    return unit_.codes_of(lists.empty() ? cleared_ : color_of(lists.front(), id, witness));
}

std::vector<uint32_t> ColorReference::drawn(size_t index) const {
    std::vector<Sequence> lists = allowed(index, {}, true);
    return lists.empty() ? Sequence() : std::move(lists.front());
}

std::array<uint32_t, 4> ColorReference::codes_after(std::span<const uint32_t> triangles,
                                                    cases::SampleId id,
                                                    const ColorWitness& witness) {
    return unit_.codes_of(color_of({triangles.begin(), triangles.end()}, id, witness));
}

std::vector<ColorStep> ColorReference::steps(size_t index, cases::SampleId id) {
    std::vector<ColorStep> out = {
        {std::nullopt, case_.target.color->load == cases::LoadOp::dont_care
                           ? std::string("what the target holds at first is not cared for")
                           : fmt::format("the target is cleared to {}", unit_.text_of(cleared_))}};
    color::Color before = cleared_;
    for (const uint32_t triangle : drawn(index)) {
        const cases::ColorOutput& output = output_of(triangle);
        const color::Source& source = source_of(triangle, id);
        const color::Color left = unit_.write(output, color::color_of(source), before);
        out.push_back({triangle, color::step_text(unit_, output, source, before, left)});
        before = left;
    }
    return out;
}

}  // namespace ref
