// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs every fault over the suite and writes down what caught it. Slow; the target record_mutants
// runs it by night and condenses the log to matrix.tsv (condense_matrix.cpp).
//
//     record_matrix LOG [--small]
//
// A case file is asked about a fault leaf by leaf, until a leaf has a finding at the profile
// vulkan: no later leaf could lower the file's level. --small leaves out leaves of more than 4,096
// samples or 1,024 vertices. Files that LOG already holds are not run again.
//
//     catch FAULT LEAF COST LEVEL/KIND/RULE/COUNT,...   findings in the order in which they came
//     file FILE LEAVES                                  done, with so many leaves
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "diff/color_planes.hpp"
#include "mutants/judge.hpp"
#include "mutants/matrix.hpp"
#include "ref/expectation.hpp"

namespace {

using Files = std::map<std::string, std::vector<const cases::Case*>>;

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
        const std::string name = fmt::format("{}/{}/{}", cases::to_string(f.level),
                                             diff::to_string(f.kind), f.rule);
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

// The lines of one file.
std::string record_file(const std::string& file, const std::vector<const cases::Case*>& leaves) {
    std::string lines;
    std::set<mutants::Fault> settled;
    for (const cases::Case* leaf : leaves) {
        const ref::Expectation expectation = ref::expect(*leaf, {}, cases::Profile::direct3d);
        const auto captured = [&](mutants::Fault fault) {
            mutants::Device device;
            device.fault = fault;
            diff::Capture out = mutants::render(*leaf, device);
            diff::drop_unattached(out, *leaf);
            return out;
        };
        const diff::Capture right = captured(mutants::Fault::none);
        if (const diff::Verdict verdict = diff::compare(*leaf, expectation, right);
            !verdict.ok()) {
            fmt::print(stderr, "false alarm: {}\n", mutants::describe(*leaf, verdict));
            continue;
        }
        for (const mutants::FaultInfo& info : mutants::all_faults()) {
            if (settled.count(info.fault) > 0 || !mutants::can_matter(info.fault, *leaf)) {
                continue;
            }
            const diff::Capture wrong = captured(info.fault);
            if (mutants::same_bits(right, wrong)) {
                continue;
            }
            const diff::Verdict verdict = diff::compare(*leaf, expectation, wrong);
            if (verdict.ok() || !verdict.error.empty()) {
                continue;
            }
            if (verdict.level == cases::Profile::vulkan) {
                settled.insert(info.fault);
            }
            lines += fmt::format("catch\t{}\t{}\t{}\t{}\n", info.name, leaf->id, cost_of(*leaf),
                                 signature_of(verdict));
        }
    }
    return lines + fmt::format("file\t{}\t{}\n", file, leaves.size());
}

std::set<std::string> files_in(const char* log) {
    std::set<std::string> done;
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string what, name;
        if (words >> what >> name && what == "file") {
            done.insert(name);
        }
    }
    return done;
}

}  // namespace

int main(int argc, char** argv) {
    const bool small = argc == 3 && std::string_view(argv[2]) == "--small";
    if (argc != 2 && !small) {
        fmt::print(stderr, "usage: record_matrix LOG [--small]\n");
        return 2;
    }
    const cases::Suite suite = cases::load_suite(EDGECASE_SOURCE_DIR "/cases/suite");
    const std::set<std::string> done = files_in(argv[1]);
    Files files;
    std::vector<std::string> order;
    for (const size_t k : mutants::leaves_by_turn(suite.cases)) {
        const cases::Case& c = suite.cases[k];
        const std::string file = mutants::file_of(c);
        if (done.count(file) > 0 || (small && !mutants::is_small(c))) {
            continue;
        }
        std::vector<const cases::Case*>& leaves = files[file];
        if (leaves.empty()) {
            order.push_back(file);
        }
        leaves.push_back(&c);
    }
    std::FILE* log = std::fopen(argv[1], "a");
    if (log == nullptr) {
        fmt::print(stderr, "{}: cannot be written\n", argv[1]);
        return 1;
    }
    std::mutex mutex;
    mutants::for_each_parallel(order.size(), [&](size_t n) {
        const std::string lines = record_file(order[n], files.at(order[n]));
        const std::lock_guard lock(mutex);
        std::fwrite(lines.data(), 1, lines.size(), log);
        std::fflush(log);
    });
    return std::fclose(log) == 0 ? 0 : 1;
}
