// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cases/load/loader.hpp"
#include "diff/delivered/delivered.hpp"
#include "queries.hpp"
#include "random_scene.hpp"
#include "scene_text.hpp"
#include "wrong_picture.hpp"

namespace histories {

namespace {

using cases::Profile;

// A case of a seed, and what is expected of it.
class Trial {
  public:
    Trial(uint64_t seed, Tally& tally) : random(seed), seed_(seed), tally_(tally) {
        scene = random_scene(random);
        auto loaded = cases::load_text(text_of(scene), "histories.toml", "histories");
        if (!loaded) {
            tally.contradictions.push_back(fmt::format("seed {}: not loaded: {}\n{}", seed,
                                                       cases::to_string(loaded.error()[0]),
                                                       text_of(scene)));
            return;
        }
        case_ = std::move(loaded->at(0));
        ++tally.scenes;
    }

    bool is_loaded() const { return case_.has_value(); }

    diff::Verdict judge(const Planes& planes, const std::vector<Shown>& picture,
                        const std::vector<uint64_t>& counted, Profile profile) {
        auto& expectation = expectations_[static_cast<size_t>(profile)];
        if (!expectation) {
            expectation = ref::expect(*case_, ref::Limits{8}, profile);
        }
        if (planes.is_whole) {
            return diff::compare(*case_, *expectation,
                                 captured(scene, case_->target, picture, counted));
        }
        return diff::compare_delivered(*case_, *expectation, delivered(scene, planes, picture));
    }

    void contradict(const std::string& what, Profile profile, const Planes& planes,
                    const std::vector<Shown>& picture, const diff::Verdict& verdict) {
        std::string out = fmt::format("seed {}: {} at {}; planes: {}\n", seed_, what,
                                      to_string(profile), names_of(planes));
        for (const diff::Finding& f : verdict.findings) {
            out += fmt::format(
                "  finding at ({},{}) sample {} layer {}: {} {} [{}] {}: expected "
                "{}, got {}; {}\n",
                f.x, f.y, f.sample, f.layer.value_or(0), to_string(f.kind), f.rule,
                to_string(f.level), f.quantity, f.expected, f.got, f.why);
        }
        for (size_t i = 0; i < picture.size(); ++i) {
            const Place p = place_of(scene, i);
            out += fmt::format("  ({},{}) sample {} layer {}:{}\n", p.x, p.y, p.sample, p.layer,
                               text_of(scene, planes, picture[i]));
        }
        tally_.contradictions.push_back(out + text_of(scene));
    }

    Scene scene;
    Random random;

  private:
    uint64_t seed_;
    Tally& tally_;
    std::optional<cases::Case> case_;
    std::array<std::optional<ref::Expectation>, 3> expectations_;
};

}  // namespace

void try_right(uint64_t seed, bool every_subset, Tally& tally) {
    Trial trial(seed, tally);
    if (!trial.is_loaded()) {
        return;
    }
    const Profile strictest = cases::kProfiles[trial.random.of<uint32_t>({0, 1, 2, 2})];
    const std::vector<Seen> seen = picture_of(trial.scene, strictest, trial.random);
    const std::vector<Shown> picture = shown(seen);
    if (std::any_of(seen.begin(), seen.end(), [](const Seen& s) { return s.is_color_large; })) {
        ++tally.none;
        return;
    }
    std::vector<Planes> subsets = subsets_of(trial.scene);
    if (!every_subset) {
        subsets = {trial.random.chance(1, 6) ? whole_of(trial.scene) : trial.random.of(subsets)};
    } else {
        subsets.push_back(whole_of(trial.scene));
    }
    for (const Planes& planes : subsets) {
        for (const Profile profile : cases::kProfiles) {
            if (profile > strictest) {
                continue;
            }
            const diff::Verdict verdict =
                trial.judge(planes, picture, counted_of(trial.scene, seen), profile);
            if (!verdict.error.empty()) {
                tally.errors.push_back(fmt::format("seed {}: {}", seed, verdict.error));
            } else if (!verdict.ok()) {
                trial.contradict(
                    fmt::format("false accusation of a device of {}", to_string(strictest)),
                    profile, planes, picture, verdict);
                return;
            } else {
                ++tally.right[static_cast<size_t>(profile)];
            }
        }
    }
}

void try_wrong(uint64_t seed, Tally& tally) {
    Trial trial(seed, tally);
    if (!trial.is_loaded()) {
        return;
    }
    const auto right = picture_of(trial.scene, Profile::direct3d, trial.random);
    const auto wrong = wrong_picture(trial.scene, right, trial.random);
    if (!wrong) {
        ++tally.none;
        return;
    }
    const Place p = place_of(trial.scene, wrong->index);
    const std::string how =
        fmt::format("({},{}) sample {} layer {}, {}", p.x, p.y, p.sample, p.layer, wrong->how);
    for (const Profile profile : cases::kProfiles) {
        if (profile < wrong->loosest) {
            continue;
        }
        const diff::Verdict verdict =
            trial.judge(wrong->planes, wrong->picture, wrong->counted, profile);
        if (!verdict.error.empty()) {
            tally.errors.push_back(fmt::format("seed {}: {}", seed, verdict.error));
        } else if (verdict.ok()) {
            trial.contradict("hole: " + how, profile, wrong->planes, wrong->picture, verdict);
            return;
        } else if (verdict.level > wrong->loosest) {
            trial.contradict(fmt::format("wrong level, {} for {}: {}", to_string(verdict.level),
                                         to_string(wrong->loosest), how),
                             profile, wrong->planes, wrong->picture, verdict);
            return;
        } else {
            ++tally.wrong[static_cast<size_t>(profile)];
        }
    }
}

void try_fewer(uint64_t seed, Tally& tally) {
    Trial trial(seed, tally);
    if (!trial.is_loaded()) {
        return;
    }
    // Something that may be right or not.
    const Profile profile = cases::kProfiles[trial.random.below(3)];
    auto picture = shown(picture_of(trial.scene, profile, trial.random));
    const auto other = shown(picture_of(trial.scene, Profile::vulkan, trial.random));
    const size_t index = trial.random.below(static_cast<uint32_t>(picture.size()));
    const Shown right = picture[index];
    for (size_t p = 0; p < kPlaneCount; ++p) {
        // What fragments leave is looked at where hits or writers do not tell that there was none.
        const bool is_alike = p >= kDepth || is_hit(other[index][p]) == is_hit(right[p]);
        picture[index][p] = (is_alike && trial.random.chance(1, 2) ? other[index] : right)[p];
    }
    std::vector<Planes> subsets = subsets_of(trial.scene);
    const Planes planes = trial.random.of(subsets);
    if (!trial.judge(planes, picture, {}, profile).ok()) {
        ++tally.wrong[static_cast<size_t>(profile)];
        return;
    }
    std::erase_if(subsets, [&](const Planes& fewer) { return !is_part(fewer, planes); });
    const Planes fewer = trial.random.of(subsets);
    const diff::Verdict verdict = trial.judge(fewer, picture, {}, profile);
    if (!verdict.error.empty()) {
        tally.errors.push_back(fmt::format("seed {}: {}", seed, verdict.error));
    } else if (!verdict.ok()) {
        trial.contradict("wrong with fewer planes than " + names_of(planes), profile, fewer,
                         picture, verdict);
    } else {
        ++tally.right[static_cast<size_t>(profile)];
    }
}

}  // namespace histories
