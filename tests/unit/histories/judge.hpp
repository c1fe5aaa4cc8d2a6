// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "diff/verdict.hpp"
#include "planes.hpp"
#include "scene.hpp"

namespace histories {

// The judge of a scene's case.
class Judge {
  public:
    explicit Judge(const Scene& scene);
    // What is wrong with the case's text; empty if nothing is.
    const std::string& error() const { return error_; }
    diff::Verdict judge(const Planes& planes, const std::vector<Shown>& picture,
                        const std::vector<uint64_t>& counted, cases::Profile profile);

  private:
    Scene scene_;
    std::string error_;
    std::optional<cases::Case> case_;
    std::array<std::optional<ref::Expectation>, 3> expectations_;
};

}  // namespace histories
