// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string_view>

#include "cases/base/input_file.hpp"
#include "cases/load/parts.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/rule_ids.hpp"
#include "cases/toml/toml_reader.hpp"
#include "cli/options/stop.hpp"
#include "cli/prepare/on_threads.hpp"

namespace cli {

namespace {

// What a rule asks for beside what its samples are, where a file may seem to have it.
std::string_view condition_of(const std::string& rule) {
    return rule == cases::rule::depth_repeat
               ? "; both draws must have the same state, the depth test included"
               : "";
}

}  // namespace

cases::SourceLocation rule_place(const cases::Case& c, std::string_view rule) {
    const std::string text = cases::read_file(c.claim.where.file).value_or("");
    const auto document = cases::read_toml(text, c.claim.where.file);
    const cases::TomlValue* const rules = document ? document->find("rules") : nullptr;
    if (rules != nullptr) {
        for (const cases::TomlValue& element : rules->array) {
            if (element.string == rule) {
                return element.where;
            }
        }
    }
    return c.claim.where;
}

std::vector<std::string> ClaimedFile::open_rules() const {
    std::vector<std::string> out;
    for (size_t k = 0; k < exercised.size(); ++k) {
        if (!exercised[k]) {
            out.push_back(first->claim.rules[k]);
        }
    }
    return out;
}

bool ClaimedFile::has(std::string_view rule) const {
    const auto at = std::ranges::find(first->claim.rules, rule);
    return at != first->claim.rules.end() &&
           exercised[static_cast<size_t>(at - first->claim.rules.begin())];
}

void ClaimedFile::note(const ref::Exercise& found) {
    for (const ref::RuleShare& share : found.rules) {
        for (size_t k = 0; k < exercised.size(); ++k) {
            if (share.samples > 0 && share.rule == first->claim.rules[k]) {
                exercised[k] = true;
            }
        }
    }
    for (size_t d = 0; d < std::min(draws.size(), found.draws.size()); ++d) {
        ref::Sight best = draws[d];
        while (best < found.draws[d] && !draws[d].compare_exchange_weak(best, found.draws[d])) {
        }
    }
}

std::map<std::string, ClaimedFile> claimed_files(const std::vector<cases::Case>& all,
                                                 const std::vector<size_t>& chosen,
                                                 const std::set<std::string>& parts) {
    std::map<std::string, ClaimedFile> files;
    for (const size_t k : chosen) {
        files.try_emplace(all[k].claim.where.file, all[k]).first->second.cases.push_back(k);
    }
    std::map<std::string, size_t> counts;
    for (const cases::Case& c : all) {
        ++counts[c.claim.where.file];
    }
    for (auto& [name, file] : files) {
        file.is_whole = file.cases.size() == counts[name] && !parts.contains(name);
    }
    return files;
}

void warn_of_left_over(const std::vector<cases::Case>& all, const std::vector<size_t>& chosen) {
    std::set<std::string> told;
    for (const size_t k : chosen) {
        for (const std::string& note : all[k].claim.notes) {
            const std::string text = "warning: " + all[k].claim.where.file + ": " + note;
            if (note.find(cases::kLeftOver) != note.npos && told.insert(text).second) {
                complain(text);
            }
        }
    }
}

namespace {

// Rules that are broken elsewhere than by what a draw leaves: a draw may be there to be harmless.
constexpr std::string_view kOfUnseenDraws[] = {
    cases::rule::number_undefined, cases::rule::write_outside,
    cases::rule::depth_repeat,  // a pass for the depth alone, before the one that is seen
};

void check_draws(const ClaimedFile& file, cases::Errors& errors) {
    if (std::ranges::any_of(kOfUnseenDraws, [&](std::string_view rule) {
            return std::ranges::count(file.first->claim.rules, rule) > 0;
        })) {
        return;
    }
    for (size_t d = 0; d < file.draws.size(); ++d) {
        if (file.draws[d] == ref::Sight::nothing) {
            errors.push_back(
                {file.first->draws[d].where,
                 fmt::format(
                     "nothing of draw {} can be seen: with it, without it and with it twice "
                     "the attachments hold the same; choose another colour or another "
                     "clear colour, or take the draw away",
                     d)});
        }
    }
}

}  // namespace

cases::Errors check_claims(const std::vector<cases::Case>& all,
                           std::map<std::string, ClaimedFile>& files) {
    std::vector<ClaimedFile*> open;
    for (auto& [name, file] : files) {
        if (file.is_whole && !file.open_rules().empty()) {
            open.push_back(&file);
        }
    }
    for_each_on_threads(open.size(), [&](size_t k) {
        for (const size_t c : open[k]->cases) {
            try {
                open[k]->note(ref::exercise(all[c], ref::Limits{kFewestSubpixelBits},
                                            open[k]->open_rules(), ref::Count::some));
            } catch (const std::exception&) {
                return;  // told of the case with the usual bits
            }
        }
    });
    cases::Errors errors;
    for (const auto& [name, file] : files) {
        if (file.is_whole) {
            check_draws(file, errors);
        }
    }
    for (const ClaimedFile* file : open) {
        for (const std::string& rule : file->open_rules()) {
            if (cases::find_rule(rule) == nullptr) {
                continue;  // an error of its own
            }
            errors.push_back(
                {rule_place(*file->first, rule),
                 fmt::format("no sample exercises the rule {}, which takes a sample {}; "
                             "take the rule away or change the case{}",
                             rule, ref::exercise_of(rule), condition_of(rule))});
        }
    }
    return errors;
}

}  // namespace cli
