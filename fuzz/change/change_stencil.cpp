// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Changes of stencil states and of blits.
#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "fuzz/change/change.hpp"

namespace fuzz {

namespace {

constexpr std::array<std::string_view, 3> kOutcomes = {"fail", "depth_fail", "pass"};

// One of the keys that have values to try.
Words change_any(Document& table, const cases::KeyTable& keys, Dice& dice) {
    std::vector<std::string_view> some;
    for (const cases::Key& key : keys.keys) {
        if (key.has_values()) {
            some.push_back(key.name);
        }
    }
    return set_any(table, keys, any_of(some, dice), dice);
}

// Each face gets a table of its own.
void part_faces(Document& stencil) {
    if (find(stencil, "front") == nullptr && find(stencil, "back") == nullptr) {
        Document both = stencil;
        stencil = table();
        set(stencil, "front", both);
        set(stencil, "back", std::move(both));
    }
}

}  // namespace

Words change_stencil(Document& document, Dice& dice) {
    Words words;
    Document* draw = any_draw(document, dice, words);
    Document* target = find(document, "target");
    if (draw == nullptr || target == nullptr) {
        return {};
    }
    if (find(*draw, "stencil") != nullptr && dice.one_in(4)) {
        erase(*draw, "stencil");
        return words + "without a stencil state";
    }
    set(*target, "stencil", boolean(true));
    if (dice.one_in(4)) {
        return "target " + set_any(*target, cases::kTargetKeys, "stencil_clear", dice);
    }
    Document* stencil = find(*draw, "stencil");
    if (stencil == nullptr) {
        stencil = &set(*draw, "stencil", table());
        for (const std::string_view outcome : kOutcomes) {
            set_any(*stencil, cases::kStencilKeys, outcome, dice);
        }
        set_any(*stencil, cases::kStencilKeys, "reference", dice);
    }
    const uint64_t which = dice.below(4);
    if (which < 2) {
        part_faces(*stencil);
    }
    Document* front = find(*stencil, "front");
    Document* back = find(*stencil, "back");
    if (front == nullptr && back == nullptr) {
        return words + "stencil " + change_any(*stencil, cases::kStencilFaceKeys, dice);
    }
    const bool is_front = back == nullptr || (front != nullptr && which % 2 == 0);
    return fmt::format("{}stencil {} {}", words, is_front ? "front" : "back",
                       change_any(is_front ? *front : *back, cases::kStencilFaceKeys, dice));
}

Words change_blit(Document& document, Dice& dice) {
    static constexpr std::array<std::string_view, 2> kRegions = {"from", "to"};
    Document* blit = find(document, "blit");
    Document* target = find(document, "target");
    Document* color = target == nullptr ? nullptr : find(*target, "color");
    if (blit == nullptr || color == nullptr) {
        return {};
    }
    switch (dice.below(6)) {
        case 0:
            return "target colour " + change_any(*color, cases::kTargetColorKeys, dice);
        case 1:
        case 2:
        case 3:
            return "blit " + change_any(*blit, cases::kBlitKeys, dice);
        default: {
            const std::string_view name = dice.of(kRegions);
            Document* region = find(*blit, name);
            if (region == nullptr || region->array.size() != 4) {
                return {};
            }
            const size_t axis = dice.below(2);
            std::swap(region->array[axis], region->array[axis + 2]);
            return fmt::format("blit {} mirrored {}", name, axis == 0 ? "across" : "down");
        }
    }
}

}  // namespace fuzz
