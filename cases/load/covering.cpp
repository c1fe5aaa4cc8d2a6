// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/covering.hpp"

#include <algorithm>

namespace cases {

namespace {

// How often each pair of values has been chosen. Pairs are counted through: those of the axes 0 and
// 1 first, then 0 and 2, ...
class Pairs {
  public:
    explicit Pairs(std::span<const size_t> sizes) : sizes_(sizes) {
        for (size_t j = 1; j < sizes.size(); ++j) {
            for (size_t i = 0; i < j; ++i) {
                couples_.push_back({i, j, missing_});
                missing_ += sizes[i] * sizes[j];
            }
        }
        chosen_.assign(missing_, 0);
    }

    size_t missing() const { return missing_; }
    // So many pairs does a combination have.
    size_t couples() const { return couples_.size(); }

    // What a combination has: pairs that are missing, and how often its pairs were chosen.
    struct Gain {
        size_t missing = 0, chosen = 0;
    };
    Gain gain(size_t combination) {
        read(combination);
        Gain gain;
        for (const Couple& couple : couples_) {
            const size_t times = chosen_[index(couple)];
            gain.chosen += times;
            if (times == 0) {
                ++gain.missing;
            }
        }
        return gain;
    }

    void choose(size_t combination) {
        read(combination);
        for (const Couple& couple : couples_) {
            if (chosen_[index(couple)]++ == 0) {
                --missing_;
            }
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
    std::vector<size_t> values_;  // of the combination that is looked at
    std::vector<size_t> chosen_;
    size_t missing_ = 0;
};

}  // namespace

std::vector<size_t> cover_pairs(std::span<const size_t> sizes) {
    size_t product = 1;
    for (const size_t size : sizes) {
        product *= size;
    }
    Pairs pairs(sizes);
    std::vector<size_t> chosen = {0};
    pairs.choose(0);
    if (product > 1) {
        chosen.push_back(product - 1);
        pairs.choose(product - 1);
    }
    // What a combination had missing when it was last looked at; it cannot have more now.
    std::vector<size_t> most(product, pairs.couples());
    while (pairs.missing() > 0) {
        size_t best = 0;
        Pairs::Gain best_gain;
        for (size_t combination = 0; combination < product; ++combination) {
            if (most[combination] < best_gain.missing || most[combination] == 0) {
                continue;
            }
            const Pairs::Gain gain = pairs.gain(combination);
            most[combination] = gain.missing;
            if (gain.missing > best_gain.missing ||
                (gain.missing == best_gain.missing && gain.chosen < best_gain.chosen)) {
                best = combination;
                best_gain = gain;
            }
        }
        chosen.push_back(best);
        pairs.choose(best);
    }
    std::ranges::sort(chosen);
    return chosen;
}

}  // namespace cases
