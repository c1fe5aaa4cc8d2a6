// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/page/page_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace report {

std::string_view page_style() {
    // From report/page/ (cmake/Embed.cmake).
    constexpr std::string_view kStyle =
#include "embedded/report.css.inc"
        ;
    return kStyle;
}

std::string script_data(std::string_view json) {
    std::string text;
    text.reserve(json.size() + json.size() / 16);
    for (const char c : json) {
        if (c == '<' || c == '>' || c == '&') {
            text += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
        } else {
            text += c;
        }
    }
    return text;
}

std::string fill_page(std::string_view page, std::span<const PageField> fields) {
    std::string text;
    for (const auto& [name, value] : fields) {
        const size_t at = page.find(name);
        text += page.substr(0, at);
        text += value;
        page.remove_prefix(std::min(page.size(), at + name.size()));
    }
    text += page;
    return text;
}

}  // namespace report
