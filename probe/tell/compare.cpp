// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/tell/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"

namespace probe {

namespace {

constexpr const char* kNotAsked = "not asked";

std::string name_of(const Datasheet& sheet) {
    std::string out;
    for (const auto& [name, value] : sheet.device) {
        if (name == "device" || name == "driver" || name == "renderer") {
            out += (out.empty() ? "" : ", ") + value;
        }
    }
    return out;
}

}  // namespace

std::vector<Difference> differences(const Datasheet& a, const Datasheet& b) {
    std::vector<Difference> out;
    for (const Property& p : a.properties) {
        const Property* other = b.find(p.id);
        const std::string answer = other == nullptr ? kNotAsked : other->answer;
        if (answer != p.answer) {
            out.push_back({p.id, p.question, p.answer, answer});
        }
    }
    for (const Property& p : b.properties) {
        if (a.find(p.id) == nullptr) {
            out.push_back({p.id, p.question, kNotAsked, p.answer});
        }
    }
    return out;
}

std::string comparison_text(const Datasheet& a, const Datasheet& b, const std::string& from_a,
                            const std::string& from_b) {
    const std::vector<Difference> all = differences(a, b);
    std::string out = fmt::format("A: {} ({})\nB: {} ({})\n", name_of(a), cases::printable(from_a),
                                  name_of(b), cases::printable(from_b));
    for (const Difference& d : all) {
        out += fmt::format("\n  {}  [{}]\n    A: {}\n    B: {}\n", d.question, d.id, d.a, d.b);
    }
    const size_t same =
        a.properties.size() - static_cast<size_t>(std::ranges::count_if(
                                  all, [](const auto& d) { return d.a != kNotAsked; }));
    out += fmt::format("\n{} other answers, {} the same\n",
                       all.empty() ? "no" : std::to_string(all.size()),
                       cases::counted(same, "answer"));
    return out;
}

}  // namespace probe
