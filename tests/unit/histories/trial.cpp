// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "trial.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "judge.hpp"
#include "queries.hpp"
#include "random_scene.hpp"
#include "scene_text.hpp"
#include "shrink.hpp"
#include "wrong_picture.hpp"

namespace histories {

namespace {

using cases::Profile;

// What is told of a picture that the judge is wrong about.
std::string told(const Scene& scene, const Planes& planes, const std::vector<Shown>& picture,
                 const diff::Verdict& verdict) {
    std::string out = "planes: " + names_of(planes) + "\n";
    for (const diff::Finding& f : verdict.findings) {
        out += fmt::format(
            "  finding at ({},{}) sample {} layer {}: {} {} [{}] {}: expected {}, got {}; {}\n",
            f.x, f.y, f.sample, f.layer.value_or(0), to_string(f.kind), f.rule, to_string(f.level),
            f.quantity, f.expected, f.got, f.why);
    }
    for (size_t i = 0; i < picture.size(); ++i) {
        const Place p = place_of(scene, i);
        out += fmt::format("  ({},{}) sample {} layer {}:{}\n", p.x, p.y, p.sample, p.layer,
                           text_of(scene, planes, picture[i]));
    }
    return out + text_of(scene);
}

// A case of a seed, before the judge.
class Trial : public Judge {
  public:
    Trial(uint64_t seed, Tally& tally) : Trial(seed, Random(seed), tally) {}

    void contradict(const std::string& what, Profile profile, const Planes& planes,
                    const std::vector<Shown>& picture, const diff::Verdict& verdict) {
        tally_.contradictions.push_back(fmt::format("seed {}: {} at {}; {}", seed_, what,
                                                    to_string(profile),
                                                    told(scene, planes, picture, verdict)));
    }

    Scene scene;
    Random random;

  private:
    uint64_t seed_;
    Tally& tally_;

    Trial(uint64_t seed, Random&& numbers, Tally& tally)
        : Trial(seed, random_scene(numbers), numbers, tally) {}
    Trial(uint64_t seed, const Scene& made, const Random& numbers, Tally& tally)
        : Judge(made), scene(made), random(numbers), seed_(seed), tally_(tally) {
        tally.scenes += error().empty() ? 1U : 0U;
        if (!error().empty()) {
            tally.contradictions.push_back(
                fmt::format("seed {}: not loaded: {}\n{}", seed, error(), text_of(scene)));
        }
    }
};

// A smaller scene of which the same sample is as wrongly judged, in words.
std::string smaller(const Scene& scene, const WrongPicture& wrong, Profile profile, bool is_level) {
    const auto try_one = [&](const Finding& f) -> std::string {
        Judge judge(f.scene);
        if (!judge.error().empty()) {
            return "";
        }
        Random random(1);
        const auto right = picture_of(f.scene, Profile::direct3d, random);
        auto picture = shown(right);
        picture.at(wrong.index) = f.sample;
        if (is_allowed(f.scene, wrong.loosest, f.planes, picture, wrong.index)) {
            return "";
        }
        const auto verdict = judge.judge(f.planes, picture, counted_of(f.scene, right), profile);
        const bool is_still =
            verdict.error.empty() && (is_level ? verdict.level > wrong.loosest : verdict.ok());
        return is_still ? told(f.scene, f.planes, picture, verdict) : "";
    };
    const Finding whole{scene, wrong.planes, wrong.picture[wrong.index]};
    const Finding small = shrunk(whole, [&](const Finding& f) { return !try_one(f).empty(); });
    return "\nsmaller: " + try_one(small);
}

// A smaller scene with a wrong count that passes, in words.
std::string smaller_of_count(const Scene& scene, Profile profile) {
    const auto try_one = [&](const Finding& f) -> std::string {
        Judge judge(f.scene);
        for (uint64_t seed = 0; seed < 60 && judge.error().empty(); ++seed) {
            Random random(seed);
            const auto right = picture_of(f.scene, Profile::direct3d, random);
            const auto wrong = wrong_count(f.scene, right, random);
            if (!wrong || wrong->loosest > profile) {
                continue;
            }
            const auto verdict = judge.judge(f.planes, shown(right), wrong->counted, profile);
            if (verdict.error.empty() && verdict.ok()) {
                return fmt::format("draw {} counts {} for {} at {}; ", wrong->draw,
                                   wrong->counted[wrong->draw],
                                   counted_of(f.scene, right)[wrong->draw],
                                   to_string(wrong->loosest)) +
                       told(f.scene, f.planes, shown(right), verdict);
            }
        }
        return "";
    };
    const Finding small = shrunk({scene, whole_of(scene), shown(Seen{})},
                                 [&](const Finding& f) { return !try_one(f).empty(); });
    return "\nsmaller: " + try_one(small);
}

// The same of a right picture that fails.
std::string smaller_right(const Scene& scene, const Planes& planes, Profile strictest,
                          Profile profile) {
    const auto try_one = [&](const Finding& f) -> std::string {
        Judge judge(f.scene);
        for (uint64_t seed = 0; seed < 60 && judge.error().empty(); ++seed) {
            Random random(seed);
            const auto right = picture_of(f.scene, strictest, random);
            const auto verdict =
                judge.judge(f.planes, shown(right), counted_of(f.scene, right), profile);
            if (verdict.error.empty() && !verdict.ok()) {
                return told(f.scene, f.planes, shown(right), verdict);
            }
        }
        return "";
    };
    const Finding small = shrunk({scene, planes, shown(Seen{})},
                                 [&](const Finding& f) { return !try_one(f).empty(); });
    return "\nsmaller: " + try_one(small);
}

}  // namespace

void try_right(uint64_t seed, bool every_subset, Tally& tally) {
    Trial trial(seed, tally);
    if (!trial.error().empty()) {
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
                if (tally.shrinks) {
                    tally.contradictions.back() +=
                        smaller_right(trial.scene, planes, strictest, profile);
                }
                return;
            } else {
                ++tally.right[static_cast<size_t>(profile)];
            }
        }
    }
}

void try_wrong(uint64_t seed, Tally& tally) {
    Trial trial(seed, tally);
    if (!trial.error().empty()) {
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
        const bool is_level = !verdict.ok() && verdict.level > wrong->loosest;
        if (!verdict.error.empty()) {
            tally.errors.push_back(fmt::format("seed {}: {}", seed, verdict.error));
        } else if (verdict.ok() || is_level) {
            const std::string what =
                is_level ? fmt::format("wrong level, {} for {}: ", to_string(verdict.level),
                                       to_string(wrong->loosest))
                         : "hole: ";
            trial.contradict(what + how, profile, wrong->planes, wrong->picture, verdict);
            if (tally.shrinks) {
                tally.contradictions.back() +=
                    is_allowed(trial.scene, wrong->loosest, wrong->planes, wrong->picture,
                               wrong->index)
                        ? smaller_of_count(trial.scene, profile)
                        : smaller(trial.scene, *wrong, profile, is_level);
            }
            return;
        } else {
            ++tally.wrong[static_cast<size_t>(profile)];
        }
    }
}

void try_fewer(uint64_t seed, Tally& tally) {
    Trial trial(seed, tally);
    if (!trial.error().empty()) {
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
