// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case would be with another word or number in the place of one that it has: another format
// of the same attachment, another sample count. Those that pass tell what a finding needs.
#pragma once

#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "fuzz/document/document.hpp"

namespace fuzz {

struct Neighbour {
    cases::Case data;
    std::string place;  // what has another value, alike for all neighbours there: "the format {}"
    std::string value;  // "rgba16-float"
    std::string now;    // the value that the document has
};

// All that load: formats of the colour target and of depth, sample counts, and the words of keys
// that the document has.
std::vector<Neighbour> neighbours(const Document& document);

// Sentences of those that pass, one for each place: "with the format rgba16-float or r32-float in
// place of rgba8-unorm". `judged` are the neighbours that a device drew and somebody judged.
std::vector<std::string> sentences(const std::vector<Neighbour>& all,
                                   const std::vector<bool>& judged,
                                   const std::vector<bool>& passes);

}  // namespace fuzz
