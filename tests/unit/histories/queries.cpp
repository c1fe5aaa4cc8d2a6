// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "queries.hpp"

#include <algorithm>

namespace histories {

namespace {

struct Bounds {
    uint64_t least = 0, most = 0;
};

// How many fragments of a draw pass at a sample, in any history that shows it. Counts are sums of
// samples: what the samples of a pixel decide together is not asked of them.
Bounds bounds_at(const Scene& scene, const Freedom& freedom, size_t draw,
                 const std::vector<Shown>& picture, size_t index) {
    std::optional<Bounds> out;
    const Place place = place_of(scene, index);
    for (const Kept& kept : decisions_of(scene, place, freedom)) {
        for (const Seen& seen : histories_of(scene, place, freedom, kept)) {
            if (shows(scene, whole_of(scene), picture[index], seen)) {
                const uint64_t count = seen.counted[draw];
                out = out ? Bounds{std::min(out->least, count), std::max(out->most, count)}
                          : Bounds{count, count};
            }
        }
    }
    return out.value();
}

Bounds bounds_of(const Scene& scene, cases::Profile profile, size_t draw,
                 const std::vector<Shown>& picture) {
    const Freedom freedom{profile, false, 0};
    Bounds all;
    for (size_t index = 0; index < picture.size(); ++index) {
        const Bounds one = bounds_at(scene, freedom, draw, picture, index);
        all = {all.least + one.least, all.most + one.most};
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
