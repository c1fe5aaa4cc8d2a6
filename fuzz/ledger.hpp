// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// fuzz.json of a hunt's folder: what was asked, how far it came, and what it found. A hunt that was
// cut off goes on from it, and another one takes what it found for known.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/model/profile.hpp"
#include "fuzz/hunt.hpp"

namespace fuzz {

struct Ledger {
    std::string tool_version, device, driver;
    std::vector<std::string> arguments;  // of the command that began
    // Of the cases that the hunt starts from; empty if it makes its own.
    std::vector<std::string> selectors;
    std::string suite;           // the folder of the suite
    std::string cases_checksum;  // with another one, seed and number mean other cases
    // Of what expectation files said, whose causes are among the entries; empty: of none.
    std::string expectations;
    // Which files those were, as a run takes them: none at all, these, or (empty) the device's own.
    bool no_expect = false;
    std::vector<std::string> expect;
    uint64_t seed = 1;
    uint32_t shard = 1, shards = 1;
    cases::Profile profile = cases::Profile::direct3d;
    double seconds = 0;
    bool is_finished = false;
    HuntCounts counts;
    // With their files' texts, which stand in files of their own. What is not reduced comes last.
    std::vector<Entry> entries;
    std::vector<Waiting> waiting;
    std::vector<uint64_t> left;  // numbers of cases that were made and not judged
};

inline constexpr const char* kLedgerFile = "fuzz.json";
// The folders of its entries' files: what it found, what expectation files explain, and copies of
// what earlier hunts found (--known).
inline constexpr const char* kFound = "found";
inline constexpr const char* kKnown = "known";
inline constexpr const char* kEarlier = "earlier";

// Where an entry is kept that is not reduced, made of the case with this number.
std::string file_of_not_reduced(uint64_t number);

// The JSON of a ledger (docs/schema/fuzz-1.json); the entries' texts are left out.
std::string to_json(const Ledger& ledger);

// Reads FOLDER/fuzz.json and the files of its entries, which have the names that a hunt gives them
// and truly lie in the folder. Errors: what is missing or malformed.
cases::Expected<Ledger> load_ledger(const std::filesystem::path& folder);

// The command that drew it: "edgecase fuzz ties/** --seed 1".
std::string command_of(const Ledger& ledger);
// A found case's file: what was found, by which hunt, what it needs, then the case.
std::string found_text(const Entry& entry, const Ledger& ledger);

}  // namespace fuzz
