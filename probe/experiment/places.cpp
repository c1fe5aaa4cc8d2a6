// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where inputs are evaluated in pixels that a triangle covers in part: an input whose value is the
// position itself tells it.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>

#include "cases/model/sample.hpp"
#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

constexpr uint32_t kSide = 64, kCell = 16, kSamples = 4;
constexpr double kSame = 1.0 / 128;  // pixel; places that are told apart differ by 1/48 at least

struct Place {
    double x = 0, y = 0;  // in the pixel
};
bool is_near(const Place& a, const Place& b) {
    return std::fabs(a.x - b.x) < kSame && std::fabs(a.y - b.y) < kSame;
}
constexpr Place kCentre{0.5, 0.5};

// A pixel as one triangle covers it, and the sample that is looked at.
struct Seen {
    uint32_t covered = 0;  // bit s: sample s
    uint32_t sample = 0;
    bool is_whole() const { return covered == (1U << kSamples) - 1; }
};

double sixteenths(int64_t n) {
    return static_cast<double>(n) / 16;
}
double doubled_area(const std::array<Corner, 3>& c) {
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
}

Place location(uint32_t s) {
    const auto at = cases::standard_sample_locations(kSamples)[s];
    return {at[0] / 16.0, at[1] / 16.0};
}
uint32_t first_of(uint32_t covered) {
    return static_cast<uint32_t>(std::countr_zero(covered));
}
Place mean(const Seen& seen) {
    Place sum;
    const double n = std::popcount(seen.covered);
    for (uint32_t s = 0; s < kSamples; ++s) {
        if ((seen.covered >> s & 1U) != 0) {
            sum = {sum.x + location(s).x / n, sum.y + location(s).y / n};
        }
    }
    return sum;
}

// A possible answer: where the input is evaluated; nothing: this pixel tells nothing of it.
struct Candidate {
    const char* name;
    std::function<Place(const Seen&)> place;
};
std::vector<Candidate> candidates() {
    return {
        {"the pixel's centre", [](const Seen&) { return kCentre; }},
        {"the sample itself", [](const Seen& s) { return location(s.sample); }},
        {"the first covered sample where it is covered in part, else the centre",
         [](const Seen& s) { return s.is_whole() ? kCentre : location(first_of(s.covered)); }},
        // Of all four samples it is the centre.
        {"the mean of the covered samples", mean},
        {"the first covered sample", [](const Seen& s) { return location(first_of(s.covered)); }},
        {"the last covered sample where it is covered in part, else the centre",
         [](const Seen& s) {
             return s.is_whole() ? kCentre
                                 : location(static_cast<uint32_t>(std::bit_width(s.covered)) - 1);
         }},
        {"the sample numbered 0", [](const Seen&) { return location(0); }},
    };
}

// Triangles on the 1/16 grid with one vertex a value: the position, in pixels.
Scene make_scene(const std::string& id) {
    Scene scene(id, kSide, kSide, kSamples);
    scene.target().has_depth = false;
    Dice dice(31);
    for (uint32_t cell = 0; cell < (kSide / kCell) * (kSide / kCell); ++cell) {
        std::array<Corner, 3> c;
        do {
            for (Corner& p : c) {
                p = {(cell % (kSide / kCell)) * kCell + sixteenths(dice.whole(0, 16 * kCell)),
                     (cell / (kSide / kCell)) * kCell + sixteenths(dice.whole(0, 16 * kCell))};
            }
        } while (std::fabs(doubled_area(c)) < 48);  // in slivers rounding moves places, too
        scene.add(c[0], c[1], c[2]);
    }
    return scene;
}
void add_position(Scene& scene, cases::Auxiliary auxiliary) {
    cases::Attribute& a = scene.attribute("position", 2, cases::Interpolation::noperspective);
    a.auxiliary = auxiliary;
    for (const glm::vec4& p : scene.draw().positions) {
        a.values.emplace_back((p.x + 1) * (kSide / 2.0F), (p.y + 1) * (kSide / 2.0F), 0, 0);
    }
}

// Calls visit(seen, place) for every sample that was hit, with where `number` says it was looked
// at.
void for_each_seen(const capture::Capture& picture, const std::vector<glm::vec4>& plane,
                   const std::function<void(const Seen&, const Place&)>& visit) {
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            Seen seen;
            for (uint32_t s = 0; s < kSamples; ++s) {
                seen.covered |= is_hit(picture, x, y, s) ? 1U << s : 0U;
            }
            for (uint32_t s = 0; s < kSamples; ++s) {
                if ((seen.covered >> s & 1U) != 0) {
                    seen.sample = s;
                    const glm::vec4& v = plane[(size_t{y} * kSide + x) * kSamples + s];
                    visit(seen, {static_cast<double>(v.x) - x, static_cast<double>(v.y) - y});
                }
            }
        }
    }
}

void settle(Property& property, const capture::Capture& picture,
            const std::vector<glm::vec4>& plane) {
    const std::vector<Candidate> all = candidates();
    std::vector<std::string> names;
    for (const Candidate& c : all) {
        names.emplace_back(c.name);
    }
    Vote vote(names);
    uint64_t count = 0;
    uint64_t same = 0;
    std::optional<Place> always;
    for_each_seen(picture, plane, [&](const Seen& seen, const Place& place) {
        ++count;
        always = always ? always : place;
        same += is_near(*always, place) ? 1U : 0U;
        vote.add([&](size_t k) { return is_near(all[k].place(seen), place); });
    });
    vote.settle(property);
    if (!property.is_known() && always && same == count && !is_near(*always, kCentre)) {
        property.answer = fmt::format("always ({:.4f}, {:.4f}) in the pixel", always->x, always->y);
        property.agree = same;
        property.contradict = 0;
        property.why.clear();
    }
}

struct Question {
    const char* id;
    const char* question;
    cases::Auxiliary auxiliary;
    bool is_shaded;      // one invocation a sample is asked for
    bool is_frag_coord;  // FragCoord.xy instead of an input
};
constexpr auto kQuestions = std::to_array<Question>({
    {"samples.inputs", "Where undecorated inputs are evaluated", cases::Auxiliary::none, false,
     false},
    {"samples.centroid", "Where inputs at centroid are evaluated", cases::Auxiliary::centroid,
     false, false},
    {"samples.sample", "Where inputs at sample are evaluated", cases::Auxiliary::sample, false,
     false},
    {"samples.shaded_inputs", "Where undecorated inputs are evaluated with sample shading",
     cases::Auxiliary::none, true, false},
    {"samples.shaded_frag_coord", "Where FragCoord.xy lies with sample shading",
     cases::Auxiliary::none, true, true},
});

}  // namespace

void measure_places(const Bench& bench) {
    for (const Question& q : kQuestions) {
        Finding property(
            bench, q.id, fmt::format("{}, 4 samples a pixel", q.question),
            q.is_frag_coord
                ? "FragCoord.xy of triangles that cover pixels in part"
                : "an input that is the position, in triangles that cover pixels in part");
        Scene scene = make_scene(q.id);
        add_position(scene, q.auxiliary);
        if (q.is_shaded) {
            scene.draw().multisample.min_sample_shading = 1.0F;
        }
        const auto picture = bench.picture_of(scene.take(), property);
        if (!picture) {
            continue;
        }
        settle(property, *picture, q.is_frag_coord ? picture->frag_coord : picture->attributes[0]);
    }
}

}  // namespace probe
