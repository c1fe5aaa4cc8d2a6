// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints docs/mutants.md: every fault of the mutants' device and what catches it, every legal
// device and that nothing is found wrong about it, every family and what it alone catches. From
// the recorded runs (rasterizers/strength/*.tsv), the tables of faults and the list of legal
// devices.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "mutants/judge.hpp"
#include "mutants/lead.hpp"
#include "rasterizers/strength/recorded.hpp"
#include "tests/docs/wrapped.hpp"

namespace {

using cases::FaultRow;
using software::Kill;
using software::Matrix;

std::string contents(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

// The sources that have the body by which the device draws a fault: "`tiles.cpp` `planes.cpp`".
class Sources {
  public:
    explicit Sources(const std::filesystem::path& root) {
        read(root / "rasterizers/software", code_);
        read(root / "cases/fault", changes_);
        read(root / "rasterizers/strength", changes_);
    }
    std::string of(const FaultRow& info) const {
        std::string out;
        for (const auto& [name, text] : cases::has_code(info.fault) ? code_ : changes_) {
            if (text.find(fmt::format("\"{}\"_fault", info.name)) != std::string::npos) {
                out += fmt::format("{}`{}`", out.empty() ? "" : " ", name);
            }
        }
        return out;
    }

  private:
    using Texts = std::map<std::string, std::string>;
    static void read(const std::filesystem::path& folder, Texts& texts) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            const std::filesystem::path extension = entry.path().extension();
            if (extension == ".cpp" || extension == ".hpp") {
                texts[entry.path().filename().string()] = contents(entry.path());
            }
        }
    }
    Texts code_, changes_;
};

// The cheapest leaves of two families, those that catch it at the loosest profile first.
std::vector<Kill> examples(std::vector<Kill> kills) {
    std::stable_sort(kills.begin(), kills.end(),
                     [](const Kill& a, const Kill& b) { return a.level < b.level; });
    kills.resize(std::min<size_t>(kills.size(), 2));
    return kills;
}

std::string code_words(std::string_view words) {
    std::string out = "`";
    for (const char c : words) {
        out += c == ' ' ? std::string("` `") : std::string(1, c);
    }
    return out + "`";
}

// False if a fault is caught by fewer than two families.
bool print_faults(const Matrix& matrix, const Sources& sources) {
    bool is_complete = true;
    std::string table;
    size_t found = 0, count = 0;
    for (const FaultRow& info : cases::kFaults) {
        const std::vector<Kill> kills = software::kills_of(matrix, info.fault);
        const std::string where = sources.of(info);
        if (kills.size() < 2 || where.empty()) {
            fmt::print(stderr, "error: {} is {}\n", info.name,
                       where.empty() ? "in no source" : "caught by fewer than two families");
            is_complete = false;
        }
        std::string cases;
        for (const Kill& kill : examples(kills)) {
            cases += fmt::format("{}`{}`", cases.empty() ? "" : " ", kill.leaf);
        }
        const std::string top = mutants::top_rule(kills);
        const bool is_found = mutants::is_broken(info, top);
        found += is_found ? 1 : 0;
        ++count;
        table += fmt::format("| `{}` | {} | {} | {} | {}`{}` | {} | {} | {} |\n", info.name,
                             info.sentence, where, code_words(info.rules), is_found ? "" : "! ",
                             top, cases::to_string(software::loosest(kills)), kills.size(), cases);
    }
    const auto count_of = [&](auto&& is_counted) {
        return std::count_if(cases::kFaults.begin(), cases::kFaults.end(),
                             [&](const FaultRow& info) {
                                 return is_counted(software::kills_of(matrix, info.fault).size());
                             });
    };
    fmt::print(
        "## Faults\n\n{}\n"
        "| fault | what the device does | where | breaks | told first | profile | families | cases "
        "|\n| --- | --- | --- | --- | --- | --- | --- | --- |\n{}",
        wrapped(fmt::format(
            "At least two families catch {} of {} faults; {} survive. A report of all their "
            "failures tells a rule first that the fault breaks for {} of them ({:.1f} %); where it "
            "does not, the rule is marked `!`. *Profile* is the loosest at which a case fails, "
            "*families* says how many catch the fault, and *cases* are the cheapest of two "
            "families.",
            count_of([](size_t kills) { return kills > 1; }), count,
            count_of([](size_t kills) { return kills == 0; }), found,
            100.0 * static_cast<double>(found) / static_cast<double>(count))),
        table);
    return is_complete;
}

// False if a device was not run, or with a finding.
bool print_legal(const Matrix& matrix) {
    bool is_complete = true;
    std::string table;
    size_t alarms = 0;
    const auto devices = mutants::legal_devices();
    for (const mutants::LegalDevice& device : devices) {
        const auto result =
            std::find_if(matrix.legal.begin(), matrix.legal.end(),
                         [&](const software::LegalResult& r) { return r.device == device.name; });
        if (result == matrix.legal.end() || result->alarms > 0) {
            fmt::print(stderr, "error: the legal device {} {}\n", device.name,
                       result == matrix.legal.end() ? "was not run" : "has false alarms");
            is_complete = false;
            continue;
        }
        alarms += result->alarms;
        table += fmt::format("| `{}` | {} | {} | {} | {} | {:.3f} |\n", device.name, device.what,
                             cases::to_string(device.profile), result->leaves, result->alarms,
                             result->worst_ratio);
    }
    fmt::print(
        "\n## Legal devices\n\n{}\n"
        "| device | what it does | profile | cases | false alarms | budgets |\n"
        "| --- | --- | --- | --- | --- | --- |\n{}",
        wrapped(fmt::format(
            "{} devices break no rule of their profile, and {} of their results were false alarms. "
            "*Cases* is how many the suite had when the device was recorded. *Budgets* is the "
            "largest "
            "accepted error of a value, in units of what its rule allows.",
            devices.size(), alarms)),
        table);
    return is_complete;
}

void print_families(const Matrix& matrix) {
    struct Family {
        size_t caught = 0;
        std::vector<std::string> alone;   // at the loosest profile
        std::vector<std::string> needed;  // one of two that catch it at all
    };
    std::map<std::string, Family> families;
    for (const FaultRow& info : cases::kFaults) {
        const std::vector<Kill> kills = software::kills_of(matrix, info.fault);
        const cases::Profile level = software::loosest(kills);
        const auto at_level = std::count_if(kills.begin(), kills.end(),
                                            [&](const Kill& kill) { return kill.level == level; });
        for (const Kill& kill : kills) {
            Family& family = families[kill.family];
            ++family.caught;
            if (at_level == 1 && kill.level == level) {
                family.alone.emplace_back(info.name);
            }
            if (kills.size() == 2) {
                family.needed.emplace_back(info.name);
            }
        }
    }
    fmt::print(
        "\n## Families\n\n{}\n"
        "| family | faults caught | alone | one of two |\n| --- | --- | --- | --- |\n",
        wrapped("The table says which faults hang on a family. *Alone* are those that no other "
                "family catches at the fault's loosest profile; *one of two* are those that only "
                "one other family would be left to catch. Here each case is drawn once, as these "
                "faults stay the same from rendering to rendering; what the relations of `repeat` "
                "and `tiled` see is a device that changes its mind, which no other check does "
                "(`tests/mutants/inconsistent_test.cpp`)."));
    const auto list = [](const std::vector<std::string>& names) {
        std::string out;
        for (const std::string& name : names) {
            out += fmt::format("{}`{}`", out.empty() ? "" : " ", name);
        }
        return out;
    };
    for (const auto& [name, family] : families) {
        fmt::print("| `{}` | {} | {} | {} |\n", name, family.caught, list(family.alone),
                   list(family.needed));
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::fputs("usage: generate_mutants_page ROOT\n", stderr);
        return 2;
    }
    const std::filesystem::path rasterizers = std::filesystem::path(argv[1]) / "rasterizers";
    const Matrix matrix = software::read_matrix(rasterizers / "strength");
    fmt::print(
        "# What the suite catches of a broken rasterizer\n\n"
        "Generated from `cases/fault/` and `rasterizers/` by `scripts/generate-docs`; do not "
        "edit.\n\n{}\n",
        wrapped(fmt::format(
            "`rasterizers/software/` is a rasterizer of its own, written as drivers are, that "
            "shares no arithmetic with the reference. It can be given one fault at a time that an "
            "author could make, in its code or by taking a case for another one, and it can be "
            "given each choice that the specifications leave open. Below is what a run of {} cases "
            "from {} case files found; "
            "`cmake --build --preset release --target record_mutants` runs the whole suite and "
            "rewrites what this page is made of ([tests/mutants](../tests/mutants/README.md)); "
            "`edgecase lint --strength` asks the same of your own case. The tests run each fault "
            "again on two of its "
            "cases, and each legal device on a share of the suite. "
            "[breaking-layer.md](breaking-layer.md) has the same of a real driver with faults.",
            matrix.leaves, matrix.files)));
    const Sources sources(argv[1]);
    const bool all_caught = print_faults(matrix, sources);
    const bool all_legal = print_legal(matrix);
    print_families(matrix);
    return all_caught && all_legal ? 0 : 3;
} catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 3;
}
