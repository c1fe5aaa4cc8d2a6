// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/json_codec.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/base/utf8.hpp"
#include "report/journal/picture_codec.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace detail {

void fail(const char* key, const std::string& what) {
    throw std::invalid_argument(fmt::format("\"{}\" {}", key, what));
}

const Json& list_of(const Json& json, const char* key) {
    if (!json.is_array()) {
        fail(key, "is not a list");
    }
    return json;
}

const Json* member(const Json& object, const char* key) {
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
}

int64_t signed_of(const Json& json, const char* key) {
    if (!json.is_number_integer()) {
        fail(key, "is not a whole number");
    }
    return json.get<int64_t>();
}

uint64_t whole_of(const Json& json, const char* key, uint64_t largest) {
    if (!json.is_number_unsigned() || json.get<uint64_t>() > largest) {
        fail(key, fmt::format("is not a whole number from 0 to {}", largest));
    }
    return json.get<uint64_t>();
}

Json encode_picture(const std::vector<uint8_t>& picture) {
    return report::encode_picture(picture);
}

std::vector<uint8_t> decode_picture(const Json& json, const char* key) {
    auto bytes = json.is_string() ? report::decode_picture(json.get_ref<const std::string&>())
                                  : std::nullopt;
    if (!bytes) {
        fail(key, "is not a picture");
    }
    return std::move(*bytes);
}

cases::Profile decode_word(const Json& json, const char* key, cases::Profile) {
    const auto profile = cases::parse_profile(decode_text(json, key));
    if (!profile) {
        fail(key, "is not a profile");
    }
    return *profile;
}

Status decode_word(const Json& json, const char* key, Status) {
    const auto status = parse_status(decode_text(json, key));
    if (!status) {
        fail(key, "is not a status");
    }
    return *status;
}

diff::FindingKind decode_word(const Json& json, const char* key, diff::FindingKind) {
    const std::string name = decode_text(json, key);
    for (size_t k = 0; k < diff::kFindingKinds; ++k) {
        if (name == diff::to_string(static_cast<diff::FindingKind>(k))) {
            return static_cast<diff::FindingKind>(k);
        }
    }
    fail(key, "is not a kind of finding");
}

}  // namespace detail

Json encode_text(std::string_view bytes) {
    if (cases::is_utf8(bytes)) {
        return std::string(bytes);
    }
    return Json{{"bytes", base64_encode(bytes)}};
}

std::string decode_text(const Json& json, const char* key) {
    if (json.is_string()) {
        return json.get<std::string>();
    }
    if (json.is_object() && json.size() == 1 && json.contains("bytes") &&
        json.at("bytes").is_string()) {
        if (auto bytes = base64_decode(json.at("bytes").get_ref<const std::string&>())) {
            return *bytes;
        }
    }
    detail::fail(key, "is not text");
}

Json encode_number(double value) {
    if (std::isnan(value)) {
        return "nan";
    }
    if (std::isinf(value)) {
        return value > 0 ? "inf" : "-inf";
    }
    return value;  // nlohmann writes the shortest text that reads back as the same binary64
}

Json encode_totals(const Run& run) {
    Json total = Json::object();
    const auto count = totals(run);
    for (size_t k = 0; k < kStatuses; ++k) {
        total[std::string(to_string(static_cast<Status>(k)))] = count.at(k);
    }
    return total;
}

double decode_number(const Json& json, const char* key) {
    if (json.is_number()) {
        return json.get<double>();
    }
    if (json.is_string()) {
        const auto& name = json.get_ref<const std::string&>();
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        if (name == "inf") {
            return kInfinity;
        }
        if (name == "-inf") {
            return -kInfinity;
        }
        if (name == "nan") {
            return std::numeric_limits<double>::quiet_NaN();
        }
    }
    detail::fail(key, "is not a number");
}

namespace {

// Reads a member of an object that has to be there.
template <class T>
void read(const Json& json, const char* key, T& to) {
    const Json* value = json.is_object() ? detail::member(json, key) : nullptr;
    if (value == nullptr) {
        detail::fail(key, "is missing");
    }
    decode(*value, key, to);
}

// Entry k of a list.
template <class T>
void read(const Json& list, size_t k, const char* key, T& to) {
    if (detail::list_of(list, key).size() <= k) {
        detail::fail(key, "is too short");
    }
    decode(list[k], key, to);
}

}  // namespace

Json encode(const Shape& t) {
    Json json{{"of", t.layer == 0 ? Json::array({t.draw, t.primitive})
                                  : Json::array({t.draw, t.primitive, t.layer})},
              {"v", encode(t.vertex)},
              {"p", t.has_points ? encode(t.points) : Json::array()},
              {"flags", (t.is_exact ? 1U : 0U) | (t.is_clipped ? 2U : 0U)}};
    if (t.is_clipped) {
        json["piece"] = encode(t.piece);
    }
    if (!t.cuts.empty()) {
        json["cuts"] = encode(t.cuts);
    }
    if (!t.boxes.empty()) {
        json["boxes"] = encode(t.boxes);
    }
    return json;
}

void decode(const Json& json, const char* /*key*/, Shape& to) {
    std::vector<uint32_t> of;
    std::vector<int64_t> points;
    uint32_t flags = 0;
    read(json, "of", of);
    read(json, "v", to.vertex);
    read(json, "p", points);
    read(json, "flags", flags);
    if (of.size() < 2 || (!points.empty() && points.size() != to.points.size())) {
        detail::fail(of.size() < 2 ? "of" : "p", "is too short");
    }
    to.draw = of[0];
    to.primitive = of[1];
    to.layer = of.size() > 2 ? of[2] : 0;
    to.has_points = !points.empty();
    std::ranges::copy(points, to.points.begin());
    to.is_exact = (flags & 1U) != 0;
    to.is_clipped = (flags & 2U) != 0;
    if (to.is_clipped) {
        read(json, "piece", to.piece);
    }
    // Left out where there are none, and by older journals.
    if (json.contains("cuts")) {
        read(json, "cuts", to.cuts);
    }
    if (json.contains("boxes")) {
        read(json, "boxes", to.boxes);
    }
}

Json encode(const SampleValue& v) {
    Json list =
        Json::array({encode(v.quantity), encode(v.exact), encode(v.nearest), encode(v.budget),
                     encode(v.low), encode(v.high), v.has_device ? Json(v.bits) : Json(nullptr)});
    if (!v.also.empty()) {
        list.push_back(encode(v.also));
    }
    return list;
}

void decode(const Json& json, const char* key, SampleValue& to) {
    std::optional<uint32_t> bits;
    read(json, 0, key, to.quantity);
    read(json, 1, key, to.exact);
    read(json, 2, key, to.nearest);
    read(json, 3, key, to.budget);
    read(json, 4, key, to.low);
    read(json, 5, key, to.high);
    read(json, 6, key, bits);
    to.has_device = bits.has_value();
    to.bits = bits.value_or(0);
    if (json.size() > 7) {
        read(json, 7, key, to.also);
    }
}

}  // namespace report
