// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "judge.hpp"

#include <utility>

#include "cases/load/loader.hpp"
#include "diff/delivered.hpp"
#include "scene_text.hpp"

namespace histories {

Judge::Judge(const Scene& scene) : scene_(scene) {
    auto loaded = cases::load_text(text_of(scene), "histories.toml", "histories");
    if (loaded) {
        case_ = std::move(loaded->at(0));
    } else {
        error_ = cases::to_string(loaded.error()[0]);
    }
}

diff::Verdict Judge::judge(const Planes& planes, const std::vector<Shown>& picture,
                           const std::vector<uint64_t>& counted, cases::Profile profile) {
    auto& expectation = expectations_[static_cast<size_t>(profile)];
    if (!expectation) {
        expectation = ref::expect(case_.value(), ref::Limits{8}, profile);
    }
    if (planes.is_whole) {
        return diff::compare(*case_, *expectation,
                             captured(scene_, case_->target, picture, counted));
    }
    return diff::compare_delivered(*case_, *expectation, delivered(scene_, planes, picture));
}

}  // namespace histories
