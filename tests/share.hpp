// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Tests that would take too long with everything that the suite has run a share of it: the I-th of
// N by EDGECASE_SUITE_SHARE=I/N, as --shard has it (1/1: all, by night), else one that moves on as
// the suite grows. What takes too long for a night has a variable of its own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

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

inline constexpr const char* kSuiteShare = "EDGECASE_SUITE_SHARE";

// What the variable says; nothing without it. A variable that is no share fails the test.
inline std::optional<Share> asked_share(const char* variable) {
    const char* text = std::getenv(variable);
    if (text == nullptr) {
        return std::nullopt;
    }
    const std::string_view words(text);
    const size_t slash = words.find('/');
    Share asked;
    const auto parse = [](std::string_view part, size_t& to) {
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), to);
        return error == std::errc{} && end == part.data() + part.size();
    };
    const bool is_good = slash != std::string_view::npos &&
                         parse(words.substr(0, slash), asked.share) &&
                         parse(words.substr(slash + 1), asked.shares) && asked.share > 0 &&
                         asked.share <= asked.shares;
    EXPECT_TRUE(is_good) << variable << "=" << words << ": must be I/N with 1 <= I <= N";
    if (!is_good) {
        return std::nullopt;
    }
    --asked.share;
    return asked;
}

// `usual`: without the variable one of so many shares.
inline Share share_of(size_t usual, size_t suite_size, const char* variable = kSuiteShare) {
    return asked_share(variable).value_or(Share{suite_size % usual, usual});
}

// The numbers below `count`, each once and in an order without meaning: of cases that are looked
// through until something is seen, families that begin the suite would cost most.
inline std::vector<size_t> spread(size_t count) {
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
    return order;
}

// How many rounds a test of random triangles makes: all of them where all of the suite is asked
// for, else a quarter.
inline int rounds(int all) {
    const std::optional<Share> asked = asked_share(kSuiteShare);
    return asked && asked->shares == 1 ? all : (all + 3) / 4;
}

}  // namespace test_support
