// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/stencil/values.hpp"

#include <fmt/format.h>

namespace ref::stencil {

uint32_t least_of(const Values& values) {
    uint32_t value = 0;
    while (!values[value]) {
        ++value;
    }
    return value;
}

std::string to_text(const Values& values, std::string_view between, size_t most) {
    std::string out;
    size_t told = 0;
    for (size_t value = 0; value < values.size(); ++value) {
        if (values[value] && told++ < most) {
            out += fmt::format("{}{}", out.empty() ? "" : between, value);
        }
    }
    return told > most ? fmt::format("{} and {} others", out, told - most) : out;
}

}  // namespace ref::stencil
