// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/files/junit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/base/printable.hpp"
#include "report/text/commands.hpp"
#include "report/text/console.hpp"
#include "report/text/levels_text.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

constexpr size_t kMaxPixels = 10;         // findings told in the text of a case
constexpr size_t kMaxOutput = 64 * 1024;  // bytes of a driver's output, head and tail

// Attribute value: parsers turn a bare newline or tab into a space (section 3.3.3).
std::string attribute(std::string_view bytes) {
    std::string text;
    for (const char c : cases::markup(bytes)) {
        if (c == '\n') {
            text += "&#10;";
        } else if (c == '\t') {
            text += "&#9;";
        } else {
            text += c;
        }
    }
    return text;
}

std::string time_of(double seconds) {
    return fmt::format("{:.6f}", std::isfinite(seconds) && seconds > 0 ? seconds : 0.0);
}

// "coverage/shared-edge/diag:rot=90" -> "coverage.shared-edge", "diag:rot=90". A parameter may hold
// a slash, so only the path before the colon is cut.
struct Name {
    std::string class_name, name;
};
Name split_id(const std::string& id) {
    const size_t end = std::min(id.find(':'), id.size());
    const size_t slash = id.rfind('/', end);
    if (slash == std::string::npos || slash == 0) {
        return {"edgecase", id};
    }
    std::string class_name = id.substr(0, slash);
    for (char& c : class_name) {
        c = c == '/' ? '.' : c;
    }
    return {class_name, id.substr(slash + 1)};
}

enum class Element { none, skipped, failure, error };
Element element_of(const Run& run, const CaseRecord& record) {
    const Status status = record.status;
    if (status == Status::pass) {
        return Element::none;
    }
    // Worst wins: what does not make the run fail comes first, then what was judged, then what was
    // not.
    return !makes_fail(run, record) ? Element::skipped
           : status <= Status::fail ? Element::failure
                                    : Element::error;
}

std::string body_of(const CaseRecord& record) {
    if (record.drawn.is_brief) {
        return "rerun: " + cases::printable(record.rerun.substr(settings_of(record.rerun).size()));
    }
    std::string text = console_case(record, {});
    for (size_t k = 1; k < record.outcome.findings.size() && k < kMaxPixels; ++k) {
        const diff::Finding& f = record.outcome.findings[k];
        text += fmt::format("{} {} {} [{}]: {}expected {}, got {}\n", sample_text(f),
                            diff::to_string(f.kind), f.rule, cases::to_string(f.level),
                            f.quantity.empty() ? "" : f.quantity + ": ", f.expected, f.got);
    }
    if (record.outcome.findings.size() > kMaxPixels) {
        text += fmt::format("and {} more, see results.json\n",
                            record.outcome.findings.size() - kMaxPixels);
    }
    for (const std::string& message : record.drawn.messages) {
        text += "validation: " + message + '\n';
    }
    return text;
}

std::string test_case(const Run& run, const CaseRecord& record) {
    const Name name = split_id(record.id);
    std::string text = fmt::format(
        "    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" line=\"{}\" time=\"{}\"",
        attribute(name.class_name), attribute(name.name), attribute(record.file), record.line,
        time_of(record.drawn.seconds));
    const Element element = element_of(run, record);
    if (element == Element::none && record.death.output.empty()) {
        return text + "/>\n";
    }
    text += ">\n";
    const std::string what = what_happened(record);
    const std::string why = why_it_happened(record);
    if (element == Element::skipped) {
        const std::string message = record.status == Status::xfail ? what
                                    : record.status == Status::fail
                                        ? fmt::format("fails only beyond --fail-at {}: {}; {}",
                                                      cases::to_string(fail_level(run)), what, why)
                                        : fmt::format("{}: {}", to_string(record.status), why);
        text += fmt::format("      <skipped message=\"{}\"/>\n", attribute(message));
    } else if (element != Element::none) {
        const std::string_view tag = element == Element::failure ? "failure" : "error";
        text += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", tag,
                            to_string(record.status), attribute(what + "\n" + why),
                            cases::markup(body_of(record)));
    }
    if (!record.death.output.empty()) {
        text += fmt::format("      <system-err>{}</system-err>\n",
                            cases::markup(head_and_tail(record.death.output, kMaxOutput)));
    }
    return text + "    </testcase>\n";
}

std::string property(std::string_view name, std::string_view value) {
    return fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", name, attribute(value));
}

}  // namespace

std::string to_junit(const Run& run) {
    size_t failures = 0, errors = 0, skipped = 0;
    for (const CaseRecord& record : run.cases) {
        const Element element = element_of(run, record);
        failures += element == Element::failure ? 1U : 0U;
        errors += element == Element::error ? 1U : 0U;
        skipped += element == Element::skipped ? 1U : 0U;
    }
    errors += run.missing_shards.size();
    const capture::DeviceInfo& d = run.device;
    const std::string name = attribute(d.name.empty() ? "no device" : d.name);
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{}\"",
                    run.cases.size() + run.missing_shards.size(), failures, errors, skipped,
                    time_of(run.seconds));
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    text += fmt::format("<testsuites name=\"edgecase\" {}>\n", counts);
    text += fmt::format("  <testsuite name=\"{}\" timestamp=\"{}\" {}>\n", name,
                        attribute(run.started), counts);
    text += "    <properties>\n";
    text += property("edgecase", run.tool_version);
    text += property("profile", cases::to_string(run.profile));
    text += property("fail_at", cases::to_string(fail_level(run)));
    const Levels found = levels(run);
    for (const LevelCount& row : found.rows) {
        text +=
            property(fmt::format("level.{}", cases::to_string(row.level)), level_text(found, row));
    }
    if (const std::string unjudged = unjudged_text(found); !unjudged.empty()) {
        text += property("level.none", unjudged);
    }
    text += property("seed", fmt::format("{}", run.seed));
    text += property("driver", d.driver_name + " " + d.driver_info);
    text += property("vulkan", d.api_version);
    text += property("uuid", d.uuid);
    text += property("subpixel_bits", fmt::format("{}", d.subpixel_bits));
    text += property("host", run.host);
    for (const auto& [key, value] : run.environment) {
        text += property(attribute("env." + key), value);
    }
    text += "    </properties>\n";
    for (const uint32_t shard : run.missing_shards) {
        text += fmt::format(
            "    <testcase classname=\"edgecase\" name=\"shard {}\" time=\"0.000000\">\n"
            "      <error type=\"not_run\" message=\"{}\"/>\n    </testcase>\n",
            shard, attribute(missing_shards_sentence(run)));
    }
    for (const CaseRecord& record : run.cases) {
        text += test_case(run, record);
    }
    return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace report
