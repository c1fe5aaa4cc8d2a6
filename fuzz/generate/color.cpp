// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/color.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "cases/format/color_format.hpp"
#include "cases/model/words.hpp"

namespace fuzz {

namespace {

const cases::ColorFormatRow& row_of(const Pose& pose) {
    const auto row = std::ranges::find_if(
        cases::kColorFormats,
        [&](const cases::ColorFormatRow& r) { return pose.is("color", r.word); });
    return row == cases::kColorFormats.end() ? cases::kColorFormats.front() : *row;
}

// A code of so many bits: patterns of bits, the ends, and any.
uint64_t code_of(uint32_t bits, Dice& dice) {
    const uint64_t largest = (uint64_t{1} << bits) - 1;
    switch (dice.below(6)) {
        case 0:
            return 0x5555'5555U & largest;
        case 1:
            return 0xcccc'cccc'ccccU & largest;
        case 2:
            return largest;
        case 3:
            return uint64_t{1} << dice.below(bits);
        default:
            return dice.below(largest + 1);
    }
}

std::string component(const Pose& pose, uint32_t k, Dice& dice) {
    const cases::ColorFormatRow& row = row_of(pose);
    const bool is_code = !pose.is_default("logic");
    const uint32_t bits = row.bits.at(k);
    if (is_integer(row.kind)) {
        const cases::Whole range = cases::whole_range(row.format, k);
        const auto least = static_cast<int64_t>(range.least),
                   most = static_cast<int64_t>(range.most);
        if (is_code) {
            const uint32_t own = std::min(bits == 0 ? row.bits[0] : bits, 24U);
            return fmt::format("{}", least + static_cast<int64_t>(code_of(own, dice)));
        }
        const int64_t near = dice.one_in(4) ? INT32_MAX : 255;
        return fmt::format("{}", dice.between(std::max(least, -near), std::min(most, near)));
    }
    if (is_code && row.kind == cases::ComponentKind::unorm && bits > 0) {
        return fmt::format("\"{}/{}\"", code_of(bits, dice), (uint64_t{1} << bits) - 1);
    }
    // What lies beyond 0 to 1 is clamped by some formats, before or after blending, and not by
    // others. binary16 ends at 65504, which the largest ones exceed: infinity may be stored then,
    // of which nothing is known once it is blended or resolved.
    const bool is_float =
        (row.kind == cases::ComponentKind::half || row.kind == cases::ComponentKind::binary32) &&
        pose.is_default("blend") && pose.is_default("resolve");
    const uint64_t kind = dice.below(16);
    if (kind < 2 && is_float) {
        const double sign = dice.one_in(3) ? -1 : 1;
        const auto exponent = static_cast<int>(dice.between(-12, 14));
        const auto significand = dice.fraction(1, 15, 1);
        return fmt::format("{}", sign * std::ldexp(significand, exponent));
    }
    return fmt::format(
        "{}", static_cast<double>(kind < 3 ? dice.between(-16, 48) : dice.between(0, 16)) / 16);
}

// Those of one colour. Half of them are of the constants or saturated, which need each other's
// numbers to show.
std::string_view factor(bool has_second, Dice& dice) {
    const auto& words = cases::kWords<cases::BlendFactor>;
    constexpr auto kSecond = static_cast<uint64_t>(cases::BlendFactor::src1_color);
    constexpr auto kFirstRare = static_cast<uint64_t>(cases::BlendFactor::constant_color);
    if (has_second && dice.one_in(2)) {
        return words[kSecond + dice.below(words.size() - kSecond)];
    }
    return words[dice.one_in(3) ? kFirstRare + dice.below(kSecond - kFirstRare)
                                : dice.below(kSecond)];
}

std::string equation(bool has_second, Dice& dice) {
    const auto& ops = cases::kWords<cases::BlendOp>;
    const std::string_view source = factor(has_second, dice);
    const std::string_view destination = factor(has_second, dice);
    // The operations without factors say little of them.
    const std::string_view op = dice.one_in(2) ? "add" : ops[dice.below(ops.size())];
    return fmt::format("source = \"{}\", destination = \"{}\", op = \"{}\"", source, destination,
                       op);
}

std::string factors(const Pose& pose, Dice& turn, Dice& dice) {
    const bool has_second = !pose.is_default("second");
    std::string keys;
    do {
        keys = equation(has_second, turn);
        if (turn.one_in(2)) {
            keys += fmt::format(", alpha = {{ {} }}", equation(has_second, turn));
        }
    } while (has_second && keys.find("src1") == std::string::npos);
    keys = fmt::format(", blend = {{ {} }}, constants = {}", keys, color_of(pose, dice));
    return has_second ? keys + fmt::format(", second = {}", color_of(pose, dice)) : keys;
}

// Of several draws the last one does what the pose says, and so that it has something to do it to,
// an early one may just write, or do something else.
std::string logic(const Pose& pose, bool is_last, Dice& dice) {
    if (pose.is_default("logic") || (!is_last && dice.one_in(3))) {
        return {};
    }
    const auto& words = cases::kWords<cases::LogicOp>;
    const bool is_other = !is_last && dice.one_in(2);
    return fmt::format(", logic = \"{}\"",
                       is_other ? words[dice.below(words.size())] : pose.value("logic"));
}

}  // namespace

bool has_integers(const Pose& pose) {
    return is_integer(row_of(pose).kind);
}

std::string color_of(const Pose& pose, Dice& dice) {
    std::vector<std::string> numbers;
    for (uint32_t k = 0; k < 4; ++k) {
        numbers.push_back(component(pose, k, dice));
    }
    // An alpha that keeps no sample or all of them: of others nothing is known.
    if (!pose.is_default("alpha_to_coverage") && dice.one_in(2)) {
        numbers.back() = dice.one_in(2) ? "0" : "1";
    }
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string color_keys_of(const Pose& pose, size_t number, size_t draws, std::string_view source,
                          Dice& turn, Dice& dice) {
    const bool is_last = number + 1 == draws;
    // Now and then the last draw has nothing of what an early one has, which has to end with that.
    const bool is_plain = is_last && draws > 1 && turn.one_in(5);
    const auto has = [&] { return is_last ? !is_plain : !turn.one_in(3); };
    std::string keys(source);
    if (!pose.is_default("blend") && has()) {
        keys += pose.is("blend", "factors") ? factors(pose, turn, dice)
                                            : fmt::format(", blend = \"{}\"", pose.value("blend"));
    }
    keys += is_plain ? "" : logic(pose, is_last, turn);
    if (!pose.is_default("write_mask") && has()) {
        keys += fmt::format(", write_mask = \"{}\"", pose.value("write_mask"));
    }
    if (!pose.is_default("alpha_to_one") && has()) {
        keys += ", alpha_to_one = true";
    }
    if (!pose.is_default("alpha_to_coverage") && has()) {
        keys += ", alpha_to_coverage = true";
    }
    return fmt::format("{{ {} }}", keys);
}

}  // namespace fuzz
