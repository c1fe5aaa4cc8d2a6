// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of the loader's sentences share: case files that are wrong in one place.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "cases/load/loader.hpp"

namespace cases {

inline const std::string kHead = "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n";
inline const std::string kTarget = "[target]\nsize = [8, 8]\n";
inline const std::string kDraw = "[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n";

// A case file that is right but for `text`: all of it, its top, [target], [matrix] (two leaves for
// `leaves`), [[draw]], what follows a triangle, a generator or an attribute.
inline std::string whole(const std::string& text) {
    return text;
}
inline std::string top(const std::string& text) {
    return kHead + text + "\n" + kTarget + kDraw;
}
inline std::string target(const std::string& text) {
    return kHead + "[target]\n" + text + "\n" + kDraw;
}
inline std::string matrix(const std::string& text) {
    return kHead + "[matrix]\n" + text + "\n" + kTarget + kDraw;
}
inline std::string leaves(const std::string& text, const std::string& beside = "") {
    return kHead + (beside.empty() ? "" : beside + "\n") + "[matrix]\nk = [0, 1]\n" + kTarget +
           "[[draw]]\n" + text + "\n";
}
// A key beside a matrix of keys that a vertex uses: i, j and k.
inline std::string pairs(const std::string& key, const std::string& axes,
                         const std::string& end = "") {
    return kHead + key + "\n[matrix]\n" + axes + "\n" + kTarget +
           "[[draw]]\nvertices = [[\"i\",\"j\"],[8,0],[\"k\",8]]\n" + end + "\n";
}
inline std::string draw(const std::string& text) {
    return kHead + kTarget + "[[draw]]\n" + text + "\n";
}
inline std::string triangle(const std::string& text) {
    return kHead + kTarget + kDraw + text + "\n";
}
inline std::string generator(const std::string& text) {
    return draw("generate = { " + text + " }");
}
inline std::string attribute(const std::string& text) {
    return triangle("[[draw.attribute]]\n" + text);
}

inline std::string errors_of(const std::string& toml) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(toml, "f", "id");
    if (loaded) {
        return "no error";
    }
    std::string text;
    for (const Error& error : loaded.error()) {
        text += (text.empty() ? "" : "\n") + to_string(error);
    }
    return text;
}

// A file, and every sentence that is said of it with its place, word for word.
struct Row {
    std::string toml;
    std::string errors;
};
inline void expect_words(std::span<const Row> rows) {
    for (const Row& row : rows) {
        EXPECT_EQ(errors_of(row.toml), row.errors) << row.toml;
    }
}

}  // namespace cases
