// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A datasheet for a terminal.
#pragma once

#include <string>

#include "probe/base/datasheet.hpp"

namespace probe {

// A line a property: question, answer, how many decisive observations agree and contradict; under
// it what was measured, or why nothing can be told. `is_long` adds the experiments.
std::string to_text(const Datasheet& sheet, bool is_long);

// "62 of 73 properties could be told".
std::string how_many_are_known(const Datasheet& sheet);
// "513 of 513": the decisive observations that agree with the answer; empty without any.
std::string sureness(const Property& property);
// "largest error 0.31 budgets, mean error 0.002 budgets"; empty without any.
std::string figures_text(const Property& property);

}  // namespace probe
