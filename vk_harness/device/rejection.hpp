// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "vk_harness/public/harness.hpp"

namespace vk_harness {

// Why a case must not be drawn: the device lacks something, or the case is invalid.
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

}  // namespace vk_harness
