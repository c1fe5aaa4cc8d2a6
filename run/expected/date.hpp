// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Days, as expectation files have them.
#pragma once

#include <string>
#include <string_view>

namespace run {

// True for a day of the calendar, YYYY-MM-DD.
bool is_date(std::string_view s);

// Today in UTC, YYYY-MM-DD.
std::string today_utc();

}  // namespace run
