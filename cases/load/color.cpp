// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/color.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace cases {

namespace {

using Kind = TomlValue::Kind;

// Whether component k of a format of integers holds the number.
bool is_whole(float number, ColorFormat format, uint32_t k) {
    const Whole range = whole_range(format, k);
    return number >= range.least && number <= range.most && !(std::floor(number) < number);
}

std::optional<Blend> read_blend(LeafContext& context, const TomlValue& value,
                                const ColorTarget& target) {
    std::optional<Blend> out;
    if (value.is(Kind::table)) {
        context.known_keys(value, kBlendKeys);
        context.read_all(value, kBlendAlphaKeys, out.emplace().color);
        out->alpha = out->color;
        if (const TomlValue* alpha = value.find("alpha");
            alpha != nullptr && context.table(*alpha, "alpha")) {
            context.known_keys(*alpha, kBlendAlphaKeys);
            context.read_all(*alpha, kBlendAlphaKeys, out->alpha = {});
        }
    } else if (const auto word = context.word(value, "blend", kBlendWords); word && *word > 0) {
        out = blend_of_word(*word);
    }
    if (out && is_integer(target.format)) {
        context.error(value.where, fmt::format("a target of integers ({}) is not blended; leave "
                                               "blend out",
                                               name_of(target.format)));
    }
    return out;
}

uint8_t read_write_mask(LeafContext& context, const TomlValue& value) {
    const std::string text = context.named_text(context.text(value, "write_mask").value_or(""));
    uint8_t mask = 0;
    for (const char letter : text) {
        const size_t k = std::string_view("rgba").find(letter);
        if (k == std::string_view::npos || (static_cast<unsigned>(mask) >> k & 1U) != 0) {
            context.error(value.where, fmt::format("write_mask is \"{}\"; write each of the "
                                                   "letters r, g, b and a at most once",
                                                   text));
            return mask;
        }
        mask = static_cast<uint8_t>(mask | 1U << k);
    }
    return mask;
}

// Whether it is a value from the vertices alone.
bool is_plain(const Attribute& attribute) {
    return attribute.source == Source::vertex && attribute.probe == Probe::value;
}

int32_t read_attribute_name(LeafContext& context, const TomlValue& value, const ColorTarget& target,
                            const std::vector<Attribute>& attributes) {
    const std::optional<std::string> name = context.text(value, "the colour's attribute");
    if (!name) {
        return -1;
    }
    const auto found = std::ranges::find(attributes, *name, &Attribute::name);
    if (found == attributes.end()) {
        context.error(value.where,
                      fmt::format("the draw has no attribute \"{}\" for its colour", *name));
        return -1;
    }
    if (!is_plain(*found)) {
        context.error(
            value.where,
            fmt::format("the colour cannot be the attribute \"{}\", which is not a value from "
                        "the vertices alone",
                        *name));
        return -1;
    }
    if (is_integer(target.format)) {
        const bool whole = std::ranges::all_of(found->values, [&](const glm::vec4& v) {
            return std::ranges::all_of(std::array{0U, 1U, 2U, 3U}, [&](uint32_t k) {
                return is_whole(v[static_cast<int>(k)], target.format, k);
            });
        });
        if (found->interpolation != Interpolation::flat || !whole) {
            context.error(value.where, fmt::format("the colour of a target of integers ({}) needs "
                                                   "a flat attribute of whole numbers that it "
                                                   "holds",
                                                   name_of(target.format)));
        }
    }
    return static_cast<int32_t>(found - attributes.begin());
}

// The colour that factors of the second source take.
void read_second(LeafContext& context, const TomlValue& table, const Target& target,
                 const ColorTarget& color, ColorOutput& out) {
    const bool takes = out.blend && takes_second(*out.blend);
    const TomlValue* second = table.find("second");
    if (second == nullptr) {
        if (takes) {
            context.error(table.where,
                          "blend has a factor of the second source; write second = [r, g, b, a]");
        }
        return;
    }
    if (!takes) {
        context.error(second->where,
                      "second without a factor of the second source means nothing; leave it out");
        return;
    }
    if (target.has_instruments) {
        context.error(second->where,
                      "a device may blend a second source into one attachment alone; write "
                      "attachments = \"color\" or \"color+depth\" in [target]");
    }
    out.blend->second = read_color(context, *second, "second", color.format).value_or(glm::vec4(0));
}

constexpr float kLeastMaskAlpha = 0.75F;

// A shader that has its colour from elsewhere than a push constant writes this colour alone.
void check_source(LeafContext& context, const TomlValue& value, const Target& target,
                  const ColorTarget& color, const ColorOutput& out,
                  const std::vector<Attribute>& attributes) {
    if (out.from == ColorFrom::push_constant) {
        return;
    }
    const SourceLocation& where = value.find("from")->where;
    if (target.has_instruments || !target.other_colors.empty() || is_integer(color.format)) {
        context.error(where,
                      "from is of one colour of numbers alone; write attachments = \"color\" or "
                      "\"color+depth\" in [target], and one [target.color]");
    } else if (out.from == ColorFrom::texels &&
               (value.find("attribute") == nullptr || attributes.empty() || out.attribute != 0)) {
        context.error(
            where,
            "the texel is the colour, and the first attribute says which; write attribute "
            "instead of value, with the name of the first");
    } else if (out.from != ColorFrom::texels && value.find("attribute") != nullptr) {
        context.error(where, "from says where a value comes from; write value, or leave out from");
    } else if (out.blend && takes_second(*out.blend)) {
        context.error(where, "from does not go with a second source; leave it out");
    } else if (is_texture(out.from) && (attributes.empty() || !is_plain(attributes.front()))) {
        context.error(where,
                      "a texture is read at the draw's first attribute, a value from the vertices; "
                      "write [[draw.attribute]]");
    } else if (out.from == ColorFrom::mask && !(out.value.w >= kLeastMaskAlpha)) {
        context.error(where,
                      "of a mask all is discarded that has an alpha below 1/2; write 3/4 or "
                      "more");
    }
}

}  // namespace

Blend blend_of_word(size_t index) {
    using F = BlendFactor;
    const auto both = [](F source, F destination, BlendOp op) {
        return Blend{{source, destination, op}, {source, destination, op}};
    };
    const std::array<Blend, kBlendWords.size()> presets = {
        {{},
         {{F::src_alpha, F::one_minus_src_alpha, BlendOp::add},
          {F::one, F::one_minus_src_alpha, BlendOp::add}},
         both(F::one, F::one_minus_src_alpha, BlendOp::add),
         both(F::one, F::one, BlendOp::add),
         both(F::dst_color, F::zero, BlendOp::add),
         both(F::one, F::one, BlendOp::reverse_subtract),
         both(F::one, F::one, BlendOp::min),
         both(F::one, F::one, BlendOp::max)}};
    return presets.at(index);
}

std::optional<glm::vec4> read_color(LeafContext& context, const TomlValue& value,
                                    const std::string& what, ColorFormat format) {
    const std::optional<std::vector<Number>> numbers = context.numbers(value, what, 4);
    if (!numbers) {
        return std::nullopt;
    }
    glm::vec4 color{};
    for (size_t k = 0; k < 4; ++k) {
        const SourceLocation& where = value.array[k].where;
        const std::optional<float> number = context.binary32((*numbers)[k], where, what);
        if (!number) {
            return std::nullopt;
        }
        if (is_integer(format) && !is_whole(*number, format, static_cast<uint32_t>(k))) {
            const Whole range = whole_range(format, static_cast<uint32_t>(k));
            context.error(where,
                          fmt::format("{} is not a whole number from {} to {}, as the format "
                                      "{} needs it",
                                      what, range.least, range.most, name_of(format)));
            return std::nullopt;
        }
        color[static_cast<int>(k)] = *number;
    }
    return color;
}

std::optional<ColorTarget> read_color_target(LeafContext& context, const TomlValue& value) {
    if (!context.table(value, "color")) {
        return std::nullopt;
    }
    context.known_keys(value, kTargetColorKeys);
    ColorTarget out;
    context.read_all(value, kTargetColorKeys, out);
    if (value.find("format") == nullptr) {
        context.error(value.where,
                      "[target.color] has no format; write one, as format = \"rgba8-unorm\"");
        return std::nullopt;
    }
    if (const TomlValue* clear = value.find("clear")) {
        out.clear = read_color(context, *clear, "clear", out.format).value_or(glm::vec4(0));
    }
    return out;
}

namespace {

ColorOutput read_color_output(LeafContext& context, const TomlValue& value, const Target& target,
                              const ColorTarget& color, const std::vector<Attribute>& attributes) {
    ColorOutput out;
    if (!context.table(value, "color")) {
        return out;
    }
    context.known_keys(value, kColorKeys);
    context.read_all(value, kColorKeys, out);
    const TomlValue* constant = value.find("value");
    const TomlValue* attribute = value.find("attribute");
    if ((constant != nullptr) == (attribute != nullptr)) {
        context.error(value.where, constant != nullptr
                                       ? "color has both value and attribute; keep one"
                                       : "color has no value; write value = [r, g, b, a] or "
                                         "attribute = \"its name\"");
        return out;
    }
    if (constant != nullptr) {
        out.value = read_color(context, *constant, "value", color.format).value_or(glm::vec4(0));
    } else {
        out.attribute = read_attribute_name(context, *attribute, color, attributes);
    }
    if (const TomlValue* blend = value.find("blend")) {
        out.blend = read_blend(context, *blend, color);
    }
    if (const TomlValue* constants = value.find("constants")) {
        if (!out.blend) {
            context.error(constants->where, "constants without blend mean nothing; leave them out");
        } else {
            out.blend->constants =
                read_color(context, *constants, "constants", color.format).value_or(glm::vec4(0));
        }
    }
    read_second(context, value, target, color, out);
    check_source(context, value, target, color, out, attributes);
    const auto needs_no_instruments = [&](const char* key, bool is_on, std::string_view why) {
        if (is_on && target.has_instruments) {
            context.error(value.find(key)->where,
                          fmt::format("{}; write attachments = \"color\" or \"color+depth\" in "
                                      "[target]",
                                      why));
        }
    };
    needs_no_instruments("logic", out.logic.has_value(),
                         "a logical operation switches off the blending that counts hits");
    needs_no_instruments("alpha_to_one", out.alpha_to_one,
                         "alpha to one changes the attachments that tell of fragments");
    needs_no_instruments("alpha_to_coverage", out.alpha_to_coverage,
                         "alpha to coverage takes the alpha of what tells of fragments");
    if (const TomlValue* mask = value.find("write_mask")) {
        out.write_mask = read_write_mask(context, *mask);
    }
    return out;
}

// A device has blend constants and a logical operation once for all of a draw's colours.
void check_shared(LeafContext& context, const TomlValue& value,
                  const std::vector<ColorOutput>& all) {
    const auto is_same = [](const glm::vec4& a, const glm::vec4& b) {
        return std::memcmp(&a, &b, sizeof a) == 0;
    };
    const ColorOutput* blended = nullptr;
    for (const ColorOutput& one : all) {
        if (one.alpha_to_one) {
            context.error(value.where,
                          "alpha to one changes the colour at location 0 alone; write one colour "
                          "target");
        }
        if (one.alpha_to_coverage) {
            context.error(value.where,
                          "alpha to coverage takes the alpha of the colour at location 0 alone; "
                          "write one colour target");
        }
        if (one.blend && takes_second(*one.blend)) {
            context.error(value.where,
                          "a device may blend a second source into one attachment alone; write one "
                          "colour target");
        }
        if (one.logic != all.front().logic) {
            context.error(value.where,
                          "a draw has one logical operation for all its colours; write the same in "
                          "each of them");
        }
        if (blended != nullptr && one.blend &&
            !is_same(blended->blend->constants, one.blend->constants)) {
            context.error(value.where,
                          "a draw has one set of blend constants for all its colours; write the "
                          "same in each that blends");
        }
        blended = blended == nullptr && one.blend ? &one : blended;
        if (!context.errors().empty()) {
            return;
        }
    }
}

}  // namespace

void read_color_outputs(LeafContext& context, const TomlValue& value, const Target& target,
                        Draw& draw) {
    if (target.other_colors.empty()) {
        draw.color = read_color_output(context, value, target, *target.color, draw.attributes);
        return;
    }
    const uint32_t count = target.color_count();
    if (!value.is(Kind::array) || value.array.size() != count) {
        context.error(value.where, fmt::format("the target has {} colours; write a list of as many "
                                               "tables, in the order of [target]'s",
                                               count));
        return;
    }
    std::vector<ColorOutput> all;
    for (uint32_t k = 0; k < count; ++k) {
        all.push_back(read_color_output(context, value.array[k], target, target.color_at(k),
                                        draw.attributes));
    }
    check_shared(context, value, all);
    for (const Attribute& attribute : draw.attributes) {
        if (!is_plain(attribute)) {
            context.error(value.where,
                          fmt::format("attribute \"{}\" is not a value from the vertices alone; "
                                      "several colour targets go with those only",
                                      attribute.name));
        }
    }
    draw.color = all[target.judged_color];
    all.erase(all.begin() + target.judged_color);
    draw.other_colors = std::move(all);
}

}  // namespace cases
