// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cases/rule.hpp"
#include "report/picture_codec.hpp"
#include "report/reports.hpp"
#include "report/sentences.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

// The page, from report/html/ (cmake/Embed.cmake).
constexpr std::string_view kPage =
#include "embedded/report.html.inc"
    ;
constexpr std::string_view kStyle =
#include "embedded/report.css.inc"
    ;
constexpr std::string_view kPictures =
#include "embedded/pictures.js.inc"
    ;
constexpr std::string_view kScript =
#include "embedded/report.js.inc"
    ;

// What keeps a page of thousands of failures small; results.json holds everything.
constexpr size_t kMostFindings = 200;               // of a case
constexpr size_t kLeastFindings = 5;                // of a case
constexpr size_t kFindingBudget = 8000;             // of a page
constexpr size_t kPictureBudget = size_t{6} << 20;  // bytes of base64 of a page
constexpr size_t kMaxOutput = 8192;                 // bytes of a driver's output, a case

std::string escaped(std::string_view bytes) {
    std::string text;
    for (const char c : printable(bytes)) {
        switch (c) {
            case '&':
                text += "&amp;";
                break;
            case '<':
                text += "&lt;";
                break;
            case '>':
                text += "&gt;";
                break;
            case '"':
                text += "&quot;";
                break;
            case '\'':
                text += "&#39;";
                break;
            default:
                text += c;
        }
    }
    return text;
}

// JSON inside <script>: no "<" at all, so neither "</script>" nor "<!--" can end or change it.
std::string script_data(const Json& json) {
    std::string text;
    for (const char c : json.dump()) {
        switch (c) {
            case '<':
                text += "\\u003c";
                break;
            case '>':
                text += "\\u003e";
                break;
            case '&':
                text += "\\u0026";
                break;
            default:
                text += c;
        }
    }
    return text;
}

void put(Json& json, const char* key, const std::string& bytes) {
    if (!bytes.empty()) {
        json[key] = printable(bytes);
    }
}

void put(Json& json, const char* key, const std::vector<std::string>& list) {
    for (const std::string& entry : list) {
        json[key].push_back(printable(entry));
    }
}

Json finding_json(const diff::Finding& f) {
    Json json{{"kind", diff::to_string(f.kind)},
              {"rule", printable(f.rule)},
              {"level", cases::to_string(f.level)},
              {"x", f.x},
              {"y", f.y},
              {"sample", f.sample},
              {"expected", printable(f.expected)},
              {"got", printable(f.got)},
              {"why", printable(f.why)}};
    put(json, "quantity", f.quantity);
    if (f.kind == diff::FindingKind::value) {
        json["ratio"] = ratio_text(f.ratio);
    }
    return json;
}

uint64_t finding_total(const CaseRecord& record) {
    uint64_t total = 0;
    for (const uint64_t count : record.counts) {
        total += count;
    }
    return std::max<uint64_t>(total, record.findings.size());
}

std::string cut(const std::string& bytes) {
    return bytes.size() <= kMaxOutput ? bytes
                                      : bytes.substr(0, kMaxOutput / 2) + "\n[...]\n" +
                                            bytes.substr(bytes.size() - kMaxOutput / 2);
}

Json case_json(const CaseRecord& r, size_t most_findings, size_t& picture_budget) {
    Json json{{"id", printable(r.id)}, {"status", to_string(r.status)}, {"line", r.line}};
    const std::string what = what_happened(r);
    json["what"] = what.empty() && r.status != Status::pass ? why_it_happened(r) : what;
    put(json, "file", r.file);
    put(json, "description", r.description);
    put(json, "rules", r.rules);
    put(json, "links", r.links);
    if (r.expected) {
        json["expected"] = to_string(*r.expected);
    }
    put(json, "bug", r.bug);
    put(json, "reason", r.reason);
    put(json, "step", r.step);
    put(json, "signal", r.signal);
    put(json, "stderr", cut(r.stderr_text));
    put(json, "messages", r.messages);
    json["time"] = seconds_text(r.seconds);
    json["attempts"] = r.attempts;
    if (r.compared_samples > 0) {
        json["compared"] =
            fmt::format("{} samples ({} must be covered, {} free), {} values", r.compared_samples,
                        r.must_samples, r.either_samples, r.compared_values);
    }
    if (r.compared_values > 0) {
        json["worst"] =
            fmt::format("{} budgets{}{}", ratio_text(r.worst_ratio),
                        r.worst_quantity.empty() ? "" : ", ", printable(r.worst_quantity));
    }
    if (!r.findings.empty()) {
        json["finding_total"] = finding_total(r);
        for (size_t k = 0; k < r.findings.size() && k < most_findings; ++k) {
            json["findings"].push_back(finding_json(r.findings[k]));
        }
    }
    const Pictures& p = r.pictures;
    if (p.width > 0 && p.height > 0) {
        Json pictures{{"width", p.width},
                      {"height", p.height},
                      {"left", p.left},
                      {"top", p.top},
                      {"expected_hits", encode_picture(p.expected_hits)},
                      {"device_hits", encode_picture(p.device_hits)},
                      {"marks", encode_picture(p.marks)}};
        const size_t size = pictures.dump().size();
        if (size <= picture_budget) {
            picture_budget -= size;
            json["pictures"] = std::move(pictures);
        }
    }
    put(json, "rerun", r.rerun);
    put(json, "explain", r.explain);
    return json;
}

Json page_data(const Run& run) {
    Json rules = Json::object();
    for (const cases::Rule& rule : cases::all_rules()) {
        rules[std::string(rule.id)] = Json{{"title", rule.title},
                                           {"profile", cases::to_string(rule.profile)},
                                           {"anchor", rule.anchor}};
    }
    Json meanings = Json::object();
    for (const cases::Profile profile : cases::kProfiles) {
        meanings[std::string(cases::to_string(profile))] = meaning(profile);
    }
    Json total = Json::object();
    const auto count = totals(run);
    for (size_t k = 0; k < kStatuses; ++k) {
        total[std::string(to_string(static_cast<Status>(k)))] = count.at(k);
    }
    const auto wrong = static_cast<size_t>(
        std::count_if(run.cases.begin(), run.cases.end(),
                      [](const CaseRecord& record) { return !record.findings.empty(); }));
    const size_t most =
        std::clamp(kFindingBudget / std::max<size_t>(wrong, 1), kLeastFindings, kMostFindings);
    size_t picture_budget = kPictureBudget;
    Json list = Json::array();
    for (const CaseRecord& record : run.cases) {
        list.push_back(case_json(record, most, picture_budget));
    }
    return Json{{"rules", rules}, {"meanings", meanings}, {"totals", total}, {"cases", list}};
}

std::string fact(std::string_view name, const std::string& value) {
    return value.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escaped(value));
}

std::string title_of(const Run& run) {
    const auto unexpected =
        std::count_if(run.cases.begin(), run.cases.end(),
                      [](const CaseRecord& record) { return !is_expected(record.status); });
    return fmt::format("edgecase: {} of {} unexpected, {}", unexpected, run.cases.size(),
                       run.device.name.empty() ? "no device" : run.device.name);
}

std::string header(const Run& run) {
    const Device& d = run.device;
    std::string text =
        fmt::format("<h1>{}</h1>\n", escaped(d.name.empty() ? std::string("no device") : d.name));
    text += fmt::format("<p class=\"verdict\">{}</p>\n<dl>\n", escaped(exit_text(exit_code(run))));
    text += fact("driver", d.driver_name + (d.driver_info.empty() ? "" : " ") + d.driver_info);
    text += fact("Vulkan", d.api_version);
    text += fact("subpixel bits", fmt::format("{}", d.subpixel_bits));
    text += fact("profile", fmt::format("{} (a finding at this level: {})",
                                        cases::to_string(run.profile), meaning(run.profile)));
    if (const CaseRecord* worst = worst_case(run)) {
        text += fact("largest accepted error",
                     fmt::format("{} budgets, {}", ratio_text(worst->worst_ratio), worst->id));
    }
    text += fact("edgecase", run.tool_version);
    text += fact("started", run.started);
    text += fact("took", seconds_text(run.seconds) + (run.ended.empty() ? ", cut off" : ""));
    text += fact("seed", fmt::format("{}", run.seed));
    text += fact("host", run.host);
    text += fact("UUID", d.uuid);
    text += fact("expectations", run.expectation_file);
    text += "</dl>\n<details><summary>Command line and environment</summary><pre>";
    for (const auto& [name, value] : run.environment) {
        text += escaped(name + "=" + value) + "\n";
    }
    for (size_t k = 0; k < run.arguments.size(); ++k) {
        text += (k > 0 ? " " : "") + escaped(run.arguments[k]);
    }
    return text + "</pre></details>";
}

// For readers without a script: the whole list, in a plain table.
std::string table(const Run& run) {
    std::string text =
        "<table><caption>All cases</caption><thead><tr><th scope=\"col\">status</th>"
        "<th scope=\"col\">case</th><th scope=\"col\">what</th></tr></thead><tbody>\n";
    for (const CaseRecord& r : run.cases) {
        const std::string what = what_happened(r);
        text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}{}</td></tr>\n", to_string(r.status),
                            escaped(r.id), escaped(what),
                            is_expected(r.status) ? "" : "<br>" + escaped(why_it_happened(r)));
    }
    return text + "</tbody></table>";
}

}  // namespace

std::string to_html(const Run& run) {
    const std::pair<std::string_view, std::string> fields[] = {
        {"{{TITLE}}", escaped(title_of(run))},
        {"{{CSS}}", std::string(kStyle)},
        {"{{HEADER}}", header(run)},
        {"{{TABLE}}", table(run)},
        {"{{DATA}}", script_data(page_data(run))},
        {"{{PICTURES}}", std::string(kPictures)},
        {"{{SCRIPT}}", std::string(kScript)},
    };
    // One pass in the page's order: what is put in is never searched for fields again.
    std::string text;
    std::string_view rest = kPage;
    for (const auto& [name, value] : fields) {
        const size_t at = rest.find(name);
        text += rest.substr(0, at);
        text += value;
        rest.remove_prefix(std::min(rest.size(), at + name.size()));
    }
    text += rest;
    return text;
}

}  // namespace report
