// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/evidence_codec.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "report/journal/picture_codec.hpp"
#include "report/journal/record_codec.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

// Entry k of a list, read as a T; anything else is an error that names what is wrong.
const Json& entry(const Json& list, size_t k, const char* what) {
    if (!list.is_array() || k >= list.size()) {
        throw std::invalid_argument(std::string(what) + " is not a list, or too short");
    }
    return list[k];
}
const Json& field(const Json& json, const char* key) {
    if (!json.is_object() || !json.contains(key)) {
        throw std::invalid_argument(std::string("\"") + key + "\" is missing");
    }
    return json.at(key);
}
const Json& list_in(const Json& json, const char* key) {
    const Json& list = field(json, key);
    if (!list.is_array()) {
        throw std::invalid_argument(std::string("\"") + key + "\" is not a list");
    }
    return list;
}
uint32_t u32(const Json& value, const char* what) {
    if (!value.is_number_unsigned() || value.get<uint64_t>() > 0xffffffffU) {
        throw std::invalid_argument(std::string("\"") + what +
                                    "\" is not a whole number from 0 to 4294967295");
    }
    return value.get<uint32_t>();
}
int64_t i64(const Json& value, const char* what) {
    if (!value.is_number_integer()) {
        throw std::invalid_argument(std::string("\"") + what + "\" is not a whole number");
    }
    return value.get<int64_t>();
}

Json shape(const Shape& t) {
    Json points = Json::array();
    if (t.has_points) {
        for (const int64_t p : t.points) {
            points.push_back(p);
        }
    }
    Json json{{"of", t.layer == 0 ? Json::array({t.draw, t.primitive})
                                  : Json::array({t.draw, t.primitive, t.layer})},
              {"v", Json::array({t.vertex[0], t.vertex[1], t.vertex[2]})},
              {"p", points},
              {"flags", (t.is_exact ? 1U : 0U) | (t.is_clipped ? 2U : 0U)}};
    if (t.is_clipped) {
        Json& piece = json["piece"] = Json::array();
        for (const double number : t.piece) {
            piece.push_back(encode_number(number));
        }
    }
    return json;
}

Shape read_shape(const Json& json) {
    Shape t;
    t.draw = u32(entry(field(json, "of"), 0, "\"of\""), "of");
    t.primitive = u32(entry(field(json, "of"), 1, "\"of\""), "of");
    t.layer = field(json, "of").size() > 2 ? u32(field(json, "of")[2], "of") : 0;
    for (size_t k = 0; k < 3; ++k) {
        t.vertex.at(k) = u32(entry(field(json, "v"), k, "\"v\""), "v");
    }
    const Json& points = list_in(json, "p");
    t.has_points = !points.empty();
    for (size_t k = 0; t.has_points && k < t.points.size(); ++k) {
        t.points.at(k) = i64(entry(points, k, "\"p\""), "p");
    }
    const uint32_t flags = u32(field(json, "flags"), "flags");
    t.is_exact = (flags & 1U) != 0;
    t.is_clipped = (flags & 2U) != 0;
    if (t.is_clipped) {
        for (const Json& number : list_in(json, "piece")) {
            t.piece.push_back(decode_number(number, "piece"));
        }
    }
    return t;
}

Json boxes(const std::vector<std::array<int64_t, 4>>& list) {
    Json json = Json::array();
    for (const auto& box : list) {
        json.push_back(Json::array({box[0], box[1], box[2], box[3]}));
    }
    return json;
}

std::vector<std::array<int64_t, 4>> read_boxes(const Json& json, const char* key) {
    std::vector<std::array<int64_t, 4>> list;
    for (const Json& box : list_in(json, key)) {
        list.emplace_back();
        for (size_t k = 0; k < 4; ++k) {
            list.back().at(k) = i64(entry(box, k, key), key);
        }
    }
    return list;
}

std::vector<uint8_t> read_picture(const Json& json, const char* key) {
    const Json& value = field(json, key);
    auto bytes =
        value.is_string() ? decode_picture(value.get_ref<const std::string&>()) : std::nullopt;
    if (!bytes) {
        throw std::invalid_argument(std::string("\"") + key + "\" is not a picture");
    }
    return std::move(*bytes);
}

}  // namespace

Json encode_pictures(const Pictures& p) {
    return Json{{"width", p.width},
                {"height", p.height},
                {"left", p.left},
                {"top", p.top},
                {"layer_height", p.layer_height},
                {"expected_hits", encode_picture(p.expected_hits)},
                {"device_hits", encode_picture(p.device_hits)},
                {"marks", encode_picture(p.marks)},
                {"errors", encode_picture(p.errors)},
                {"device_colors", encode_picture(p.device_colors)},
                {"expected_colors", encode_picture(p.expected_colors)},
                {"device_depths", encode_picture(p.device_depths)},
                {"depth_low", encode_number(p.depth_low)},
                {"depth_high", encode_number(p.depth_high)}};
}

Pictures decode_pictures(const Json& json) {
    Pictures p;
    p.width = u32(field(json, "width"), "width");
    p.height = u32(field(json, "height"), "height");
    p.left = u32(field(json, "left"), "left");
    p.top = u32(field(json, "top"), "top");
    if (json.contains("layer_height")) {
        p.layer_height = u32(field(json, "layer_height"), "layer_height");
    }
    p.expected_hits = read_picture(json, "expected_hits");
    p.device_hits = read_picture(json, "device_hits");
    p.marks = read_picture(json, "marks");
    if (json.contains("errors")) {  // older journals end here
        p.errors = read_picture(json, "errors");
        p.device_colors = read_picture(json, "device_colors");
        p.expected_colors = read_picture(json, "expected_colors");
        p.device_depths = read_picture(json, "device_depths");
        p.depth_low = decode_number(field(json, "depth_low"), "depth_low");
        p.depth_high = decode_number(field(json, "depth_high"), "depth_high");
    }
    return p;
}

Json encode_geometry(const Geometry& g) {
    Json locations = Json::array();
    for (const auto& at : g.sample_locations) {
        locations.push_back(Json::array({at[0], at[1]}));
    }
    Json triangles = Json::array();
    for (const Shape& t : g.triangles) {
        triangles.push_back(shape(t));
    }
    return Json{{"width", g.width},
                {"height", g.height},
                {"samples", g.samples},
                {"locations", locations},
                {"triangles", triangles},
                {"triangle_total", g.triangle_total},
                {"scissors", boxes(g.scissors)},
                {"blit", boxes(g.blit_regions)}};
}

Geometry decode_geometry(const Json& json) {
    Geometry g;
    g.width = u32(field(json, "width"), "width");
    g.height = u32(field(json, "height"), "height");
    g.samples = u32(field(json, "samples"), "samples");
    for (const Json& at : list_in(json, "locations")) {
        const uint32_t x = u32(entry(at, 0, "locations"), "locations");
        const uint32_t y = u32(entry(at, 1, "locations"), "locations");
        if (x > 255 || y > 255) {
            throw std::invalid_argument("\"locations\" holds a number beyond 255");
        }
        g.sample_locations.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y)});
    }
    for (const Json& t : list_in(json, "triangles")) {
        g.triangles.push_back(read_shape(t));
    }
    g.triangle_total = static_cast<uint64_t>(i64(field(json, "triangle_total"), "triangle_total"));
    g.scissors = read_boxes(json, "scissors");
    g.blit_regions = read_boxes(json, "blit");
    return g;
}

Json encode_evidence(const SampleEvidence& e) {
    Json values = Json::array();
    for (const SampleValue& v : e.values) {
        Json list =
            Json::array({encode_text(v.quantity), encode_text(v.exact), encode_number(v.nearest),
                         encode_number(v.budget), encode_number(v.low), encode_number(v.high),
                         v.has_device ? Json(v.bits) : Json(nullptr)});
        if (!v.also.empty()) {
            list.push_back(encode_text(v.also));
        }
        values.push_back(std::move(list));
    }
    return Json{{"at", Json::array({e.x, e.y, e.sample})},
                {"writer", encode_text(e.writer)},
                {"allowed", encode_text(e.allowed)},
                {"hits", encode_text(e.hits)},
                {"values", values}};
}

SampleEvidence decode_evidence(const Json& json) {
    SampleEvidence e;
    e.x = u32(entry(field(json, "at"), 0, "\"at\""), "at");
    e.y = u32(entry(field(json, "at"), 1, "\"at\""), "at");
    e.sample = u32(entry(field(json, "at"), 2, "\"at\""), "at");
    e.writer = decode_text(field(json, "writer"), "writer");
    e.allowed = decode_text(field(json, "allowed"), "allowed");
    e.hits = decode_text(field(json, "hits"), "hits");
    for (const Json& list : list_in(json, "values")) {
        SampleValue v;
        v.quantity = decode_text(entry(list, 0, "\"values\""), "quantity");
        v.exact = decode_text(entry(list, 1, "\"values\""), "exact");
        v.nearest = decode_number(entry(list, 2, "\"values\""), "nearest");
        v.budget = decode_number(entry(list, 3, "\"values\""), "budget");
        v.low = decode_number(entry(list, 4, "\"values\""), "low");
        v.high = decode_number(entry(list, 5, "\"values\""), "high");
        const Json& bits = entry(list, 6, "\"values\"");
        v.has_device = !bits.is_null();
        v.bits = v.has_device ? u32(bits, "bits") : 0;
        v.also = list.size() > 7 ? decode_text(list[7], "also") : std::string();
        e.values.push_back(std::move(v));
    }
    return e;
}

}  // namespace report
