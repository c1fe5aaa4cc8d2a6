// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/expected_hits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "cases/select/selector.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

// One picture of the target; appends its rows. False: told what is wrong with it.
bool read_picture(LeafContext& context, const TomlValue& value, const std::string& name,
                  const Target& target, std::vector<std::string>& rows) {
    const std::optional<std::string> text = context.text(value, name);
    if (!text) {
        return false;
    }
    const size_t first = rows.size();
    for (size_t start = 0; start < text->size();) {
        const size_t end = std::min(text->find('\n', start), text->size());
        std::string row = text->substr(start, end - start);
        if (!row.empty() && row.back() == '\r') {
            row.pop_back();
        }
        rows.push_back(std::move(row));
        start = end + 1;
    }
    const size_t count = rows.size() - first;
    if (count != target.height) {
        context.error(value.where, fmt::format("{} has {} rows, but the target is {} pixels high",
                                               name, count, target.height));
        return false;
    }
    for (size_t j = 0; j < count; ++j) {
        const std::string& row = rows[first + j];
        if (row.size() != target.width) {
            context.error(value.where,
                          fmt::format("row {} of {} has {} characters, but the target is {} "
                                      "pixels wide",
                                      j, name, row.size(), target.width));
            return false;
        }
        const size_t odd = row.find_first_not_of(".123456789?");
        if (odd != std::string::npos) {
            context.error(value.where, fmt::format("column {} of row {} of {} is not ., 1 to 9 "
                                                   "or ?",
                                                   odd, j, name));
            return false;
        }
    }
    return true;
}

std::optional<ExpectedHits> read_hits(LeafContext& context, const TomlValue& table,
                                      const std::string& what, const Target& target) {
    context.known_keys(table, kExpectKeys, what);
    const TomlValue* hits = table.find("hits");
    if (hits == nullptr) {
        context.error(table.where, what + " has no hits; draw one row a pixel row");
        return std::nullopt;
    }
    ExpectedHits expected{{}, hits->where};
    const uint32_t pictures = target.samples * target.layers;
    if (pictures == 1) {
        return read_picture(context, *hits, "hits", target, expected.rows)
                   ? std::optional(std::move(expected))
                   : std::nullopt;
    }
    if (!hits->is(Kind::array) || hits->array.size() != pictures) {
        context.error(
            hits->where,
            target.layers == 1
                ? fmt::format("the target has {} samples a pixel, so hits is an array of {} "
                              "pictures, sample 0 first",
                              target.samples, pictures)
            : target.samples == 1
                ? fmt::format("the target has {} layers, so hits is an array of {} pictures, layer "
                              "0 first",
                              target.layers, pictures)
                : fmt::format("the target has {} layers of {} samples a pixel, so hits is an array "
                              "of {} pictures, all samples of layer 0 first",
                              target.layers, target.samples, pictures));
        return std::nullopt;
    }
    for (size_t s = 0; s < hits->array.size(); ++s) {
        if (!read_picture(context, hits->array[s], fmt::format("picture {} of hits", s), target,
                          expected.rows)) {
            return std::nullopt;
        }
    }
    return expected;
}

}  // namespace

void read_expectation(LeafContext& context, const TomlValue& root, const std::string& leaf,
                      Case& c) {
    const TomlValue* expect = root.find("expect");
    if (expect == nullptr || !context.table(*expect, "expect")) {
        return;
    }
    if (leaf.empty()) {
        c.claim.expected_hits = read_hits(context, *expect, "[expect]", c.target);
        return;
    }
    if (const TomlValue* table = expect->find(leaf); table != nullptr && table->is(Kind::table)) {
        c.claim.expected_hits =
            read_hits(context, *table, fmt::format("[expect.\"{}\"]", leaf), c.target);
    }
}

void check_expectation_keys(const TomlValue& root, const Matrix& matrix, Errors& errors) {
    const TomlValue* expect = root.find("expect");
    if (expect == nullptr || !expect->is(Kind::table) || matrix.axes.empty()) {
        return;
    }
    std::vector<std::string> leaves, left_out;
    for (size_t combination = 0; combination < matrix.size(); ++combination) {
        const bool is_leaf = std::ranges::binary_search(matrix.leaves, combination);
        (is_leaf ? leaves : left_out).push_back(matrix.text(combination));
    }
    for (const TomlEntry& entry : expect->table) {
        if (std::ranges::find(leaves, entry.key) != leaves.end()) {
            if (!entry.value.is(Kind::table)) {
                errors.push_back(
                    {entry.value.where, fmt::format("the expectation of {} is {}; write a table",
                                                    entry.key, describe(entry.value))});
            }
            continue;
        }
        if (std::ranges::find(left_out, entry.key) != left_out.end()) {
            const std::string nearest = nearest_name(entry.key, leaves);
            errors.push_back(
                {entry.where, fmt::format("the combination \"{}\" is left out by leaves; write "
                                          "[expect.\"{}\"] or another",
                                          entry.key, nearest.empty() ? leaves.front() : nearest)});
            continue;
        }
        errors.push_back({entry.where, no_leaf(entry.key, leaves,
                                               fmt::format("[expect.\"{}\"]", leaves.front()))});
    }
}

}  // namespace cases
