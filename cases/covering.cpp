// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/covering.hpp"

#include <algorithm>

namespace cases {

namespace {

// Which pairs of values are still missing. Pairs are counted through: those of the axes 0 and 1
// first, then 0 and 2, ...
class MissingPairs {
  public:
    explicit MissingPairs(std::span<const size_t> sizes) : sizes_(sizes) {
        for (size_t j = 1; j < sizes.size(); ++j) {
            for (size_t i = 0; i < j; ++i) {
                couples_.push_back({i, j, total_});
                total_ += sizes[i] * sizes[j];
            }
        }
        is_missing_.assign(total_, true);
        left_ = total_;
    }

    size_t left() const { return left_; }
    // At most so many pairs does a combination have.
    size_t couples() const { return couples_.size(); }

    // Of those that the combination has.
    size_t count(size_t combination) {
        read(combination);
        size_t n = 0;
        for (const Couple& couple : couples_) {
            if (is_missing_[index(couple)]) {
                ++n;
            }
        }
        return n;
    }

    void cover(size_t combination) {
        read(combination);
        for (const Couple& couple : couples_) {
            if (is_missing_[index(couple)]) {
                --left_;
            }
            is_missing_[index(couple)] = false;
        }
    }

  private:
    struct Couple {
        size_t i, j;   // axes
        size_t start;  // of their pairs
    };

    void read(size_t combination) {
        values_.resize(sizes_.size());
        for (size_t i = sizes_.size(); i-- > 0;) {
            values_[i] = combination % sizes_[i];
            combination /= sizes_[i];
        }
    }
    size_t index(const Couple& couple) const {
        return couple.start + values_[couple.i] * sizes_[couple.j] + values_[couple.j];
    }

    std::span<const size_t> sizes_;
    std::vector<Couple> couples_;
    std::vector<bool> is_missing_;
    std::vector<size_t> values_;  // of the combination that is looked at
    size_t total_ = 0, left_ = 0;
};

}  // namespace

std::vector<size_t> cover_pairs(std::span<const size_t> sizes) {
    size_t product = 1;
    for (const size_t size : sizes) {
        product *= size;
    }
    MissingPairs missing(sizes);
    std::vector<size_t> chosen = {0};
    missing.cover(0);
    if (product > 1) {
        chosen.push_back(product - 1);
        missing.cover(product - 1);
    }
    // What a combination had missing when it was last looked at; it cannot have more now.
    std::vector<size_t> most(product, missing.couples());
    while (missing.left() > 0) {
        size_t best = 0, best_count = 0;
        for (size_t combination = 0; combination < product; ++combination) {
            if (most[combination] <= best_count) {
                continue;
            }
            most[combination] = missing.count(combination);
            if (most[combination] > best_count) {
                best = combination;
                best_count = most[combination];
            }
        }
        chosen.push_back(best);
        missing.cover(best);
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace cases
