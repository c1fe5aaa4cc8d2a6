// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Tests that would take too long with everything that the suite has run a share of it: the k-th of
// n by VARIABLE=k/n (0/1: all), else one that moves on as the suite grows.
#pragma once

#include <gtest/gtest.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace test_support {

struct Share {
    size_t share = 0, shares = 1;

    // The same names at every run and on every machine.
    bool has(std::string_view name) const {
        uint32_t hash = 2166136261U;  // FNV-1a
        for (const char c : name) {
            hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
        }
        return hash % shares == share;
    }
};

// `usual`: without the variable one of so many shares. A variable that is no share fails the test.
inline Share share_of(const char* variable, size_t usual, size_t suite_size) {
    Share out{suite_size % usual, usual};
    if (const char* text = std::getenv(variable)) {
        const std::string_view words(text);
        const size_t slash = words.find('/');
        Share asked;
        const auto parse = [](std::string_view part, size_t& to) {
            const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), to);
            return error == std::errc{} && end == part.data() + part.size();
        };
        const bool is_good =
            slash != std::string_view::npos && parse(words.substr(0, slash), asked.share) &&
            parse(words.substr(slash + 1), asked.shares) && asked.share < asked.shares;
        EXPECT_TRUE(is_good) << variable << "=" << words << ": must be k/n with k < n";
        if (is_good) {
            out = asked;
        }
    }
    return out;
}

}  // namespace test_support
