// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/tell/json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace probe {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "edgecase-probe-1";
constexpr std::array<const char*, 4> kPictures = {"none", "star", "curve", "staircase"};

// JSON has no NaN and no infinity.
Json number(double v) {
    return std::isfinite(v) ? Json(v) : std::isnan(v) ? Json("nan") : Json(v > 0 ? "inf" : "-inf");
}
double number_of(const Json& json) {
    if (json.is_number()) {
        return json.get<double>();
    }
    const auto word = json.get<std::string>();
    return word == "nan" ? std::nan("") : word == "inf" ? HUGE_VAL : -HUGE_VAL;
}

Json property_json(const Property& p) {
    Json json = {{"id", p.id},
                 {"question", p.question},
                 {"answer", p.answer},
                 {"known", p.is_known()},
                 {"agree", p.agree},
                 {"contradict", p.contradict},
                 {"experiment", p.experiment},
                 {"why", p.why},
                 {"figures", Json::array()}};
    for (const Figure& f : p.figures) {
        json["figures"].push_back({{"name", f.name}, {"value", number(f.value)}, {"unit", f.unit}});
    }
    if (p.picture.kind != PictureKind::none) {
        Json points = Json::array();
        for (const auto& [x, y] : p.picture.points) {
            points.push_back({number(x), number(y)});
        }
        json["picture"] = {{"kind", kPictures.at(static_cast<size_t>(p.picture.kind))},
                           {"points", std::move(points)}};
        if (!p.picture.marks.empty()) {
            json["picture"]["marks"] = p.picture.marks;
        }
        if (!p.picture.axes[0].empty()) {
            json["picture"]["axes"] = p.picture.axes;
        }
    }
    return json;
}

Property property_of(const Json& json) {
    Property p;
    p.id = json.at("id").get<std::string>();
    p.question = json.at("question").get<std::string>();
    p.answer = json.at("answer").get<std::string>();
    p.agree = json.at("agree").get<uint64_t>();
    p.contradict = json.at("contradict").get<uint64_t>();
    p.experiment = json.at("experiment").get<std::string>();
    p.why = json.at("why").get<std::string>();
    for (const Json& f : json.at("figures")) {
        p.figures.push_back({f.at("name").get<std::string>(), number_of(f.at("value")),
                             f.at("unit").get<std::string>()});
    }
    if (json.contains("picture")) {
        const Json& picture = json.at("picture");
        const auto* const kind =
            std::ranges::find(kPictures, picture.at("kind").get<std::string>());
        p.picture.kind = kind == kPictures.end()
                             ? PictureKind::none
                             : static_cast<PictureKind>(kind - kPictures.begin());
        for (const Json& point : picture.at("points")) {
            p.picture.points.push_back({number_of(point.at(0)), number_of(point.at(1))});
        }
        if (picture.contains("marks")) {
            p.picture.marks = picture.at("marks").get<std::vector<uint8_t>>();
        }
        if (picture.contains("axes")) {
            p.picture.axes = picture.at("axes").get<std::array<std::string, 2>>();
        }
    }
    return p;
}

}  // namespace

std::string to_json(const Datasheet& sheet) {
    Json json = {{"schema", kSchema}, {"device", Json::object()}, {"properties", Json::array()}};
    for (const auto& [name, value] : sheet.device) {
        json["device"][name] = value;
    }
    for (const Property& p : sheet.properties) {
        json["properties"].push_back(property_json(p));
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

cases::Expected<Datasheet> from_json(std::string_view text) {
    const auto wrong = [](const std::string& what) {
        return tl::unexpected(cases::Error{{}, what});
    };
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) {
        return wrong("it is no JSON");
    }
    if (!json.is_object() || !json.contains("schema") || json["schema"] != kSchema) {
        return wrong("it is no datasheet of 'edgecase probe --json' (its \"schema\" is not \"" +
                     std::string(kSchema) + "\")");
    }
    Datasheet sheet;
    try {
        for (const auto& [name, value] : json.at("device").items()) {
            sheet.device.emplace_back(name, value.get<std::string>());
        }
        for (const Json& p : json.at("properties")) {
            sheet.properties.push_back(property_of(p));
        }
    } catch (const Json::exception& e) {
        return wrong("a member of the datasheet is missing or has another type (" +
                     std::string(e.what()) + ")");
    }
    return sheet;
}

}  // namespace probe
