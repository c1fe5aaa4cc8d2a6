// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What two failures have in common if they have one cause: what is wrong, and what of the case is
// needed for it.
#pragma once

#include <optional>
#include <string>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/toml/toml_reader.hpp"
#include "diff/verdict.hpp"
#include "fuzz/essential.hpp"
#include "report/record/run.hpp"

namespace fuzz {

// What is wrong with a case: its gravest finding, or how its worker died.
struct Symptom {
    report::Status status = report::Status::fail;
    diff::FindingKind kind = diff::FindingKind::missing;  // of a fail
    std::string rule;                                     // of a fail
    cases::Profile level = cases::Profile::vulkan;        // of a fail
    std::string signal;                                   // of a crash
    friend bool operator==(const Symptom&, const Symptom&) = default;
    friend auto operator<=>(const Symptom&, const Symptom&) = default;
};
// Nothing of a case that does not fail. Of its findings the one that breaks the loosest profile
// counts, of these the commonest: in what fails that way are the fewest accidents.
std::optional<Symptom> symptom_of(const report::CaseRecord& record);
// Whether a record shows a symptom, among others perhaps.
bool shows(const report::CaseRecord& record, const Symptom& symptom);
// "extra of scissor.half-open [vulkan]", "crash by SIGSEGV".
std::string to_text(const Symptom& symptom);
// The symptom of such a text; nothing if it is none.
std::optional<Symptom> parse_symptom(const std::string& text);

// What a case has that a plain one has not. Numbers do not count, nor what a format is called, but
// for rectangles that reach beyond 15 bits.
Essentials essentials(const cases::TomlValue& document);
// Whether some triangle is so thin that it may have no area on a device's grid.
bool has_thin_triangle(const cases::Case& c);

}  // namespace fuzz
