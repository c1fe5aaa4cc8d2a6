// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/change/changed_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "cases/load/matrix.hpp"
#include "cases/write/to_toml.hpp"

namespace fuzz {

namespace {

// Streams of the dice; generated cases take 1 to 3.
constexpr uint64_t kOrderStream = 4, kGroupStream = 5, kNumberStream = 6;
constexpr int kTries = 8;        // of a number or a group, until the loader takes one
constexpr int kMostChanges = 3;  // of a number
constexpr int kRolls = 6;        // of a change, until it finds what it changes

// The case as a document of its own: without what a file says of it and what it no longer is.
// Nothing if it is too large to be written.
Document document_of(cases::Case c) {
    c.claim.catches.clear();
    c.claim.links.clear();
    c.claim.expected_hits.reset();
    return cases::to_tree(c).value_or(Document());
}

Source::Made made_of(Document document, const std::string& description, uint64_t number) {
    set(document, "description", text(description));
    Source::Made made;
    made.text = to_text(document);
    made.data = load_one(document, std::to_string(number));
    return made;
}

void add(Words& words, const Words& more) {
    words += (words.empty() || more.empty() ? "" : "; ") + more;
}

// The file with one value for each name: of the matrix those of the leaf.
Document closed(const Start& start, const std::vector<std::pair<std::string, Document>>& values) {
    Document document = *start.open;
    Document matrix = table();
    if (const auto read = cases::read_matrix(document.find("matrix"), document.find("leaves"))) {
        for (const auto& [key, text] : start.data.claim.parameters) {
            for (const cases::Matrix::Axis& axis : read->axes) {
                for (size_t v = 0; axis.key == key && v < axis.values.size(); ++v) {
                    if (axis.texts[v] == text) {
                        set(matrix, key, list({*axis.values[v]}));
                    }
                }
            }
        }
    }
    for (const auto& [key, value] : values) {
        set(matrix, key, list({value}));
    }
    for (const char* key : {"fuzz", "leaves", "expect"}) {
        erase(document, key);
    }
    set(document, "matrix", std::move(matrix));
    return document;
}

// What the loader says of the file with one value for a name and the nominal ones for the others;
// nothing if it takes it.
std::optional<std::string> refusal(const Start& start, const std::vector<cases::OpenName>& names,
                                   const cases::OpenName& asked, uint64_t number) {
    std::vector<std::pair<std::string, Document>> values;
    for (const cases::OpenName& name : names) {
        values.emplace_back(name.key, name.value(name.key == asked.key ? number : name.nominal));
    }
    const auto loaded = cases::load_tree(closed(start, values), "open");
    return loaded ? std::nullopt : std::optional(loaded.error().front().message);
}

}  // namespace

cases::Errors check_open_values(const std::vector<Start>& leaves) {
    constexpr uint64_t kMostTried = 64;  // of a list
    cases::Errors errors;
    const Document& document = *leaves.front().open;
    const auto matrix = cases::read_matrix(document.find("matrix"), document.find("leaves"));
    const auto names = matrix ? cases::read_open(document.find("fuzz"), *matrix)
                              : cases::ExpectedAll<std::vector<cases::OpenName>>();
    for (const cases::OpenName& name : names ? *names : std::vector<cases::OpenName>()) {
        std::vector<uint64_t> tried = {0, name.count - 1};  // the ends of a range
        if (!name.list.empty()) {
            tried.resize(std::min(name.count, kMostTried));
            std::iota(tried.begin(), tried.end(), uint64_t{0});
        }
        for (const uint64_t number : tried) {
            std::optional<std::string> why;
            for (const Start& leaf : leaves) {
                why = refusal(leaf, *names, name, number);
                if (!why) {
                    break;
                }
            }
            if (why) {
                errors.push_back(
                    {name.where,
                     fmt::format("with the value {} of the [fuzz] key {} no case can be loaded: {}",
                                 cases::value_text(name.value(number)).value_or("?"), name.key,
                                 *why)});
            }
        }
    }
    return errors;
}

ChangedSource::ChangedSource(uint64_t seed, Starts starts)
    : seed_(seed), starts_(std::move(starts)), order_(starts_->size()) {}

// Each start in turn, in another order each time.
const Start& ChangedSource::start_of(uint64_t group) {
    const uint64_t count = order_.size();
    if (cycle_ != group / count) {
        cycle_ = group / count;
        std::iota(order_.begin(), order_.end(), size_t{0});
        Dice dice(seed_, kOrderStream, cycle_);
        for (size_t k = order_.size(); k > 1; --k) {
            std::swap(order_[k - 1], order_[dice.below(k)]);
        }
    }
    return (*starts_)[order_[group % count]];
}

void ChangedSource::enter(uint64_t group) {
    start_ = &start_of(group);
    document_ = other_ = {};
    words_.clear();
    refused_ = 0;
    open_.clear();
    if (start_->open) {
        const auto matrix =
            cases::read_matrix(start_->open->find("matrix"), start_->open->find("leaves"));
        if (matrix) {
            open_ = cases::read_open(start_->open->find("fuzz"), *matrix)
                        .value_or(std::vector<cases::OpenName>());
        }
        return;
    }
    document_ = document_of(start_->data);
    if (document_.table.empty()) {
        return;
    }
    Dice dice(seed_, kGroupStream, group);
    other_ = document_of((*starts_)[dice.below(starts_->size())].data);
    const uint64_t changes = dice.below(3);
    for (int tries = 0; changes > 0 && tries < kTries; ++tries) {
        Document changed = document_;
        Words words;
        for (uint64_t k = 0; k < changes; ++k) {
            Words one;
            for (int roll = 0; one.empty() && roll < kRolls; ++roll) {
                one = change_state(changed, dice, other_.table.empty() ? nullptr : &other_);
            }
            add(words, one);
        }
        if (!words.empty() && load_one(changed, "group")) {
            document_ = std::move(changed);
            words_ = std::move(words);
            return;
        }
        ++refused_;
    }
}

Source::Made ChangedSource::make(uint64_t number) const {
    Made made = start_->open ? make_open(number) : make_change(number);
    made.refused += number % group_size() == 0 ? refused_ : 0;
    if (!made.data) {
        made.text.clear();
    }
    return made;
}

Source::Made ChangedSource::make_change(uint64_t number) const {
    Made made;
    if (document_.table.empty()) {
        return made;
    }
    Dice dice(seed_, kNumberStream, number);
    for (int tries = 0; tries < kTries; ++tries) {
        Document changed = document_;
        Words words = words_;
        // What the group has in common is drawn once without anything else.
        const bool is_plain = tries == 0 && !words_.empty() && number % group_size() == 0;
        const int64_t changes = is_plain ? 0 : dice.between(1, kMostChanges);
        for (int64_t k = 0; k < changes; ++k) {
            Words one;
            for (int roll = 0; one.empty() && roll < kRolls; ++roll) {
                one = change_geometry(changed, dice, other_.table.empty() ? nullptr : &other_);
            }
            add(words, one);
        }
        if (words.empty()) {
            continue;
        }
        const uint64_t refused = made.refused;
        made = made_of(std::move(changed),
                       fmt::format("Made by edgecase fuzz of {}: {}.", start_->data.id, words),
                       number);
        made.refused = refused + (made.data ? 0 : 1);
        if (made.data) {
            break;
        }
    }
    return made;
}

Source::Made ChangedSource::make_open(uint64_t number) const {
    Made made;
    Dice dice(seed_, kNumberStream, number);
    for (int tries = 0; tries < kTries; ++tries) {
        std::vector<std::pair<std::string, Document>> values;
        Words words;
        for (const cases::OpenName& name : open_) {
            Document value = name.value(dice.below(name.count));
            add(words, fmt::format("{} = {}", name.key, cases::value_text(value).value_or("?")));
            values.emplace_back(name.key, std::move(value));
        }
        const uint64_t refused = made.refused;
        if (auto c = load_one(closed(*start_, values), std::to_string(number))) {
            if (Document document = document_of(std::move(*c)); !document.table.empty()) {
                made =
                    made_of(std::move(document),
                            fmt::format("Made by edgecase fuzz of {}: {}.", start_->data.id, words),
                            number);
            }
        }
        made.refused = refused + (made.data ? 0 : 1);
        if (made.data) {
            break;
        }
    }
    return made;
}

}  // namespace fuzz
