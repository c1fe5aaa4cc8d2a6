// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <vector>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "report/text/causes.hpp"
#include "report/text/commands.hpp"
#include "report/text/diagnosis_text.hpp"
#include "report/text/doors_text.hpp"
#include "report/text/headline.hpp"
#include "report/text/levels_text.hpp"
#include "report/text/sentences.hpp"
#include "report/text/unexpected.hpp"
#include "report/text/wrap.hpp"

namespace report {

namespace {

constexpr uint32_t kMaxPictureWidth = 64;   // characters
constexpr uint32_t kMaxPictureHeight = 32;  // lines
constexpr std::string_view kIndent = "      ";

// SGR codes; blue, orange and bold tell apart what red and green do not.
std::string_view color_of(Status status) {
    constexpr std::string_view kBad = "1;31";
    constexpr std::array<std::string_view, kStatuses> kColors = {
        "34", "2",  "2",  "2",  "1;36", "1;36", "1;33",  // pass to flake
        kBad, kBad, kBad, kBad, kBad,   "1;33"};         // fail to not_run
    return kColors.at(static_cast<size_t>(status));
}

std::string painted(std::string_view text, std::string_view sgr, const ConsoleStyle& style) {
    return style.color ? fmt::format("\x1b[{}m{}\x1b[0m", sgr, text) : std::string(text);
}

std::string upper(std::string_view word) {
    std::string text;
    for (const char c : word) {
        text += c == '_' ? ' ' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return text;
}

char character_of(uint8_t mark, uint8_t expected_hits) {
    constexpr std::string_view kCharacters = "#~MXDVO";  // by SampleMark
    static_assert(kCharacters.size() == static_cast<size_t>(diff::SampleMark::order) + 1);
    if (mark == 0 && expected_hits == 0) {
        return '.';
    }
    return mark < kCharacters.size() ? kCharacters[mark] : '?';
}

// Where `length` of `size` pixels begin such that `middle` is seen.
uint32_t window_begin(uint32_t middle, uint32_t length, uint32_t size) {
    const uint32_t begin = middle > length / 2 ? middle - length / 2 : 0;
    return std::min(begin, size - length);
}

std::string ascii_picture(const CaseRecord& record, const ConsoleStyle& style) {
    const Pictures& p = record.evidence.pictures;
    const size_t pixels = size_t{p.width} * p.height;
    if (pixels == 0 || p.marks.empty() || p.marks.size() % pixels != 0 ||
        p.expected_hits.size() != p.marks.size()) {
        return {};
    }
    // A picture without a wrong sample shows nothing of what the whole case got wrong.
    const auto told = std::ranges::find(record.outcome.findings, false, &diff::Finding::of_case);
    const bool is_told = told != record.outcome.findings.end();
    if (!is_told && !record.outcome.findings.empty()) {
        return {};
    }
    const size_t samples = p.marks.size() / pixels;
    const uint32_t room = style.width > 16 ? style.width - 8 : 8;
    const uint32_t width = std::min({p.width, kMaxPictureWidth, room});
    const uint32_t height = std::min(p.height, kMaxPictureHeight);
    // The window holds the first finding, else the middle of the wrong samples.
    const auto inside = [](uint32_t at, uint32_t begin) { return at > begin ? at - begin : 0; };
    const uint32_t x = is_told ? told->x : record.outcome.min_x;
    const uint32_t y =
        is_told ? told->layer.value_or(0) * p.layer_height + told->y : record.outcome.min_y;
    const uint32_t left = window_begin(inside(x, p.left), width, p.width);
    const uint32_t top = window_begin(inside(y, p.top), height, p.height);

    std::string text = fmt::format(
        "{}pixels ({},{}) to ({},{}): # covered, . not, ~ either, M missing, X extra, D double, "
        "V value, O order\n",
        kIndent, p.left + left, p.top + top, p.left + left + width - 1, p.top + top + height - 1);
    for (uint32_t j = top; j < top + height; ++j) {
        if (p.layer_height > 0 && (j == top || (p.top + j) % p.layer_height == 0)) {
            text += fmt::format("{}layer {}, from row {}\n", kIndent, (p.top + j) / p.layer_height,
                                (p.top + j) % p.layer_height);
        }
        text += kIndent;
        for (uint32_t i = left; i < left + width; ++i) {
            const size_t begin = (size_t{j} * p.width + i) * samples;
            size_t worst = begin;
            for (size_t k = begin; k < begin + samples; ++k) {
                // The worst sample stands for its pixel; among good ones, a covered one.
                if (p.marks[k] > p.marks[worst] ||
                    (p.marks[k] == p.marks[worst] && p.expected_hits[k] > p.expected_hits[worst])) {
                    worst = k;
                }
            }
            text += character_of(p.marks[worst], p.expected_hits[worst]);
        }
        text += '\n';
    }
    return text;
}

std::string or_unknown(const std::string& text) {
    return text.empty() ? "unknown" : cases::printable(text);
}

constexpr size_t kMaxPrintedLines = 8;  // of what a driver printed before it died
constexpr size_t kMaxPrintedColumns = 160;
constexpr size_t kMaxCauses = 20;

// The last lines that a driver printed before its worker ended, and how to look at it.
std::string death_text(const CaseRecord& record) {
    std::vector<std::string> lines;
    const std::string text = cases::printable(record.death.output);
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        if (text.find_first_not_of(" \t", begin) < end) {
            lines.push_back(text.substr(begin, std::min(end - begin, kMaxPrintedColumns)));
        }
        begin = end + 1;
    }
    std::string printed;
    for (size_t k = lines.size() - std::min(lines.size(), kMaxPrintedLines); k < lines.size();
         ++k) {
        printed += fmt::format("{}  | {}\n", kIndent, lines[k]);
    }
    if (!printed.empty()) {
        printed = fmt::format("{}the driver printed{}:\n", kIndent,
                              lines.size() > kMaxPrintedLines ? ", in the end" : "") +
                  printed;
    }
    return printed + fmt::format("{}debug: {}\n", kIndent, cases::printable(debug_line(record)));
}

// The settings in front of the rerun lines of the first causes, if all have the same.
std::string_view shared_settings(const std::vector<Cause>& list, size_t count) {
    const auto settings = [](const Cause& cause) {
        return settings_of(smallest_case(cause).rerun);
    };
    const std::string_view first = count > 0 ? settings(list.front()) : std::string_view();
    const bool is_shared =
        std::all_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count),
                    [&](const Cause& cause) { return settings(cause) == first; });
    return is_shared ? first : std::string_view();
}

// The causes of a run's unexpected results that are told: none if each result has been told.
std::vector<Cause> told_causes(const Run& run, const ConsoleStyle& style) {
    std::vector<Cause> list = causes(run);
    std::erase_if(list, [](const Cause& cause) { return cause.status == Status::not_run; });
    std::set<const CaseRecord*> results;
    for (const Cause& cause : list) {
        results.insert(cause.cases.begin(), cause.cases.end());
    }
    return results.size() <= kHandful && !style.verbose ? std::vector<Cause>() : list;
}

// A line each with its smallest case, but for those that a diagnosis repeats. Settings that all
// rerun lines have in front, a driver's path often, are told once: they would hide the causes.
std::string causes_text(const Run& run, const ConsoleStyle& style) {
    std::vector<Cause> list = told_causes(run, style);
    const size_t all = list.size();
    if (!style.verbose) {
        std::erase_if(list, [](const Cause& cause) { return cause.diagnosis.has_value(); });
    }
    const size_t folded = all - list.size();
    const size_t told = style.verbose ? list.size() : std::min(list.size(), kMaxCauses);
    const std::string_view settings = shared_settings(list, told);
    std::string text = list.empty() ? "" : "causes, the worst first:\n";
    if (!settings.empty()) {
        text = fmt::format(
            "causes, the worst first; put the settings in front of each rerun:\n"
            "  settings: {}\n",
            cases::printable(std::string(settings.substr(0, settings.size() - 1))));
    }
    for (size_t k = 0; k < told; ++k) {
        const Cause& cause = list[k];
        std::string level = cause_level(cause);
        level = level.empty() ? "" : fmt::format(" [{}]", level);
        const std::string rerun = rerun_of(cause);
        text += fmt::format("  {}{}   rerun: {}\n",
                            painted(cause_title(cause), color_of(cause.status), style), level,
                            cases::printable(rerun.substr(settings.size())));
    }
    if (told < list.size()) {
        text += fmt::format("  and {} more: see the report, or use -v\n", list.size() - told);
    }
    if (folded > 0 && !style.verbose) {
        text += fmt::format("{} of {} {} the same as the diagnosis; -v lists {}\n", folded,
                            cases::counted(all, "cause"), folded == 1 ? "says" : "say",
                            folded == 1 ? "it" : "them");
    }
    return text;
}

// What the device does wrong, a line each; but for those that explain a part of it only.
std::string diagnoses_text(const Run& run, const ConsoleStyle& style,
                           std::string_view word = "diagnosis") {
    const Repeated repeated(run);
    std::string text;
    for (size_t k = 0; k < run.diagnoses.size(); ++k) {
        const Diagnosis& d = run.diagnoses[k];
        if (!repeated.is_partial(k)) {
            text += fmt::format("{}: {}; it {}\n", word, painted(what_it_does(d), "1", style),
                                evidence_for(d));
        }
    }
    return text;
}

// Those that explain a part of the failures only: after the causes, which they take nothing from.
std::string partial_diagnoses_text(const Run& run) {
    const Repeated repeated(run);
    std::string text;
    for (size_t k = 0; k < run.diagnoses.size(); ++k) {
        if (repeated.is_partial(k)) {
            const Diagnosis& d = run.diagnoses[k];
            text += fmt::format("some cases look as if: {}\n{}{}; {}\n", what_it_does(d), kIndent,
                                limits_of(d), evidence_for(d));
        }
    }
    return text;
}

// The case with the fewest samples of those that show the gravest cause, and how to repeat it.
std::string smallest_text(const Run& run) {
    const std::vector<Cause> list = causes(run);
    const auto first = std::ranges::find_if(
        list, [](const Cause& cause) { return cause.status != Status::not_run; });
    return first == list.end() ? std::string()
                               : fmt::format("smallest case: {}   rerun: {}\n",
                                             cases::printable(smallest_case(*first).id),
                                             cases::printable(rerun_of(*first)));
}

// "free: 64 of 256 samples at profile vulkan, ...": those with which nothing is tested. Who draws
// files of one's own is told without asking.
std::string free_text(const Run& run, bool is_asked) {
    uint64_t free = 0, samples = 0, count = 0;
    const CaseRecord* most = nullptr;
    for (const CaseRecord& r : run.cases) {
        free += r.outcome.either_samples;
        samples += r.outcome.compared_samples;
        count += r.outcome.either_samples > 0 ? 1 : 0;
        if (r.outcome.either_samples > (most == nullptr ? 0 : most->outcome.either_samples)) {
            most = &r;
        }
    }
    if (samples == 0 || (!is_asked && (free == 0 || run.own_hash.empty()))) {
        return {};
    }
    std::string text = fmt::format("free: {} of {} samples at profile {}", free, samples,
                                   cases::to_string(run.profile));
    if (most != nullptr) {
        text += fmt::format(", in {}; most in {}: {} of {}", cases::counted(count, "case"),
                            cases::printable(most->id), most->outcome.either_samples,
                            most->outcome.compared_samples);
    }
    return text + '\n';
}

// Those of which something is known of the device: not unsupported, skipped, not run or in error.
size_t judged_cases(const Run& run) {
    return static_cast<size_t>(std::ranges::count_if(run.cases, [](const CaseRecord& record) {
        const Status status = actual_status(record);
        return status != Status::unsupported && status != Status::skip &&
               status != Status::not_run && status != Status::error;
    }));
}

}  // namespace

std::string console_header(const Run& run, const ConsoleStyle& style) {
    const capture::DeviceInfo& d = run.device;
    // What draws without a driver (captures, an algorithm) has no Vulkan.
    const bool is_other = d.api_version.empty() && !d.name.empty();
    std::string text = fmt::format(
        "{}  {}  {}{}{}{}  {} subpixel bits{}  profile {}  seed {}",
        painted("edgecase " + or_unknown(run.tool_version), "1", style), or_unknown(d.name),
        or_unknown(d.driver_name), d.driver_info.empty() ? "" : " ",
        cases::printable(d.driver_info), is_other ? "" : "  Vulkan " + or_unknown(d.api_version),
        d.subpixel_bits, judged_bits_note(d), cases::to_string(run.profile), run.seed);
    std::ranges::replace(text, '\n', ' ');
    text += '\n';
    return style.wrap ? wrapped(text, style.width) : text;
}

std::string console_case(const CaseRecord& record, const ConsoleStyle& style) {
    std::string text = fmt::format(
        "{} {}   {}\n", painted(upper(to_string(record.status)), color_of(record.status), style),
        cases::printable(record.id), what_happened(record));
    text += fmt::format("{}{}\n", kIndent, why_it_happened(record));
    if (const std::string others = other_relations_text(record); !others.empty()) {
        text += fmt::format("{}also: {}\n", kIndent, others);
    }
    text += fmt::format("{}rerun: {}\n", kIndent, cases::printable(record.rerun));
    if (record.status == Status::crash || record.status == Status::timeout) {
        text += death_text(record);
    }
    if (!record.commands.explain.empty()) {
        text += fmt::format("{}explain: {}\n", kIndent, cases::printable(record.commands.explain));
    }
    const bool is_outdated = record.status == Status::xpass || record.status == Status::improved;
    if (is_outdated && !record.known.place.empty() && !style.folder.empty()) {
        const std::string file = record.known.place.substr(0, record.known.place.rfind(':'));
        text += fmt::format("{}update: edgecase expect --update {} {}\n", kIndent,
                            cases::printable(style.folder), cases::printable(file));
    }
    if (style.verbose) {
        text += ascii_picture(record, style);
    }
    return style.wrap ? wrapped(text, style.width) : text;
}

std::string console_totals(const Run& run, const ConsoleStyle& style) {
    const auto count = totals(run);
    std::string text = cases::counted(run.cases.size(), "case");
    for (size_t k = 0; k < kStatuses; ++k) {
        if (count.at(k) > 0) {
            const auto status = static_cast<Status>(k);
            std::string word(to_string(status));
            std::ranges::replace(word, '_', ' ');
            text +=
                "  " + painted(fmt::format("{} {}", count.at(k), word), color_of(status), style);
        }
    }
    const bool is_cut = run.ended.empty() && !(run.seconds > 0);
    // Always seconds, so that one run's time is seen beside another's.
    const std::string time = fmt::format("{:.{}f} s", run.seconds, run.seconds < 1 ? 2 : 1);
    text += fmt::format("   {}   seed {}\n", is_cut ? "cut off" : time, run.seed);
    return style.wrap ? wrapped(text, style.width) : text;
}

std::string first_look_text(const Run& run, const ConsoleStyle& style) {
    const size_t failed = totals(run).at(static_cast<size_t>(Status::fail));
    if (2 * failed <= judged_cases(run)) {
        return {};
    }
    ConsoleStyle with_picture = style;
    with_picture.verbose = true;
    const std::string text = fmt::format(
        "first look, after {}: {} of {} fail that are the plainest of their families\n{}"
        "smallest case:\n{}the run goes on; Ctrl-C ends it with reports of what was judged\n",
        seconds_text(run.seconds), failed, cases::counted(judged_cases(run), "case"),
        diagnoses_text(run, style, "diagnosis so far"),
        console_case(smallest_case(causes(run).front()), with_picture));
    return style.wrap ? wrapped(text, style.width) : text;
}

std::string console_summary(const Run& run, const std::string& report_path,
                            const ConsoleStyle& style, const std::string& exit_words) {
    std::string text = causes_text(run, style) + partial_diagnoses_text(run);
    if (!style.totals_are_told) {
        ConsoleStyle unwrapped = style;
        unwrapped.wrap = false;
        text += console_totals(run, unwrapped);
    }
    if (const size_t judged = judged_cases(run); judged > 0 && 2 * judged < run.cases.size()) {
        text += fmt::format("only {} of {} cases {} judged\n", judged, run.cases.size(),
                            judged == 1 ? "was" : "were");
    }
    if (const CaseRecord* worst = worst_case(run)) {
        text += fmt::format("largest accepted error {}{}{} in {}\n", accepted_text(run, *worst),
                            worst->outcome.worst_quantity.empty() ? "" : ", ",
                            cases::printable(worst->outcome.worst_quantity),
                            cases::printable(worst->id));
    }
    if (const std::string unseen = new_pictures_text(run); !unseen.empty()) {
        text += unseen + "; --strict makes them unexpected\n";
    }
    if (const std::string shortened = shortened_text(run); !shortened.empty()) {
        text += shortened + '\n';
    }
    text += doors_text(run, style.verbose) + ways_text(run);
    text += free_text(run, style.verbose);
    text += levels_line(run) + '\n' + diagnoses_text(run, style) + smallest_text(run);
    const std::string exit = exit_words.empty() ? exit_text(run) : exit_words;
    text += report_path.empty()
                ? exit + '\n'
                : fmt::format("report {}    {}\n", cases::printable(report_path), exit);
    return style.wrap ? wrapped(text, style.width) : text;
}

}  // namespace report
