// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/stencil.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "cases/model/words.hpp"

namespace fuzz {

namespace {

// Values near the ends of a byte, and near what the first operations leave, come more often.
uint32_t near_value(uint32_t clear, Dice& dice) {
    switch (dice.below(6)) {
        case 0:
            return static_cast<uint32_t>(dice.below(256));
        case 1:
            return 255;
        case 2:
            return (clear + 1) % 256;
        case 3:
            return static_cast<uint32_t>(dice.below(4));
        default:
            return clear;
    }
}

// Some of the bits, those beyond the attachment's included, which count for nothing.
std::string mask(Dice& dice) {
    static constexpr std::array<uint32_t, 8> kMasks = {0xff, 0,    1,    0x80,
                                                       0xf,  0xfe, 0xaa, 0xffffff0fU};
    return fmt::format("{}", dice.of(kMasks));
}

// The keys of one face, or of both. `counts`: the operation where a fragment passes, if the pose
// has none of its own.
std::vector<std::string> face_keys(const Pose& pose, size_t number, uint32_t clear,
                                   std::string_view counts, Dice& turn, Dice& dice) {
    std::vector<std::string> keys;
    const auto key = [&keys](std::string_view name, std::string_view word) {
        keys.push_back(fmt::format("{} = \"{}\"", name, word));
    };
    if (!pose.is_default("stencil-compare") && (number > 0 || pose.is("draws", "1"))) {
        key("compare", pose.value("stencil-compare"));
    }
    if (pose.is_default("stencil-ops")) {
        key("pass", counts);
    } else {
        for (const std::string_view outcome : {"fail", "depth_fail", "pass"}) {
            key(outcome, turn.of(cases::kWords<cases::StencilOp>));
        }
    }
    keys.push_back(fmt::format("reference = {}", near_value(clear, dice)));
    if (!pose.is_default("stencil-masks")) {
        keys.push_back("compare_mask = " + mask(turn));
        keys.push_back("write_mask = " + mask(turn));
    }
    return keys;
}

}  // namespace

uint32_t stencil_clear_of(const Pose& pose, Dice& dice) {
    static constexpr std::array<uint32_t, 6> kClears = {1, 2, 127, 128, 254, 255};
    return pose.is_default("stencil_clear") ? 0 : dice.of(kClears);
}

std::string stencil_of(const Pose& pose, size_t number, uint32_t clear, Dice& turn, Dice& dice) {
    if (pose.is_default("stencil-compare") && pose.is_default("stencil-ops") &&
        pose.is_default("stencil-masks")) {
        return {};
    }
    if (pose.is("stencil-ops", "same")) {
        const std::vector<std::string> both = face_keys(pose, number, clear, "", turn, dice);
        return fmt::format("{{ {} }}", fmt::join(both, ", "));
    }
    const std::vector<std::string> front =
        face_keys(pose, number, clear, "increment-wrap", turn, dice);
    const std::vector<std::string> back =
        face_keys(pose, number, clear, "decrement-wrap", turn, dice);
    return fmt::format("{{ front = {{ {} }}, back = {{ {} }} }}", fmt::join(front, ", "),
                       fmt::join(back, ", "));
}

}  // namespace fuzz
