// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/files/json.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "cases/base/printable.hpp"
#include "report/journal/json_codec.hpp"
#include "report/journal/json_object.hpp"
#include "report/journal/picture_codec.hpp"
#include "report/text/causes.hpp"
#include "report/text/diagnosis_text.hpp"
#include "report/text/doors_text.hpp"
#include "report/text/levels_text.hpp"
#include "report/text/sentences.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

// Readers of results.json get text, never an escape sequence or a byte that is not UTF-8.
Json texts(const std::vector<std::string>& list) {
    Json json = Json::array();
    for (const std::string& entry : list) {
        json.push_back(cases::printable(entry));
    }
    return json;
}

// As in the journal, but the sample is an object and texts are printable.
Json finding_json(diff::Finding f) {
    cases::make_printable(f);
    Json json = encode(f);
    Json sample{{"x", f.x}, {"y", f.y}, {"index", f.sample}};
    if (f.layer) {
        sample["layer"] = *f.layer;
    }
    json["sample"] = f.of_case ? Json(nullptr) : std::move(sample);
    for (const char* key : {"x", "y", "layer", "of_case"}) {
        json.erase(key);
    }
    return json;
}

Json counts_json(const CaseRecord& r) {
    Json json = Json::object();
    for (size_t k = 0; k < diff::kFindingKinds; ++k) {
        json[std::string(diff::to_string(static_cast<diff::FindingKind>(k)))] =
            r.outcome.counts.at(k);
    }
    return json;
}

Json groups_json(const CaseRecord& r) {
    Json json = Json::array();
    for (diff::FindingGroup group : r.outcome.groups) {
        cases::make_printable(group);
        json.push_back(encode(group));
    }
    return json;
}

Json case_json(const CaseRecord& r, cases::Profile profile) {
    Json findings = Json::array();
    for (const diff::Finding& f : r.outcome.findings) {
        findings.push_back(finding_json(f));
    }
    const bool wrong = r.outcome.finding_total() > 0;
    const auto level = level_of(r, Of::all), news = level_of(r, Of::news);
    Json box = nullptr;
    if (wrong && r.outcome.wrong_samples != 0) {
        box = Json{{"min_x", r.outcome.min_x},
                   {"min_y", r.outcome.min_y},
                   {"max_x", r.outcome.max_x},
                   {"max_y", r.outcome.max_y}};
    }
    Json pictures = nullptr;
    if (r.evidence.pictures.width > 0) {
        const Pictures& p = r.evidence.pictures;
        pictures = Json{{"encoding", "base64 of (run length - 1, value) pairs"},
                        {"width", p.width},
                        {"height", p.height},
                        {"left", p.left},
                        {"top", p.top},
                        {"expected_hits", encode_picture(p.expected_hits)},
                        {"device_hits", encode_picture(p.device_hits)},
                        {"marks", encode_picture(p.marks)}};
        if (p.layer_height > 0) {
            pictures["layer_height"] = p.layer_height;
        }
    }
    return object_of({
        {"id", cases::printable(r.id)},
        {"file", cases::printable(r.file)},
        {"line", r.line},
        {"description", cases::printable(r.description)},
        {"status", to_string(r.status)},
        {"profile", cases::to_string(profile)},
        {"rules", texts(r.rules)},
        {"links", texts(r.links)},
        {"expected", r.known.expected ? Json(to_string(*r.known.expected)) : Json(nullptr)},
        {"bug", cases::printable(r.known.bug)},
        {"expectation", cases::printable(r.known.place)},
        {"unlike", cases::printable(r.known.unlike)},
        {"unseen_picture", r.known.unseen_picture},
        {"expired", cases::printable(r.known.expired)},
        {"actual", to_string(actual_status(r))},
        {"bits", cases::printable(r.drawn.bits)},
        {"hit_bits", cases::printable(r.drawn.hit_bits)},
        {"reason", cases::printable(r.reason)},
        {"step", cases::printable(r.death.step)},
        {"signal", cases::printable(r.death.signal)},
        {"stderr", cases::printable(r.death.output)},
        {"messages", texts(r.drawn.messages)},
        {"seconds", encode_number(r.drawn.seconds)},
        {"attempts", r.drawn.attempts},
        {"brief", r.drawn.is_brief},
        {"level", level ? Json(cases::to_string(*level)) : Json(nullptr)},
        {"new_level", news ? Json(cases::to_string(*news)) : Json(nullptr)},
        {"counts", counts_json(r)},
        {"groups", groups_json(r)},
        {"finding_total", r.outcome.finding_total()},
        {"wrong_samples", r.outcome.wrong_samples ? Json(*r.outcome.wrong_samples) : Json(nullptr)},
        {"findings", std::move(findings)},
        {"bounding_box", std::move(box)},
        {"must_samples", r.outcome.must_samples},
        {"either_samples", r.outcome.either_samples},
        {"compared_samples", r.outcome.compared_samples},
        {"compared_values", r.outcome.compared_values},
        {"worst_ratio", encode_number(r.outcome.worst_ratio)},
        {"worst_quantity", cases::printable(r.outcome.worst_quantity)},
        {"pictures", std::move(pictures)},
        {"rerun", cases::printable(r.rerun)},
        {"explain", cases::printable(r.commands.explain)},
    });
}

Json run_json(const Run& run) {
    Json environment = Json::object();
    for (const auto& [name, value] : run.environment) {
        environment[cases::printable(name)] = cases::printable(value);
    }
    return Json{
        {"arguments", texts(run.arguments)},
        {"environment", environment},
        {"started", cases::printable(run.started)},
        {"ended", run.ended.empty() ? Json(nullptr) : Json(cases::printable(run.ended))},
        {"seconds", encode_number(run.seconds)},
        {"host", cases::printable(run.host)},
        {"seed", run.seed},
        {"suite_root", cases::printable(run.suite_root)},
        {"suite_hash", cases::printable(run.suite_hash)},
        {"expectation_file", cases::printable(run.expectation_file)},
        {"shard", run.shard},
        {"shards", run.shards},
        {"jobs", run.jobs},
        {"interrupted", run.interrupted},
        {"shortened_cases", run.shortened_cases},
        {"missing_shards", run.missing_shards},
        {"fail_at", cases::to_string(fail_level(run))},
        {"exit_code", exit_code(run)},
    };
}

Json doors_json(const Run& run) {
    Json list = Json::array();
    for (const DoorCount& count : door_counts(run)) {
        list.push_back(Json{{"door", count.door},
                            {"pictures", count.pictures},
                            {"left_out", count.left_out},
                            {"unsupported", count.closed},
                            {"reason", cases::printable(count.reason)}});
        if (!count.bug.empty()) {
            list.back()["skipped_by"] = cases::printable(count.bug);
        }
    }
    return list;
}

Json levels_json(const Run& run) {
    const Levels found = levels(run);
    Json rows = Json::array();
    const auto ids = [](const std::vector<const CaseRecord*>& records) {
        Json list = Json::array();
        for (const CaseRecord* record : records) {
            list.push_back(cases::printable(record->id));
        }
        return list;
    };
    for (const LevelCount& row : found.rows) {
        rows.push_back(Json{{"level", cases::to_string(row.level)},
                            {"judged", row.is_judged && found.judged > 0},
                            {"text", level_text(found, row)},
                            {"unexpected", row.unexpected.size()},
                            {"expected", row.expected.size()},
                            {"unexpected_cases", ids(row.unexpected)},
                            {"expected_cases", ids(row.expected)}});
    }
    return Json{{"judged", found.judged}, {"unjudged", found.unjudged}, {"rows", std::move(rows)}};
}

Json diagnoses_json(const Run& run) {
    Json list = encode(run.diagnoses);
    const Repeated repeated(run);
    for (size_t k = 0; k < run.diagnoses.size(); ++k) {
        list.at(k)["partial"] = repeated.is_partial(k);
    }
    return list;
}

Json families_of(const Cause& cause) {
    std::set<std::string> families;
    for (const CaseRecord* record : cause.cases) {
        families.insert(cases::printable(family_of(*record)));
    }
    return families;
}

Json causes_json(const Run& run) {
    Json list = Json::array();
    for (const Cause& cause : causes(run)) {
        Json json{{"status", to_string(cause.status)},
                  {"family", families_text(cause.cases)},
                  {"families", families_of(cause)},
                  {"rule", cases::printable(cause.rule)},
                  {"kind", cases::printable(cause.kind)},
                  {"door", cases::printable(cause.door)},
                  {"level", cause.level ? Json(cases::to_string(*cause.level)) : Json(nullptr)},
                  {"known", cause.is_known},
                  {"diagnosis", cause.diagnosis ? Json(*cause.diagnosis) : Json(nullptr)},
                  {"cases", Json::array()}};
        for (const CaseRecord* record : cause.cases) {
            json["cases"].push_back(cases::printable(record->id));
        }
        list.push_back(std::move(json));
    }
    return list;
}

// The text whose last value is the empty list of cases, with the cases, a line each: indented they
// are half as long again. One after the other: what they are as values of the library takes ten
// times the memory of the text.
void put_with_cases(std::string_view text, const Run& run, const cases::Put& put) {
    constexpr std::string_view kEmpty = "[]\n}";
    if (run.cases.empty()) {
        put(text);
        return;
    }
    put(text.substr(0, text.size() - kEmpty.size()));
    for (const CaseRecord& record : run.cases) {
        put((&record == &run.cases.front() ? "[\n  " : ",\n  ") +
            case_json(record, run.profile).dump());
    }
    put("\n ]\n}");
}

}  // namespace

void tell_json(const Run& run, const cases::Put& put) {
    Json total = encode_totals(run);
    total["cases"] = run.cases.size();
    capture::DeviceInfo device = run.device;
    cases::make_printable(device);
    const CaseRecord* worst = worst_case(run);
    const Json json{
        {"schema", "edgecase-results-1"},
        {"tool", Json{{"name", "edgecase"}, {"version", cases::printable(run.tool_version)}}},
        {"profile", cases::to_string(run.profile)},
        {"run", run_json(run)},
        {"device", encode(device)},
        {"totals", total},
        {"worst", worst == nullptr
                      ? Json(nullptr)
                      : Json{{"ratio", encode_number(worst->outcome.worst_ratio)},
                             {"quantity", cases::printable(worst->outcome.worst_quantity)},
                             {"case", cases::printable(worst->id)}}},
        {"doors", doors_json(run)},
        {"levels", levels_json(run)},
        {"diagnoses", diagnoses_json(run)},
        {"causes", causes_json(run)},
        {"cases", Json::array()},
    };
    put_with_cases(json.dump(1), run, put);
    put("\n");
}

std::string to_json(const Run& run) {
    std::string text;
    tell_json(run, [&text](std::string_view piece) { text += piece; });
    return text;
}

}  // namespace report
