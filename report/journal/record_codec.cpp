// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/journal/record_codec.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cases/base/utf8.hpp"
#include "report/journal/evidence_codec.hpp"
#include "report/journal/json_object.hpp"
#include "report/journal/picture_codec.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

[[noreturn]] void fail(const std::string& sentence) {
    throw std::invalid_argument(sentence);
}

const Json& member(const Json& json, const char* key) {
    if (!json.is_object()) {
        fail("a record is not an object");
    }
    const auto it = json.find(key);
    if (it == json.end()) {
        fail(fmt::format("\"{}\" is missing", key));
    }
    return *it;
}

const Json& list_of(const Json& json, const char* key) {
    const Json& list = member(json, key);
    if (!list.is_array()) {
        fail(fmt::format("\"{}\" is not a list", key));
    }
    return list;
}

// Reading into a field of a structure, by its type.
void read(const Json& json, const char* key, std::string& to) {
    to = decode_text(member(json, key), key);
}
void read(const Json& json, const char* key, double& to) {
    to = decode_number(member(json, key), key);
}
void read(const Json& json, const char* key, bool& to) {
    const Json& value = member(json, key);
    if (!value.is_boolean()) {
        fail(fmt::format("\"{}\" is neither true nor false", key));
    }
    to = value.get<bool>();
}
uint64_t whole_of(const Json& value, const char* key, uint64_t largest) {
    if (!value.is_number_unsigned() || value.get<uint64_t>() > largest) {
        fail(fmt::format("\"{}\" is not a whole number from 0 to {}", key, largest));
    }
    return value.get<uint64_t>();
}
void read(const Json& json, const char* key, uint64_t& to) {
    to = whole_of(member(json, key), key, std::numeric_limits<uint64_t>::max());
}
void read(const Json& json, const char* key, uint32_t& to) {
    to = static_cast<uint32_t>(
        whole_of(member(json, key), key, std::numeric_limits<uint32_t>::max()));
}
void read(const Json& json, const char* key, std::vector<std::string>& to) {
    for (const Json& entry : list_of(json, key)) {
        to.push_back(decode_text(entry, key));
    }
}
void read(const Json& json, const char* key, cases::Profile& to) {
    const auto profile = cases::parse_profile(decode_text(member(json, key), key));
    if (!profile) {
        fail(fmt::format("\"{}\" is not a profile", key));
    }
    to = *profile;
}
void read(const Json& json, const char* key, Status& to) {
    const auto status = parse_status(decode_text(member(json, key), key));
    if (!status) {
        fail(fmt::format("\"{}\" is not a status", key));
    }
    to = *status;
}
void read(const Json& json, const char* key, diff::FindingKind& to) {
    const std::string name = decode_text(member(json, key), key);
    for (size_t k = 0; k < diff::kFindingKinds; ++k) {
        if (name == diff::to_string(static_cast<diff::FindingKind>(k))) {
            to = static_cast<diff::FindingKind>(k);
            return;
        }
    }
    fail(fmt::format("\"{}\" is not a kind of finding", key));
}

// What journals of earlier versions do not hold.
void read_if_there(const Json& json, const char* key, std::string& to) {
    if (json.contains(key)) {
        read(json, key, to);
    }
}

Json encode_texts(const std::vector<std::string>& list) {
    Json json = Json::array();
    for (const std::string& entry : list) {
        json.push_back(encode_text(entry));
    }
    return json;
}

Json encode_finding(const diff::Finding& f) {
    Json json = object_of({{"kind", diff::to_string(f.kind)},
                           {"rule", encode_text(f.rule)},
                           {"level", cases::to_string(f.level)},
                           {"x", f.x},
                           {"y", f.y},
                           {"sample", f.sample},
                           {"quantity", encode_text(f.quantity)},
                           {"expected", encode_text(f.expected)},
                           {"got", encode_text(f.got)},
                           {"why", encode_text(f.why)},
                           {"ratio", encode_number(f.ratio)}});
    if (f.layer) {
        json["layer"] = *f.layer;
    }
    return json;
}

diff::Finding decode_finding(const Json& json) {
    diff::Finding f;
    read(json, "kind", f.kind);
    read(json, "rule", f.rule);
    read(json, "level", f.level);
    read(json, "x", f.x);
    read(json, "y", f.y);
    read(json, "sample", f.sample);
    if (json.contains("layer")) {
        read(json, "layer", f.layer.emplace());
    }
    read(json, "quantity", f.quantity);
    read(json, "expected", f.expected);
    read(json, "got", f.got);
    read(json, "why", f.why);
    read(json, "ratio", f.ratio);
    return f;
}

}  // namespace

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
    fail(fmt::format("\"{}\" is not text", key));
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
    fail(fmt::format("\"{}\" is not a number", key));
}

Json encode_device(const Device& d) {
    return Json{{"name", encode_text(d.name)},
                {"driver_name", encode_text(d.driver_name)},
                {"driver_info", encode_text(d.driver_info)},
                {"uuid", encode_text(d.uuid)},
                {"type", encode_text(d.type)},
                {"api_version", encode_text(d.api_version)},
                {"vendor_id", d.vendor_id},
                {"device_id", d.device_id},
                {"driver_version", d.driver_version},
                {"driver_id", d.driver_id},
                {"subpixel_bits", d.subpixel_bits},
                {"viewport_subpixel_bits", d.viewport_subpixel_bits},
                {"has_primitive_id", d.has_primitive_id}};
}

Device decode_device(const Json& json) {
    Device d;
    read(json, "name", d.name);
    read(json, "driver_name", d.driver_name);
    read(json, "driver_info", d.driver_info);
    read(json, "uuid", d.uuid);
    read(json, "type", d.type);
    read(json, "api_version", d.api_version);
    read(json, "vendor_id", d.vendor_id);
    read(json, "device_id", d.device_id);
    read(json, "driver_version", d.driver_version);
    read(json, "driver_id", d.driver_id);
    read(json, "subpixel_bits", d.subpixel_bits);
    read(json, "viewport_subpixel_bits", d.viewport_subpixel_bits);
    read(json, "has_primitive_id", d.has_primitive_id);
    return d;
}

Json encode_planned(const CaseRecord& r) {
    return object_of({
        {"id", encode_text(r.id)},
        {"file", encode_text(r.file)},
        {"line", r.line},
        {"description", encode_text(r.description)},
        {"rules", encode_texts(r.rules)},
        {"links", encode_texts(r.links)},
        {"rerun", encode_text(r.rerun)},
        {"catches", encode_text(r.catches)},
    });
}

CaseRecord decode_planned(const Json& json) {
    CaseRecord r;
    read(json, "id", r.id);
    read(json, "file", r.file);
    read(json, "line", r.line);
    read(json, "description", r.description);
    read(json, "rules", r.rules);
    read(json, "links", r.links);
    read(json, "rerun", r.rerun);
    read_if_there(json, "catches", r.catches);
    return r;
}

Json encode_case(const CaseRecord& r) {
    Json findings = Json::array();
    for (const diff::Finding& f : r.findings) {
        findings.push_back(encode_finding(f));
    }
    Json counts = Json::array();
    for (const uint64_t count : r.counts) {
        counts.push_back(count);
    }
    Json evidence = Json::array();
    for (const SampleEvidence& e : r.evidence) {
        evidence.push_back(encode_evidence(e));
    }
    Json out = encode_planned(r);
    append_fields(out.get_ref<Json::object_t&>(),
                  {
                      {"status", to_string(r.status)},
                      {"expected", r.expected ? Json(to_string(*r.expected)) : Json(nullptr)},
                      {"bug", encode_text(r.bug)},
                      {"expectation", encode_text(r.expectation)},
                      {"expired", encode_text(r.expired)},
                      {"actual", r.actual ? Json(to_string(*r.actual)) : Json(nullptr)},
                      {"bits", encode_text(r.bits)},
                      {"hit_bits", encode_text(r.hit_bits)},
                      {"reason", encode_text(r.reason)},
                      {"step", encode_text(r.step)},
                      {"signal", encode_text(r.signal)},
                      {"stderr", encode_text(r.stderr_text)},
                      {"seconds", encode_number(r.seconds)},
                      {"attempts", r.attempts},
                      {"messages", encode_texts(r.messages)},
                      {"findings", std::move(findings)},
                      {"counts", std::move(counts)},
                      {"wrong_samples", r.wrong_samples ? Json(*r.wrong_samples) : Json(nullptr)},
                      {"level", cases::to_string(r.level)},
                      {"min_x", r.min_x},
                      {"min_y", r.min_y},
                      {"max_x", r.max_x},
                      {"max_y", r.max_y},
                      {"must_samples", r.must_samples},
                      {"either_samples", r.either_samples},
                      {"compared_samples", r.compared_samples},
                      {"compared_values", r.compared_values},
                      {"worst_ratio", encode_number(r.worst_ratio)},
                      {"worst_quantity", encode_text(r.worst_quantity)},
                      {"explain", encode_text(r.explain)},
                      {"evidence", std::move(evidence)},
                  });
    // Most cases have neither.
    if (!(r.pictures == Pictures())) {
        out["pictures"] = encode_pictures(r.pictures);
    }
    if (!(r.geometry == Geometry())) {
        out["geometry"] = encode_geometry(r.geometry);
    }
    return out;
}

CaseRecord decode_case(const Json& json) {
    CaseRecord r = decode_planned(json);
    read(json, "status", r.status);
    if (!member(json, "expected").is_null()) {
        r.expected.emplace();
        read(json, "expected", *r.expected);
    }
    read(json, "bug", r.bug);
    read_if_there(json, "expectation", r.expectation);
    read_if_there(json, "expired", r.expired);
    if (json.contains("actual") && !json.at("actual").is_null()) {
        r.actual.emplace();
        read(json, "actual", *r.actual);
    }
    read_if_there(json, "bits", r.bits);
    read_if_there(json, "hit_bits", r.hit_bits);
    read(json, "reason", r.reason);
    read(json, "step", r.step);
    read(json, "signal", r.signal);
    read(json, "stderr", r.stderr_text);
    read(json, "seconds", r.seconds);
    read(json, "attempts", r.attempts);
    read(json, "messages", r.messages);
    for (const Json& finding : list_of(json, "findings")) {
        r.findings.push_back(decode_finding(finding));
    }
    const Json& counts = list_of(json, "counts");
    if (counts.size() != r.counts.size()) {
        fail(fmt::format("\"counts\" does not have {} entries", r.counts.size()));
    }
    for (size_t k = 0; k < r.counts.size(); ++k) {
        r.counts.at(k) = whole_of(counts[k], "counts", std::numeric_limits<uint64_t>::max());
    }
    if (json.contains("wrong_samples") && !json.at("wrong_samples").is_null()) {
        r.wrong_samples.emplace();
        read(json, "wrong_samples", *r.wrong_samples);
    }
    read(json, "level", r.level);
    read(json, "min_x", r.min_x);
    read(json, "min_y", r.min_y);
    read(json, "max_x", r.max_x);
    read(json, "max_y", r.max_y);
    read(json, "must_samples", r.must_samples);
    read(json, "either_samples", r.either_samples);
    read(json, "compared_samples", r.compared_samples);
    read(json, "compared_values", r.compared_values);
    read(json, "worst_ratio", r.worst_ratio);
    read(json, "worst_quantity", r.worst_quantity);
    if (json.contains("pictures")) {
        r.pictures = decode_pictures(json.at("pictures"));
    }
    read(json, "explain", r.explain);
    if (json.contains("catches")) {  // older journals have no evidence
        for (const Json& sample : list_of(json, "evidence")) {
            r.evidence.push_back(decode_evidence(sample));
        }
    }
    if (json.contains("geometry")) {
        r.geometry = decode_geometry(json.at("geometry"));
    }
    return r;
}

Json encode_header(const Run& run) {
    Json environment = Json::array();
    for (const auto& [name, value] : run.environment) {
        environment.push_back(Json::array({encode_text(name), encode_text(value)}));
    }
    return Json{{"tool_version", encode_text(run.tool_version)},
                {"arguments", encode_texts(run.arguments)},
                {"environment", environment},
                {"started", encode_text(run.started)},
                {"host", encode_text(run.host)},
                {"profile", cases::to_string(run.profile)},
                {"seed", run.seed},
                {"suite_root", encode_text(run.suite_root)},
                {"suite_hash", encode_text(run.suite_hash)},
                {"expectation_file", encode_text(run.expectation_file)},
                {"shard", run.shard},
                {"shards", run.shards},
                {"jobs", run.jobs}};
}

Run decode_header(const Json& json) {
    Run run;
    read(json, "tool_version", run.tool_version);
    read(json, "arguments", run.arguments);
    for (const Json& pair : list_of(json, "environment")) {
        if (!pair.is_array() || pair.size() != 2) {
            fail("\"environment\" holds something that is not a name and a value");
        }
        run.environment.emplace_back(decode_text(pair[0], "environment"),
                                     decode_text(pair[1], "environment"));
    }
    read(json, "started", run.started);
    read(json, "host", run.host);
    read(json, "profile", run.profile);
    read(json, "seed", run.seed);
    read(json, "suite_root", run.suite_root);
    read_if_there(json, "suite_hash", run.suite_hash);
    read(json, "expectation_file", run.expectation_file);
    read(json, "shard", run.shard);
    read(json, "shards", run.shards);
    read(json, "jobs", run.jobs);
    return run;
}

Json encode_stop(const Run& run) {
    return Json{{"ended", encode_text(run.ended)},
                {"seconds", encode_number(run.seconds)},
                {"interrupted", run.interrupted}};
}

void decode_stop(const Json& json, Run& run) {
    read(json, "ended", run.ended);
    read(json, "seconds", run.seconds);
    read(json, "interrupted", run.interrupted);
}

}  // namespace report
