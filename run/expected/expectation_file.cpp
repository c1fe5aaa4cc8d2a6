// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/expectation_file.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "cases/base/input_file.hpp"
#include "cases/base/printable.hpp"
#include "cases/base/regex.hpp"
#include "cases/model/door.hpp"
#include "cases/model/way.hpp"
#include "cases/select/selector.hpp"
#include "run/expected/date.hpp"

namespace run {

using cases::Errors;
using report::Status;

namespace {

constexpr std::string_view kOlderFirstLine = "# edgecase-expectations 1";
constexpr std::array kStatuses = {Status::fail,        Status::crash, Status::timeout,
                                  Status::device_lost, Status::flake, Status::skip};

std::string_view trim(std::string_view s) {
    const size_t begin = s.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) {
        return {};
    }
    return s.substr(begin, s.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> split_words(std::string_view s) {
    std::istringstream in{std::string(s)};
    std::vector<std::string> words;
    for (std::string word; in >> word;) {
        words.push_back(word);
    }
    return words;
}

std::optional<VersionBound> parse_bound(std::string_view word) {
    using Relation = VersionBound::Relation;
    constexpr std::array<std::pair<std::string_view, Relation>, 5> kRelations = {{
        {">=", Relation::at_least},
        {"<=", Relation::at_most},
        {">", Relation::above},
        {"<", Relation::below},
        {"=", Relation::equal},
    }};
    for (const auto& [sign, relation] : kRelations) {
        if (word.starts_with(sign)) {
            const std::string_view rest = word.substr(sign.size());
            if (rest.empty() || rest.find_first_not_of("0123456789.") != std::string_view::npos) {
                return std::nullopt;
            }
            VersionBound bound{relation, find_version(rest, 0), std::string(word)};
            return bound.version.empty() ? std::nullopt : std::optional(std::move(bound));
        }
    }
    return std::nullopt;
}

constexpr std::string_view kDoor = "door=";

class Parser {
  public:
    Parser(const std::filesystem::path& path, std::string today, bool for_update)
        : today_(std::move(today)), for_update_(for_update) {
        file_.path = path;
    }

    cases::ExpectedAll<ExpectationFile> parse(std::string_view text) {
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of some editors
        size_t begin = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
        while (begin < text.size()) {
            const size_t end = std::min(text.find('\n', begin), text.size());
            ++line_;
            parse_line(trim(text.substr(begin, end - begin)));
            if (line_ == 1 && !errors_.empty()) {
                return tl::unexpected(errors_);  // something else: its lines would tell nothing
            }
            begin = end + 1;
        }
        if (line_ == 0) {
            line_ = 1;
            fail("the file is empty; its first line must be '" +
                 std::string(kExpectationsFirstLine) + "'");
        } else if (!has_device_) {
            line_ = 1;
            fail(
                "no line says which device is meant; add '# device: NAME-GLOB  driver: REGEX "
                "VERSIONS'");
        }
        if (!errors_.empty()) {
            return tl::unexpected(errors_);
        }
        return std::move(file_);
    }

  private:
    void fail(std::string message) {
        errors_.push_back({{file_.path.string(), line_, 1}, cases::printable(message)});
    }

    void parse_line(std::string_view line) {
        if (line.find('\0') != std::string_view::npos) {
            fail("the line holds a zero byte, which no text has");
        } else if (line_ == 1) {
            file_.is_older = line == kOlderFirstLine;
            if (file_.is_older && !for_update_) {
                fail(
                    "the file is of format 1, whose lines name no cause; bring it to format 2 with "
                    "'edgecase expect --update RUN " +
                    file_.path.string() + "'");
            } else if (line != kExpectationsFirstLine && !file_.is_older) {
                fail("the first line must be '" + std::string(kExpectationsFirstLine) + "'");
            }
        } else if (line.empty()) {
            return;
        } else if (line.front() == '#') {
            const std::string_view comment = trim(line.substr(1));
            for (const std::string_view key : {"device:", "driver:", "profile:"}) {
                if (comment.starts_with(key)) {
                    parse_header(comment);
                    return;
                }
            }
        } else {
            parse_expectation(line);
        }
    }

    void parse_header(std::string_view header) {
        constexpr std::array<std::string_view, 3> kKeys = {"device:", "driver:", "profile:"};
        if (!file_.lines.empty() || !file_.doors.empty()) {
            fail("a header line must stand above the first expectation");
            return;
        }
        while (!header.empty()) {
            const auto key = std::find_if(kKeys.begin(), kKeys.end(), [&](std::string_view k) {
                return header.starts_with(k);
            });
            header.remove_prefix(
                key->size());  // found: the caller and the search below look for keys
            size_t end = header.size();
            for (const std::string_view other : kKeys) {
                end = std::min(end, header.find(other));
            }
            set_header(*key, trim(header.substr(0, end)));
            header.remove_prefix(end);
        }
    }

    void set_header(std::string_view key, std::string_view value) {
        if (value.empty()) {
            fail("'" + std::string(key) + "' has no value");
        } else if (key == "device:") {
            if (std::exchange(has_device_, true)) {
                fail("a second 'device:' header; one file speaks of one device");
            }
            file_.device_glob = value;
        } else if (key == "driver:") {
            for (const std::string& word : split_words(value)) {
                if (std::string_view("<>=").find(word.front()) != std::string_view::npos) {
                    if (std::optional<VersionBound> bound = parse_bound(word); bound) {
                        file_.versions.push_back(std::move(*bound));
                    } else {
                        fail("'" + word +
                             "' is no version bound; write one like '>=22.3' or '<23'");
                    }
                } else {
                    file_.driver_regex += (file_.driver_regex.empty() ? "" : " ") + word;
                }
            }
            if (auto checked = cases::check_regex(file_.driver_regex); !checked) {
                fail(checked.error().message);
            }
        } else {
            for (const std::string& word : split_words(value)) {
                if (const auto profile = cases::parse_profile(word); profile) {
                    file_.profiles.push_back(*profile);
                } else {
                    fail("'" + word + "' is no profile; write vulkan, practice or direct3d");
                }
            }
        }
    }

    void parse_expectation(std::string_view line) {
        ExpectationLine entry;
        entry.where = {file_.path.string(), line_, 1};
        const size_t hash = line.find(" #");
        entry.note = hash == std::string_view::npos ? "" : std::string(trim(line.substr(hash + 2)));
        const std::vector<std::string> words = split_words(line.substr(0, hash));
        if (words.size() < 3) {
            fail("an expectation is 'ID-GLOB STATUS BUG [until=YYYY-MM-DD]  # REASON'");
            return;
        }
        entry.glob = words[0];
        const bool is_door = entry.glob.starts_with(kDoor);
        if (is_door) {
            entry.glob.erase(0, kDoor.size());
            check_door(entry.glob, words[1]);
        }
        std::vector<std::string> names;
        bool known = false;
        for (const Status status : kStatuses) {
            names.emplace_back(report::to_string(status));
            if (words[1] == names.back()) {
                entry.status = status;
                known = true;
            }
        }
        if (!known) {
            fail("'" + words[1] + "' is no status that can be expected" +
                 cases::did_you_mean(words[1], names,
                                     "; write fail, crash, timeout, device_lost, flake or skip"));
            return;
        }
        entry.bug = words[2] == "-" ? "" : words[2];
        if (entry.bug.empty() && is_door) {
            fail("a door that is left out needs a reference to a bug in its third column");
        } else if (entry.bug.empty() && entry.status != Status::skip) {
            fail("an expected " + words[1] +
                 " needs a reference to a bug in its third column ('-' is for skip)");
        }
        bool is_understood = true;  // else what a line says is not what it lacks
        for (size_t k = 3; k < words.size(); ++k) {
            if (is_cause_word(words[k])) {
                if (auto added = add_cause_word(entry.cause, words[k]); !added) {
                    fail(added.error().message);
                    is_understood = false;
                }
            } else if (words[k].starts_with("until=") && is_date(words[k].substr(6))) {
                entry.until = words[k].substr(6);
                entry.is_past = entry.until < today_;
            } else {
                fail("'" + words[k] +
                     "' is not understood; after the bug may stand causes, like "
                     "'extra:cover.outside@vulkan<=3', and 'until=YYYY-MM-DD'");
                is_understood = false;
            }
        }
        if (is_understood && !is_door) {
            check_cause(entry);
        }
        if (entry.note.empty()) {
            fail("the expectation of '" + entry.glob +
                 "' gives no reason; add one sentence after ' # '");
        }
        (is_door ? file_.doors : file_.lines).push_back(std::move(entry));
    }

    void check_door(const std::string& name, const std::string& status) {
        if (!cases::find_door(name)) {
            fail("there is no door '" + name + "'" +
                 cases::did_you_mean(name, cases::door_words(), "; 'edgecase doors' lists them"));
        } else if (status != "skip") {
            fail(
                "a door can be left out as a whole by 'skip'; a failure through it is expected of "
                "cases, by causes like 'value:door.index=" +
                name + "@vulkan<=3'");
        }
    }

    // A failure or a crash is known by what it looks like, so that it hides no other one.
    void check_cause(const ExpectationLine& entry) {
        const ExpectedCause& cause = entry.cause;
        if (entry.status == Status::skip && !cause.is_empty()) {
            fail("a case that is not drawn has no cause; remove '" + to_text(cause) + "'");
        } else if (file_.is_older) {
            return;
        } else if (entry.status == Status::fail && cause.groups.empty() && cause.bits.empty()) {
            fail("the expectation of '" + entry.glob +
                 "' names no cause; write KIND:RULE@LEVEL<=COUNT, as 'edgecase expect --update' "
                 "does");
        } else if (entry.status == Status::crash && cause.signal.empty() && cause.step.empty()) {
            fail("the expectation of '" + entry.glob +
                 "' does not say how it crashes; write signal=NAME or step=NAME");
        }
    }

    ExpectationFile file_;
    std::string today_;
    bool for_update_ = false;
    Errors errors_;
    uint32_t line_ = 0;
    bool has_device_ = false;
};

}  // namespace

cases::ExpectedAll<ExpectationFile> parse_expectations(std::string_view text,
                                                       const std::filesystem::path& path,
                                                       const std::string& today, bool for_update) {
    return Parser(path, today, for_update).parse(text);
}

cases::ExpectedAll<ExpectationFile> load_expectations(const std::filesystem::path& path) {
    const cases::Expected<std::string> text = cases::read_file(path, cases::Pipes::read);
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        return tl::unexpected(
            Errors{{{path.string(), 0, 0}, "this is a folder; name an expectation file in it"}});
    }
    if (!text || text->empty()) {
        return tl::unexpected(Errors{{{path.string(), 0, 0},
                                      std::filesystem::exists(path, ignored)
                                          ? "the expectation file is empty or cannot be read"
                                          : "there is no such expectation file"}});
    }
    return parse_expectations(*text, path, today_utc());
}

std::vector<uint32_t> find_version(std::string_view text, size_t begin) {
    std::vector<uint32_t> version;
    size_t at = text.find_first_of("0123456789", begin);
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') {
        uint64_t number = 0;
        for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at) {
            number = std::min<uint64_t>(number * 10 + static_cast<uint64_t>(text[at] - '0'),
                                        0xffffffffU);
        }
        version.push_back(static_cast<uint32_t>(number));
        if (at >= text.size() || text[at] != '.') {
            break;
        }
        ++at;
    }
    return version;
}

bool satisfies(const std::vector<uint32_t>& version, const VersionBound& bound) {
    // Compared as far as the bound goes: 22.3.6 is equal to 22.3 and not above it.
    std::vector<uint32_t> head = version;
    head.resize(bound.version.size(), 0);
    switch (bound.relation) {
        case VersionBound::Relation::at_least:
            return head >= bound.version;
        case VersionBound::Relation::above:
            return head > bound.version;
        case VersionBound::Relation::at_most:
            return head <= bound.version;
        case VersionBound::Relation::below:
            return head < bound.version;
        case VersionBound::Relation::equal:
            return head == bound.version;
    }
    return false;
}

std::string mismatch(const ExpectationFile& file, const capture::DeviceInfo& device,
                     cases::Profile profile) {
    if (::fnmatch(file.device_glob.c_str(), device.name.c_str(), 0) != 0) {
        return "it is for the device '" + file.device_glob + "', this is '" + device.name + "'";
    }
    const std::string driver = device.driver_name + " " + device.driver_info;
    const auto match = cases::find_regex(file.driver_regex, driver);
    if (!match) {
        return "it is for the driver '" + file.driver_regex + "', this is '" + driver + "'";
    }
    for (const VersionBound& bound : file.versions) {
        if (!satisfies(find_version(driver, match->second), bound)) {
            return "its driver versions do not include '" + driver + "'";
        }
    }
    if (!file.profiles.empty() &&
        std::find(file.profiles.begin(), file.profiles.end(), profile) == file.profiles.end()) {
        return "it is not for profile " + std::string(cases::to_string(profile));
    }
    return {};
}

namespace {

// Whether a line that matches no case that is drawn speaks of a way of some case. Which ways are
// drawn is the run's choice.
bool is_of_known_way(std::string_view glob, const std::vector<std::string>& ids) {
    const auto [base, way] = cases::split_way(glob);
    return std::ranges::any_of(cases::all_ways(),
                               [&way = way](const cases::WayRow& row) {
                                   return cases::glob_matches(way, row.word);
                               }) &&
           std::ranges::any_of(ids, [&base = base](const std::string& id) {
               return cases::glob_matches(base, id);
           });
}

}  // namespace

cases::ExpectedAll<std::map<std::string, ExpectationLine>> resolve_expectations(
    const std::vector<ExpectationFile>& files, const std::vector<std::string>& ids,
    bool whole_suite) {
    std::map<std::string, ExpectationLine> expected;
    Errors errors;
    for (const ExpectationFile& file : files) {
        for (const ExpectationLine& line : file.lines) {
            bool used = false;
            for (const std::string& id : ids) {
                if (!cases::glob_matches(line.glob, id)) {
                    continue;
                }
                used = true;
                const auto [at, fresh] = expected.emplace(id, line);
                // A way that is skipped as a whole may be known for more, which nobody sees then.
                const bool is_skipped = at->second.status == Status::skip;
                if (!fresh && (is_skipped || line.status == Status::skip) &&
                    !cases::split_way(id).way.empty()) {
                    at->second = is_skipped ? at->second : line;
                    continue;
                }
                // What a door shows may be another bug than what the plain picture does.
                const bool is_of_door =
                    is_of_other_doors(line.cause, {}) || is_of_other_doors(at->second.cause, {});
                if (!fresh) {
                    add_up(at->second.cause, line.cause);
                }
                const bool is_other_bug = at->second.bug != line.bug;
                if (!fresh && is_other_bug && is_of_door && at->second.status == line.status) {
                    at->second.bug += "; " + line.bug;
                } else if (!fresh && (at->second.status != line.status || is_other_bug)) {
                    errors.push_back({line.where, "'" + line.glob + "' disagrees about '" + id +
                                                      "' with " + at->second.where.file + ":" +
                                                      std::to_string(at->second.where.line)});
                    break;
                }
            }
            if (!used && whole_suite && !is_of_known_way(line.glob, ids)) {
                errors.push_back(
                    {line.where, "'" + line.glob + "' matches no case" +
                                     cases::did_you_mean(line.glob, ids, "; remove the line")});
            }
        }
    }
    if (!errors.empty()) {
        return tl::unexpected(errors);
    }
    return expected;
}

Status judge_expected(Status actual, std::optional<Status> expected, bool is_past) {
    if (!expected || actual == Status::error || actual == Status::not_run ||
        actual == Status::unsupported || actual == Status::skip) {
        return actual;
    }
    if (is_past) {
        return actual == Status::pass ? Status::xpass : actual;
    }
    if (*expected == Status::flake) {
        // A known flake may pass, and two drawings that fail may have the same bits by chance.
        return actual == Status::flake || actual == Status::fail ? Status::xfail : actual;
    }
    if (actual == *expected) {
        return Status::xfail;
    }
    if (actual == Status::pass) {
        return Status::xpass;
    }
    if (actual == Status::flake || actual > *expected) {
        return actual;
    }
    return Status::improved;  // bad, but less bad than the line says
}

namespace {

bool is_excused(const ExpectationLine& line, const report::CaseRecord& record) {
    return judge_expected(record.status, line.status, line.is_past) == Status::xfail &&
           what_is_new(line.cause, record).empty();
}

}  // namespace

bool has_new_picture(const ExpectationLine& line, const report::CaseRecord& record) {
    // A line that knows bits has seen them.
    return line.pictures_are_known && line.cause.bits.empty() && line.status == Status::fail &&
           !record.drawn.bits.empty() && !line.seen.contains(record.drawn.bits) &&
           is_excused(line, record);
}

Status counts_as(const ExpectationLine& line, const report::CaseRecord& record) {
    if (is_of_other_doors(line.cause, record.drawn.doors)) {
        return record.status;
    }
    const Status status = judge_expected(record.status, line.status, line.is_past);
    const bool is_news = status == Status::xfail && !is_excused(line, record);
    return is_news || (line.excuses_seen_only && has_new_picture(line, record)) ? record.status
                                                                                : status;
}

void apply(const ExpectationLine& line, report::CaseRecord& record) {
    if (is_of_other_doors(line.cause, record.drawn.doors)) {
        return;
    }
    record.known.expected = line.status;
    record.known.bug = line.bug;
    record.known.place = line.where.file + ":" + std::to_string(line.where.line);
    record.known.expired = line.is_past ? line.until : "";
    record.known.actual = record.status;
    if (judge_expected(record.status, line.status, line.is_past) == Status::xfail) {
        mark_known(line.cause, record);
        record.known.unlike = what_is_new(line.cause, record);
        record.known.unseen_picture = has_new_picture(line, record);
        if (record.known.unseen_picture && line.excuses_seen_only) {
            record.known.unlike =
                "the picture, bits " + record.drawn.bits + ", is none that was seen before";
        }
    }
    record.status = counts_as(line, record);
}

bool skips(const ExpectationLine& line) {
    return line.status == report::Status::skip && !line.is_past;
}

cases::Errors past_lines(const ExpectationFile& file) {
    cases::Errors errors;
    for (const auto* lines : {&file.doors, &file.lines}) {
        for (const ExpectationLine& line : *lines) {
            if (line.is_past) {
                errors.push_back({line.where, "the expectation of '" + line.glob + "' ended on " +
                                                  line.until +
                                                  "; re-check it, or extend the date"});
            }
        }
    }
    return errors;
}

}  // namespace run
