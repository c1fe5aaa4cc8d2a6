// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/base/regex.hpp"

#include <re2/re2.h>

namespace cases {

namespace {

RE2::Options quietly() {
    RE2::Options options;
    options.set_log_errors(false);
    return options;
}

}  // namespace

Expected<void> check_regex(std::string_view regex) {
    const RE2 compiled({regex.data(), regex.size()}, quietly());
    if (!compiled.ok()) {
        // A long expression is in the message once, and not in RE2's sentence again.
        return failure("'{}' is not a regular expression ({})", regex.substr(0, 200),
                       std::string_view(compiled.error()).substr(0, 80));
    }
    return {};
}

std::optional<std::pair<size_t, size_t>> find_regex(std::string_view regex, std::string_view text) {
    const RE2 compiled({regex.data(), regex.size()}, quietly());
    re2::StringPiece match;
    const re2::StringPiece whole(text.data(), text.size());
    if (!compiled.ok() || !compiled.Match(whole, 0, whole.size(), RE2::UNANCHORED, &match, 1)) {
        return std::nullopt;
    }
    const auto begin = static_cast<size_t>(match.data() - text.data());
    return std::pair(begin, begin + match.size());
}

}  // namespace cases
