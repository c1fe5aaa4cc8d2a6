// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/inputs.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

#include "cases/model/words.hpp"
#include "fuzz/generate/color.hpp"

namespace fuzz {

namespace {

constexpr std::string_view kClipTable = "[[draw.clip_distance]]\n";

std::string list_of(const std::vector<std::string>& words) {
    return fmt::format("[{}]", fmt::join(words, ", "));
}

std::string interpolation_of(const Pose& pose, size_t attribute) {
    const std::string_view mode = pose.is("interpolation", "mixed")
                                      ? cases::kWords<cases::Interpolation>.at(attribute % 3)
                                      : pose.value("interpolation");
    return mode == "smooth" ? "" : fmt::format("interpolation = \"{}\"\n", mode);
}

std::string values_of(size_t vertices, size_t components, bool has_sign, Dice& dice) {
    std::vector<std::string> values;
    // Neither negative nor positive now and then, wherever it is taken.
    const int64_t largest = has_sign && dice.one_in(8) ? 0 : 32;
    for (size_t v = 0; v < vertices; ++v) {
        std::vector<std::string> one;
        for (size_t c = 0; c < components; ++c) {
            one.push_back(fmt::format("{}", dice.fraction(has_sign ? -largest : 0, largest, 32)));
        }
        values.push_back(list_of(one));
    }
    return fmt::format("values = {}\n", list_of(values));
}

std::string color_attribute(const Pose& pose, size_t vertices, Dice& dice) {
    const bool is_integer = has_integers(pose);
    std::vector<std::string> colors;
    for (size_t v = 0; v < vertices; ++v) {
        colors.push_back(color_of(pose, dice));
    }
    return fmt::format("[[draw.attribute]]\nname = \"c\"\n{}values = {}\n",
                       is_integer ? "interpolation = \"flat\"\n" : interpolation_of(pose, 0),
                       list_of(colors));
}

// The keys of the probe, and how many components it has.
std::pair<std::string, size_t> probe_of(const Pose& pose, size_t components, Dice& state) {
    const std::string_view probe = pose.value("probe");
    std::string keys = fmt::format("probe = \"{}\"\n", probe);
    if (probe == "at-sample") {
        keys += fmt::format("sample = {}\n",
                            state.below(std::stoul(std::string(pose.value("samples")))));
    } else if (probe == "at-offset") {
        const double y = state.fraction(-8, 7, 16), x = state.fraction(-8, 7, 16);
        keys += fmt::format("offset = [{}, {}]\n", x, y);
    } else if (probe == "query-lod") {
        const uint32_t height = 1U << state.below(9), width = 1U << state.below(9);
        keys += fmt::format("texture = [{}, {}]\n", width, height);
        components = 2;
    }
    return {keys, components};
}

}  // namespace

std::string distances_of(const Pose& pose, size_t vertices, Dice& dice) {
    std::string text;
    for (const auto& [feature, table] :
         {std::pair{"clip-distances", kClipTable},
          std::pair{"cull-distances", std::string_view("[[draw.cull_distance]]\n")}}) {
        const auto count = std::stoul(std::string(pose.value(feature)));
        for (size_t k = 0; k < count; ++k) {
            text += table;
            if (dice.one_in(2)) {
                const double d = dice.fraction(-8, 8, 8);
                const int64_t c = dice.between(-1, 1);
                const int64_t b = dice.between(-3, 3), a = dice.between(-3, 3);
                text += fmt::format("half_space = [{}, {}, {}, {}]\n", a, b, c, d);
                continue;
            }
            std::vector<std::string> values;
            for (size_t v = 0; v < vertices; ++v) {
                values.push_back(fmt::format("{}", dice.fraction(-8, 8, 4)));
            }
            text += fmt::format("values = {}\n", list_of(values));
        }
    }
    return text;
}

std::string attributes_of(const Pose& pose, size_t vertices, bool has_sign, Dice& state,
                          Dice& dice) {
    std::string text;
    if (!pose.is_default("color-from") && !pose.is_default("color")) {
        text += color_attribute(pose, vertices, dice);
    }
    const std::string_view count = pose.value("attributes");
    const size_t attributes = count == "none" ? 0U : count == "one" ? 1U : count == "two" ? 2U : 3U;
    for (size_t a = 0; a < attributes; ++a) {
        text += "[[draw.attribute]]\n" + interpolation_of(pose, a);
        if (!pose.is_default("auxiliary")) {
            text += fmt::format("auxiliary = \"{}\"\n", pose.value("auxiliary"));
        }
        // One of them is a plain input, if there are several.
        if (const std::string_view source =
                pose.value(pose.is_default("fragment-input") ? "source" : "fragment-input");
            a == 0 && source != "vertex") {
            text += fmt::format("source = \"{}\"\n", source);
            continue;
        }
        size_t components = 1 + state.below(4);
        if (a == 0 && !pose.is_default("probe")) {
            const auto [keys, of_probe] = probe_of(pose, components, state);
            text += keys;
            components = of_probe;
        }
        text += values_of(vertices, components, has_sign, dice);
    }
    return text;
}

std::string complement_of(std::string draw) {
    for (size_t at = 0; (at = draw.find(kClipTable, at)) != std::string::npos;) {
        at += kClipTable.size();
        draw.insert(at, "negate = true\n");
    }
    return draw;
}

}  // namespace fuzz
