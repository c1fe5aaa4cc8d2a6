// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cases/key/key.hpp"
#include "cases/model/triangle.hpp"

namespace fuzz {

using cases::TomlValue;
using report::Status;

namespace {

bool is_failure(Status status) {
    return status >= Status::flake && status <= Status::crash;
}

// The corners of a triangle go to the device's grid, of 1/16 pixel or finer, each by up to half a
// step in x and y. One less high than this, in pixels, may lose its area there, or turn over.
constexpr double kThin = 1.0 / 8;

double number_of(const TomlValue& value) {
    return value.is(TomlValue::Kind::integer) ? static_cast<double>(value.integer) : value.floating;
}

// Whether some vertex of the draw has another w than another one, or all have one that is not 1.
void add_depths(const TomlValue& draw, Essentials& all) {
    const TomlValue* vertices = draw.find("vertices");
    if (vertices == nullptr) {
        return;
    }
    const TomlValue* space = draw.find("space");
    const bool is_clip = space != nullptr && space->string == "clip";
    std::set<double> z, w;
    for (const TomlValue& vertex : vertices->array) {
        const double of_vertex = vertex.array.size() > 3 ? number_of(vertex.array[3]) : 1;
        w.insert(of_vertex);
        z.insert((vertex.array.size() > 2 ? number_of(vertex.array[2]) : 0.5) /
                 (is_clip ? of_vertex : 1));
    }
    if (w.size() > 1) {
        all.insert({Trait::unequal_w});
    }
    if (std::ranges::any_of(w, [](double v) { return v <= 0; })) {
        all.insert({Trait::behind_the_eye});
    }
    if (z.size() > 1) {
        all.insert({Trait::sloping_depth});
    }
    if (vertices->array.size() > 6) {
        all.insert({Trait::several_triangles});
    }
}

// Whether a rectangle reaches further than 15 bits: drivers keep such numbers in 16.
bool is_far(const TomlValue& rectangle) {
    const std::vector<TomlValue>& n = rectangle.array;
    constexpr double kFar = 32767;
    return n.size() == 4 &&
           (std::fabs(number_of(n[0])) > kFar || std::fabs(number_of(n[1])) > kFar ||
            number_of(n[0]) + number_of(n[2]) > kFar || number_of(n[1]) + number_of(n[3]) > kFar);
}

void add_keys(const TomlValue& table, const std::string& path, const cases::KeyTable* keys,
              Essentials& all) {
    for (const cases::TomlEntry& entry : table.table) {
        const TomlValue& value = entry.value;
        const bool is_top = path.empty();
        const std::string name = is_top || path == "target" ? entry.key : path + "." + entry.key;
        const cases::Key* row = cases::find_key(keys, entry.key);
        const cases::KeyTable* inner = cases::keys_in(keys, entry.key);
        if (row != nullptr && row->has(cases::Key::kSilent)) {
            continue;
        }
        if (value.is(TomlValue::Kind::table)) {
            if (entry.key == "color") {
                all.insert({Trait::key, "color"});
            }
            add_keys(value, is_top ? entry.key : name, inner, all);
        } else if (entry.key == "relations") {
            for (const TomlValue& relation : value.array) {
                all.insert({Trait::relation,
                            relation.table.empty() ? relation.string : relation.table.front().key});
            }
        } else if (value.is(TomlValue::Kind::array) && !value.array.empty() &&
                   value.array.front().is(TomlValue::Kind::table)) {
            if (entry.key == "draw" && value.array.size() > 1) {
                all.insert({Trait::several_draws});
            } else if (entry.key != "draw") {
                all.insert(entry.key == "color" ? Essential{Trait::several_colors}
                                                : Essential{Trait::key, name});
            }
            for (const TomlValue& element : value.array) {
                if (entry.key == "draw") {
                    add_depths(element, all);
                }
                add_keys(element, name, inner, all);
            }
        } else if (value.is(TomlValue::Kind::string) &&
                   (row == nullptr || !row->has(cases::Key::kAnyWord))) {
            all.insert({Trait::key, name, value.string});
        } else if (entry.key == "samples" || value.is(TomlValue::Kind::boolean)) {
            all.insert(entry.key == "samples"
                           ? Essential{Trait::several_samples}
                           : Essential{Trait::key, name, value.boolean ? "true" : "false"});
        } else {
            all.insert({Trait::key, name});
            // Numbers do not count, but for these: a scissor is in most cases that have one no need
            // of a cause that needs a far one.
            if ((entry.key == "scissor" || entry.key == "viewport") && is_far(value)) {
                all.insert({Trait::far, name});
            }
        }
    }
}

// The place in pixels, but for where the viewport begins.
std::optional<std::array<double, 2>> place(const cases::Draw& draw, uint32_t vertex) {
    const glm::dvec4 p(draw.positions[vertex]);
    const double x = p.x / p.w * double{draw.viewport.width} / 2;
    const double y = p.y / p.w * double{draw.viewport.height} / 2;
    return std::isfinite(x) && std::isfinite(y) ? std::optional(std::array{x, y}) : std::nullopt;
}

}  // namespace

bool has_thin_triangle(const cases::Case& c) {
    const std::vector<cases::Triangle> all = cases::assemble(c);
    return std::ranges::any_of(all, [&](const cases::Triangle& t) {
        const cases::Draw& draw = c.draws[t.draw];
        const auto p = place(draw, t.vertex[0]), q = place(draw, t.vertex[1]),
                   r = place(draw, t.vertex[2]);
        if (!p || !q || !r) {
            return false;
        }
        const auto longest = std::max({std::hypot((*q)[0] - (*p)[0], (*q)[1] - (*p)[1]),
                                       std::hypot((*r)[0] - (*q)[0], (*r)[1] - (*q)[1]),
                                       std::hypot((*p)[0] - (*r)[0], (*p)[1] - (*r)[1])});
        const double twice_area =
            ((*q)[0] - (*p)[0]) * ((*r)[1] - (*p)[1]) - ((*q)[1] - (*p)[1]) * ((*r)[0] - (*p)[0]);
        return std::abs(twice_area) <= kThin * longest;
    });
}

std::optional<Symptom> symptom_of(const report::CaseRecord& record) {
    if (!is_failure(record.status)) {
        return std::nullopt;
    }
    Symptom symptom;
    symptom.status = record.status;
    symptom.signal = record.death.signal;
    if (record.status != Status::fail) {
        return symptom;
    }
    const auto gravest =
        std::ranges::min_element(record.outcome.groups, [](const auto& a, const auto& b) {
            return std::pair(a.level, b.count) < std::pair(b.level, a.count);
        });
    if (gravest == record.outcome.groups.end()) {
        return std::nullopt;
    }
    symptom.kind = gravest->kind;
    symptom.rule = gravest->rule;
    symptom.level = gravest->level;
    return symptom;
}

bool shows(const report::CaseRecord& record, const Symptom& symptom) {
    if (record.status != symptom.status || record.death.signal != symptom.signal) {
        return false;
    }
    return record.status != Status::fail ||
           std::ranges::any_of(record.outcome.groups, [&](const auto& group) {
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

Essentials essentials(const TomlValue& document) {
    Essentials all;
    add_keys(document, "", &cases::kFileKeys, all);
    return all;
}

}  // namespace fuzz
