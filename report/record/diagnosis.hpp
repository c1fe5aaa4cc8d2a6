// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a wrong device does, as far as it was found out by drawing failed cases with each of many
// errors on purpose (diagnosis/diagnose.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cases/base/fields.hpp"

namespace report {

struct Diagnosis {
    // Sentences without their full stop: what explains the failures, and the word for it. Several:
    // nothing that was tried tells them apart.
    std::vector<std::string> what, names;
    // Failed cases whose wrong samples and values it repeats, of those that it was tried on; the
    // first of them by id.
    uint64_t cases = 0, tried = 0;
    uint64_t failed = 0;  // cases in all, with those that were not tried; 0 in older journals
    std::vector<std::string> examples;
    // Ids of all failed cases that it was tried on: those that it repeats, and the others.
    std::vector<std::string> explained, unexplained;
    uint64_t samples = 0;  // wrong samples of these cases, of which it repeats
    uint64_t same_samples = 0;
    uint64_t values = 0;  // wrong values that were told of these cases, of which it repeats
    uint64_t same_values = 0;
    // Cases that failed otherwise than it would have them fail, and that passed though it would
    // have them fail; and how many that passed it was tried on.
    uint64_t against = 0, passed_against = 0, passed_tried = 0;
    static void fields(auto&& visit, auto&... d) {
        visit("what", d.what...);
        visit("names", d.names...);
        visit("cases", d.cases...);
        visit("tried", d.tried...);
        visit({"failed", cases::kOlderLackIt}, d.failed...);
        visit("examples", d.examples...);
        visit({"explained", cases::kOlderLackIt}, d.explained...);
        visit({"unexplained", cases::kOlderLackIt}, d.unexplained...);
        visit("samples", d.samples...);
        visit("same_samples", d.same_samples...);
        visit("values", d.values...);
        visit("same_values", d.same_values...);
        visit("against", d.against...);
        visit("passed_against", d.passed_against...);
        visit("passed_tried", d.passed_tried...);
    }
    friend bool operator==(const Diagnosis&, const Diagnosis&) = default;
};

}  // namespace report
