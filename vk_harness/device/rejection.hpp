// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "vk_harness/public/harness.hpp"

namespace vk_harness {

// Why a case must not be drawn: the device lacks something, or the case is invalid. What looks at a
// part of a case throws it.
struct Rejection {
    Rendered::Status status = Rendered::Status::unsupported;
    std::string reason;
};

template <class... T>
Rejection unsupported(fmt::format_string<T...> text, T&&... values) {
    return {Rendered::Status::unsupported, fmt::format(text, std::forward<T>(values)...)};
}

template <class... T>
Rejection invalid(fmt::format_string<T...> text, T&&... values) {
    return {Rendered::Status::error, fmt::format(text, std::forward<T>(values)...)};
}

// Throws that the device cannot draw the case, if a sentence says why.
inline void refuse(std::optional<std::string> why) {
    if (why) {
        throw Rejection{Rendered::Status::unsupported, *std::move(why)};
    }
}
// The case needs a feature; `lacks`: which the device has not.
inline void refuse_without(bool lacks, std::string_view feature) {
    if (lacks) {
        throw unsupported("the device lacks the feature {}", feature);
    }
}

}  // namespace vk_harness
