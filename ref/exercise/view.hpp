// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of the table see of a sample.
#pragma once

#include "ref/exercise/case_facts.hpp"

namespace ref {

// One sample as a test sees it; the set-ups are those of the profile at which it looks.
struct View {
    CaseFacts& facts;
    const JudgedSample& sample;
    TriangleSetups& setups;
    const cases::Case& of() const { return facts.of(); }
    // Whether the attachments tell if triangle t is drawn there; instruments always do.
    bool shows(uint32_t t) const {
        return facts.shown() == nullptr || facts.shown()->shows(sample.index, sample.id, t);
    }
    // The same of the order of what is drawn there.
    bool shows_order() const {
        return facts.shown() == nullptr || facts.shown()->shows_order(sample.index, sample.id);
    }
};

}  // namespace ref
