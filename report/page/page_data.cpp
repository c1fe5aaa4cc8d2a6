// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/page/page_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>

#include "cases/base/printable.hpp"
#include "cases/model/device.hpp"
#include "cases/model/rule.hpp"
#include "report/journal/json_codec.hpp"
#include "report/text/causes.hpp"
#include "report/text/commands.hpp"
#include "report/text/diagnosis_text.hpp"
#include "report/text/sentences.hpp"

namespace report {

using Json = nlohmann::ordered_json;

namespace {

// results.json holds everything.
constexpr size_t kMostFindings = 200;  // of a case
constexpr size_t kLeastFindings = 5;   // of a case
constexpr size_t kMostOfSample = 24;   // four attributes of four numbers, FragCoord, depth, colour
constexpr size_t kFindingBudget = 12000;  // of a page
constexpr size_t kMaxOutput = 8192;       // bytes of a driver's output, a case

// Texts that many cases share, stored once; printable.
class Strings {
  public:
    size_t number_of(const std::string& bytes) {
        const auto [it, is_new] = numbers_.try_emplace(bytes, list_.size());
        if (is_new) {
            list_.push_back(cases::printable(bytes));
        }
        return it->second;
    }
    const Json& list() const { return list_; }

  private:
    std::unordered_map<std::string, size_t> numbers_;
    Json list_ = Json::array();
};

void put(Json& json, const char* key, const std::string& bytes) {
    if (!bytes.empty()) {
        json[key] = cases::printable(bytes);
    }
}

void put(Json& json, const char* key, const std::vector<std::string>& list) {
    for (const std::string& entry : list) {
        json[key].push_back(cases::printable(entry));
    }
}

// A list, as finding() of dom.js reads it. Rows are those of the stacked layers, as in pictures; of
// the whole case the place is null.
Json finding_json(const CaseRecord& r, const diff::Finding& f, Strings& strings) {
    const uint32_t row = f.layer.value_or(0) * r.evidence.pictures.layer_height + f.y;
    const bool has_ratio =
        f.kind == diff::FindingKind::value && f.ratio > 0 && std::isfinite(f.ratio);
    const auto place = [&](uint32_t number) { return f.of_case ? Json(nullptr) : Json(number); };
    return Json::array({diff::to_string(f.kind), strings.number_of(f.rule),
                        cases::to_string(f.level), place(f.x), place(row), place(f.sample),
                        strings.number_of(f.quantity), strings.number_of(f.expected),
                        strings.number_of(f.got), strings.number_of(f.why),
                        has_ratio ? Json(ratio_text(f.ratio)) : Json(nullptr)});
}

// Causes in the order of the terminal.
Json causes_json(const Run& run, const std::vector<Cause>& list) {
    Json json = Json::array();
    for (const Cause& cause : list) {
        json.push_back(cause_json(cause, [&](const CaseRecord& record) {
            return static_cast<size_t>(&record - run.cases.data());
        }));
        if (!cause.level && cause.is_known) {
            json.back()["known"] = true;
        }
        if (cause.diagnosis) {
            json.back()["diagnosis"] = *cause.diagnosis;
        }
    }
    return json;
}

// What the device does wrong: a sentence, on what it rests, and the numbers of the cases that show
// it.
Json diagnoses_json(const Run& run) {
    Json json = Json::array();
    const Repeated repeated(run);
    for (const Diagnosis& d : run.diagnoses) {
        Json members = Json::array();
        for (const std::string& id : d.examples) {
            const auto at = std::ranges::find(run.cases, id, &CaseRecord::id);
            if (at != run.cases.end()) {
                members.push_back(at - run.cases.begin());
            }
        }
        json.push_back(Json{{"what", cases::printable(what_it_does(d))},
                            {"evidence", evidence_for(d)},
                            {"cases", std::move(members)}});
        if (repeated.is_partial(json.size() - 1)) {
            json.back()["limits"] = limits_of(d);
        }
    }
    return json;
}

Json case_json(const CaseRecord& r, size_t most_findings, Strings& strings) {
    Json json{{"id", cases::printable(r.id)}, {"status", to_string(r.status)}, {"line", r.line}};
    const std::string what = what_happened(r);
    json["what"] = what.empty() && r.status != Status::pass ? why_it_happened(r) : what;
    if (!r.file.empty()) {
        json["file"] = strings.number_of(r.file);
    }
    json["description"] = strings.number_of(r.description);
    json["catches"] = strings.number_of(r.catches);
    if (!r.rules.empty()) {
        json["rules"] = strings.number_of(fmt::format("{}", fmt::join(r.rules, " ")));
    }
    put(json, "links", r.links);
    if (r.known.expected) {
        json["expected"] = to_string(*r.known.expected);
    }
    put(json, "bug", r.known.bug);
    put(json, "expired", r.known.expired);
    put(json, "reason", r.reason);
    put(json, "step", r.death.step);
    put(json, "signal", r.death.signal);
    put(json, "stderr", head_and_tail(r.death.output, kMaxOutput));
    put(json, "messages", r.drawn.messages);
    json["time"] = seconds_text(r.drawn.seconds);
    json["seconds"] = encode_number(r.drawn.seconds);
    json["attempts"] = r.drawn.attempts;
    if (r.outcome.compared_samples > 0) {
        json["compared"] = Json::array({r.outcome.compared_samples, r.outcome.must_samples,
                                        r.outcome.either_samples, r.outcome.compared_values});
    }
    if (r.outcome.compared_values > 0) {
        json["worst"] =
            Json::array({encode_number(r.outcome.worst_ratio), ratio_text(r.outcome.worst_ratio),
                         cases::printable(r.outcome.worst_quantity)});
    }
    if (!r.outcome.findings.empty()) {
        json["finding_total"] = r.outcome.finding_total();
        json["finding_kept"] = r.outcome.findings.size();  // in results.json
        json["counts"] = counts_text(r);
        const diff::Finding& lead = leading_finding(r);
        json["lead"] = finding_json(r, lead, strings);
        const auto is_here = [](const diff::Finding& a, const diff::Finding& b) {
            return a.x == b.x && a.y == b.y && a.sample == b.sample && a.of_case == b.of_case;
        };
        // Those of the leading sample, then the others in order; of a sample all, within reason.
        const size_t most_of_sample = std::min(most_findings + 4, kMostOfSample);
        Json& list = json["findings"] = Json::array();
        for (const diff::Finding& f : r.outcome.findings) {
            if (is_here(f, lead) && list.size() < most_of_sample) {
                list.push_back(finding_json(r, f, strings));
            }
        }
        for (size_t k = 0; k < r.outcome.findings.size(); ++k) {
            const bool is_new =
                k == 0 || !is_here(r.outcome.findings[k], r.outcome.findings[k - 1]);
            if (list.size() >= (is_new ? most_findings : most_findings + kMostOfSample)) {
                break;
            }
            if (!is_here(r.outcome.findings[k], lead)) {
                list.push_back(finding_json(r, r.outcome.findings[k], strings));
            }
        }
    }
    const std::string settings(settings_of(r.rerun));
    put(json, "rerun", r.rerun.substr(settings.size()));
    put(json, "explain", r.commands.explain);
    const std::string debug = debug_line(r);
    put(json, "debug", debug.substr(std::min(settings.size(), debug.size())));
    put(json, "reproducer", r.commands.reproducer);
    put(json, "no_reproducer", r.commands.no_reproducer);
    json["settings"] = strings.number_of(settings);
    return json;
}

// Adds what fits to the cases: first all of the smallest case of every cause, then pictures with
// triangles, then values. Returns the cases that had to be left without.
std::vector<size_t> add_evidence(const Run& run, const std::vector<Cause>& all, Json& list) {
    size_t left = kEvidenceBudget;
    std::vector<size_t> without;
    const auto add_picture = [&](size_t k) {
        const CaseRecord& r = run.cases[k];
        if (r.evidence.pictures.width > 0 && r.evidence.pictures.height > 0) {
            Json both = Json::array({encode(r.evidence.pictures), encode(r.evidence.geometry)});
            const size_t size = both.dump().size();
            const bool is_first =
                left == kEvidenceBudget;  // fits by definition: parts come to an end
            if (size > left && !is_first) {
                without.push_back(k);
                return;
            }
            left -= std::min(size, left);
            list[k]["pictures"] = std::move(both[0]);
            list[k]["geometry"] = std::move(both[1]);
        }
    };
    const auto add_values = [&](size_t k) {
        Json values = Json::array();
        for (SampleEvidence e : run.cases[k].evidence.samples) {
            cases::make_printable(e);
            values.push_back(encode(e));
        }
        if (!values.empty() && list[k].contains("pictures")) {
            const size_t size = values.dump().size();
            if (size <= left) {
                left -= size;
                list[k]["evidence"] = std::move(values);
            }
        }
    };
    std::set<size_t> first;
    for (const Cause& cause : all) {
        const auto k = static_cast<size_t>(&smallest_case(cause) - run.cases.data());
        first.insert(k);
        add_picture(k);
        add_values(k);
    }
    std::vector<size_t> rest;
    for (size_t k = 0; k < run.cases.size(); ++k) {
        if (run.cases[k].evidence.pictures.width > 0 && !first.contains(k)) {
            rest.push_back(k);
        }
    }
    std::ranges::for_each(rest, add_picture);
    std::ranges::for_each(rest, add_values);
    return without;
}

// References of cases that pass, each with its triangles, as a list; many leaves of a file share
// one. Each case gets the number of its own; one that does not fit gets none.
std::string references_text(const Run& run, Json& list) {
    size_t left = kReferenceBudget, count = 0;
    std::string text;
    struct Known {
        const CaseRecord* record;
        size_t number;
    };
    std::unordered_multimap<size_t, Known> known;  // by a hash of the hits
    const auto number_of = [&](const CaseRecord& r) -> std::optional<size_t> {
        const std::string_view hits(reinterpret_cast<const char*>(r.evidence.reference.hits.data()),
                                    r.evidence.reference.hits.size());
        const size_t hash = std::hash<std::string_view>()(hits);
        const auto [begin, end] = known.equal_range(hash);
        const auto same = std::find_if(begin, end, [&](const auto& entry) {
            const CaseRecord& other = *entry.second.record;
            return other.evidence.reference == r.evidence.reference &&
                   other.evidence.geometry == r.evidence.geometry;
        });
        if (same != end) {
            return same->second.number;
        }
        const std::string both =
            Json::array({encode(r.evidence.reference), encode(r.evidence.geometry)}).dump();
        if (both.size() > left) {
            return std::nullopt;
        }
        left -= both.size();
        text += (text.empty() ? "" : ",") + both;
        known.emplace(hash, Known{&r, count});
        return count++;
    };
    for (size_t k = 0; k < run.cases.size(); ++k) {
        if (!run.cases[k].evidence.reference.hits.empty()) {
            if (const auto number = number_of(run.cases[k])) {
                list[k]["reference"] = *number;
            }
        }
    }
    return "[" + text + "]";
}

// The texts of the files of the page's cases.
Json sources_json(const Run& run) {
    std::set<std::string> files;
    for (const CaseRecord& record : run.cases) {
        files.insert(record.file);
    }
    size_t left = kSourceBudget;
    Json json = Json::object();
    for (const auto& [file, text] : run.sources) {
        if (files.contains(file) && text.size() <= left) {
            left -= text.size();
            json[cases::printable(file)] = cases::printable(text);
        }
    }
    return json;
}

}  // namespace

Json cause_json(const Cause& cause, const std::function<size_t(const CaseRecord&)>& number_of) {
    const CaseRecord& smallest = smallest_case(cause);
    Json members = Json::array({number_of(smallest)});
    for (const CaseRecord* record : cause.cases) {
        if (record != &smallest) {
            members.push_back(number_of(*record));
        }
    }
    Json json{{"status", to_string(cause.status)},
              {"family", cases::printable(families_text(cause.cases))},
              {"rule", cases::printable(cause.rule)},
              {"kind", cases::printable(cause.kind)},
              {"level", cause.level ? cases::to_string(*cause.level) : ""},
              {"cases", std::move(members)}};
    put(json, "door", cause.door);
    if (const std::string rerun = rerun_of(cause); rerun != smallest.rerun) {
        put(json, "rerun", rerun);
    }
    return json;
}

PageData page_data(const Run& run, size_t part) {
    PageData data;
    Json rules = Json::object();
    for (const cases::Rule& rule : cases::all_rules()) {
        rules[std::string(rule.id)] = Json{{"title", rule.title},
                                           {"text", rule.text},
                                           {"profile", cases::to_string(rule.profile)},
                                           {"anchor", rule.anchor}};
    }
    Json meanings = Json::object();
    for (const cases::Profile profile : cases::kProfiles) {
        meanings[std::string(cases::to_string(profile))] = meaning(profile);
    }
    Json total = encode_totals(run);
    const auto wrong = static_cast<size_t>(std::ranges::count_if(
        run.cases, [](const CaseRecord& record) { return !record.outcome.findings.empty(); }));
    const size_t most =
        std::clamp(kFindingBudget / std::max<size_t>(wrong, 1), kLeastFindings, kMostFindings);
    const Repeated repeated(run);
    Strings strings;
    Json list = Json::array();
    for (const CaseRecord& record : run.cases) {
        list.push_back(case_json(record, most, strings));
        if (const auto number = repeated.by(record.id)) {
            list.back()["diagnosis"] = *number;
        }
    }
    const std::vector<Cause> all = causes(run);
    data.left_out = add_evidence(run, all, list);
    for (const size_t k : data.left_out) {
        list[k]["part"] = part + 1;
    }
    data.on_demand = fmt::format("{{\"references\":{},\"sources\":{}}}", references_text(run, list),
                                 sources_json(run).dump());
    data.json = Json{{"rules", std::move(rules)},
                     {"meanings", std::move(meanings)},
                     {"totals", std::move(total)},
                     {"profile", cases::to_string(run.profile)},
                     {"subpixel_bits", cases::judged_subpixel_bits(run.device.subpixel_bits)},
                     {"part", part},
                     {"without_pictures", data.left_out.size()},
                     {"diagnoses", diagnoses_json(run)},
                     {"causes", causes_json(run, all)},
                     {"known_causes", causes_json(run, known_causes(run))},
                     {"strings", strings.list()},
                     {"cases", std::move(list)}};
    return data;
}

}  // namespace report
