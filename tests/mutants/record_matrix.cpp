// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs every fault and every legal device over the suite and writes down what was found. Slow; the
// target record_mutants does all of it.
//
//     record_matrix faults LOG [--quick] [FAULT...]  adds to LOG but files that it holds
//     record_matrix legal LOG [--quick]              adds to LOG but devices that it holds
//     record_matrix condense LOG FOLDER              writes FOLDER/matrix.tsv and legal.tsv
//
// A case file is asked about a fault leaf by leaf, until a leaf has a finding at the profile
// vulkan: no later leaf could lower the file's level. --quick leaves out leaves of more than 4,096
// samples or 1,024 vertices, takes the first and the last leaf of each file, and asks no more files
// of a family about a fault that two of them have caught. With FAULTs every leaf is asked about
// these alone. Lines of LOG, separated by tabs:
//
//     catch FAULT LEAF COST LEVEL/KIND/RULE/COUNT,...   findings in the order in which they came
//     file FILE LEAVES                                  done, with so many leaves
//     legal DEVICE LEAVES ALARMS WORST                  done
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "folders.hpp"
#include "mutants/judge.hpp"
#include "mutants/lead.hpp"
#include "mutants/matrix.hpp"
#include "rasterizers/strength/recorded.hpp"
#include "ref/expectation/expectation.hpp"
#include "report/text/sentences.hpp"

namespace {

// Samples and vertices: what a leaf costs, roughly.
size_t cost_of(const cases::Case& c) {
    size_t vertices = 0;
    for (const cases::Draw& draw : c.draws) {
        vertices += draw.indices ? draw.indices->size() : draw.positions.size();
    }
    return size_t{c.target.width} * c.target.height * c.target.samples * c.target.layers +
           4 * vertices;
}

// "vulkan/missing/cover.inside/12,direct3d/extra/tie.top-left/3"
std::string signature_of(const diff::Verdict& verdict) {
    std::vector<std::pair<std::string, size_t>> parts;
    for (const diff::Finding& f : verdict.findings) {
        const std::string name =
            fmt::format("{}/{}/{}", cases::to_string(f.level), diff::to_string(f.kind), f.rule);
        const auto same = std::find_if(parts.begin(), parts.end(),
                                       [&](const auto& part) { return part.first == name; });
        if (same == parts.end()) {
            parts.emplace_back(name, 1);
        } else {
            ++same->second;
        }
    }
    std::string text;
    for (const auto& [name, count] : parts) {
        text += fmt::format("{}{}/{}", text.empty() ? "" : ",", name, count);
    }
    return text;
}

// What is asked of whom.
struct Plan {
    bool quick = false;
    std::vector<cases::Fault> faults;
};

constexpr size_t kQuickLeaves = 2;
constexpr size_t kQuickFiles = 2;

// How many files of a family have caught a fault at the profile vulkan.
class Tally {
  public:
    void add(cases::Fault fault, const std::string& family) {
        const std::lock_guard lock(mutex_);
        ++files_[{fault, family}];
    }
    bool is_enough(cases::Fault fault, const std::string& family) {
        const std::lock_guard lock(mutex_);
        return files_[{fault, family}] >= kQuickFiles;
    }

  private:
    std::mutex mutex_;
    std::map<std::pair<cases::Fault, std::string>, size_t> files_;
};

// The lines of one file.
std::string record_file(const std::vector<const cases::Case*>& leaves, const Plan& plan,
                        Tally& tally) {
    std::string lines;
    std::set<cases::Fault> settled;
    const std::string family = mutants::family_of(*leaves.front());
    for (const cases::Case* leaf : leaves) {
        const ref::Expectation expectation = ref::expect(*leaf, {}, cases::Profile::direct3d);
        const auto captured = [&](cases::Fault fault) {
            mutants::Device device;
            device.fault = fault;
            return mutants::captured(*leaf, device);
        };
        const capture::Capture right = captured(cases::kNoFault);
        if (const diff::Verdict verdict = mutants::compare(*leaf, expectation, right);
            !verdict.ok()) {
            fmt::print(stderr, "false alarm: {}\n", mutants::describe(*leaf, verdict));
            continue;
        }
        for (const cases::Fault fault : plan.faults) {
            if (settled.count(fault) > 0 || !mutants::can_matter(fault, *leaf) ||
                (plan.quick && tally.is_enough(fault, family))) {
                continue;
            }
            const capture::Capture wrong = captured(fault);
            if (mutants::same_bits(right, wrong)) {
                continue;
            }
            const diff::Verdict verdict = mutants::compare(*leaf, expectation, wrong);
            if (verdict.ok() || !verdict.error.empty()) {
                continue;
            }
            if (verdict.level == cases::Profile::vulkan) {
                settled.insert(fault);
                tally.add(fault, family);
            }
            lines += fmt::format("catch\t{}\t{}\t{}\t{}\n", cases::to_string(fault), leaf->id,
                                 cost_of(*leaf), signature_of(verdict));
        }
    }
    return lines;
}

std::vector<std::vector<std::string>> lines_of(const char* log) {
    std::vector<std::vector<std::string>> out;
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);) {
        std::istringstream cells(line);
        out.emplace_back();
        for (std::string cell; std::getline(cells, cell, '\t');) {
            out.back().push_back(cell);
        }
    }
    return out;
}

// The second cells of the lines that begin with `what`.
std::set<std::string> done_in(const char* log, std::string_view what) {
    std::set<std::string> done;
    for (const std::vector<std::string>& line : lines_of(log)) {
        if (line.size() > 1 && line[0] == what) {
            done.insert(line[1]);
        }
    }
    return done;
}

// Faults and the files that caught them at the profile vulkan, each pair once.
std::set<std::pair<cases::Fault, std::string>> caught_in(const char* log) {
    std::set<std::pair<cases::Fault, std::string>> out;
    for (const std::vector<std::string>& line : lines_of(log)) {
        if (line.size() < 5 || line[0] != "catch" || line[4].find("vulkan/") == std::string::npos) {
            continue;
        }
        for (const cases::FaultRow& info : cases::kFaults) {
            if (info.name == line[1]) {
                out.emplace(info.fault, line[2].substr(0, line[2].find(':')));
            }
        }
    }
    return out;
}

// A log that several threads write to, whole blocks of lines at a time.
class Log {
  public:
    explicit Log(const char* path) : out_(path, std::ios::app) {}
    void add(const std::string& lines) {
        const std::lock_guard lock(mutex_);
        out_ << lines << std::flush;
    }
    bool good() const { return out_.good(); }

  private:
    std::ofstream out_;
    std::mutex mutex_;
};

// The first and the last, or as many as kQuickLeaves between them.
void thin_out(std::vector<const cases::Case*>& leaves) {
    if (leaves.size() <= kQuickLeaves) {
        return;
    }
    std::vector<const cases::Case*> some;
    for (size_t k = 0; k < kQuickLeaves; ++k) {
        some.push_back(leaves[k * (leaves.size() - 1) / (kQuickLeaves - 1)]);
    }
    leaves = some;
}

int record_faults(const cases::Suite& suite, const char* path, Plan plan) {
    const bool some_faults = !plan.faults.empty();
    if (!some_faults) {
        for (const cases::FaultRow& info : cases::kFaults) {
            plan.faults.push_back(info.fault);
        }
    }
    const std::set<std::string> done =
        some_faults ? std::set<std::string>{} : done_in(path, "file");
    std::map<std::string, std::vector<const cases::Case*>> files;
    std::vector<std::string> order;
    for (const size_t k : mutants::leaves_by_turn(suite.cases)) {
        const cases::Case& c = suite.cases[k];
        const std::string file = mutants::file_of(c);
        if (done.count(file) > 0 || (plan.quick && !mutants::is_small(c))) {
            continue;
        }
        std::vector<const cases::Case*>& leaves = files[file];
        if (leaves.empty()) {
            order.push_back(file);
        }
        leaves.push_back(&c);
    }
    Tally tally;
    for (const auto& [fault, file] : caught_in(path)) {
        tally.add(fault, file.substr(0, file.find('/')));
    }
    Log log(path);
    mutants::for_each_parallel(order.size(), [&](size_t n) {
        std::vector<const cases::Case*>& leaves = files.at(order[n]);
        if (plan.quick && !some_faults) {
            thin_out(leaves);
        }
        log.add(record_file(leaves, plan, tally) +
                (some_faults ? "" : fmt::format("file\t{}\t{}\n", order[n], leaves.size())));
    });
    return log.good() ? 0 : 1;
}

int record_legal(const cases::Suite& suite, const char* path, bool quick) {
    const std::set<std::string> done = done_in(path, "legal");
    Log log(path);
    for (const mutants::LegalDevice& legal : mutants::legal_devices()) {
        if (done.count(legal.name) > 0) {
            continue;
        }
        std::mutex mutex;
        size_t leaves = 0, alarms = 0;
        double worst = 0;
        mutants::for_each_parallel(suite.cases.size(), [&](size_t k) {
            const cases::Case& c = suite.cases[k];
            if (quick && !mutants::is_small(c)) {
                return;
            }
            const diff::Verdict verdict = mutants::judge(c, legal.device, legal.profile);
            const std::lock_guard lock(mutex);
            ++leaves;
            if (verdict.ok()) {
                worst = std::max(worst, verdict.worst_ratio);
            } else {
                ++alarms;
                fmt::print(stderr, "{}: {}\n", legal.name, mutants::describe(c, verdict));
            }
        });
        log.add(fmt::format("legal\t{}\t{}\t{}\t{:.3f}\n", legal.name, leaves, alarms, worst));
    }
    return log.good() ? 0 : 1;
}

// What a report would lead with, of the findings that a line "catch" holds.
mutants::Lead lead_of(const std::string& signature) {
    report::CaseRecord record;
    std::istringstream parts(signature);
    for (std::string part; std::getline(parts, part, ',');) {
        std::istringstream words(part);
        std::string level, kind, rule, count;
        std::getline(words, level, '/');
        std::getline(words, kind, '/');
        std::getline(words, rule, '/');
        std::getline(words, count, '/');
        diff::Finding finding;
        finding.level = cases::parse_profile(level).value();
        for (size_t k = 0; k < diff::kFindingKinds; ++k) {
            if (to_string(static_cast<diff::FindingKind>(k)) == kind) {
                finding.kind = static_cast<diff::FindingKind>(k);
            }
        }
        finding.rule = rule;
        record.outcome.findings.insert(record.outcome.findings.end(), std::stoul(count), finding);
    }
    const diff::Finding& lead = report::leading_finding(record);
    return {lead.level, lead.kind, lead.rule};
}

struct Catch {
    std::string leaf;
    size_t cost = 0;
    mutants::Lead lead;
};

// The looser one, of equal ones the cheaper one.
bool is_better(const Catch& a, const Catch& b) {
    return std::tuple(a.lead.level, a.cost, a.leaf) < std::tuple(b.lead.level, b.cost, b.leaf);
}

mutants::Kill kill_of(cases::Fault fault, const std::string& family,
                      const std::map<std::string, Catch>& files) {
    mutants::Kill kill;
    kill.fault = fault;
    kill.family = family;
    const Catch* best = nullptr;
    for (const auto& entry : files) {
        const Catch& caught = entry.second;
        best = best == nullptr || is_better(caught, *best) ? &caught : best;
        const auto same =
            std::find_if(kill.leads.begin(), kill.leads.end(),
                         [&](const mutants::LeadCount& l) { return l.lead == caught.lead; });
        if (same == kill.leads.end()) {
            kill.leads.push_back({caught.lead, 1});
        } else {
            ++same->files;
        }
    }
    kill.leaf = best->leaf;
    kill.lead = best->lead;
    kill.level = best->lead.level;
    std::stable_sort(kill.leads.begin(), kill.leads.end(),
                     [](const auto& a, const auto& b) { return a.files > b.files; });
    return kill;
}

int condense(const char* path, const std::filesystem::path& folder) {
    mutants::Matrix matrix;
    // By fault and family: the best catch of each file.
    std::map<std::string, std::map<std::string, std::map<std::string, Catch>>> catches;
    for (const std::vector<std::string>& line : lines_of(path)) {
        if (line.size() == 3 && line[0] == "file") {
            ++matrix.files;
            matrix.leaves += std::stoul(line[2]);
        } else if (line.size() == 5 && line[0] == "legal") {
            matrix.legal.push_back(
                {line[1], std::stoul(line[2]), std::stoul(line[3]), std::stod(line[4])});
        } else if (line.size() == 5 && line[0] == "catch") {
            const Catch caught{line[2], std::stoul(line[3]), lead_of(line[4])};
            const std::string family = line[2].substr(0, line[2].find('/'));
            const std::string file = line[2].substr(0, line[2].find(':'));
            const auto [at, fresh] = catches[line[1]][family].emplace(file, caught);
            if (!fresh && is_better(caught, at->second)) {
                at->second = caught;
            }
        } else {
            fmt::print(stderr, "{}: a line is no line of a log\n", path);
            return 1;
        }
    }
    for (const cases::FaultRow& info : cases::kFaults) {
        for (const auto& [family, files] : catches[std::string(info.name)]) {
            matrix.kills.push_back(kill_of(info.fault, family, files));
        }
    }
    std::ofstream(folder / "matrix.tsv") << mutants::matrix_text(matrix);
    std::ofstream(folder / "legal.tsv") << mutants::legal_text(matrix);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string_view> words(argv + 1, argv + argc);
    Plan plan;
    plan.quick = std::erase(words, "--quick") > 0;
    if (words.size() == 3 && words[0] == "condense") {
        return condense(argv[2], argv[3]);
    }
    if (words.size() < 2 || (words[0] != "faults" && words[0] != "legal")) {
        fmt::print(stderr,
                   "usage: record_matrix faults LOG [--quick] [FAULT...]\n"
                   "       record_matrix legal LOG [--quick]\n"
                   "       record_matrix condense LOG FOLDER\n");
        return 2;
    }
    for (const cases::FaultRow& info : cases::kFaults) {
        if (std::find(words.begin() + 2, words.end(), info.name) != words.end()) {
            plan.faults.push_back(info.fault);
        }
    }
    const std::string path(words[1]);
    const cases::Suite suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
    return words[0] == "faults" ? record_faults(suite, path.c_str(), plan)
                                : record_legal(suite, path.c_str(), plan.quick);
}
