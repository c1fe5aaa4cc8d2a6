// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which cases of a run are looked at.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "diagnosis/diagnose.hpp"
#include "report/record/run.hpp"

namespace diagnosis {

// Of one case: samples and vertices; those that cost more are not looked at.
inline constexpr uint64_t kMaxCost = 1U << 14U;

struct Choice {
    const report::CaseRecord* record = nullptr;
    const cases::Case* data = nullptr;
    uint64_t cost = 0;
};

// Of cases that passed or failed and are taken: the cheapest of each kind, then the second of each,
// and so on, at most so many.
using Takes = std::function<bool(const cases::Case&, const report::CaseRecord&)>;
using KindOf = std::function<std::string(const report::CaseRecord&)>;
std::vector<Choice> by_turn(const report::Run& run, const CaseOf& case_of, const Takes& takes,
                            const KindOf& kind, size_t most);

// The first part of a case's id.
std::string family_of(const std::string& id);
// Kinds; the second is the first rule that a case breaks, the third the family and that rule.
std::string family_of(const report::CaseRecord& record);
std::string first_rule(const report::CaseRecord& record);
std::string family_and_rule(const report::CaseRecord& record);
std::string file_of(const report::CaseRecord& record);

}  // namespace diagnosis
