// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/page/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cases/base/printable.hpp"
#include "report/page/page_data.hpp"
#include "report/page/page_parts.hpp"
#include "report/text/headline.hpp"
#include "report/text/levels_text.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

// The page, from report/page/ (cmake/Embed.cmake).
constexpr std::string_view kPage =
#include "embedded/report.html.inc"
    ;
// In an order in which each file uses only what stands above it at load time.
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
#include "embedded/viewer.js.inc"
    ,
#include "embedded/inspector.js.inc"
    ,
#include "embedded/case.js.inc"
    ,
#include "embedded/causes.js.inc"
    ,
#include "embedded/overview.js.inc"
    ,
#include "embedded/main.js.inc"
    ,
};

std::string fact(std::string_view name, const std::string& value) {
    return value.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, cases::markup(value));
}

std::string key_fact(std::string_view name, const std::string& value) {
    return "<div>" + fact(name, value) + "</div>";
}

std::string title_of(const Run& run) {
    const auto unexpected = std::ranges::count_if(
        run.cases, [](const CaseRecord& record) { return !is_expected(record.status); });
    return fmt::format("edgecase: {}{} of {} unexpected, {}",
                       run.missing_shards.empty() ? "" : "not the whole run, ", unexpected,
                       run.cases.size(), run.device.name.empty() ? "no device" : run.device.name);
}

// What was found at each level; one that unexpected findings break has its colour.
std::string levels_list(const Run& run) {
    const Levels found = levels(run);
    std::string text;
    for (const LevelCount& row : found.rows) {
        const std::string_view level = cases::to_string(row.level);
        const bool is_broken = !row.unexpected.empty();
        text += fmt::format("<li><strong{}>{}: {}</strong>{}</li>\n",
                            is_broken ? fmt::format(" class=\"level level-{}\"", level) : "", level,
                            cases::markup(level_text(found, row)),
                            is_broken ? fmt::format(" {}", meaning(row.level)) : "");
    }
    if (const std::string unjudged = unjudged_text(found); !unjudged.empty()) {
        text += fmt::format("<li>without a level: {}</li>\n", unjudged);
    }
    return "<ul class=\"levels\">\n" + text + "</ul>\n";
}

// "2026-11-21 05:00 UTC" of "2026-11-21T05:00:00Z"; any other text as it is.
std::string day_and_time(const std::string& utc) {
    constexpr size_t kLength = 20;
    return utc.size() == kLength && utc[10] == 'T' && utc.back() == 'Z'
               ? fmt::format("{} {} UTC", utc.substr(0, 10), utc.substr(11, 5))
               : utc;
}

std::string header(const Run& run) {
    const capture::DeviceInfo& d = run.device;
    std::string text = fmt::format("<h1>{}</h1>\n", cases::markup(headline(run)));
    text += levels_list(run);
    if (const std::string shortened = shortened_text(run); !shortened.empty()) {
        text += fmt::format("<p>{}</p>\n", cases::markup(shortened));
    }
    text += fmt::format(
        "<dl class=\"key\">\n{}{}", key_fact("device", d.name.empty() ? "no device" : d.name),
        key_fact("driver", d.driver_name + (d.driver_info.empty() ? "" : " ") + d.driver_info));
    text += key_fact("Vulkan", d.api_version);
    text += key_fact("subpixel bits", fmt::format("{}{}", d.subpixel_bits, judged_bits_note(d)));
    text += key_fact("profile", std::string(cases::to_string(run.profile)));
    text += key_fact(
        "run", fmt::format("{}, {}", day_and_time(run.started),
                           run.ended.empty() ? "cut off" : "took " + seconds_text(run.seconds)));
    text += "</dl>\n<details><summary>About this run</summary><dl>\n";
    text += fact("edgecase", run.tool_version);
    text += fact("ended with", exit_text(run));
    text += fact("sample locations, 1/16 pixel", d.sample_locations);
    text += fact("depth beside a stencil, where a case names none",
                 d.depth_beside_stencil == capture::DeviceInfo().depth_beside_stencil
                     ? ""
                     : d.depth_beside_stencil);
    if (const CaseRecord* worst = worst_case(run)) {
        text += fact("largest accepted error",
                     fmt::format("{}, {}", accepted_text(run, *worst), worst->id));
    }
    text += fact("fails at", std::string(cases::to_string(fail_level(run))));
    text += fact("seed", fmt::format("{}", run.seed));
    text += fact("host", run.host);
    text += fact("UUID", d.uuid);
    text += fact("expectations", run.expectation_file);
    text += "</dl><pre>";
    for (const auto& [name, value] : run.environment) {
        text += cases::markup(name + "=" + value) + "\n";
    }
    for (size_t k = 0; k < run.arguments.size(); ++k) {
        text += (k > 0 ? " " : "") + cases::markup(run.arguments[k]);
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
                            cases::markup(r.id), cases::markup(what),
                            is_expected(r.status) || r.drawn.is_brief
                                ? ""
                                : "<br>" + cases::markup(why_it_happened(r)));
    }
    return text + "</tbody></table>";
}

std::string script() {
    std::string text;
    for (const std::string_view part : kScripts) {
        text += part;
    }
    return text;
}

// One page; `left_out` as page_data() gives it.
std::string page_of(const Run& run, size_t part, std::vector<size_t>& left_out) {
    const std::string part_text = part > 1 ? fmt::format(" (part {})", part) : "";
    PageData data = page_data(run, part);
    left_out = std::move(data.left_out);
    const PageField fields[] = {
        {"{{TITLE}}", cases::markup(title_of(run)) + part_text},
        {"{{CSS}}", std::string(page_style())},
        {"{{HEADER}}", header(run)},
        {"{{TABLE}}", table(run)},
        {"{{DATA}}", script_data(data.json.dump())},
        {"{{ON_DEMAND}}", script_data(data.on_demand)},
        {"{{SCRIPT}}", script()},
    };
    return fill_page(kPage, fields);
}

}  // namespace

std::string to_html(const Run& run) {
    std::vector<size_t> left_out;
    return page_of(run, 1, left_out);
}

void for_each_page(const Run& run, const std::function<void(size_t, const std::string&)>& visit) {
    std::vector<size_t> left_out;
    visit(1, page_of(run, 1, left_out));
    Run rest;
    static_cast<RunHeader&>(rest) = run;
    static_cast<RunEnd&>(rest) = run;
    rest.device = run.device;
    for (const size_t k : left_out) {
        rest.cases.push_back(run.cases[k]);
    }
    for (size_t part = 2; !rest.cases.empty(); ++part) {
        visit(part, page_of(rest, part, left_out));
        std::vector<CaseRecord> cases;
        for (const size_t k : left_out) {
            cases.push_back(std::move(rest.cases[k]));
        }
        rest.cases = std::move(cases);  // fewer than before: the first case of a page always fits
    }
}

}  // namespace report
