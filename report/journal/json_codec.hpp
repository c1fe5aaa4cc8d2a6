// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The records of the journal as JSON and back, by their lists of fields (cases/base/fields.hpp).
// Exact: bytes that are not UTF-8 become {"bytes": base64}, infinities and NaN become strings,
// pictures base64 of runs. Reading is strict; it throws std::invalid_argument with a sentence.
#pragma once

#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "cases/base/fields.hpp"
#include "report/record/run.hpp"

namespace report {

nlohmann::ordered_json encode_text(std::string_view bytes);
nlohmann::ordered_json encode_number(double value);

// `key` is what an error calls it.
std::string decode_text(const nlohmann::ordered_json& json, const char* key);
double decode_number(const nlohmann::ordered_json& json, const char* key);

// Cases by status.
nlohmann::ordered_json encode_totals(const Run& run);

// Compact, as a list where there are thousands; otherwise like the templates below.
nlohmann::ordered_json encode(const Shape& triangle);
nlohmann::ordered_json encode(const SampleValue& value);
void decode(const nlohmann::ordered_json& json, const char* key, Shape& to);
void decode(const nlohmann::ordered_json& json, const char* key, SampleValue& to);

namespace detail {

using Json = nlohmann::ordered_json;

// Throws "KEY" + what is wrong with it.
[[noreturn]] void fail(const char* key, const std::string& what);
const Json& list_of(const Json& json, const char* key);
// Nullptr if there is no such member.
const Json* member(const Json& object, const char* key);
int64_t signed_of(const Json& json, const char* key);
uint64_t whole_of(const Json& json, const char* key, uint64_t largest);
Json encode_picture(const std::vector<uint8_t>& picture);
std::vector<uint8_t> decode_picture(const Json& json, const char* key);

cases::Profile decode_word(const Json& json, const char* key, cases::Profile);
Status decode_word(const Json& json, const char* key, Status);
diff::FindingKind decode_word(const Json& json, const char* key, diff::FindingKind);

// Whether a field that may be left out is as constructed.
template <class T>
bool is_empty(const T& value) {
    if constexpr (cases::is_optional<T> || std::is_same_v<T, bool>) {
        return !value;
    } else if constexpr (requires { value.empty(); }) {
        return value.empty();
    } else if constexpr (cases::HasFields<T> && std::equality_comparable<T>) {
        return value == T{};
    } else {
        return false;
    }
}

template <class T>
inline constexpr bool is_picture = std::is_same_v<T, std::vector<uint8_t>>;

}  // namespace detail

template <class T>
nlohmann::ordered_json encode(const T& value) {
    using detail::Json;
    if constexpr (cases::HasFields<T>) {
        Json::object_t object;  // Json's own braces would look for each key among all before it
        T::fields(
            [&object]<class M>(const cases::Field& field, const M& member) {
                const bool is_left_out =
                    field.has(cases::kLeftOutIfEmpty) && detail::is_empty(member);
                if (!field.has(cases::kNotReported) && !is_left_out) {
                    object.emplace_back(field.name, encode(member));
                }
            },
            value);
        return Json(std::move(object));
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
        return encode_text(value);
    } else if constexpr (std::is_floating_point_v<T>) {
        return encode_number(value);
    } else if constexpr (std::is_enum_v<T>) {
        return to_string(value);
    } else if constexpr (cases::is_optional<T>) {
        return value ? encode(*value) : Json(nullptr);
    } else if constexpr (cases::is_pair<T>) {
        return Json::array({encode(value.first), encode(value.second)});
    } else if constexpr (detail::is_picture<T>) {
        return detail::encode_picture(value);
    } else if constexpr (cases::is_vector<T> || cases::is_array<T>) {
        Json list = Json::array();
        for (const auto& entry : value) {
            list.push_back(encode(entry));
        }
        return list;
    } else {
        static_assert(std::is_integral_v<T>);
        return value;
    }
}

template <class T>
void decode(const nlohmann::ordered_json& json, const char* key, T& to) {
    if constexpr (cases::HasFields<T>) {
        if (!json.is_object()) {
            throw std::invalid_argument("a record is not an object");
        }
        T::fields(
            [&json](const cases::Field& field, auto& member) {
                if (field.has(cases::kNotReported)) {
                    return;
                }
                if (const auto* value = detail::member(json, field.name)) {
                    decode(*value, field.name, member);
                } else if (!field.has(cases::kOlderLackIt) && !field.has(cases::kLeftOutIfEmpty)) {
                    detail::fail(field.name, "is missing");
                }
            },
            to);
    } else if constexpr (std::is_same_v<T, std::string>) {
        to = decode_text(json, key);
    } else if constexpr (std::is_floating_point_v<T>) {
        to = static_cast<T>(decode_number(json, key));
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_boolean()) {
            detail::fail(key, "is neither true nor false");
        }
        to = json.get<bool>();
    } else if constexpr (std::is_enum_v<T>) {
        to = detail::decode_word(json, key, to);
    } else if constexpr (cases::is_optional<T>) {
        to.reset();
        if (!json.is_null()) {
            decode(json, key, to.emplace());
        }
    } else if constexpr (cases::is_pair<T>) {
        if (!json.is_array() || json.size() != 2) {
            detail::fail(key, "holds something that is not a name and a value");
        }
        decode(json[0], key, to.first);
        decode(json[1], key, to.second);
    } else if constexpr (detail::is_picture<T>) {
        to = detail::decode_picture(json, key);
    } else if constexpr (cases::is_vector<T>) {
        for (const auto& entry : detail::list_of(json, key)) {
            decode(entry, key, to.emplace_back());
        }
    } else if constexpr (cases::is_array<T>) {
        if (detail::list_of(json, key).size() != to.size()) {
            detail::fail(key, "does not have " + std::to_string(to.size()) + " entries");
        }
        for (size_t k = 0; k < to.size(); ++k) {
            decode(json[k], key, to[k]);
        }
    } else if constexpr (std::is_signed_v<T>) {
        static_assert(std::is_same_v<T, int64_t>);
        to = detail::signed_of(json, key);
    } else {
        to = static_cast<T>(detail::whole_of(json, key, std::numeric_limits<T>::max()));
    }
}

// A whole record.
template <class T>
T decode(const nlohmann::ordered_json& json) {
    T value;
    decode(json, "record", value);
    return value;
}

}  // namespace report
