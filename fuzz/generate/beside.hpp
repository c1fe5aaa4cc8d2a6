// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Colour targets beside the one of a generated case.
#pragma once

#include <string>

#include "fuzz/generate/dice.hpp"

namespace fuzz {

// A case's text with one to three more colour targets, if it has one, at locations before and
// behind it. What they hold is not judged, and may do nothing to what is. The dice are a turn's, so
// that its cases share pipelines.
std::string beside_others(std::string text, Dice dice);

}  // namespace fuzz
