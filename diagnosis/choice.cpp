// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/choice.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "diagnosis/work.hpp"

namespace diagnosis {

using report::CaseRecord;

namespace {

std::vector<Choice> in_turns(std::map<std::string, std::vector<Choice>> kinds, size_t most) {
    std::vector<Choice> out;
    for (auto& [kind, list] : kinds) {
        std::ranges::sort(list, [](const Choice& a, const Choice& b) {
            return std::tie(a.cost, a.record->id) < std::tie(b.cost, b.record->id);
        });
    }
    for (size_t turn = 0; out.size() < most; ++turn) {
        const size_t before = out.size();
        std::vector<Choice> of_turn;
        for (const auto& [kind, list] : kinds) {
            if (turn < list.size()) {
                of_turn.push_back(list[turn]);
            }
        }
        std::ranges::stable_sort(of_turn, {}, &Choice::cost);
        out.insert(out.end(), of_turn.begin(), of_turn.end());
        if (out.size() == before) {
            break;
        }
    }
    out.resize(std::min(out.size(), most));
    return out;
}

}  // namespace

std::vector<Choice> by_turn(const report::Run& run, const CaseOf& case_of, const Takes& takes,
                            const KindOf& kind, size_t most) {
    std::map<std::string, std::vector<Choice>> kinds;
    for (const CaseRecord& record : run.cases) {
        const cases::Case* c = nullptr;
        if ((record.status == report::Status::fail || record.status == report::Status::pass) &&
            (c = case_of(record.id)) != nullptr && cost_of(*c) <= kMaxCost && takes(*c, record)) {
            kinds[kind(record)].push_back({&record, c, cost_of(*c)});
        }
    }
    return in_turns(std::move(kinds), most);
}

std::string family_of(const std::string& id) {
    return id.substr(0, id.find('/'));
}

std::string family_of(const CaseRecord& record) {
    return family_of(record.id);
}

std::string first_rule(const CaseRecord& record) {
    return record.outcome.groups.empty() ? "" : record.outcome.groups.front().rule;
}

std::string family_and_rule(const CaseRecord& record) {
    return family_of(record) + ' ' + first_rule(record);
}

std::string file_of(const CaseRecord& record) {
    return record.id.substr(0, record.id.find(':'));
}

}  // namespace diagnosis
