// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What to say to somebody who named a rule that there is not.
#pragma once

#include <string>
#include <string_view>

namespace cases {

// "did you mean 'depth.bias'?", with that quote, if a rule is near; else the rules of the
// family that the word names; else where all are listed. Inside a family only what follows the
// point is compared, for "depth.test" is near to "depth.bias" by its family alone.
std::string rule_hint(std::string_view word, char quote);

}  // namespace cases
