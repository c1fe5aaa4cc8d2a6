// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/beside.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "cases/format/color_format.hpp"
#include "cases/load/color.hpp"
#include "fuzz/generate/color.hpp"

namespace fuzz {

namespace {

constexpr std::string_view kTarget = "[target.color]\n", kDraw = "\ncolor = ";
constexpr std::array<std::string_view, 6> kMasks = {"rgba", "rgba", "", "r", "gba", "rgb"};

// From `begin` to the end of what closes it, or nothing.
std::string key_of(std::string_view text, std::string_view begin, char close) {
    const size_t from = text.find(begin);
    const size_t to = from == std::string_view::npos ? from : text.find(close, from + begin.size());
    return to == std::string_view::npos ? std::string()
                                        : std::string(text.substr(from, to + 1 - from));
}

std::string number_of(bool is_integer, Dice& dice) {
    return is_integer ? fmt::format("{}", dice.below(256))
                      : fmt::format("{}", dice.fraction(-8, 32, 16));
}

std::string value_of(bool is_integer, Dice& dice) {
    std::vector<std::string> numbers;
    for (int k = 0; k < 4; ++k) {
        numbers.push_back(number_of(is_integer, dice));
    }
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

// What a draw that writes `own` to its judged target writes to one of a format.
std::string output_of(std::string_view own, cases::ColorFormat format, Dice& dice) {
    const bool is_integer = cases::is_integer(format);
    const std::string attribute = key_of(own, "attribute = \"", '"');
    std::string out = !is_integer && !attribute.empty() && dice.one_in(2)
                          ? attribute
                          : "value = " + value_of(is_integer, dice);
    if (!is_integer && dice.one_in(2)) {
        out += fmt::format(", blend = \"{}\"",
                           cases::kBlendWords[1 + dice.below(cases::kBlendWords.size() - 1)]);
        // All that is blended has the same constants, and all colours the same operation.
        const std::string constants = key_of(own, "constants = [", ']');
        out += constants.empty() ? "" : ", " + constants;
    }
    const std::string logic = key_of(own, "logic = \"", '"');
    out += logic.empty() ? "" : ", " + logic;
    return fmt::format("{{ {}, write_mask = \"{}\" }}", out, dice.of(kMasks));
}

std::string list_of(std::vector<std::string> others, size_t judged, std::string own) {
    others.insert(others.begin() + static_cast<std::ptrdiff_t>(judged), std::move(own));
    return fmt::format("[{}]", fmt::join(others, ", "));
}

}  // namespace

std::string beside_others(std::string text, Dice dice) {
    const size_t target = text.find(kTarget);
    const size_t end = text.find("\n\n", target);
    if (target == std::string::npos || end == std::string::npos) {
        return text;
    }
    std::vector<cases::ColorFormat> formats;
    // With attributes there is less room.
    const uint64_t most = text.find("[[draw.attribute]]") == std::string::npos ? 3 : 1;
    for (uint64_t count = 1 + dice.below(most); formats.size() < count;) {
        formats.push_back(kPoseFormats[dice.below(kPoseFormats.size())].format);
    }
    const size_t judged = dice.below(formats.size() + 1);
    std::vector<std::string> targets;
    for (const cases::ColorFormat format : formats) {
        targets.push_back(fmt::format("{{ format = \"{}\", clear = {} }}", cases::name_of(format),
                                      value_of(cases::is_integer(format), dice)));
    }
    // The keys of the table, a line each.
    std::string own = text.substr(target + kTarget.size(), end - target - kTarget.size());
    while (own.find('\n') != std::string::npos) {
        own.replace(own.find('\n'), 1, ", ");
    }
    std::string out =
        text.substr(0, target) +
        fmt::format("color = {}\njudged = {}", list_of(targets, judged, "{ " + own + " }"), judged);
    text.erase(0, end);
    for (size_t at = text.find(kDraw); at != std::string::npos; at = text.find(kDraw)) {
        const size_t line_end = text.find('\n', at + 1);
        const std::string output = text.substr(at + kDraw.size(), line_end - at - kDraw.size());
        std::vector<std::string> outputs;
        for (const cases::ColorFormat format : formats) {
            outputs.push_back(output_of(output, format, dice));
        }
        out += text.substr(0, at) + std::string(kDraw) + list_of(outputs, judged, output);
        text.erase(0, line_end);
    }
    return out + text;
}

}  // namespace fuzz
