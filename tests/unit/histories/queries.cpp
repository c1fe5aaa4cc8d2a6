// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "queries.hpp"

#include <algorithm>

namespace histories {

namespace {

struct Bounds {
    uint64_t least = 0, most = 0;
};

// How many fragments of a draw pass at samples `first` to `last`, in any history that shows them.
std::optional<Bounds> bounds_of(const Scene& scene, const Freedom& freedom, const Kept& kept,
                                size_t draw, const std::vector<Shown>& picture, size_t first,
                                size_t last) {
    Bounds all;
    for (size_t i = first; i < last; ++i) {
        std::optional<Bounds> one;
        for (const Seen& seen : histories_of(scene, place_of(scene, i), freedom, kept)) {
            if (shows(scene, whole_of(scene), picture[i], seen)) {
                const uint64_t count = seen.counted[draw];
                one = one ? Bounds{std::min(one->least, count), std::max(one->most, count)}
                          : Bounds{count, count};
            }
        }
        if (!one) {
            return std::nullopt;
        }
        all = {all.least + one->least, all.most + one->most};
    }
    return all;
}

Bounds bounds_of(const Scene& scene, cases::Profile profile, size_t draw,
                 const std::vector<Shown>& picture) {
    const Freedom freedom{profile, false, 0};
    const size_t step = is_shared(scene, freedom) ? scene.samples : 1;
    Bounds all;
    for (size_t first = 0; first < picture.size(); first += step) {
        std::optional<Bounds> unit;
        for (const Kept& kept : decisions_of(scene, place_of(scene, first), freedom)) {
            const auto some = bounds_of(scene, freedom, kept, draw, picture, first, first + step);
            if (some) {
                unit = unit ? Bounds{std::min(unit->least, some->least),
                                     std::max(unit->most, some->most)}
                            : *some;
            }
        }
        all = {all.least + unit.value().least, all.most + unit.value().most};
    }
    return all;
}

}  // namespace

std::vector<uint64_t> counted_of(const Scene& scene, const std::vector<Seen>& picture) {
    std::vector<uint64_t> counted(scene.has_query() ? scene.draws.size() : 0);
    for (size_t draw = 0; draw < counted.size(); ++draw) {
        for (const Seen& seen : picture) {
            counted[draw] += scene.draws[draw].query != Query::none ? seen.counted[draw] : 0;
        }
        if (scene.draws[draw].query == Query::occlusion) {
            counted[draw] = std::min<uint64_t>(counted[draw], 1);
        }
    }
    return counted;
}

std::optional<WrongCount> wrong_count(const Scene& scene, const std::vector<Seen>& picture,
                                      Random& random) {
    WrongCount out{counted_of(scene, picture), 0, {}};
    if (out.counted.empty()) {
        return std::nullopt;
    }
    do {
        out.draw = random.below(static_cast<uint32_t>(scene.draws.size()));
    } while (scene.draws[out.draw].query == Query::none);
    uint64_t& count = out.counted[out.draw];
    const bool is_precise = scene.draws[out.draw].query == Query::precise;
    if (!is_precise) {
        count = 1 - count;
    } else {
        count = count > 0 && random.chance(1, 2) ? count - 1 : count + 1 + random.below(3);
    }
    for (const cases::Profile profile : cases::kProfiles) {
        const Bounds bounds = bounds_of(scene, profile, out.draw, shown(picture));
        const bool is_wrong = is_precise   ? count < bounds.least || count > bounds.most
                              : count == 0 ? bounds.least > 0
                                           : bounds.most == 0;
        if (is_wrong) {
            out.loosest = profile;
            return out;
        }
    }
    return std::nullopt;
}

}  // namespace histories
