// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A pose is what a generated case has besides its geometry: the features whose change costs a
// driver a pipeline or an attachment. Many geometries are drawn with each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/generate/dice.hpp"

namespace fuzz {

// One dimension of the swarm. Value 0 is the case format's default.
struct Feature {
    std::string_view name;
    std::vector<std::string_view> values;
};
// All features, in a fixed order.
const std::vector<Feature>& features();

class Pose {
  public:
    Pose();  // all defaults
    // The value of a feature by its name, which must be one of features().
    std::string_view value(std::string_view feature) const;
    bool is(std::string_view feature, std::string_view value) const {
        return this->value(feature) == value;
    }
    bool is_default(std::string_view feature) const;
    void set(size_t feature, size_t value) { values_[feature] = value; }
    void set(std::string_view feature, size_t value);
    // (feature, value) of all that are no defaults.
    std::vector<std::pair<size_t, size_t>> active() const;
    std::string text() const;  // "samples=4 topology=triangle-fan"

  private:
    std::vector<size_t> values_;  // by index of features()
};

// Any value of a feature from the `first` one on, some more often than others.
size_t value_of(std::string_view feature, size_t first, Dice& dice);

// Of three poses the last one is bare (bare.hpp). Those of each kind have numbers of their own.
constexpr bool is_bare(uint64_t pose_number) {
    return pose_number % 3 == 2;
}
constexpr uint64_t number_of_kind(uint64_t pose_number) {
    return is_bare(pose_number) ? pose_number / 3 : 2 * (pose_number / 3) + pose_number % 3;
}

// The poses of a seed, one after the other: a few random features are switched on in each [Groce
// et al., "Swarm Testing", ISSTA 2012], and of some such candidates the one is taken with the most
// pairs of features that no earlier pose of its kind had. `is_valid` says which candidates are
// cases at all; it must depend on the pose alone, so that a seed means the same on every machine.
class Poses {
  public:
    explicit Poses(uint64_t seed) : seed_(seed) {}
    template <class IsValid>
    Pose next(IsValid&& is_valid) {
        Pose best;
        size_t most = 0;
        bool found = false;
        for (size_t k = 0; k < kCandidates || !found; ++k) {
            Pose candidate = draw(k);
            const size_t fresh = fresh_pairs(candidate);
            if ((!found || fresh > most) && is_valid(candidate)) {
                best = std::move(candidate);
                most = fresh;
                found = true;
            }
        }
        const std::optional<Pose> other = apart(best);
        take(best);
        return other && is_valid(*other) ? *other : best;
    }
    size_t count() const { return count_; }
    size_t pairs() const { return seen_[0].size() + seen_[1].size(); }

  private:
    static constexpr size_t kCandidates = 12;
    Pose draw(size_t candidate) const;
    static Pose blit(uint64_t number);
    uint64_t number() const { return number_of_kind(count_); }
    // Of some poses the same with what is drawn apart. It need not be a case.
    std::optional<Pose> apart(const Pose& pose) const;
    size_t fresh_pairs(const Pose& pose) const;
    void take(const Pose& pose);

    uint64_t seed_ = 0;
    size_t count_ = 0;
    std::array<std::set<std::pair<uint64_t, uint64_t>>, 2> seen_;  // of bare poses the second
};

}  // namespace fuzz
