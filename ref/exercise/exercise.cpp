// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/exercise.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "cases/fault/change.hpp"
#include "ref/blit/blit.hpp"
#include "ref/exercise/exercise_table.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/onlooker.hpp"

namespace ref {

namespace {

using cases::Profile;

// A rule that the case claims, and the samples found so far.
class Claim {
  public:
    Claim(const ExerciseRow* row, size_t samples, Count count)
        : row_(row), is_counting_(count == Count::all), found_(is_counting_ ? samples : 0) {}
    const ExerciseRow& row() const { return *row_; }
    bool is_done() const { return !is_counting_ && count_ > 0; }
    bool has(size_t index) const { return is_counting_ && found_[index]; }
    void add(size_t index) {
        if (is_counting_ && !found_[index]) {
            found_[index] = true;
        }
        ++count_;
    }
    uint64_t count() const { return count_; }
    bool is_counting() const { return is_counting_; }
    bool is_least = false;  // some samples were passed over

  private:
    const ExerciseRow* row_;
    bool is_counting_;
    std::vector<bool> found_;
    uint64_t count_ = 0;
};

// Runs the tests of one profile.
class Looks : public Onlooker {
  public:
    Looks(CaseFacts& facts, std::vector<Claim>& claims, Profile profile) : facts_(facts) {
        for (Claim& claim : claims) {
            for (const Way& way : claim.row().ways) {
                if (way.test != nullptr && way.profile == profile && !claim.is_done()) {
                    looks_.push_back({&claim, &way});
                }
            }
        }
    }
    bool is_needed() const { return !looks_.empty(); }
    bool look(const JudgedSample& sample, TriangleSetups& setups) override {
        const View view{facts_, sample, setups};
        std::erase_if(looks_, [](const Test& test) { return test.claim->is_done(); });
        for (const Test& test : looks_) {
            if (!test.claim->is_done() && !test.claim->has(sample.index) &&
                test.way->test(view, test.claim->row().rule)) {
                test.claim->add(sample.index);
            }
        }
        return !looks_.empty();
    }

  private:
    struct Test {
        Claim* claim;
        const Way* way;
    };
    CaseFacts& facts_;
    std::vector<Test> looks_;
};

// Comparing numbers takes rationals: of a case with more samples not all are looked at where they
// are counted.
constexpr size_t kMostCompared = 4096;

// So many samples are gone on by: an odd number, so that all columns are visited.
size_t step_of(const Way& way, size_t samples, bool is_counting) {
    const bool is_dear = way.differ == Differ::values || way.differ == Differ::depths;
    return is_dear && is_counting && samples > kMostCompared ? (samples / kMostCompared) | 1U : 1;
}

// Looks for samples that tell the case from what wrong devices make of it.
void look_for_differences(Original& original, Claim& claim) {
    for (const Way& way : claim.row().ways) {
        cases::Case other = original.of();
        if (claim.is_done() || !cases::take_with(way.fault, other)) {
            continue;
        }
        Difference difference(original, std::move(other), way.differ, claim.row().rule);
        const size_t samples = original.expected().samples.size();
        const size_t step = step_of(way, samples, claim.is_counting());
        claim.is_least = claim.is_least || step > 1;
        for (size_t k = 0; k < samples && !claim.is_done(); k += step) {
            if (!claim.has(k) && difference.shows(k)) {
                claim.add(k);
            }
        }
    }
}

void look_at_texels(const cases::Case& c, std::vector<Claim>& claims) {
    const BlitReference reference(c);
    for (Claim& claim : claims) {
        const ExerciseRow& row = claim.row();
        for (const Way& way : row.ways) {
            if (way.texels == Way::Texels::none || !row.is_about(*c.blit)) {
                continue;
            }
            for (uint32_t y = 0; y < c.target.height && !claim.is_done(); ++y) {
                for (uint32_t x = 0; x < c.target.width && !claim.is_done(); ++x) {
                    if (reference.is_inside(x, y) == (way.texels == Way::Texels::inside)) {
                        claim.add(size_t{y} * c.target.width + x);
                    }
                }
            }
        }
    }
}

void look_at_samples(const cases::Case& c, const Limits& limits, std::vector<Claim>& claims,
                     Exercise& out) {
    std::optional<Expectation> expected;  // at direct3d
    std::optional<Original> original;
    if (!c.target.has_instruments) {
        expected = expect(c, limits, Profile::direct3d);
        original.emplace(c, *expected);
        if (c.target.color) {
            out.draws = sights_of_draws(*original);
        }
    }
    CaseFacts facts(c, limits, c.target.has_instruments ? nullptr : &original->shown());
    for (size_t k = 0; k < std::size(cases::kProfiles); ++k) {
        const Profile profile = cases::kProfiles[k];
        Looks looks(facts, claims, profile);
        if (profile == Profile::direct3d && expected && !looks.is_needed()) {
            out.must_samples[k] = expected->must_samples;
            continue;
        }
        Expectation of_profile = expect(c, limits, profile, looks.is_needed() ? &looks : nullptr);
        out.must_samples[k] = of_profile.must_samples;
        if (profile == Profile::direct3d && !expected) {
            expected = std::move(of_profile);
        }
    }
    out.free_samples = expected->either_samples;
    if (!original) {
        original.emplace(c, *expected);
    }
    for (Claim& claim : claims) {
        look_for_differences(*original, claim);
    }
}

}  // namespace

std::string_view exercise_of(std::string_view rule) {
    const ExerciseRow* row = find_exercise(rule);
    return row == nullptr ? std::string_view{} : row->how;
}

Exercise exercise(const cases::Case& c, const Limits& limits, std::span<const std::string> rules,
                  Count count) {
    Exercise out;
    out.samples = uint64_t{c.target.width} * c.target.rows() * c.target.samples;
    std::vector<Claim> claims;
    for (const std::string& rule : rules) {
        if (const ExerciseRow* row = find_exercise(rule)) {
            claims.emplace_back(row, out.samples, count);
        }
    }
    if (c.blit) {
        look_at_texels(c, claims);
    } else {
        look_at_samples(c, limits, claims, out);
    }
    for (const Claim& claim : claims) {
        out.rules.push_back({claim.row().rule, claim.count(), claim.is_least});
    }
    return out;
}

}  // namespace ref
