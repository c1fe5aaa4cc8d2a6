// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/strength/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace software {

namespace {

constexpr std::string_view kHead =
    "# Written by the target record_mutants; do not edit (README.md).\n";

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, at);) {
        out.push_back(part);
    }
    return out;
}

[[noreturn]] void refuse(const std::string& where) {
    throw std::runtime_error(
        fmt::format("{}: not what record_mutants writes; build the target record_mutants", where));
}

template <class T>
T number(const std::string& text, const std::string& where) {
    T value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        refuse(where);
    }
    return value;
}

std::optional<diff::FindingKind> parse_kind(std::string_view name) {
    for (size_t k = 0; k < diff::kFindingKinds; ++k) {
        if (to_string(static_cast<diff::FindingKind>(k)) == name) {
            return static_cast<diff::FindingKind>(k);
        }
    }
    return std::nullopt;
}

std::string text_of(const Lead& lead) {
    return fmt::format("{} {} {}", cases::to_string(lead.level), diff::to_string(lead.kind),
                       lead.rule);
}

Lead parse_lead(const std::string& level, const std::string& kind, const std::string& rule,
                const std::string& where) {
    const auto profile = cases::parse_profile(level);
    const auto parsed = parse_kind(kind);
    if (!profile || !parsed) {
        refuse(where);
    }
    return {*profile, *parsed, rule};
}

// FAULT FAMILY LEAF LEAD LEAD FILES, LEAD FILES, ...
Kill parse_kill(const std::vector<std::string>& cells, const std::string& where) {
    if (cells.size() != 5) {
        refuse(where);
    }
    Kill kill;
    kill.fault = cases::find_fault(cells[0]);
    kill.family = cells[1];
    kill.leaf = cells[2];
    const std::vector<std::string> lead = split(cells[3], ' ');
    if (kill.fault == kNoFault || lead.size() != 3) {
        refuse(where);
    }
    kill.lead = parse_lead(lead[0], lead[1], lead[2], where);
    kill.level = kill.lead.level;
    for (const std::string& part : split(cells[4], ',')) {
        const std::vector<std::string> words = split(part, ' ');
        if (words.size() != 4) {
            refuse(where);
        }
        kill.leads.push_back(
            {parse_lead(words[0], words[1], words[2], where), number<size_t>(words[3], where)});
    }
    return kill;
}

// Calls row(cells, where) for each line that is no comment.
template <class Row>
void read_rows(std::istream& in, const std::string& name, const Row& row) {
    if (!in) {
        refuse(name);
    }
    size_t count = 0;
    for (std::string line; std::getline(in, line);) {
        ++count;
        if (!line.starts_with('#')) {
            row(split(line, '\t'), fmt::format("{}:{}", name, count));
        }
    }
}

void read_kills(std::istream& in, const std::string& name, Matrix& out) {
    read_rows(in, name, [&](const std::vector<std::string>& cells, const std::string& where) {
        if (cells.size() == 3 && cells[0] == "asked") {
            out.leaves = number<size_t>(cells[1], where);
            out.files = number<size_t>(cells[2], where);
        } else {
            out.kills.push_back(parse_kill(cells, where));
        }
    });
}

}  // namespace

size_t Kill::files() const {
    return std::accumulate(leads.begin(), leads.end(), size_t{0},
                           [](size_t sum, const LeadCount& part) { return sum + part.files; });
}

Matrix read_matrix(const std::filesystem::path& folder) {
    Matrix out;
    std::ifstream kills(folder / "matrix.tsv");
    read_kills(kills, folder / "matrix.tsv", out);
    std::ifstream legal(folder / "legal.tsv");
    read_rows(
        legal, folder / "legal.tsv",
        [&](const std::vector<std::string>& cells, const std::string& where) {
            if (cells.size() != 4) {
                refuse(where);
            }
            out.legal.push_back({cells[0], number<size_t>(cells[1], where),
                                 number<size_t>(cells[2], where), number<double>(cells[3], where)});
        });
    return out;
}

const std::vector<Kill>& built_in_kills() {
    static const std::vector<Kill> kills = [] {
        Matrix matrix;
        std::istringstream in(
#include "embedded/matrix.tsv.inc"
        );
        read_kills(in, "matrix.tsv", matrix);
        return matrix.kills;
    }();
    return kills;
}

std::string matrix_text(const Matrix& matrix) {
    std::string text(kHead);
    text +=
        "# asked, leaves, case files; then: fault, family, its cheapest leaf at the loosest "
        "profile, what that leads with,\n# and what the family's case files lead with, and "
        "how many of them\n";
    text += fmt::format("asked\t{}\t{}\n", matrix.leaves, matrix.files);
    for (const Kill& kill : matrix.kills) {
        text += fmt::format("{}\t{}\t{}\t{}\t", to_string(kill.fault), kill.family, kill.leaf,
                            text_of(kill.lead));
        for (size_t k = 0; k < kill.leads.size(); ++k) {
            text += fmt::format("{}{} {}", k == 0 ? "" : ",", text_of(kill.leads[k].lead),
                                kill.leads[k].files);
        }
        text += '\n';
    }
    return text;
}

std::string legal_text(const Matrix& matrix) {
    std::string text(kHead);
    text += "# device, leaves, false alarms, largest accepted error in budgets\n";
    for (const LegalResult& r : matrix.legal) {
        text += fmt::format("{}\t{}\t{}\t{:.3f}\n", r.device, r.leaves, r.alarms, r.worst_ratio);
    }
    return text;
}

std::vector<Kill> kills_of(const Matrix& matrix, Fault fault) {
    std::vector<Kill> out;
    std::ranges::copy_if(matrix.kills, std::back_inserter(out),
                         [&](const Kill& kill) { return kill.fault == fault; });
    return out;
}

cases::Profile loosest(const std::vector<Kill>& kills) {
    cases::Profile level = cases::Profile::direct3d;
    for (const Kill& kill : kills) {
        level = std::min(level, kill.level);
    }
    return level;
}

}  // namespace software
