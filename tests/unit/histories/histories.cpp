// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "histories.hpp"

#include <algorithm>

namespace histories {

namespace {

// Answers one after the other: every answer to the first question, with each all to the second...
class Answers {
  public:
    uint32_t pick(uint32_t count) {
        if (at_ == given_.size()) {
            given_.push_back({0, count});
        }
        return given_[at_++].answer;
    }
    // The next answers; false if all were given.
    bool next() {
        at_ = 0;
        while (!given_.empty() && ++given_.back().answer == given_.back().count) {
            given_.pop_back();
        }
        return !given_.empty();
    }

  private:
    struct Answer {
        uint32_t answer, count;
    };
    std::vector<Answer> given_;
    size_t at_ = 0;
};

size_t first_of_pixel(const Scene& scene, size_t index) {
    return index - index % scene.samples;
}

}  // namespace

std::vector<Seen> histories_of(const Scene& scene, const Place& place, const Freedom& freedom,
                               const Kept& kept, const Fault& fault) {
    std::vector<Seen> all;
    Answers answers;
    const Pick pick = [&](uint32_t count) { return answers.pick(count); };
    do {
        all.push_back(draw_sample(scene, place, freedom, kept, pick, fault));
    } while (answers.next());
    return all;
}

std::vector<Kept> decisions_of(const Scene& scene, const Place& place, const Freedom& freedom) {
    Kept none;
    for (const Draw& draw : scene.draws) {
        none.emplace_back(draw.triangles.size(), false);
    }
    std::vector<Kept> all = {none};
    for (size_t d = 0; d < scene.draws.size(); ++d) {
        const bool is_open = is_shared(scene, scene.draws[d], freedom) &&
                             is_sign_open(scene, scene.draws[d], place, freedom);
        for (size_t t = 0; is_open && t < none[d].size(); ++t) {
            const size_t count = all.size();
            for (size_t i = 0; i < count; ++i) {
                all.push_back(all[i]);
                all.back()[d][t] = true;
            }
        }
    }
    return all;
}

std::vector<Seen> picture_of(const Scene& scene, cases::Profile profile, Random& random) {
    const Freedom freedom{profile, true, random.bits()};
    const Pick pick = [&](uint32_t count) { return random.below(count); };
    std::vector<Seen> picture;
    Kept kept;
    for (size_t index = 0; index < scene.sample_count(); ++index) {
        const Place place = place_of(scene, index);
        if (place.sample == 0) {
            kept = random.of(decisions_of(scene, place, freedom));
        }
        picture.push_back(draw_sample(scene, place, freedom, kept, pick));
    }
    return picture;
}

bool is_allowed(const Scene& scene, cases::Profile profile, const Planes& planes,
                const std::vector<Shown>& picture, size_t index) {
    const Freedom freedom{profile, false, 0};
    const std::vector<Kept> decisions = decisions_of(scene, place_of(scene, index), freedom);
    // The judge tries out eight decisions of a pixel together, and asks its samples one by one
    // where there are more (diff/shared_decisions.hpp).
    const bool is_pixel = is_shared(scene, freedom) && decisions.size() <= 1U << 8U;
    const size_t first = is_pixel ? first_of_pixel(scene, index) : index;
    const size_t last = is_pixel ? first + scene.samples : index + 1;
    for (const Kept& kept : decisions) {
        bool is_right = true;
        for (size_t i = first; i < last && is_right; ++i) {
            const auto all = histories_of(scene, place_of(scene, i), freedom, kept);
            is_right = std::any_of(all.begin(), all.end(), [&](const Seen& seen) {
                return shows(scene, planes, picture[i], seen);
            });
        }
        if (is_right) {
            return true;
        }
    }
    return false;
}

}  // namespace histories
