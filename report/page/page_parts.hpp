// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What all pages are made of: a template with fields, one style, data in a script element.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace report {

// The style sheet of every page.
std::string_view page_style();

// JSON inside <script>: no "<" at all, so neither "</script>" nor "<!--" can end or change it.
std::string script_data(std::string_view json);

// A template whose fields ("{{DATA}}") are replaced in the order in which they stand in it; what is
// put in is never searched for fields again.
using PageField = std::pair<std::string_view, std::string>;
std::string fill_page(std::string_view page, std::span<const PageField> fields);

}  // namespace report
