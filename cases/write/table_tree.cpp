// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/table_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <vector>

#include "cases/toml/binary32.hpp"

namespace cases {

namespace {

// Outside of these exponents a power of two is easier to read as a power than in digits.
constexpr int kSmallPower = -16;
constexpr int kLargePower = 30;

TomlValue non_finite(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    for (const char* word : {"nan", "-nan", "inf", "-inf"}) {
        if (read_special_number(word)->non_finite == bits) {
            return tree::text(word);
        }
    }
    return tree::text(fmt::format("bits(0x{:08x})", bits));
}

}  // namespace

TomlValue number_value(float value, Reading reading) {
    if (!std::isfinite(value)) {
        return non_finite(value);
    }
    // What a TOML float means is the nearest binary64, which is rounded again.
    const std::string plain = shortest(value);
    double read = 0;
    std::from_chars(plain.data(), plain.data() + plain.size(), read);
    const bool is_plain = reading == Reading::exact ? !(read < static_cast<double>(value)) &&
                                                          !(read > static_cast<double>(value))
                                                    : same_bits(static_cast<float>(read), value);
    std::vector<std::string> ways;
    int exponent = 0;
    const float half = std::frexp(value, &exponent);  // of magnitude 1/2 for a power of two
    const bool is_far = exponent - 1 < kSmallPower || exponent - 1 > kLargePower;
    if (is_far && same_bits(std::fabs(half), 0.5F)) {
        ways.push_back(fmt::format("{}2^{}", value < 0 ? "-" : "", exponent - 1));
    }
    if (!is_plain) {
        ways.push_back(plain + "f");
        ways.push_back(fmt::format("{:a}", value));
    }
    const auto shortest_way = std::ranges::min_element(ways, {}, &std::string::size);
    constexpr size_t kQuotes = 2;
    return shortest_way == ways.end() ||
                   (is_plain && plain.size() <= shortest_way->size() + kQuotes)
               ? tree::number(read)
               : tree::text(*shortest_way);
}

TomlValue whole_numbers(std::initializer_list<int64_t> values) {
    std::vector<TomlValue> items;
    for (const int64_t value : values) {
        items.push_back(tree::number(static_cast<double>(value)));
    }
    return tree::list(std::move(items));
}

void TableTree::add(std::string_view key, TomlValue value) {
    const Key* const row = keys_.find(key);
    if (row == nullptr) {
        return;
    }
    std::vector<TomlEntry>& entries = value_.table;
    const auto at = std::ranges::lower_bound(
        entries, row, {}, [this](const TomlEntry& entry) { return keys_.find(entry.key); });
    if (at != entries.end() && at->key == key) {
        at->value = std::move(value);
    } else {
        entries.insert(at, {std::string(key), {}, std::move(value)});
    }
}

}  // namespace cases
