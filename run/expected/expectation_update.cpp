// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/expectation_update.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "cases/select/selector.hpp"
#include "report/text/sentences.hpp"
#include "run/expected/glob_cover.hpp"

namespace run {

using report::CaseRecord;
using report::Status;

namespace {

std::vector<std::string> split_lines(std::string_view text) {
    std::vector<std::string> lines;
    size_t begin = 0;
    while (begin < text.size()) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        lines.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

// Whether a run says anything about a case.
bool is_judged(Status actual) {
    return actual == Status::pass || (actual >= Status::flake && actual <= Status::crash);
}

// Where the k-th word of a line begins and ends.
std::pair<size_t, size_t> word_at(const std::string& line, size_t k) {
    size_t begin = 0, end = 0;
    for (size_t n = 0; n <= k; ++n) {
        begin = line.find_first_not_of(" \t", end);
        end = std::min(line.find_first_of(" \t\r", begin), line.size());
    }
    return {begin, end};
}

std::string with_word(const std::string& line, size_t k, const std::string& word) {
    const auto [begin, end] = word_at(line, k);
    return line.substr(0, begin) + word + line.substr(end);
}

// A line whose words between the bug and the reason are replaced.
std::string with_words_after_bug(const std::string& line, const std::string& words) {
    return line.substr(0, word_at(line, 2).second) + (words.empty() ? "" : "   " + words) + "   " +
           line.substr(line.find('#', line.find(" #")));
}

// The words of a line between the bug and the reason.
std::string words_of(const ExpectedCause& cause, const std::string& until) {
    const std::string text = to_text(cause);
    return text + (text.empty() || until.empty() ? "" : "   ") +
           (until.empty() ? "" : "until=" + until);
}

std::string new_line(const std::string& id, Status status, const std::string& bug,
                     const ExpectedCause& cause, const std::string& until,
                     const std::string& reason) {
    const std::string words = words_of(cause, until);
    return id + "   " + std::string(report::to_string(status)) + "   " + (bug.empty() ? "-" : bug) +
           (words.empty() ? "" : "   " + words) + "   # " + reason;
}

// What a line has to say of a case.
struct Wanted {
    std::string id;
    Status status = Status::fail;
    ExpectedCause cause;
};

// Cases that one line can speak of: they end alike, and crash alike; none with a line each.
using Alike = std::tuple<Status, std::string, std::string, std::string>;
Alike alike_of(const Wanted& wanted, bool a_line_each) {
    return {wanted.status, wanted.cause.signal, wanted.cause.step, a_line_each ? wanted.id : ""};
}

// The cause of all of them that a glob matches.
ExpectedCause cause_of_all(const std::vector<Wanted>& all, const std::string& glob) {
    ExpectedCause cause;
    for (const Wanted& wanted : all) {
        if (cases::glob_matches(glob, wanted.id)) {
            widen(cause, wanted.cause);
        }
    }
    return cause;
}

std::vector<std::string> ids_of(const std::vector<Wanted>& all) {
    std::vector<std::string> ids;
    for (const Wanted& wanted : all) {
        ids.push_back(wanted.id);
    }
    return ids;
}

// What the run says of a case, for a line that nobody has explained yet.
std::string reason_of(const CaseRecord& record) {
    if (record.outcome.findings.empty()) {
        return report::one_line(report::why_it_happened(record));
    }
    const diff::Finding& f = report::leading_finding(record);
    return report::one_line(report::counts_text(record) + ", " + f.rule + " [" +
                            std::string(cases::to_string(f.level)) + "].");
}

class Updater {
  public:
    Updater(const ExpectationFile& file, const report::Run& run,
            const std::vector<std::string>& ids, const UpdateWords& words)
        : file_(file), run_(run), ids_(ids), words_(words) {
        for (const CaseRecord& record : run.cases) {
            records_.emplace(record.id, &record);
        }
    }

    Update update(std::string_view text) {
        lines_ = split_lines(text);
        std::map<size_t, const ExpectationLine*> by_line;
        for (const ExpectationLine& line : file_.lines) {
            by_line.emplace(line.where.line - 1, &line);
        }
        for (size_t k = 0; k < lines_.size(); ++k) {
            if (const auto found = by_line.find(k); found != by_line.end()) {
                update_line(*found->second, lines_[k]);
            } else {
                keep(lines_[k]);
            }
        }
        add_new_lines();
        if (file_.is_older) {
            change_format();
        }
        return std::move(result_);
    }

  private:
    void keep(const std::string& raw) { result_.text += raw + '\n'; }
    void remove(const std::string& raw) { result_.changes.push_back("- " + raw); }
    void add(const std::string& raw) {
        result_.changes.push_back("+ " + raw);
        keep(raw);
    }

    // What a line about the case should say now: nothing if it is not needed any more.
    std::optional<Wanted> wanted(const ExpectationLine& line, const CaseRecord& record) const {
        const Status actual = report::actual_status(record);
        if (actual == Status::pass) {  // a flake passes now and then
            return line.status == Status::flake
                       ? std::optional(Wanted{record.id, line.status, line.cause})
                       : std::nullopt;
        }
        const bool is_as_known =
            actual == line.status || (line.status == Status::flake && actual == Status::fail &&
                                      what_is_new(line.cause, record).empty());
        Wanted wanted{record.id, is_as_known ? line.status : actual, {}};
        if (is_as_known) {
            wanted.cause = line.cause;
        }
        const bool with_bits = words_.bits || !wanted.cause.bits.empty();
        if (words_.bits && is_as_known && wanted.cause.bits.empty()) {
            wanted.cause.bits = cause_of(record, true).bits;
        }
        if (wanted.cause.is_empty() || !what_is_new(wanted.cause, record).empty()) {
            widen(wanted.cause, cause_of(record, with_bits));
            if (actual == Status::crash && wanted.cause.signal.empty() &&
                wanted.cause.step.empty()) {
                wanted.cause = cause_of(record, with_bits);
            }
        }
        return wanted;
    }

    void update_line(const ExpectationLine& line, const std::string& raw) {
        std::map<Alike, std::vector<Wanted>> wanted_of;
        size_t matched = 0, judged = 0, passed = 0;
        for (const std::string& id : ids_) {
            if (!cases::glob_matches(line.glob, id)) {
                continue;
            }
            ++matched;
            covered_.insert(id);
            const auto record = records_.find(id);
            // Of what was not drawn, the line is believed.
            std::optional<Wanted> now = Wanted{id, line.status, line.cause};
            if (record != records_.end() && is_judged(report::actual_status(*record->second))) {
                ++judged;
                now = wanted(line, *record->second);
            }
            if (now) {
                wanted_of[alike_of(*now, words_.bits)].push_back(*now);
            } else {
                ++passed;
            }
        }
        if (matched == 0) {
            result_.notes.push_back("'" + line.glob + "' matches no case of the suite");
        }
        if (judged == 0) {
            keep_line(line, raw, false);
        } else if (wanted_of.empty()) {
            remove(raw);
            ++result_.removed;
        } else if (wanted_of.size() == 1 && passed == 0) {
            const std::vector<Wanted>& all = wanted_of.begin()->second;
            const Wanted now{line.glob, all.front().status, cause_of_all(all, line.glob)};
            if (now.status == line.status && now.cause == line.cause) {
                keep_line(line, raw, true);
            } else {
                ++result_.changed;
                change(line, raw, now);
            }
        } else {
            ++result_.changed;
            remove(raw);
            for (const auto& [alike, all] : wanted_of) {
                for (const std::string& glob : cover_by_globs(ids_of(all), ids_)) {
                    check_bug(line, glob);
                    add(new_line(glob, all.front().status, bug_of(line), cause_of_all(all, glob),
                                 line.until, line.note));
                }
            }
        }
    }

    std::string bug_of(const ExpectationLine& line) const {
        return line.bug.empty() ? words_.bug : line.bug;
    }
    void check_bug(const ExpectationLine& line, const std::string& id) {
        if (bug_of(line).empty()) {  // it was a skip
            result_.without_bug.push_back(id);
        }
    }

    void change(const ExpectationLine& line, const std::string& raw, const Wanted& now) {
        check_bug(line, line.glob);
        remove(raw);
        std::string changed = with_word(raw, 1, std::string(report::to_string(now.status)));
        if (line.bug.empty() && !words_.bug.empty()) {
            changed = with_word(changed, 2, words_.bug);
        }
        add(with_words_after_bug(changed, words_of(now.cause, line.until)));
    }

    // A file of format 1 is one of format 2 once all its lines name causes.
    void change_format() {
        const auto again = parse_expectations(result_.text, file_.path, "", true);
        const bool is_whole =
            again && std::all_of(again->lines.begin(), again->lines.end(), [](const auto& line) {
                return !line.cause.is_empty() ||
                       (line.status != Status::fail && line.status != Status::crash);
            });
        if (!is_whole) {
            result_.notes.emplace_back(
                "the file stays of format 1, which a run refuses: this run did not draw all of its "
                "cases, so some lines name no cause");
            return;
        }
        const size_t end = result_.text.find('\n');
        remove(result_.text.substr(0, end));
        result_.changes.push_back("+ " + std::string(kExpectationsFirstLine));
        result_.text = std::string(kExpectationsFirstLine) + result_.text.substr(end);
    }

    void keep_line(const ExpectationLine& line, const std::string& raw, bool still_true) {
        ++result_.kept;
        if (!line.is_past) {
            keep(raw);
            return;
        }
        if (!words_.until.empty() && still_true) {
            --result_.kept;
            ++result_.changed;
            remove(raw);
            add(with_words_after_bug(raw, words_of(line.cause, words_.until)));
            return;
        }
        keep(raw);
        result_.notes.push_back(
            "the expectation of '" + line.glob + "' ended on " + line.until +
            (still_true
                 ? " and is still needed; look at it again and give --until DATE to extend it"
                 : " and the run did not draw its cases; look at it again"));
    }

    void add_new_lines() {
        // Failures that break the same rules in the same way, in the order of the first.
        std::map<std::pair<Alike, std::set<std::string>>, size_t> index;
        std::vector<std::vector<Wanted>> all_new;
        for (const CaseRecord& record : run_.cases) {
            const Status status = record.status;
            const bool bad = status >= Status::flake && status <= Status::crash;
            const bool better = status == Status::xpass || status == Status::improved;
            if ((!bad && !better) || covered_.contains(record.id)) {
                continue;
            }
            if (record.known.expected && !record.known.place.empty()) {
                result_.notes.push_back("'" + record.id + "' is spoken of by " +
                                        record.known.place + "; update that file");
                continue;
            }
            if (better) {
                continue;
            }
            if (words_.bug.empty()) {
                result_.without_bug.push_back(record.id);
                continue;
            }
            // What the device must support and does not is excused by not drawing it.
            const bool drawn = report::actual_status(record) != Status::unsupported;
            Wanted now{record.id, drawn ? status : Status::skip,
                       drawn ? cause_of(record, words_.bits) : ExpectedCause()};
            std::set<std::string> rules;
            for (const diff::FindingGroup& group : now.cause.groups) {
                rules.insert(std::string(diff::to_string(group.kind)) + ' ' + group.rule);
            }
            const auto [at, fresh] = index.emplace(
                std::pair(alike_of(now, words_.bits), std::move(rules)), all_new.size());
            if (fresh) {
                all_new.emplace_back();
            }
            all_new[at->second].push_back(std::move(now));
        }
        for (const std::vector<Wanted>& alike : all_new) {
            for (const std::string& glob : cover_by_globs(ids_of(alike), ids_)) {
                const auto first = std::find_if(alike.begin(), alike.end(), [&](const Wanted& w) {
                    return cases::glob_matches(glob, w.id);
                });
                ++result_.added;
                add(new_line(
                    glob, first->status, words_.bug, cause_of_all(alike, glob), words_.until,
                    words_.reason.empty() ? reason_of(*records_.at(first->id)) : words_.reason));
            }
        }
    }

    const ExpectationFile& file_;
    const report::Run& run_;
    const std::vector<std::string>& ids_;
    const UpdateWords& words_;
    std::map<std::string, const CaseRecord*> records_;
    std::vector<std::string> lines_;
    std::set<std::string> covered_;  // ids that a line speaks of
    Update result_;
};

// A device's name with a backslash before each of the signs that a glob or a regular expression
// reads, so that it matches only itself.
std::string escaped(const std::string& name, std::string_view signs) {
    std::string text;
    for (const char c : name) {
        if (signs.find(c) != std::string_view::npos) {
            text += '\\';
        }
        text += c;
    }
    return text;
}

}  // namespace

Update update_expectations(std::string_view text, const ExpectationFile& file,
                           const report::Run& run, const std::vector<std::string>& ids,
                           const UpdateWords& words) {
    return Updater(file, run, ids, words).update(text);
}

std::string new_expectation_file(const report::Run& run) {
    const capture::DeviceInfo& d = run.device;
    std::string text = std::string(kExpectationsFirstLine) +
                       "\n# device: " + escaped(report::one_line(d.name), "*?[]\\");
    if (!d.driver_name.empty()) {
        text += "   driver: " + escaped(report::one_line(d.driver_name), ".*+?^$()[]{}|\\");
        const std::string driver = d.driver_name + " " + d.driver_info;
        const std::vector<uint32_t> version = find_version(driver, d.driver_name.size());
        for (size_t k = 0; k < std::min<size_t>(version.size(), 2); ++k) {
            text += (k == 0 ? " =" : ".") + std::to_string(version[k]);
        }
    }
    return text + "   profile: " + std::string(cases::to_string(run.profile)) + "\n";
}

}  // namespace run
