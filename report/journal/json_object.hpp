// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Objects of records that there are thousands of. nlohmann's braces make a list of lists first,
// copy from it, and compare each key with all before it.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

namespace report {

struct JsonField {
    const char* key;
    nlohmann::ordered_json value;
};

// The fields in their order behind those that are there; no two have the same key. The values are
// moved out of the array.
template <size_t N>
void append_fields(nlohmann::ordered_json::object_t& object, JsonField (&&fields)[N]) {
    object.reserve(object.size() + N);
    for (JsonField& field : fields) {
        object.emplace_back(field.key, std::move(field.value));
    }
}

template <size_t N>
nlohmann::ordered_json object_of(JsonField (&&fields)[N]) {
    nlohmann::ordered_json::object_t object;
    append_fields(object, std::move(fields));
    return nlohmann::ordered_json(std::move(object));
}

}  // namespace report
