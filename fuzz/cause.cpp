// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace fuzz {

using cases::TomlEntry;
using cases::TomlValue;
using report::Status;

namespace {

bool is_failure(Status status) {
    return status >= Status::flake && status <= Status::crash;
}

// Keys that say nothing of what is drawn, or that every case has.
constexpr std::array<std::string_view, 9> kPlain = {
    "format", "description", "rules", "links", "catches", "size", "name", "vertices", "values"};
// Keys whose word does not matter: a cause that needs one format or comparison is mostly met with
// others, too.
constexpr std::array<std::string_view, 8> kAnyWord = {
    "format", "depth", "compare", "blend", "op", "source", "destination", "write_mask"};

template <size_t N>
bool is_one_of(const std::array<std::string_view, N>& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

double number(const TomlValue& value) {
    return value.is(TomlValue::Kind::integer) ? static_cast<double>(value.integer) : value.floating;
}

// Whether some vertex of the draw has another w than another one, or all have one that is not 1.
void add_depths(const TomlValue& draw, std::set<std::string>& words) {
    const TomlValue* vertices = draw.find("vertices");
    if (vertices == nullptr) {
        return;
    }
    std::set<double> z, w;
    for (const TomlValue& vertex : vertices->array) {
        z.insert(vertex.array.size() > 2 ? number(vertex.array[2]) : 0.5);
        w.insert(vertex.array.size() > 3 ? number(vertex.array[3]) : 1);
    }
    if (w.size() > 1) {
        words.insert("unequal w");
    }
    if (std::any_of(w.begin(), w.end(), [](double v) { return v <= 0; })) {
        words.insert("behind the eye");
    }
    if (w.size() == 1 && z.size() > 1) {
        words.insert("sloping depth");
    }
    if (vertices->array.size() > 6) {
        words.insert("several triangles");
    }
}

void add_keys(const TomlValue& table, const std::string& path, std::set<std::string>& words) {
    for (const TomlEntry& entry : table.table) {
        const TomlValue& value = entry.value;
        const bool is_top = path.empty();
        const std::string name = is_top || path == "target" ? entry.key : path + "." + entry.key;
        if (is_one_of(kPlain, entry.key)) {
            continue;
        }
        if (value.is(TomlValue::Kind::table)) {
            if (entry.key == "color") {
                words.insert("color");
            }
            add_keys(value, is_top ? entry.key : name, words);
        } else if (entry.key == "relations") {
            for (const TomlValue& relation : value.array) {
                words.insert("relation " + (relation.table.empty() ? relation.string
                                                                   : relation.table.front().key));
            }
        } else if (value.is(TomlValue::Kind::array) && !value.array.empty() &&
                   value.array.front().is(TomlValue::Kind::table)) {
            if (entry.key == "draw" && value.array.size() > 1) {
                words.insert("several draws");
            } else if (entry.key != "draw") {
                words.insert(name);
            }
            for (const TomlValue& element : value.array) {
                if (entry.key == "draw") {
                    add_depths(element, words);
                }
                add_keys(element, name, words);
            }
        } else if (value.is(TomlValue::Kind::string) && !is_one_of(kAnyWord, entry.key)) {
            words.insert(name + "=" + value.string);
        } else if (entry.key == "samples" || value.is(TomlValue::Kind::boolean)) {
            words.insert(entry.key == "samples" ? "several samples"
                                                : name + (value.boolean ? "=true" : "=false"));
        } else {
            words.insert(name);
        }
    }
}

}  // namespace

std::optional<Symptom> symptom_of(const report::CaseRecord& record) {
    if (!is_failure(record.status)) {
        return std::nullopt;
    }
    Symptom symptom;
    symptom.status = record.status;
    symptom.signal = record.signal;
    if (record.status != Status::fail) {
        return symptom;
    }
    const auto gravest = std::min_element(
        record.groups.begin(), record.groups.end(), [](const auto& a, const auto& b) {
            return std::pair(a.level, b.count) < std::pair(b.level, a.count);
        });
    if (gravest == record.groups.end()) {
        return std::nullopt;
    }
    symptom.kind = gravest->kind;
    symptom.rule = gravest->rule;
    symptom.level = gravest->level;
    return symptom;
}

bool shows(const report::CaseRecord& record, const Symptom& symptom) {
    if (record.status != symptom.status || record.signal != symptom.signal) {
        return false;
    }
    return record.status != Status::fail ||
           std::any_of(record.groups.begin(), record.groups.end(), [&](const auto& group) {
               return group.kind == symptom.kind && group.rule == symptom.rule &&
                      group.level == symptom.level;
           });
}

std::string to_text(const Symptom& s) {
    if (s.status == Status::fail) {
        return fmt::format("{} of {} [{}]", diff::to_string(s.kind), s.rule,
                           cases::to_string(s.level));
    }
    return s.signal.empty() ? std::string(report::to_string(s.status))
                            : fmt::format("{} by {}", report::to_string(s.status), s.signal);
}

std::optional<Symptom> parse_symptom(const std::string& text) {
    Symptom s;
    const size_t of = text.find(" of "), level = text.find(" [");
    if (of != std::string::npos && level != std::string::npos && text.ends_with("]")) {
        const auto profile = cases::parse_profile(text.substr(level + 2, text.size() - level - 3));
        for (size_t k = 0; k < diff::kFindingKinds; ++k) {
            const auto kind = static_cast<diff::FindingKind>(k);
            if (profile && text.substr(0, of) == diff::to_string(kind)) {
                s.kind = kind;
                s.rule = text.substr(of + 4, level - of - 4);
                s.level = *profile;
                return s;
            }
        }
        return std::nullopt;
    }
    const size_t by = text.find(" by ");
    const auto status = report::parse_status(text.substr(0, by));
    if (!status || !is_failure(*status)) {
        return std::nullopt;
    }
    s.status = *status;
    s.signal = by == std::string::npos ? "" : text.substr(by + 4);
    return s;
}

std::set<std::string> essentials(const TomlValue& document) {
    std::set<std::string> words;
    add_keys(document, "", words);
    return words;
}

}  // namespace fuzz
