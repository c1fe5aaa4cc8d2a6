// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/expectation_update.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "cases/base/printable.hpp"
#include "cases/model/selector.hpp"
#include "report/text/sentences.hpp"

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

std::string one_line(const std::string& text) {
    std::string line = cases::printable(text);
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::replace(line.begin(), line.end(), '\t', ' ');
    return line;
}

std::string new_line(const std::string& id, Status status, const std::string& bug,
                     const std::string& until, const std::string& reason) {
    return id + "   " + std::string(report::to_string(status)) + "   " + (bug.empty() ? "-" : bug) +
           (until.empty() ? "" : "   until=" + until) + "   # " + reason;
}

// What the run says of a case, for a line that nobody has explained yet.
std::string reason_of(const CaseRecord& record) {
    if (record.findings.empty()) {
        return one_line(report::why_it_happened(record));
    }
    const diff::Finding& f = report::leading_finding(record);
    return one_line(report::counts_text(record) + ", " + f.rule + " [" +
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
    static std::optional<Status> wanted(const ExpectationLine& line, Status actual) {
        if (line.status == Status::flake && actual == Status::pass) {
            return Status::flake;  // a flake passes now and then
        }
        return actual == Status::pass ? std::nullopt : std::optional(actual);
    }

    void update_line(const ExpectationLine& line, const std::string& raw) {
        std::vector<std::pair<std::string, std::optional<Status>>> cases;  // what is wanted of each
        std::set<std::optional<Status>> seen;
        for (const std::string& id : ids_) {
            if (!cases::glob_matches(line.glob, id)) {
                continue;
            }
            covered_.insert(id);
            const auto record = records_.find(id);
            const bool judged =
                record != records_.end() && is_judged(report::actual_status(*record->second));
            cases.emplace_back(id, line.status);  // not drawn: as the line says
            if (judged) {
                cases.back().second = wanted(line, report::actual_status(*record->second));
                seen.insert(cases.back().second);
            }
        }
        std::set<std::optional<Status>> all;
        for (const auto& [id, status] : cases) {
            all.insert(status);
        }
        if (cases.empty()) {
            result_.notes.push_back("'" + line.glob + "' matches no case of the suite");
        }
        if (seen.empty() || (all.size() == 1 && *all.begin() == line.status)) {
            keep_line(line, raw, !seen.empty());
        } else if (all.size() == 1 && !*all.begin()) {
            remove(raw);
            ++result_.removed;
        } else if (all.size() == 1) {
            ++result_.changed;
            change(line, raw, **all.begin());
        } else {
            ++result_.changed;
            remove(raw);
            for (const auto& [id, status] : cases) {
                if (status) {
                    check_bug(line, id);
                    add(new_line(id, *status, bug_of(line), line.until, line.note));
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

    void change(const ExpectationLine& line, const std::string& raw, Status status) {
        check_bug(line, line.glob);
        remove(raw);
        std::string changed = with_word(raw, 1, std::string(report::to_string(status)));
        if (line.bug.empty() && !words_.bug.empty()) {
            changed = with_word(changed, 2, words_.bug);
        }
        add(changed);
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
            add(with_word(raw, 3, "until=" + words_.until));
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
        for (const CaseRecord& record : run_.cases) {
            const Status status = record.status;
            const bool bad = status >= Status::flake && status <= Status::crash;
            const bool better = status == Status::xpass || status == Status::improved;
            if ((!bad && !better) || covered_.contains(record.id)) {
                continue;
            }
            if (record.expected && !record.expectation.empty()) {
                result_.notes.push_back("'" + record.id + "' is spoken of by " +
                                        record.expectation + "; update that file");
                continue;
            }
            if (better) {
                continue;
            }
            if (words_.bug.empty()) {
                result_.without_bug.push_back(record.id);
                continue;
            }
            ++result_.added;
            add(new_line(record.id, status, words_.bug, words_.until,
                         words_.reason.empty() ? reason_of(record) : words_.reason));
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
    const report::Device& d = run.device;
    std::string text =
        "# edgecase-expectations 1\n# device: " + escaped(one_line(d.name), "*?[]\\");
    if (!d.driver_name.empty()) {
        text += "   driver: " + escaped(one_line(d.driver_name), ".*+?^$()[]{}|\\");
        const std::string driver = d.driver_name + " " + d.driver_info;
        const std::vector<uint32_t> version = find_version(driver, d.driver_name.size());
        for (size_t k = 0; k < std::min<size_t>(version.size(), 2); ++k) {
            text += (k == 0 ? " =" : ".") + std::to_string(version[k]);
        }
    }
    return text + "   profile: " + std::string(cases::to_string(run.profile)) + "\n";
}

}  // namespace run
