// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "report/compare/comparison.hpp"
#include "report/journal/json_codec.hpp"
#include "report/text/wrap.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t kListed = 20;     // cases of a less important kind that are listed
constexpr uint32_t kMaxSide = 64;  // characters and lines of a picture

std::string status_word(const CaseRecord* record) {
    std::string word(record == nullptr ? "-" : to_string(actual_status(*record)));
    std::ranges::replace(word, '_', ' ');
    return word;
}

size_t listed(Change change, bool verbose) {
    if (change == Change::same) {
        return 0;
    }
    if (verbose || change == Change::regression || change == Change::vanished ||
        change == Change::fix) {
        return static_cast<size_t>(-1);
    }
    const bool is_told = change != Change::other_values && change != Change::fails_alike &&
                         change != Change::judged_in_none;
    return is_told ? kListed : 0;
}

// Where two devices hit other samples: '#' both, '.' none, 'A' and 'B' one of them, '2' another
// number of times.
std::string picture(const ComparedCase& c, const std::vector<std::string>& letters,
                    const ConsoleStyle& style) {
    for (size_t k = 1; k < c.records.size(); ++k) {
        if (c.records[0] == nullptr || c.records[k] == nullptr) {
            continue;
        }
        const Pictures &p = c.records[0]->evidence.pictures, &q = c.records[k]->evidence.pictures;
        if (!show_same_hits(p, q) || p.device_hits == q.device_hits) {
            continue;
        }
        const size_t samples = p.device_hits.size() / (size_t{p.width} * p.height);
        const uint32_t width = std::min({p.width, kMaxSide, std::max(style.width, 16U) - 8});
        const uint32_t height = std::min(p.height, kMaxSide);
        std::string text = fmt::format(
            "    pixels ({},{}) to ({},{}): # both, . none, {} and {} one of them, "
            "2 both, not as often\n",
            p.left, p.top, p.left + width - 1, p.top + height - 1, letters[0], letters[k]);
        for (uint32_t j = 0; j < height; ++j) {
            text += "    ";
            for (uint32_t i = 0; i < width; ++i) {
                char mark = '.';
                for (size_t s = 0; s < samples; ++s) {
                    const size_t at = (size_t{j} * p.width + i) * samples + s;
                    const unsigned a = p.device_hits[at], b = q.device_hits[at];
                    if (a != b) {
                        mark = a > 0 && b > 0 ? '2' : a > 0 ? letters[0][0] : letters[k][0];
                        break;
                    }
                    mark = a > 0 ? '#' : mark;
                }
                text += mark;
            }
            text += '\n';
        }
        return text;
    }
    return {};
}

}  // namespace

std::string heading(Change change, size_t count) {
    // In the order of Change.
    constexpr std::array<const char*, kChanges> kHeadings = {
        "regressions: {} got worse",
        "vanished: {} of the first run not in a later one, or unsupported or skipped there",
        "fixes: {} got better",
        "fail in all, in different ways: {}",
        "fail in all, bit for bit alike: {}",
        "the reference allows both, other samples are hit: {}",
        "pass with the same hits and other values within the budgets: {}",
        "judged in some of the runs only: {}",
        "judged in none of the runs, so not compared: {}",
        "the same bit for bit: {}"};
    return fmt::format(fmt::runtime(kHeadings.at(static_cast<size_t>(change))),
                       cases::counted(count, "case"));
}

std::string comparison_headline(const Comparison& comparison) {
    const auto count = [&](Change change) {
        return comparison.counts.at(static_cast<size_t>(change));
    };
    const size_t all = compared_cases(comparison);
    if (all == 0 && count(Change::vanished) == 0) {
        return "No case was compared";
    }
    if (all > 0 && count(Change::same) + count(Change::judged_in_none) == comparison.cases.size()) {
        return all == 1 ? "The one case is the same bit for bit"
                        : fmt::format("All {} cases are the same bit for bit", all);
    }
    const size_t worse = count(Change::regression), fails = count(Change::fails_otherwise);
    std::string text =
        worse == 0 ? "No case got worse" : cases::counted(worse, "case") + " got worse";
    if (count(Change::vanished) > 0) {
        text += fmt::format(", {} vanished", count(Change::vanished));
    }
    if (count(Change::fix) > 0) {
        text += fmt::format(", {} got better", count(Change::fix));
    }
    if (fails > 0) {
        text += fmt::format(", {} {} in {}", fails, fails == 1 ? "fails" : "fail",
                            fails == 1 ? "another way" : "other ways");
    }
    return text;
}

std::string exit_words(const Comparison& comparison) {
    const auto has = [&](Change change) {
        return comparison.counts.at(static_cast<size_t>(change)) > 0;
    };
    const int code = exit_code(comparison);
    return fmt::format(
        "exit {}: {}", code,
        code == kExitOk                ? "no regression"
        : code == kExitNothingSelected ? "0 cases compared: no two runs judged the same"
        : code == kExitInternal        ? "no regression, but cases were not judged"
        : has(Change::regression)
            ? (has(Change::vanished) ? "regressions, and cases vanished" : "regressions")
        : has(Change::vanished) ? "cases vanished; --common compares those that all runs have"
                                : "differences (--strict)");
}

std::string comparison_text(const std::vector<NamedRun>& runs, const Comparison& comparison,
                            const ConsoleStyle& style, const std::string& exit) {
    std::string text;
    for (size_t k = 0; k < runs.size(); ++k) {
        const Run& run = runs[k].run;
        text +=
            fmt::format("{}  {}  {}  {} {}  {} subpixel bits  profile {}  {}\n",
                        comparison.letters[k], cases::printable(runs[k].folder),
                        cases::printable(run.device.name), cases::printable(run.device.driver_name),
                        cases::printable(run.device.driver_info), run.device.subpixel_bits,
                        cases::to_string(run.profile), cases::counted(run.cases.size(), "case"));
    }
    for (const std::string& remark : comparison.remarks) {
        text += "note: " + remark + "\n";
    }
    size_t column = 4;
    for (const ComparedCase& c : comparison.cases) {
        for (const CaseRecord* record : c.records) {
            column = std::max(column, status_word(record).size());
        }
    }
    for (size_t kind = 0; kind < kChanges; ++kind) {
        const auto change = static_cast<Change>(kind);
        const size_t count = comparison.counts.at(kind);
        if (count == 0) {
            continue;
        }
        const bool loud = change == Change::regression || change == Change::vanished;
        const std::string title = heading(change, count);
        text += style.color ? fmt::format("\x1b[{}m{}\x1b[0m\n", loud ? "1;31" : "1", title)
                            : title + '\n';
        const size_t most = listed(change, style.verbose);
        size_t told = 0;
        for (const ComparedCase& c : comparison.cases) {
            if (c.change != change || told >= most) {
                continue;
            }
            if (told++ == 0) {
                text += "  ";
                for (const std::string& name : comparison.letters) {
                    text += fmt::format("{:<{}}  ", name, column);
                }
                text += "case\n";
            }
            text += "  ";
            for (const CaseRecord* record : c.records) {
                text += fmt::format("{:<{}}  ", status_word(record), column);
            }
            text += cases::printable(c.id) + (c.detail.empty() ? "" : "   " + c.detail) + '\n';
            if (style.verbose) {
                text += picture(c, comparison.letters, style);
            }
        }
        if (told > 0 && told < count) {
            text += fmt::format("  and {} more (-v lists them)\n", count - told);
        }
    }
    text += (exit.empty() ? exit_words(comparison) : exit) + '\n';
    return style.wrap ? wrapped(text, style.width) : text;
}

Json compared_run(const NamedRun& run, const Comparison& comparison, size_t index) {
    const capture::DeviceInfo& device = run.run.device;
    return Json{{"name", comparison.letters[index]},
                {"folder", cases::printable(run.folder)},
                {"device", cases::printable(device.name)},
                {"driver", cases::printable(device.driver_name + " " + device.driver_info)},
                {"subpixel_bits", device.subpixel_bits}};
}

std::string comparison_json(const std::vector<NamedRun>& runs, const Comparison& comparison) {
    Json list = Json::array();
    for (size_t k = 0; k < runs.size(); ++k) {
        const Run& run = runs[k].run;
        Json json = compared_run(runs[k], comparison, k);
        json["tool_version"] = cases::printable(run.tool_version);
        json["suite_hash"] = cases::printable(run.suite_hash);
        json["started"] = cases::printable(run.started);
        json["cases"] = run.cases.size();
        list.push_back(std::move(json));
    }
    Json totals = Json::object();
    for (size_t k = 0; k < kChanges; ++k) {
        totals[std::string(to_string(static_cast<Change>(k)))] = comparison.counts.at(k);
    }
    Json cases = Json::array();
    for (const ComparedCase& c : comparison.cases) {
        if (c.change == Change::same) {
            continue;
        }
        Json results = Json::array();
        for (const CaseRecord* record : c.records) {
            results.push_back(
                record == nullptr
                    ? Json(nullptr)
                    : Json{{"status", to_string(actual_status(*record))},
                           {"bits", cases::printable(record->drawn.bits)},
                           {"hit_bits", cases::printable(record->drawn.hit_bits)},
                           {"worst_ratio", encode_number(record->outcome.worst_ratio)}});
        }
        cases.push_back(Json{{"id", cases::printable(c.id)},
                             {"change", to_string(c.change)},
                             {"results", results},
                             {"detail", c.detail}});
    }
    const Json json{{"schema", "edgecase-comparison-1"},
                    {"profile", cases::to_string(runs.front().run.profile)},
                    {"runs", list},
                    {"remarks", comparison.remarks},
                    {"totals", totals},
                    {"exit_code", exit_code(comparison)},
                    {"cases", cases}};
    return json.dump(1) + '\n';
}

}  // namespace report
