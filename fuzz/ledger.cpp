// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cases/base/input_file.hpp"
#include "cases/base/printable.hpp"

namespace fuzz {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

constexpr const char* kSchema = "edgecase-fuzz-1";

Json also_of(const Entry& entry) {
    Json all = Json::array();
    for (const auto& [kind, rule] : entry.also) {
        all.push_back({{"kind", diff::to_string(kind)}, {"rule", rule}});
    }
    return all;
}

Json to_json(const Waiting& waiting) {
    Json symptoms = Json::array();
    for (const Symptom& symptom : waiting.symptoms) {
        symptoms.push_back(to_text(symptom));
    }
    return {{"case", waiting.number}, {"symptoms", std::move(symptoms)}};
}

Json to_json(const Entry& entry) {
    return {{"symptom", to_text(entry.symptom)},
            {"file", entry.file},
            {"is_known", entry.is_known},
            {"is_reduced", entry.is_reduced},
            {"is_minimal", entry.is_minimal},
            {"first_case", entry.first_case},
            {"count", entry.count},
            {"essentials", to_texts(entry.essentials)},
            {"needs", entry.needs},
            {"needs_format", entry.needs_format},
            {"overflows", entry.overflows},
            {"undrawn", entry.undrawn},
            {"passes", entry.passes},
            {"bug", entry.bug},
            {"seen", entry.seen},
            {"also", also_of(entry)}};
}

// Whether a text can be a part of a file's name.
bool is_plain(std::string_view text) {
    return text.find_first_not_of(
               "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
               "0123456789.-_") == text.npos;
}

// These throw nlohmann's exceptions, which load_ledger() turns into an error.
Symptom symptom_of(const std::string& text) {
    const auto parsed = parse_symptom(text);
    if (!parsed || !is_plain(parsed->rule)) {  // files are named by the rule
        throw std::runtime_error("'" + text + "' is no symptom");
    }
    return *parsed;
}

Waiting waiting_of(const Json& json) {
    Waiting waiting;
    waiting.number = json.at("case");
    for (const Json& symptom : json.at("symptoms")) {
        waiting.symptoms.push_back(symptom_of(symptom.get<std::string>()));
    }
    if (waiting.symptoms.empty()) {
        throw std::runtime_error("a case waits without a symptom");
    }
    return waiting;
}

// Whether a file has a name that a hunt gives: it is read, and may be deleted.
bool is_own_file(const Entry& entry) {
    if (!entry.is_reduced) {
        return entry.file == file_of_not_reduced(entry.first_case);
    }
    const size_t slash = entry.file.find('/');
    const std::string folder = entry.file.substr(0, slash);
    if (slash == std::string::npos ||
        (folder != kFound && folder != kKnown && folder != kEarlier)) {
        return false;
    }
    return entry.file.ends_with(".toml") && is_plain(entry.file.substr(slash + 1));
}

Entry entry_of(const Json& json, const fs::path& folder) {
    Entry entry;
    entry.symptom = symptom_of(json.at("symptom").get<std::string>());
    entry.is_reduced = json.at("is_reduced");
    entry.file = json.at("file");
    entry.is_minimal = json.at("is_minimal");
    entry.first_case = json.at("first_case");
    entry.count = json.at("count");
    entry.essentials = parse_essentials(json.at("essentials").get<std::set<std::string>>());
    entry.needs = json.at("needs").get<std::vector<std::string>>();
    // Older hunts say in words alone that a case needs its format.
    entry.needs_format =
        json.value("needs_format", std::ranges::any_of(entry.needs, [](const std::string& need) {
                       return need.starts_with("not with the format");
                   }));
    entry.overflows = json.value("overflows", false);
    entry.undrawn = json.value("undrawn", std::vector<std::string>());
    entry.passes = json.value("passes", std::vector<std::string>());
    entry.bug = json.value("bug", "");
    entry.seen = json.value("seen", "");
    for (const Json& also : json.at("also")) {
        for (size_t k = 0; k < diff::kFindingKinds; ++k) {
            const auto kind = static_cast<diff::FindingKind>(k);
            if (also.at("kind") == diff::to_string(kind)) {
                entry.also.insert({kind, also.at("rule")});
            }
        }
    }
    if (!is_own_file(entry)) {
        throw std::runtime_error("'" + entry.file + "' is no name of a file of a hunt");
    }
    cases::Expected<std::string> text = cases::read_inside(folder, folder / entry.file);
    if (!text) {
        throw std::runtime_error("the file '" + entry.file +
                                 "' cannot be read: " + text.error().message);
    }
    entry.set_text(std::move(*text));
    return entry;
}

}  // namespace

std::string file_of_not_reduced(uint64_t number) {
    return fmt::format("{}/not-reduced-{}.toml", kFound, number);
}

std::string to_json(const Ledger& ledger) {
    Json entries = Json::array();
    for (const Entry& entry : ledger.entries) {
        entries.push_back(to_json(entry));
    }
    Json waiting = Json::array();
    for (const Waiting& one : ledger.waiting) {
        waiting.push_back(to_json(one));
    }
    Json json = {{"schema", kSchema},
                 {"tool_version", ledger.tool_version},
                 {"device", cases::printable(ledger.device)},
                 {"driver", cases::printable(ledger.driver)},
                 {"arguments", ledger.arguments},
                 {"selectors", ledger.selectors},
                 {"suite", ledger.suite},
                 {"cases_checksum", ledger.cases_checksum},
                 {"expectations", ledger.expectations},
                 {"no_expect", ledger.no_expect},
                 {"expect", ledger.expect},
                 {"seed", ledger.seed},
                 {"shard", ledger.shard},
                 {"shards", ledger.shards},
                 {"profile", cases::to_string(ledger.profile)},
                 {"seconds", ledger.seconds},
                 {"is_finished", ledger.is_finished}};
    HuntCounts::fields([&](const cases::Field& f, const auto& value) { json[f.name] = value; },
                       ledger.counts);
    json["causes"] = std::move(entries);
    json["waiting"] = std::move(waiting);
    json["left"] = ledger.left;
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

cases::Expected<Ledger> load_ledger(const fs::path& folder) {
    const fs::path file = folder / kLedgerFile;
    const cases::Expected<std::string> text = cases::read_inside(folder, file);
    if (!text) {
        return cases::failure("'{}' is not the folder of a hunt: {} cannot be read: {}",
                              folder.string(), kLedgerFile, text.error().message);
    }
    try {
        const Json json = Json::parse(*text);
        if (json.at("schema") != kSchema) {
            return cases::failure("{} has another schema than {}", file.string(), kSchema);
        }
        Ledger ledger;
        ledger.tool_version = json.at("tool_version");
        ledger.device = json.at("device");
        ledger.driver = json.at("driver");
        ledger.arguments = json.at("arguments").get<std::vector<std::string>>();
        ledger.selectors = json.value("selectors", std::vector<std::string>());
        ledger.suite = json.value("suite", "");
        ledger.cases_checksum = json.value("cases_checksum", "");
        ledger.expectations = json.value("expectations", "");
        ledger.no_expect = json.value("no_expect", false);
        ledger.expect = json.value("expect", std::vector<std::string>());
        ledger.seed = json.at("seed");
        ledger.shard = json.at("shard");
        ledger.shards = json.at("shards");
        const auto profile = cases::parse_profile(json.at("profile").get<std::string>());
        if (!profile) {
            return cases::failure("{} names no profile", file.string());
        }
        ledger.profile = *profile;
        ledger.seconds = json.at("seconds");
        ledger.is_finished = json.at("is_finished");
        HuntCounts::fields(
            [&](const cases::Field& f, auto& value) {
                if (json.contains(f.name) || !f.has(cases::kOlderLackIt)) {
                    value = json.at(f.name);
                }
            },
            ledger.counts);
        for (const Json& entry : json.at("causes")) {
            ledger.entries.push_back(entry_of(entry, folder));
            ledger.entries.back().is_known = entry.at("is_known");
        }
        for (const Json& waiting : json.at("waiting")) {
            ledger.waiting.push_back(waiting_of(waiting));
        }
        ledger.left = json.value("left", std::vector<uint64_t>());
        return ledger;
    } catch (const std::exception& e) {
        return cases::failure("{} is malformed: {}", file.string(), cases::printable(e.what()));
    }
}

std::string command_of(const Ledger& ledger) {
    std::string command = "edgecase fuzz";
    for (const std::string& selector : ledger.selectors) {
        command += " " + cases::printable(selector);
    }
    return command + fmt::format(" --seed {}", ledger.seed);
}

std::string found_text(const Entry& entry, const Ledger& ledger) {
    std::string text = to_text(entry.symptom);
    text = entry.bug.empty()
               ? fmt::format("# {}, found by '{}' in case {} on {}.\n", text, command_of(ledger),
                             entry.first_case, cases::printable(ledger.device))
               : fmt::format("# {}, known by an expectation file on {}: {}\n", text,
                             cases::printable(ledger.device), cases::printable(entry.bug));
    if (!entry.seen.empty()) {
        text += fmt::format("# Seen: {}.\n", cases::printable(entry.seen));
    }
    if (entry.shown_first) {
        text += fmt::format("# A run of it tells first what it shows, too: {}.\n",
                            to_text(*entry.shown_first));
    }
    if (!entry.is_reduced) {
        text += "# Not reduced: the hunt ended before. 'edgecase fuzz --resume' reduces it.\n";
        return text + entry.text;
    }
    text += need_text(entry);
    if (!entry.is_minimal) {
        text += "# The reduction ended early: it may be larger than it has to be.\n";
    }
    return text + entry.text;
}

}  // namespace fuzz
