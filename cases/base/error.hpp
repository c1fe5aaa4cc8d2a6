// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace cases {

// Where something stands in a text file; line and column count from 1, 0 means unknown.
struct SourceLocation {
    std::string file;
    uint32_t line = 0;
    uint32_t column = 0;
    static void fields(auto&& visit, auto&... w) {
        visit("file", w.file...);
        visit("line", w.line...);
        visit("column", w.column...);
    }
};

// One thing wrong with a file or a request, told in one sentence: what is wrong, where, what to do.
struct Error {
    SourceLocation where;
    std::string message;
};
using Errors = std::vector<Error>;

// An error of no file, as a function returns it.
inline tl::unexpected<Error> failure(std::string message) {
    return tl::unexpected(Error{{}, std::move(message)});
}

template <class First, class... Rest>
tl::unexpected<Error> failure(fmt::format_string<First, Rest...> text, First&& first,
                              Rest&&... rest) {
    return failure(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

template <class T>
using Expected = tl::expected<T, Error>;
template <class T>
using ExpectedAll = tl::expected<T, Errors>;

// "file:line:column: error: message"; parts of the location that are unknown are left out.
std::string to_string(const Error& error);

}  // namespace cases
