// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/document/document.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace fuzz {

bool erase(Document& table, std::string_view key) {
    return std::erase_if(table.table, [&](const cases::TomlEntry& e) { return e.key == key; }) > 0;
}

bool erase_at(Document* table, std::string_view key, size_t element) {
    Document* list = table == nullptr ? nullptr : find(*table, key);
    if (list == nullptr || element >= list->array.size()) {
        return false;
    }
    list->array.erase(list->array.begin() + static_cast<std::ptrdiff_t>(element));
    return !list->array.empty() || erase(*table, key);
}

bool erase_color(Document& document) {
    Document* target = find(document, "target");
    if (target == nullptr || !erase(*target, "color")) {
        return false;
    }
    for (const char* key : {"judged", "attachments", "resolve"}) {
        erase(*target, key);
    }
    for_each_draw(document, [](Document& draw) { erase(draw, "color"); });
    return true;
}

static uint64_t bits_of(double value) {
    return std::bit_cast<uint64_t>(std::isnan(value) ? std::numeric_limits<double>::quiet_NaN()
                                                     : value);
}

bool is_same(const Document& a, const Document& b) {
    return a.kind == b.kind && a.boolean == b.boolean && a.integer == b.integer &&
           bits_of(a.floating) == bits_of(b.floating) && a.string == b.string &&
           std::ranges::equal(a.array, b.array, is_same) && a.table.size() == b.table.size() &&
           std::ranges::all_of(a.table, [&](const cases::TomlEntry& entry) {
               const Document* other = b.find(entry.key);
               return other != nullptr && is_same(entry.value, *other);
           });
}

}  // namespace fuzz
