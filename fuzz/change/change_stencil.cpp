// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Changes of stencil states and of blits.
#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "cases/model/words.hpp"
#include "fuzz/change/change.hpp"

namespace fuzz {

namespace {

// Where operations end or begin anew, and where a mask takes bits away.
constexpr std::array<double, 8> kValues = {0, 1, 2, 127, 128, 170, 254, 255};
constexpr std::array<std::string_view, 3> kOutcomes = {"fail", "depth_fail", "pass"};
constexpr std::array<std::string_view, 3> kNumbers = {"reference", "compare_mask", "write_mask"};

Words set_word(Document& face, std::string_view key, std::string_view word) {
    set(face, key, text(std::string(word)));
    return fmt::format("{} {}", key, word);
}

// One key of a face.
Words change_face(Document& face, Dice& dice) {
    const uint64_t kind = dice.below(7);
    if (kind == 0) {
        return set_word(face, "compare", any_of(cases::kWords<cases::CompareOp>, dice));
    }
    if (kind < 4) {
        const std::string_view outcome = dice.of(kOutcomes);
        return set_word(face, outcome, any_of(cases::kWords<cases::StencilOp>, dice));
    }
    const std::string_view key = dice.of(kNumbers);
    const double value = dice.of(kValues);
    set(face, key, number(value));
    return fmt::format("{} {}", key, value);
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
        const double clear = dice.of(kValues);
        set(*target, "stencil_clear", number(clear));
        return fmt::format("the stencil cleared to {}", clear);
    }
    Document* stencil = find(*draw, "stencil");
    if (stencil == nullptr) {
        stencil = &set(*draw, "stencil", table());
        for (const std::string_view outcome : kOutcomes) {
            set_word(*stencil, outcome, any_of(cases::kWords<cases::StencilOp>, dice));
        }
        set(*stencil, "reference", number(dice.of(kValues)));
    }
    const uint64_t which = dice.below(4);
    if (which < 2) {
        part_faces(*stencil);
    }
    Document* front = find(*stencil, "front");
    Document* back = find(*stencil, "back");
    if (front == nullptr && back == nullptr) {
        return words + "stencil " + change_face(*stencil, dice);
    }
    const bool is_front = back == nullptr || (front != nullptr && which % 2 == 0);
    return fmt::format("{}stencil {} {}", words, is_front ? "front" : "back",
                       change_face(is_front ? *front : *back, dice));
}

Words change_blit(Document& document, Dice& dice) {
    static constexpr std::array<std::string_view, 2> kRegions = {"from", "to"};
    Document* blit = find(document, "blit");
    Document* target = find(document, "target");
    Document* color = target == nullptr ? nullptr : find(*target, "color");
    if (blit == nullptr || color == nullptr) {
        return {};
    }
    const std::string_view format = any_of(cases::kWords<cases::ColorFormat>, dice);
    switch (dice.below(6)) {
        case 0:
            return "blit " +
                   set_word(*blit, "filter", any_of(cases::kWords<cases::BlitFilter>, dice));
        case 1:
            return "blit " +
                   set_word(*blit, "pattern", any_of(cases::kWords<cases::BlitPattern>, dice));
        case 2:
            return "target colour " + set_word(*color, "format", format);
        case 3:
            return "blit " + set_word(*blit, "format", format);
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
