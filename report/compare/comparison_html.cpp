// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cases/base/printable.hpp"
#include "cases/model/rule.hpp"
#include "report/compare/comparison.hpp"
#include "report/journal/json_codec.hpp"
#include "report/journal/picture_codec.hpp"
#include "report/page/page_data.hpp"
#include "report/page/page_parts.hpp"
#include "report/text/causes.hpp"
#include "report/text/sentences.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::string_view kPage =
#include "embedded/compare.html.inc"
    ;
constexpr std::string_view kScripts[] = {
#include "embedded/dom.js.inc"
    ,
#include "embedded/exact.js.inc"
    ,
#include "embedded/geometry.js.inc"
    ,
#include "embedded/pictures.js.inc"
    ,
#include "embedded/limits.js.inc"
    ,
#include "embedded/canvas.js.inc"
    ,
#include "embedded/causes.js.inc"
    ,
#include "embedded/compare.js.inc"
    ,
};

constexpr size_t kMostPictures = size_t{6} << 20;  // bytes, as they stand in the page

// The hits of each run and the triangles of the first, if they are there for two runs at least, of
// the same pixels, and differ.
Json pictures_of(const ComparedCase& c) {
    const Pictures* first = nullptr;
    const Geometry* geometry = nullptr;
    bool differs = false;
    Json hits = Json::array();
    for (const CaseRecord* record : c.records) {
        const Pictures* p = record == nullptr ? nullptr : &record->evidence.pictures;
        const bool fits = p != nullptr && show_same_hits(*p, first == nullptr ? *p : *first);
        if (!fits) {
            hits.push_back(nullptr);
            continue;
        }
        differs = differs || (first != nullptr && p->device_hits != first->device_hits);
        geometry = first == nullptr ? &record->evidence.geometry : geometry;
        first = first == nullptr ? p : first;
        hits.push_back(encode_picture(p->device_hits));
    }
    if (!differs) {
        return {};
    }
    return Json{{"width", first->width},
                {"height", first->height},
                {"left", first->left},
                {"top", first->top},
                {"layer_height", first->layer_height},
                {"hits", hits},
                {"geometry", encode(*geometry)}};
}

Json result_of(const CaseRecord* record) {
    if (record == nullptr) {
        return nullptr;
    }
    const Status status = actual_status(*record);
    return Json{{"status", to_string(status)},
                {"what", what_happened(*record)},
                {"why", status == Status::pass ? std::string() : why_it_happened(*record)}};
}

// The record of a case that shows what is wrong with it: the first that does not pass.
const CaseRecord* failing_record(const ComparedCase& c) {
    for (const CaseRecord* record : c.records) {
        if (record != nullptr && !is_expected(actual_status(*record))) {
            return record;
        }
    }
    return nullptr;
}

// The causes behind each kind of change, in the order of the terminal; cases are told by their
// numbers in the page's list, where those that are the same have none.
Json causes_json(const Comparison& comparison, Json& rules) {
    Json list = Json::array();
    for (size_t k = 0; k < kChanges; ++k) {
        const auto change = static_cast<Change>(k);
        Run failing;  // of this change
        std::vector<size_t> numbers;
        size_t number = 0;
        for (const ComparedCase& c : comparison.cases) {
            if (c.change == Change::same) {
                continue;
            }
            const CaseRecord* const record = c.change == change ? failing_record(c) : nullptr;
            if (record != nullptr) {
                failing.cases.push_back(*record);
                failing.cases.back().status = actual_status(*record);
                // Whatever an expectation speaks of counts here.
                for (diff::FindingGroup& group : failing.cases.back().outcome.groups) {
                    group.known = 0;
                }
                numbers.push_back(number);
            }
            ++number;
        }
        for (const Cause& cause : causes(failing)) {
            list.push_back(cause_json(cause, [&](const CaseRecord& record) {
                return numbers.at(static_cast<size_t>(&record - failing.cases.data()));
            }));
            list.back()["change"] = to_string(change);
            if (const cases::Rule* rule = cases::find_rule(cause.rule)) {
                rules[cause.rule] = Json{{"title", rule->title}, {"anchor", rule->anchor}};
            }
        }
    }
    return list;
}

Json data_of(const std::vector<NamedRun>& runs, const Comparison& comparison,
             const std::vector<std::string>& reports) {
    Json list = Json::array();
    for (size_t k = 0; k < runs.size(); ++k) {
        const Run& run = runs[k].run;
        Json json = compared_run(runs[k], comparison, k);
        json["cases"] = run.cases.size();
        json["exit"] = exit_text(run);
        json["report"] = reports[k];
        list.push_back(std::move(json));
    }
    Json kinds = Json::array();
    for (size_t k = 0; k < kChanges; ++k) {
        const auto change = static_cast<Change>(k);
        kinds.push_back(Json{{"name", to_string(change)},
                             {"count", comparison.counts.at(k)},
                             {"text", heading(change, comparison.counts.at(k))}});
    }
    size_t bytes = 0, left_out = 0;
    Json cases = Json::array();
    for (const ComparedCase& c : comparison.cases) {
        if (c.change == Change::same) {
            continue;
        }
        Json results = Json::array();
        for (const CaseRecord* record : c.records) {
            results.push_back(result_of(record));
        }
        Json one{{"id", cases::printable(c.id)},
                 {"change", to_string(c.change)},
                 {"results", std::move(results)},
                 {"detail", c.detail}};
        if (Json pictures = pictures_of(c); !pictures.is_null()) {
            const size_t size = pictures.dump().size();
            if (bytes + size > kMostPictures) {
                ++left_out;
            } else {
                bytes += size;
                one["pictures"] = std::move(pictures);
            }
        }
        cases.push_back(std::move(one));
    }
    Json rules = Json::object(), meanings = Json::object();
    Json causes = causes_json(comparison, rules);
    for (const cases::Profile profile : cases::kProfiles) {
        meanings[std::string(cases::to_string(profile))] = meaning(profile);
    }
    return Json{{"profile", cases::to_string(runs.front().run.profile)},
                {"runs", std::move(list)},
                {"remarks", comparison.remarks},
                {"kinds", std::move(kinds)},
                {"cases", std::move(cases)},
                {"pictures_left_out", left_out},
                {"strings", Json::array()},
                {"causes", std::move(causes)},
                {"rules", std::move(rules)},
                {"meanings", std::move(meanings)}};
}

// For readers without a script.
std::string table(const Comparison& comparison) {
    std::string text = "<table><thead><tr><th scope=\"col\">change</th>";
    for (const std::string& letter : comparison.letters) {
        text += fmt::format("<th scope=\"col\">{}</th>", cases::markup(letter));
    }
    text += "<th scope=\"col\">case</th><th scope=\"col\">detail</th></tr></thead><tbody>\n";
    for (const ComparedCase& c : comparison.cases) {
        if (c.change == Change::same) {
            continue;
        }
        text += fmt::format("<tr><td>{}</td>", to_string(c.change));
        for (const CaseRecord* record : c.records) {
            text += fmt::format("<td>{}</td>",
                                record == nullptr ? "-" : to_string(actual_status(*record)));
        }
        text += fmt::format("<td>{}</td><td>{}</td></tr>\n", cases::markup(c.id),
                            cases::markup(c.detail));
    }
    return text + "</tbody></table>";
}

}  // namespace

std::string comparison_html(const std::vector<NamedRun>& runs, const Comparison& comparison,
                            const std::vector<std::string>& reports) {
    const std::string headline = comparison_headline(comparison);
    std::string title = "edgecase: " + headline, script;
    for (size_t k = 0; k < runs.size(); ++k) {
        title += fmt::format("{} {}", k == 0 ? "," : " and", cases::printable(runs[k].folder));
    }
    for (const std::string_view part : kScripts) {
        script += part;
    }
    const PageField fields[] = {
        {"{{TITLE}}", cases::markup(title)},
        {"{{CSS}}", std::string(page_style())},
        {"{{HEADLINE}}", cases::markup(headline)},
        {"{{VERDICT}}", cases::markup(exit_words(comparison))},
        {"{{TABLE}}", table(comparison)},
        {"{{DATA}}", script_data(data_of(runs, comparison, reports).dump())},
        {"{{SCRIPT}}", script},
    };
    return fill_page(kPage, fields);
}

}  // namespace report
