// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/lead.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "report/text/causes.hpp"

namespace mutants {

std::string top_rule(const std::vector<Kill>& kills) {
    report::Run run;
    for (const Kill& kill : kills) {
        for (const LeadCount& part : kill.leads) {
            report::CaseRecord record;
            record.id = kill.leaf;
            record.status = report::Status::fail;
            record.outcome.level = part.lead.level;
            diff::Finding finding;
            finding.kind = part.lead.kind;
            finding.rule = part.lead.rule;
            finding.level = part.lead.level;
            record.outcome.findings = {finding};
            run.cases.insert(run.cases.end(), part.files, record);
        }
    }
    const std::vector<report::Cause> causes = report::causes(run);
    return causes.empty() ? "" : causes.front().rule;
}

bool is_broken(const FaultRow& info, std::string_view rule) {
    std::istringstream rules{std::string(info.rules)};
    return std::find(std::istream_iterator<std::string>(rules), {}, rule) !=
           std::istream_iterator<std::string>();
}

}  // namespace mutants
