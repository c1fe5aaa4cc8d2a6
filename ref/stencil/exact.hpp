// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ref/stencil/outcome.hpp"

namespace ref::stencil::exact {

// The oracle: each course by itself, from the first fragment to the last, with the test and the
// operations bit by bit.
Resolution resolve(const Question& question);

}  // namespace ref::stencil::exact
