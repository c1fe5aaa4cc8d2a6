// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/date.hpp"

#include <array>
#include <chrono>
#include <ctime>

namespace run {

bool is_date(std::string_view s) {
    if (s.size() != 10) {
        return false;
    }
    for (size_t k = 0; k < s.size(); ++k) {
        if (k == 4 || k == 7 ? s[k] != '-' : s[k] < '0' || s[k] > '9') {
            return false;
        }
    }
    const auto number = [&](size_t begin, size_t length) {
        return std::stoi(std::string(s.substr(begin, length)));
    };
    using namespace std::chrono;  // NOLINT(google-build-using-namespace): its calendar
    return year_month_day(year(number(0, 4)), month(static_cast<unsigned>(number(5, 2))),
                          day(static_cast<unsigned>(number(8, 2))))
        .ok();
}

std::string today_utc() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &utc);
    return text.data();
}

}  // namespace run
