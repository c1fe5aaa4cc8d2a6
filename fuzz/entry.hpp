// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One cause of a hunt, with the smallest case that shows it, and which failures it explains.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cases/model/case.hpp"
#include "fuzz/cause.hpp"
#include "fuzz/generate/source.hpp"
#include "run/session.hpp"

namespace fuzz {

// What a case has that decides whether it may fail by the cause of an entry.
struct Facts {
    Essentials essentials;
    std::optional<cases::ColorFormat> format;  // of the colours that are judged
    bool has_varying_attribute = true;         // false: its only one is a constant
};
// The facts of a case file's text; none if it is no TOML.
Facts facts_of(const std::string& text);

// One cause: the smallest case that shows it, and how often it was met.
struct Entry {
    Symptom symptom;
    // Of the failing case, what it needs to fail in any like way: by another rule, without what
    // only a suite wants of it.
    Essentials essentials;
    // What else the reduced case breaks: in a case with the same essentials that is no news.
    std::set<std::pair<diff::FindingKind, std::string>> also;
    std::string text;  // of the reduced case
    Facts facts;       // of the text
    // Of the colours of cases with this cause, besides the reduced one's.
    std::set<cases::ColorFormat> other_formats;
    bool needs_format = false;         // the text with the plain format does not show it
    bool overflows = false;            // diff::Finding::overflows of what was seen
    std::vector<std::string> needs;    // "not with 1 sample": simpler cases that do not show it
    std::vector<std::string> undrawn;  // "with 2 samples": simpler ones that the device cannot draw
    std::vector<std::string> passes;   // "with 2 samples in place of 4": other ones that pass
    std::optional<Symptom> shown_first;  // what a run of the text leads with, if not the symptom
    std::string seen;        // "pixel (1, 0), sample 0: color: expected r 3, got r 2; why"
    bool is_reduced = true;  // false: the text is as it was drawn, and explains no other
    bool is_minimal = false;
    bool is_known = false;    // from an earlier hunt, or from expectation files
    std::string bug;          // what an expectation file refers to
    std::string file;         // where it is kept; filled in by whoever keeps it
    std::string stale_file;   // where a case was kept that a graver one has replaced since
    uint64_t first_case = 0;  // the number of the case it was reduced from
    uint64_t count = 0;       // failing cases that it explains
    // Takes another text, with its facts.
    void set_text(std::string other);
};

// Makes a case file of one leaf as small as it can be while it shows a symptom. Nothing if it does
// not show it, or is no case. Where `is_over` is true, from some time on, it ends with a case that
// shows the symptom, and says nothing else of it.
std::optional<Entry> reduce_case(const std::string& text, const Symptom& symptom,
                                 const run::DrawAndJudge& draw, size_t most_rounds,
                                 const std::function<bool()>& is_over = {});

// The comment lines that say what an entry needs and what passes.
std::string need_text(const Entry& entry);

// A case's text with a description of what it shows and a rule that it exercises, if there is one.
std::string described(const std::string& text, const Symptom& symptom);

// All that a record shows, each in the gravest way, the gravest first.
std::vector<Symptom> symptoms_of(const report::CaseRecord& record);

}  // namespace fuzz
