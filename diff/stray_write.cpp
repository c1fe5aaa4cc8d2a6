// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/stray_write.hpp"

#include <fmt/format.h>

#include "cases/model/rule_ids.hpp"

namespace diff {

void add_stray_writes(const cases::Case& c, std::span<const capture::StrayWrite> writes,
                      Verdict& verdict) {
    const cases::Target& t = c.target;
    for (const capture::StrayWrite& w : writes) {
        const std::string_view side = w.is_before ? "before" : "after";
        Finding finding = finding_at(
            FindingKind::value, t,
            w.is_before ? cases::SampleId{0, 0, 0, 0}
                        : cases::SampleId{t.width - 1, t.height - 1, t.samples - 1, t.layers - 1});
        finding.rule = cases::rule::write_outside;
        finding.level = cases::Profile::vulkan;
        finding.quantity = fmt::format("memory {} {}", side, w.attachment);
        finding.expected = fmt::format("{:#010x}", w.expected);
        finding.got = fmt::format("{:#010x}", w.got);
        finding.why = fmt::format(
            "a buffer that no command of the case writes to lies {} the attachment in its memory; "
            "{} of its words changed, the nearest {} bytes {}",
            side, w.words, w.distance,
            w.is_before ? "before the first byte" : "after the last byte");
        if (w.renderings > 1) {
            finding.why +=
                fmt::format("; {} renderings were in the submission, and none of them did it alone",
                            w.renderings);
        }
        verdict.add(std::move(finding), t);
    }
}

}  // namespace diff
