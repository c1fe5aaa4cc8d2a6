// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <tuple>

#include "mutants/judge.hpp"
#include "rasterizers/strength/strength.hpp"

namespace mutants {

namespace {

constexpr size_t kBatch = 16;

}  // namespace

bool is_small(const cases::Case& c) {
    size_t vertices = 0;
    for (const cases::Draw& draw : c.draws) {
        vertices += draw.indices ? draw.indices->size() : draw.positions.size();
    }
    return c.target.width * c.target.height * c.target.samples <= 64U * 64U && vertices <= 1024;
}

size_t MatrixRow::file_count() const {
    size_t count = 0;
    for (const auto& [family, names] : files) {
        count += names.size();
    }
    return count;
}

std::string family_of(const cases::Case& c) {
    return c.id.substr(0, c.id.find('/'));
}

std::string file_of(const cases::Case& c) {
    return c.id.substr(0, c.id.find(':'));
}

std::vector<size_t> leaves_by_turn(std::span<const cases::Case> suite) {
    // Number in the file, number of the file in its family, number in the suite.
    std::vector<std::tuple<size_t, size_t, size_t>> order;
    std::map<std::string, size_t> leaves, files;
    for (size_t k = 0; k < suite.size(); ++k) {
        const size_t leaf = leaves[file_of(suite[k])]++;
        size_t& file = files[family_of(suite[k])];
        file += leaf == 0 ? 1 : 0;
        order.emplace_back(leaf, file, k);
    }
    std::sort(order.begin(), order.end());
    std::vector<size_t> out;
    for (const auto& [leaf, file, k] : order) {
        out.push_back(k);
    }
    return out;
}

void measure(std::span<const cases::Case> suite, std::span<const size_t> leaves,
             std::vector<MatrixRow>& rows, const std::function<bool(const MatrixRow&)>& asks,
             const std::function<void(const std::string&)>& alarm) {
    // In batches, so that what is asked does not hang on which thread was first.
    for (; leaves.size() > kBatch; leaves = leaves.subspan(kBatch)) {
        measure(suite, leaves.first(kBatch), rows, asks, alarm);
    }
    std::vector<size_t> asked;
    for (size_t r = 0; r < rows.size(); ++r) {
        if (asks(rows[r])) {
            asked.push_back(r);
        }
    }
    if (asked.empty()) {
        return;
    }
    std::vector<Fault> faults;
    std::map<Fault, MatrixRow*> row_of;
    for (const size_t r : asked) {
        faults.push_back(rows[r].fault);
        row_of[rows[r].fault] = &rows[r];
    }
    std::mutex mutex;
    for_each_parallel(leaves.size(), [&](size_t n) {
        const cases::Case& c = suite[leaves[n]];
        const auto note = [&](Fault fault, const diff::Verdict& verdict) {
            const std::lock_guard lock(mutex);
            MatrixRow& row = *row_of.at(fault);
            row.loosest = row.lines.empty() ? verdict.level : std::min(row.loosest, verdict.level);
            row.files[family_of(c)].insert(file_of(c));
            row.first_rule.emplace(file_of(c), verdict.findings.front().rule);
            row.lines.push_back(
                fmt::format("{}  {}", cases::to_string(verdict.level), describe(c, verdict)));
        };
        if (const auto wrong = try_faults(c, faults, note)) {
            const std::lock_guard lock(mutex);
            alarm(describe(c, *wrong));
        }
    });
}

}  // namespace mutants
