// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "wrong_picture.hpp"

#include <fmt/format.h>

#include "queries.hpp"

namespace histories {

namespace {

using cases::Profile;

constexpr std::array<const char*, kWrongs> kWrongNames = {
    "nothing",         "is lost",        "depth ignored",   "depth reversed",
    "depth kept",      "bounds ignored", "stencil ignored", "stencil kept",
    "discard ignored", "discards all",   "early as late",   "face exchanged",
    "cull ignored",    "mask ignored",   "blend ignored",   "written twice"};

Seen any_history(const Scene& scene, const Place& place, Profile profile, const Fault& fault,
                 Random& random) {
    const Freedom freedom{profile, false, 0};
    const Kept kept = random.of(decisions_of(scene, place, freedom));
    return random.of(histories_of(scene, place, freedom, kept, fault));
}

// Changes what one plane that is delivered shows.
std::string change(const Scene& scene, const Planes& planes, Shown& sample, const Seen& other,
                   Random& random) {
    auto plane = static_cast<PlaneNumber>(random.below(kPlaneCount));
    while (!planes.has(plane)) {
        plane = static_cast<PlaneNumber>(random.below(kPlaneCount));
    }
    Seen& seen = sample[plane];
    size_t draw = random.below(static_cast<uint32_t>(scene.draws.size()));
    while (scene.draws[draw].clear) {  // one at least is none
        draw = random.below(static_cast<uint32_t>(scene.draws.size()));
    }
    const auto triangle = random.below(static_cast<uint32_t>(scene.draws[draw].triangles.size()));
    if (random.chance(1, 2)) {
        seen = other;
        return fmt::format("plane {} of another history", static_cast<int>(plane));
    }
    switch (plane) {
        case kHits:
            switch (random.below(3)) {
                case 0:
                    ++(random.chance(1, 2) ? seen.front : seen.back);
                    return "one hit more";
                case 1:
                    (seen.front != 0 ? seen.front : seen.back) -= seen.front + seen.back != 0;
                    return "one hit less";
                default:
                    std::swap(seen.front, seen.back);
                    return "faces exchanged";
            }
        case kWriter:
        case kFragCoord:
        case kAttributeV:
        case kAttributeA:
            seen.draw = static_cast<int>(draw);
            seen.triangle = static_cast<int>(triangle);
            seen.z = scene.draws[draw].triangles[triangle].z0;
            seen.a = static_cast<double>(random.below(4)) - 1;
            return fmt::format("plane {} of triangle {} of draw {}", static_cast<int>(plane),
                               triangle, draw);
        case kDepth:
            seen.depth = random.chance(1, 2) ? random.below(9) / 8.0
                                             : scene.draws[draw].triangles[triangle].z0;
            return "another depth";
        case kColor:
            seen.color = written(scene.colors[scene.judged].about(), seen.color, scene.draws[draw],
                                 scene.draws[draw].colors[scene.judged]);
            return fmt::format("written by draw {} once more", draw);
        default:
            seen.stencil =
                random.chance(1, 2) ? seen.stencil ^ (1U << random.below(8)) : random.below(4);
            return "another stencil";
    }
}

std::string make_wrong(const Scene& scene, const Planes& planes, Shown& sample, const Place& place,
                       Random& random) {
    const auto profile = cases::kProfiles[random.below(3)];
    const Seen other = any_history(scene, place, profile, {}, random);
    switch (random.below(3)) {
        case 0: {
            const Fault fault{static_cast<Wrong>(1 + random.below(kWrongs - 1)),
                              random.below(static_cast<uint32_t>(scene.draws.size()))};
            sample = shown(any_history(scene, place, profile, fault, random));
            return fmt::format("draw {}: {}", fault.draw,
                               kWrongNames[static_cast<size_t>(fault.what)]);
        }
        case 1:
            for (Seen& plane : sample) {
                plane = random.chance(1, 2) ? other : plane;
            }
            return "planes of two histories";
        default:
            return change(scene, planes, sample, other, random);
    }
}

}  // namespace

std::optional<WrongPicture> wrong_picture(const Scene& scene, const std::vector<Seen>& picture,
                                          Random& random) {
    const std::vector<Planes> subsets = subsets_of(scene);
    if (scene.has_query() && random.chance(1, 4)) {
        if (const auto wrong = wrong_count(scene, picture, random)) {
            return WrongPicture{
                shown(picture),
                whole_of(scene),
                0,
                wrong->counted,
                fmt::format("query of draw {} counts {} for {}", wrong->draw,
                            wrong->counted[wrong->draw], counted_of(scene, picture)[wrong->draw]),
                wrong->loosest};
        }
    }
    for (int tries = 0; tries < 16; ++tries) {
        WrongPicture out{shown(picture),
                         random.chance(1, 6) ? whole_of(scene) : random.of(subsets),
                         random.below(static_cast<uint32_t>(scene.sample_count())),
                         counted_of(scene, picture),
                         {},
                         {}};
        out.how = make_wrong(scene, out.planes, out.picture[out.index], place_of(scene, out.index),
                             random);
        for (const Profile profile : cases::kProfiles) {
            if (!is_allowed(scene, profile, out.planes, out.picture, out.index)) {
                out.loosest = profile;
                return out;
            }
        }
    }
    return std::nullopt;
}

}  // namespace histories
