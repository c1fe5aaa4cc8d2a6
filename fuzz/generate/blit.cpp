// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/blit.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/format/color_format.hpp"
#include "fuzz/generate/color.hpp"

namespace fuzz {

namespace {

// A format of numbers, or of integers, which are blitted to integers only.
std::string_view format_of(bool is_integer, Dice& dice) {
    std::vector<std::string_view> words;
    for (const cases::ColorFormatRow& row : kPoseFormats) {
        if ((row.kind == cases::ComponentKind::uint) == is_integer) {
            words.push_back(row.word);
        }
    }
    return words[dice.below(words.size())];
}

// Two different numbers from 0 to `side`, mostly in their order: the other one mirrors.
std::array<int64_t, 2> ends_of(uint32_t side, Dice& dice) {
    const auto most = static_cast<int64_t>(side);
    if (dice.one_in(3)) {
        return dice.one_in(3) ? std::array{most, int64_t{0}} : std::array{int64_t{0}, most};
    }
    std::array<int64_t, 2> ends = {dice.between(0, most - 1), most};
    ends[1] = dice.between(ends[0] + 1, most);
    if (dice.one_in(3)) {
        std::swap(ends[0], ends[1]);
    }
    return ends;
}

std::string corners(std::string_view key, std::array<int64_t, 2> x, std::array<int64_t, 2> y) {
    return fmt::format("{} = [{}, {}, {}, {}]\n", key, x[0], y[0], x[1], y[1]);
}

}  // namespace

std::string blit_of(const Pose& pose, uint32_t width, uint32_t height, Dice& dice) {
    const bool is_integer = pose.is("blit", "nearest") && dice.one_in(5);
    const std::string_view format = format_of(is_integer, dice);
    std::string text = fmt::format("[target.color]\nformat = \"{}\"\n", format);
    if (dice.one_in(2)) {
        // Numbers with exact codes in every format.
        std::array<uint64_t, 4> clear{};
        for (uint64_t& component : clear) {
            component = dice.below(2);
        }
        text += fmt::format("clear = [{}]\n", fmt::join(clear, ", "));
    }
    text += "\n[blit]\n";
    if (!dice.one_in(3)) {
        text += fmt::format("format = \"{}\"\n", format_of(is_integer, dice));
    }
    const auto across = static_cast<uint32_t>(dice.between(1, 20));
    const auto down = static_cast<uint32_t>(dice.between(1, 20));
    text += fmt::format("size = [{}, {}]\n", across, down);
    text += dice.one_in(4) ? "pattern = \"ramp\"\n" : fmt::format("seed = {}\n", dice.below(100));
    text += fmt::format("filter = \"{}\"\n", pose.value("blit"));
    const auto from_y = ends_of(down, dice), from_x = ends_of(across, dice);
    text += corners("from", from_x, from_y);
    if (dice.one_in(6)) {
        // A region of the source's size may reach beyond the target: its end is cut texel by texel.
        const int64_t y = dice.between(-3, static_cast<int64_t>(height) - 1);
        const int64_t x = dice.between(-3, static_cast<int64_t>(width) - 1);
        const auto side = [](std::array<int64_t, 2> ends) {
            return ends[0] < ends[1] ? ends[1] - ends[0] : ends[0] - ends[1];
        };
        if (x + side(from_x) > 0 && y + side(from_y) > 0) {
            return text + corners("to", {x, x + side(from_x)}, {y, y + side(from_y)}) +
                   "clip = true\n";
        }
    }
    const auto to_y = ends_of(height, dice), to_x = ends_of(width, dice);
    return text + corners("to", to_x, to_y);
}

}  // namespace fuzz
