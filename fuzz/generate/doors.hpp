// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Other ways of the API for a generated case.
#pragma once

#include <string>

#include "fuzz/generate/dice.hpp"

namespace fuzz {

// A case's text with the relation that it goes through one to three doors, if it can take them. The
// dice are a turn's, so that its cases take the same.
std::string through_doors(std::string text, Dice dice);

}  // namespace fuzz
