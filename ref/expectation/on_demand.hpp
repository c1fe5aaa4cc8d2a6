// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The expectation of a scene, sample by sample as it is asked for: of a looser profile only the
// samples matter that a device has wrong.
#pragma once

#include <cstddef>
#include <functional>

#include "ref/expectation/expectation.hpp"
#include "ref/expectation/scene.hpp"

namespace ref {

class OnDemand {
  public:
    explicit OnDemand(Scene& scene) : with_(expect_on_demand(scene)) {}  // keeps the reference

    // An expectation that says of sample `index` what expect(scene) says; of samples that were
    // never asked for it may say that nothing hits them. Always the same object, which grows.
    const Expectation& at(size_t index) { return with_(index); }

  private:
    std::function<const Expectation&(size_t)> with_;
};

}  // namespace ref
