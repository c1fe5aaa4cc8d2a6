// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/headline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "report/record/levels.hpp"
#include "report/text/sentences.hpp"

namespace report {

namespace {

// What cases of an unexpected status do, of one and of several, in the order of telling.
struct Deed {
    Status status;
    std::string_view one, several;
};
constexpr Deed kDeeds[] = {
    {Status::fail, "fails", "fail"},
    {Status::crash, "crashes", "crash"},
    {Status::timeout, "hangs", "hang"},
    {Status::device_lost, "loses the device", "lose the device"},
    {Status::error, "cannot be judged", "cannot be judged"},
    {Status::not_run, "was not run", "were not run"},
    {Status::flake, "differs from run to run", "differ from run to run"},
    {Status::improved, "is better than expected", "are better than expected"},
    {Status::xpass, "passes unexpectedly", "pass unexpectedly"},
};

bool is_new_picture(const CaseRecord& record) {
    return record.status == Status::xfail && record.known.unseen_picture;
}

}  // namespace

std::string new_pictures_text(const Run& run) {
    constexpr size_t kNamed = 3;
    std::vector<std::string> ids;
    for (const CaseRecord& record : run.cases) {
        if (is_new_picture(record)) {
            ids.push_back(cases::printable(record.id));
        }
    }
    if (ids.empty()) {
        return {};
    }
    const size_t count = ids.size();
    const size_t known = totals(run).at(static_cast<size_t>(Status::xfail));
    ids.resize(std::min(count, kNamed));
    return fmt::format("{} of {} {} drawn with bits that nobody has seen before: {}{}", count,
                       cases::counted(known, "known failure"), count == 1 ? "is" : "are",
                       fmt::join(ids, " "),
                       count > kNamed ? fmt::format(" and {} more", count - kNamed) : "");
}

std::string headline(const Run& run) {
    const auto count = totals(run);
    const auto of = [&](Status status) { return count.at(static_cast<size_t>(status)); };
    // Of what the levels are of, as far as it was judged: the page tells both numbers together.
    const size_t asked = run.cases.size() - of(Status::unsupported) - of(Status::skip);
    const bool is_judged = asked < run.cases.size() && levels(run).judged == asked;
    const std::string all = cases::counted(asked, is_judged ? "judged case" : "case");
    std::string text;
    const auto tell = [&](size_t n, std::string_view one, std::string_view several) {
        if (n > 0) {
            text += text.empty() ? fmt::format("{} of {}", n, all) : fmt::format(", {}", n);
            text += fmt::format(" {}", n == 1 ? one : several);
        }
    };
    const auto beyond =
        static_cast<size_t>(std::ranges::count_if(run.cases, [&](const CaseRecord& record) {
            return record.status == Status::fail && !makes_fail(run, record);
        }));
    for (const Deed& deed : kDeeds) {
        tell(of(deed.status) - (deed.status == Status::fail ? beyond : 0), deed.one, deed.several);
    }
    const std::string level = fmt::format(" only beyond {}", cases::to_string(fail_level(run)));
    tell(beyond, "fails" + level, "fail" + level);
    if (!run.missing_shards.empty()) {
        return fmt::format("Not the whole run: {} missing{}{}", missing_shards_text(run),
                           text.empty() ? "" : "; ", text);
    }
    if (!text.empty()) {
        return text;
    }
    const size_t passed = of(Status::pass), known = of(Status::xfail), judged = passed + known;
    if (judged == 0) {
        return "No case was judged";
    }
    if (known > 0) {
        const auto unseen = std::ranges::count_if(run.cases, is_new_picture);
        return fmt::format("All as expected: {} of {} {}, as is known{}", known,
                           cases::counted(judged, "judged case"), known == 1 ? "fails" : "fail",
                           unseen > 0 ? fmt::format(", {} of them with bits that nobody has seen "
                                                    "before",
                                                    unseen)
                                      : "");
    }
    const std::string_view which = judged == run.cases.size() ? "case" : "judged case";
    return judged == 1 ? fmt::format("The one {} passes", which)
                       : fmt::format("All {} pass", cases::counted(judged, which));
}

}  // namespace report
