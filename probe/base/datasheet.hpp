// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What was found out about a rasterizer: one property a question, each with how sure it is.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace probe {

inline constexpr std::string_view kCannotTell = "cannot tell";

// A number that was measured beside the answer: "largest error", 0.31, "budgets".
struct Figure {
    std::string name;
    double value = 0;
    std::string unit;
    friend bool operator==(const Figure&, const Figure&) = default;
};

// What a page draws of a property, and how.
enum class PictureKind : uint8_t { none, star, curve, staircase };
struct Picture {
    PictureKind kind = PictureKind::none;
    std::vector<std::array<double, 2>> points;
    std::vector<uint8_t> marks = {};  // of a star: whether the edge in that direction owns ties
    std::array<std::string, 2> axes = {};  // what x and y are, with their units
    friend bool operator==(const Picture&, const Picture&) = default;
};

// A question and its answer. Observations are decisive where the possible answers predict
// different pictures; `agree` and `contradict` count those, by the answer that is given.
struct Property {
    std::string id;        // "grid.bits.x"; the word before the first dot is its section
    std::string question;  // "Subpixel bits in effect along x"
    std::string answer = std::string(kCannotTell);
    uint64_t agree = 0, contradict = 0;
    std::string experiment;  // how it was found, one sentence
    std::string why;         // of 'cannot tell', one sentence; else a remark or nothing
    std::vector<Figure> figures = {};
    Picture picture = {};

    bool is_known() const { return answer != kCannotTell; }
    std::string section() const { return id.substr(0, id.find('.')); }
    friend bool operator==(const Property&, const Property&) = default;
};

struct Datasheet {
    // What the device says of itself, in the order in which it is told: name, value.
    std::vector<std::pair<std::string, std::string>> device;
    std::vector<Property> properties;

    const Property* find(std::string_view id) const;
    // The answer of a property, 'cannot tell' if there is none.
    std::string_view answer(std::string_view id) const;
};

// "grid" -> "Subpixel grid": the sections of a datasheet in their order.
struct Section {
    std::string_view name, title;
};
inline constexpr auto kSections = std::to_array<Section>({
    {"grid", "Subpixel grid"},
    {"ties", "Samples on edges"},
    {"samples", "Samples and where inputs are evaluated"},
    {"setup", "Set-up of triangles"},
    {"precision", "Precision"},
    {"clipping", "Clipping"},
    {"conservative", "Conservative rasterization"},
    {"depth", "Depth"},
    {"color", "Colours"},
    {"blending", "Blending"},
    {"inputs", "Inputs"},
    {"derivatives", "Derivatives and level of detail"},
    {"resolve", "Resolves"},
    {"blit", "Blits"},
});

}  // namespace probe
